// Controls for a lesson's parameters: native inputs with labels, units and limits.

import { element, formatNumber } from './dom.js';
import { text } from './texts.js';

/**
 * Fills the form with a lesson's parameters.
 * @param {HTMLFormElement} form
 * @param {object[]} parameters as the engine lists them
 * @param {{value: (key: string) => string, change: (key: string, value: string) => void, word: (texts: object) => string}} page
 * @returns {() => void} updates the controls from the state
 */
export function buildControls(form, parameters, page) {
  const controls = parameters.map((parameter) =>
    parameter.kind === 'choice' ? choiceControl(parameter, page) : numberControl(parameter, page),
  );
  form.replaceChildren(...controls.map((control) => control.element));
  return () => controls.forEach((control) => control.update());
}

function choiceControl(parameter, page) {
  const id = `parameter-${parameter.key}`;
  const options = parameter.choices.map(({ value, label }) => element('option', { value }, page.word(label)));
  const select = element('select', { id, name: parameter.key }, ...options);
  select.addEventListener('change', () => page.change(parameter.key, select.value));
  const label = element('label', { for: id }, page.word(parameter.label));
  return {
    element: element('div', { class: 'control choice' }, label, select),
    update: () => (select.value = page.value(parameter.key)),
  };
}

function numberControl(parameter, page) {
  const { key, min, max, step, unit } = parameter;
  const id = `parameter-${key}`;
  const name = page.word(parameter.label);
  const attributes = { min, max, step, name: key };
  const range = element('input', { type: 'range', id, ...attributes });
  const number = element('input', {
    type: 'number',
    id: `${id}-number`,
    ...attributes,
    step: 'any',
    'aria-label': unit ? `${name} (${unit})` : name,
    'aria-describedby': `${id}-limits ${id}-error`,
  });
  range.addEventListener('input', () => page.change(key, range.value));
  const error = element('span', { class: 'error', id: `${id}-error`, 'aria-live': 'polite' });
  const showValidity = () => {
    const isValid = number.checkValidity();
    number.setAttribute('aria-invalid', !isValid);
    error.textContent = isValid ? '' : text('limits', formatNumber(min), formatNumber(max));
    return isValid;
  };
  number.addEventListener('input', () => {
    if (showValidity() && number.value !== '') page.change(key, String(number.valueAsNumber));
  });
  number.addEventListener('change', () => {
    if (number.value === '' && showValidity()) number.value = page.value(key);
  });
  const row = element(
    'div',
    { class: 'control' },
    element('label', { for: id }, name),
    element('span', { class: 'value' }, number, element('span', { class: 'unit' }, unit ?? '')),
    element(
      'span',
      { class: 'track', id: `${id}-limits` },
      element('small', {}, formatNumber(min)),
      range,
      element('small', {}, formatNumber(max)),
    ),
    error,
  );
  return {
    element: row,
    update() {
      const value = page.value(key);
      range.value = value;
      range.setAttribute('aria-valuetext', unit ? `${formatNumber(Number(value))} ${unit}` : formatNumber(Number(value)));
      if (Number(number.value) !== Number(value) || number.value === '') number.value = value;
      showValidity();
    },
  };
}
