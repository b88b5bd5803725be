// Renders explanations as headings, MathML matrices and coordinate tables.
//
// A step is `{id, title, formula, items: [{id, name, value}]}`; a value is a number, a vector, `{rows}` or text.

import { element, formatNumber, math } from './dom.js';
import { resourceUrl, server } from './resources.js';
import { term } from './texts.js';

/** Renders steps for the matrix pane. @param {object[]} steps @param {(value: any) => string} word */
export function stepsWithMatrices(steps, word) {
  return steps.map((step) =>
    element('div', { class: 'step', 'data-step': step.id }, heading(step, word), matrices(step, word), valueList(step, word)),
  );
}

function heading({ title, formula }, word) {
  return element('h4', {}, term(word(title)), ' ', element('span', { class: 'formula' }, ...codes(formula ?? '')));
}

/** Links formula ids to their entries on the server. A static page has no entries. @param {string} formula */
function codes(formula) {
  if (!server.native || formula === '') return [formula];
  const link = (id) => element('a', { href: resourceUrl(`reference/${id}`), target: '_blank', rel: 'noopener' }, id);
  return formula.split(', ').flatMap((id, i) => (i > 0 ? [', ', link(id)] : [link(id)]));
}

/** Renders the matrices of a step side by side. */
function matrices({ items }, word) {
  const shown = items.filter(({ value }) => value?.rows);
  const figures = shown.map(({ id, name, value }) =>
    element('figure', { 'data-item': id }, matrix(value.rows), element('figcaption', {}, term(word(name)))),
  );
  return element('div', { class: 'factors' }, ...figures);
}

/** Renders a matrix in brackets. @param {number[][]} rows */
export function matrix(rows) {
  const table = math('mtable', ...rows.map((row) => math('mtr', ...row.map((entry) => math('mtd', numberOf(entry))))));
  return math('math', math('mrow', math('mo', '['), table, math('mo', ']')));
}

const numberOf = (value) => math('mn', formatNumber(value));

/** Renders all values except matrices, with their names. */
function valueList({ items }, word) {
  const others = items.filter(({ value }) => !value?.rows);
  const entries = others.flatMap(({ id, name, value }) => [
    element('dt', {}, term(word(name))),
    element('dd', { 'data-item': id }, valueText(value, word)),
  ]);
  return entries.length > 0 ? element('dl', {}, ...entries) : '';
}

/** Formats a value as text. */
export function valueText(value, word) {
  if (typeof value === 'number') return formatNumber(value);
  if (Array.isArray(value)) return value.every((one) => typeof one === 'number') ? `(${value.map(formatNumber).join(', ')})` : value.map((one) => valueText(one, word)).join(', ');
  return value === null || value === undefined ? '' : word(value);
}

/** Renders a point's coordinates, one row per space. @param {object[]} spaces @param {string[]} heads */
export function journeyTable(spaces, word, heads) {
  const row = ({ space, label, value }) => {
    const cells = ['x', 'y', 'z', 'w'].map((axis, i) =>
      element('td', { 'data-axis': axis }, value ? (i < value.length ? formatNumber(value[i]) : '') : '–'),
    );
    return element('tr', { 'data-space': space }, element('th', { scope: 'row' }, word(label)), ...cells);
  };
  const head = element('tr', {}, ...heads.map((text) => element('th', { scope: 'col' }, text)));
  return element('table', { class: 'journey' }, element('thead', {}, head), element('tbody', {}, ...spaces.map(row)));
}

/** Renders a table of numbers. @param {string[]} columns @param {number[][]} rows */
export function plainTable(columns, rows) {
  const head = element('tr', {}, ...columns.map((text) => element('th', { scope: 'col' }, text)));
  const body = rows.map((row) => element('tr', {}, ...row.map((value) => element('td', {}, formatNumber(value)))));
  return element('table', {}, element('thead', {}, head), element('tbody', {}, ...body));
}
