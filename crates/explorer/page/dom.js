// DOM elements and number formatting.

/** Creates an element with attributes and children. @param {string} name */
export function element(name, attributes = {}, ...children) {
  const created = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) created.setAttribute(key, String(value));
  created.append(...children);
  return created;
}

/** Creates a MathML element. @param {string} name */
export function math(name, ...children) {
  const created = document.createElementNS('http://www.w3.org/1998/Math/MathML', name);
  created.append(...children);
  return created;
}

/** Formats a number with at most five significant digits and a true minus sign. @param {number} value */
export function formatNumber(value) {
  if (typeof value !== 'number') return String(value);
  if (Math.abs(value) < 5e-13) return '0';
  const rounded = Number(value.toPrecision(5));
  const text = Math.abs(rounded) >= 1e7 || Math.abs(rounded) < 1e-5 ? rounded.toExponential() : String(rounded);
  return text.replaceAll('-', '−');
}

/** Returns the element with an id. @param {string} id @returns {any} */
export const byId = (id) => document.getElementById(id);
