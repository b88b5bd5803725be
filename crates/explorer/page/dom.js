// Elements of the page, and numbers as they are read.

/** An element with attributes and children. @param {string} name */
export function element(name, attributes = {}, ...children) {
  const created = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) created.setAttribute(key, String(value));
  created.append(...children);
  return created;
}

/** An element of MathML. @param {string} name */
export function math(name, ...children) {
  const created = document.createElementNS('http://www.w3.org/1998/Math/MathML', name);
  created.append(...children);
  return created;
}

/** A number with five significant digits at most and a true minus sign. @param {number} value */
export function formatNumber(value) {
  if (typeof value !== 'number') return String(value);
  if (Math.abs(value) < 5e-13) return '0';
  const rounded = Number(value.toPrecision(5));
  const text = Math.abs(rounded) >= 1e7 || Math.abs(rounded) < 1e-5 ? rounded.toExponential() : String(rounded);
  return text.replaceAll('-', '−');
}

/** The element with an id. @param {string} id @returns {any} */
export const byId = (id) => document.getElementById(id);
