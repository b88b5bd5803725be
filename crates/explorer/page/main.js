// The explorer page: lessons, controls and panes around one engine in a worker.

import { EngineClient } from './client.js';
import { buildControls } from './controls.js';
import { byId, element } from './dom.js';
import { acceptDrops, copyText, findModel, isModel, isScene, namedFiles, saveFile } from './files.js';
import { Panes, SIZE, makeOrbit, makePick } from './panes.js';
import { chooseNative, preferences } from './preferences.js';
import { server } from './resources.js';
import { State } from './state.js';
import { journeyTable, plainTable, stepsWithMatrices } from './tables.js';
import { applyTexts, sentence, sourceName, text, word } from './texts.js';

const client = new EngineClient(chooseNative());
const panes = new Panes(client, { query: () => state.query(), showState, fail: showError, settled });
let state = new State('');
/** @type {any[]} */
let lessons = [];
/** Scene file styles. @type {string[]} */
let styles = [];
/** @type {any} */
let lesson = null;
/** The engine's last answer to `what=state`. @type {any} */
let shown = null;
let updateControls = () => {};

/** For tests and measurements. */
globalThis.explorer = { panes, client };

start();

async function start() {
  preferences(applyLanguage);
  try {
    ({ lessons, styles = [] } = await client.askJson('v=1&what=lessons'));
  } catch (error) {
    byId('title').textContent = '';
    document.querySelector('.panes').hidden = true;
    const isTold = error.code && error.code !== 'worker-died';
    showNotice(isTold ? error.message : text('notStarted', error.message), error.help || text('notStartedHelp'));
    return;
  }
  applyLanguage();
  await openLink(location.hash.slice(1) || server.open || '');
  addEventListener('hashchange', () => openLink(location.hash.slice(1)));
}

/** Returns the user's last file that a lesson can show. */
function ownFile(id) {
  const isOwn = { model: isModel, scene: isScene }[id] ?? (() => false);
  return [...(server.files ?? []), ...client.files.keys()].findLast(isOwn);
}

/** Returns the lessons in the menu. Lessons without a model are omitted if no file can be opened. */
function offered() {
  return lessons.filter(({ id, models }) => models.length > 0 || !client.native || ownFile(id));
}

/** Whether the lesson shows the user's file, and there is none. */
function isEmpty() {
  return lesson.models.length === 0 && !state.get('model');
}

/** Opens a link. A malformed link is reported, and its lesson opens with defaults. */
async function openLink(link) {
  if (lesson && new State(link).query() === state.query()) return;
  hideNotice();
  const asked = link.replace(/(^|&)lang=[^&]*/, '') || `v=1&lesson=${lessons[0].id}`;
  const known = lessons.find(({ id }) => id === new URLSearchParams(asked).get('lesson')) ?? lessons[0];
  let query = asked;
  try {
    query = (await client.askJson(`${asked}&what=state&size=${SIZE.join('x')}`)).link;
  } catch (error) {
    const isMissing = error.code === 'missing_model';
    // Without any model, the text of the lesson says how to begin.
    if (!isMissing || asked.includes('model=')) showNotice(error.message, `${sentence(error.help)} ${isMissing ? '' : text('badLinkHelp')}`.trim());
    query = `v=1&lesson=${known.id}`;
  }
  if (lesson) state.replace(query.replace(/^#/, ''));
  else state = new State(query.replace(/^#/, ''));
  showLesson();
}

/** Shows the text, controls and panes of the current lesson. */
function showLesson() {
  const chosen = lessons.find(({ id }) => id === state.get('lesson')) ?? lessons[0];
  const isNew = chosen !== lesson;
  lesson = chosen;
  shown = null;
  byId('lesson').value = lesson.id;
  byId('source').textContent = sourceName(lesson.source);
  byId('title').textContent = word(lesson.title);
  const hint = text(client.native ? 'startNative' : 'startModel');
  byId('statement').textContent = isEmpty() ? `${word(lesson.statement)} ${hint}` : word(lesson.statement);
  document.body.classList.toggle('empty', isEmpty());
  document.title = `${word(lesson.title)} – Alberti explorer`;
  updateControls = buildControls(byId('parameters'), [...lesson.parameters, styleParameter()], { value: valueOf, change: changeState, word });
  buildPinControls();
  for (const section of document.querySelectorAll('[data-pane]')) {
    const name = section.dataset.pane;
    section.hidden = name === 'pick' ? isNew || section.hidden : !lesson.panes.includes(name);
  }
  if (isNew) {
    document.querySelector('.cursor').hidden = true;
    byId('depth-details').open = lesson.id === 'depth-table';
  }
  panes.select(isEmpty() ? null : lesson.panes);
  stateChanged();
}

/** Returns the value of a parameter from the state, or its default. */
function valueOf(key) {
  return state.get(key) ?? String(lesson.parameters.find((one) => one.key === key)?.default ?? '');
}

/** Returns the style parameter, which every lesson has. */
function styleParameter() {
  const choices = styles.map((style) => ({ value: style, label: style }));
  return { key: 'style', kind: 'choice', label: text('style'), choices: [{ value: '', label: text('styleDefault') }, ...choices] };
}

/** Changes the state after a control moved. An empty value restores the default. */
function changeState(key, value) {
  state.set(key, value);
  stateChanged();
}

/** Updates controls, link and the named panes, or all panes, after a change. */
function stateChanged(names) {
  delete document.body.dataset.settled;
  updateControls();
  updatePin();
  byId('undo').disabled = state.past.length === 0;
  byId('redo').disabled = state.future.length === 0;
  panes.change(names);
}

/** Once all panes show the state, updates the link and announces the consequences. */
function settled() {
  const hash = `#${state.query()}`;
  if (location.hash !== hash) history.replaceState(null, '', hash);
  const said = (shown?.consequences ?? []).map(word).join(' ');
  if (byId('status').dataset.said !== said) {
    byId('status').dataset.said = said;
    byId('status').textContent = said;
  }
  document.body.dataset.settled = state.query();
}

/** Shows the state as text and numbers. */
function showState(answer) {
  shown = answer;
  hideNotice('engine');
  updatePin();
  byId('consequences').replaceChildren(...(answer.consequences ?? []).map((one) => element('li', {}, word(one))));
  byId('matrix').replaceChildren(...stepsWithMatrices(answer.matrix.steps, word));
  showJourney(answer);
  showLegend(answer);
  byId('depth').alt = text('depthLabel');
  showDepthTable(answer.depth_table);
  // No scene file describes a wrong picture.
  for (const id of ['copy-command', 'copy-scene']) byId(id).disabled = answer.scene === null;
}

/** Shows distances, depths, and the smallest step that the buffer resolves. */
function showDepthTable(table) {
  byId('depth-details').hidden = !table;
  if (!table) return;
  byId('depth-table').replaceChildren(plainTable(table.columns.map(word), table.rows));
}

/** Shows the pinned point in every space, its outcode and, on demand, every step. */
function showJourney({ journey, outcode }) {
  const heads = [text('space'), 'x', 'y', 'z', 'w'];
  byId('journey').replaceChildren(journeyTable(journey.spaces, word, heads));
  const planes = outcode.outside_of.map(word).join(', ');
  byId('outcode').textContent = outcode.is_inside
    ? text('outcodeInside', outcode.bits)
    : text('outcodeOutside', outcode.bits, planes);
  byId('steps').replaceChildren(...stepsWithMatrices(journey.steps, word));
}

/** Shows the meaning of the triangle colors, with triangle counts. */
function showLegend({ colors, facts }) {
  for (const legend of document.querySelectorAll('.legend')) {
    const names = ['inside', 'clipped', 'outside'].filter((name) => colors?.[name] && name in facts);
    const shownNames = legend.dataset.of === 'volume' ? names.filter((name) => name !== 'outside') : names;
    legend.replaceChildren(
      ...shownNames.map((name) => {
        const swatch = element('i', { 'aria-hidden': 'true' });
        swatch.style.background = colors[name];
        return element('li', {}, swatch, `${text(name)}: ${facts[name]}`);
      }),
    );
  }
}

// ---- The pinned point

/** Returns the pinned point: the chosen point, or the engine's choice. */
function pinOf() {
  return state.get('pin')?.split(',').map(Number) ?? shown?.pin ?? lesson.pin;
}

function buildPinControls() {
  const fields = ['x', 'y', 'z'].map((axis, i) => {
    const input = element('input', { type: 'number', step: 'any', id: `pin-${axis}` });
    input.addEventListener('change', () => {
      const pin = pinOf();
      if (input.value === '') return updatePin();
      pin[i] = input.valueAsNumber;
      return changeState('pin', pin.join(','));
    });
    return element('label', {}, axis, ' ', input);
  });
  byId('pin').replaceChildren(element('fieldset', {}, element('legend', {}, text('pinLabel')), ...fields));
}

function updatePin() {
  const pin = pinOf();
  ['x', 'y', 'z'].forEach((axis, i) => {
    const input = byId(`pin-${axis}`);
    if (input && (input.value === '' || Number(input.value) !== pin[i])) input.value = String(Number(pin[i]?.toPrecision(6)));
  });
}

/** Explains a pixel, and pins the surface point there. */
async function pick(pixel) {
  try {
    const query = `${state.query()}&what=pick&pixel=${pixel.join(',')}&size=${SIZE.join('x')}`;
    const answer = await client.askJson(query);
    const steps = stepsWithMatrices(answer.steps ?? answer.explanation?.steps ?? [], word);
    const verdict = word(answer.verdict ?? answer.explanation?.verdict);
    byId('pick').replaceChildren(element('p', { class: 'verdict' }, verdict), ...steps);
    document.querySelector('[data-pane=pick]').hidden = false;
    byId('status').textContent = verdict;
    if (answer.position) changeState('pin', answer.position.join(','));
  } catch (error) {
    showError(error);
  }
}

// ---- Menu, buttons, keys

function applyLanguage() {
  applyTexts();
  if (client.native) byId('engine').textContent = text('native');
  document.querySelector('.files').hidden = client.native;
  const groups = new Map();
  for (const { id, source, title } of offered()) {
    if (!groups.has(source)) groups.set(source, element('optgroup', { label: sourceName(source) }));
    groups.get(source).append(element('option', { value: id }, word(title)));
  }
  byId('lesson').replaceChildren(...groups.values());
  if (lesson) showLesson();
}

/** The last state of each lesson. @type {Map<string, string>} */
const visited = new Map();

/** Opens a lesson as it was left, or with its default values. */
function openLesson(id) {
  if (!isEmpty()) visited.set(lesson.id, state.query());
  const own = ownFile(id);
  const link = visited.get(id) ?? `v=1&lesson=${id}${own ? `&model=${encodeURIComponent(own)}` : ''}`;
  history.pushState(null, '', `#${link}`);
  openLink(link);
}

function stepLesson(by) {
  const all = offered();
  openLesson(all.at((all.indexOf(lesson) + by) % all.length).id);
}

function undo() {
  if (state.undo()) showLesson();
}

function redo() {
  if (state.redo()) showLesson();
}

async function copy(words) {
  if (await copyText(words)) byId('status').textContent = text('copied');
}

/** Requests a file and saves it. */
async function save(what, name, type) {
  try {
    const { bytes } = await client.ask(`${state.query()}&what=${what}&size=${SIZE.join('x')}`);
    saveFile(name, type, bytes);
    byId('status').textContent = text('saved', name);
  } catch (error) {
    showError(error);
  }
}

/** Opens one of the user's models with the files it refers to. @param {File[]} files */
async function openFiles(files) {
  const { model, isHuge, megabytes } = findModel(files);
  if (!model) return showNotice(text('noModel'), text('noModelHelp'));
  if (isHuge) return showNotice(text('hugeModel', model.name, megabytes), text('hugeModelHelp'));
  const link = `v=1&lesson=${isScene(model.name) ? 'scene' : 'model'}&model=${encodeURIComponent(model.name)}`;
  try {
    for (const [name, file] of await namedFiles(files)) await client.addFile(name, file);
    // A broken model must not change anything.
    await client.ask(`${link}&what=state`);
    await openLink(link);
  } catch (error) {
    if (error.code === 'worker-died') showError(error);
    else showNotice(`${model.name}: ${error.message}`, error.help);
  }
}

byId('lesson').addEventListener('change', (event) => openLesson(event.target.value));
byId('previous').addEventListener('click', () => stepLesson(-1));
byId('next').addEventListener('click', () => stepLesson(1));
byId('undo').addEventListener('click', undo);
byId('redo').addEventListener('click', redo);
byId('reset').addEventListener('click', () => {
  const model = state.get('model');
  state.replace(`v=1&lesson=${lesson.id}${model ? `&model=${encodeURIComponent(model)}` : ''}`);
  showLesson();
});
byId('copy-link').addEventListener('click', () => copy(`${location.href.replace(/#.*/, '')}#${state.query()}`));
byId('copy-command').addEventListener('click', () => copy(shown?.command ?? ''));
byId('copy-scene').addEventListener('click', () => copy(shown?.scene ?? ''));
byId('save-picture').addEventListener('click', () => save('picture&format=png&samples=4', `${lesson.id}.png`, 'image/png'));
byId('save-drawing').addEventListener('click', () => save('drawing', `${lesson.id}.svg`, 'image/svg+xml'));
byId('files').addEventListener('change', (event) => openFiles([...event.target.files]));
byId('parameters').addEventListener('submit', (event) => event.preventDefault());
byId('pin').addEventListener('submit', (event) => event.preventDefault());
acceptDrops(openFiles);
addEventListener('keydown', (event) => {
  const key = event.key.toLowerCase();
  const isText = event.target.matches?.('input[type=number], textarea');
  if (!(event.ctrlKey || event.metaKey) || event.altKey || isText || !['z', 'y'].includes(key)) return;
  event.preventDefault();
  if (key === 'y' || event.shiftKey) redo();
  else undo();
});

for (const [name, key] of [['world', 'orbit'], ['volume', 'volume_orbit']]) {
  makeOrbit(byId(name), {
    angles: () => state.get(key)?.split(',').map(Number) ?? lesson?.[key] ?? [35, 20],
    turn(angles) {
      state.set(key, angles.join(','));
      stateChanged([name]);
    },
  });
}
makePick(byId('picture'), document.querySelector('.cursor'), {
  move: ([x, y]) => (byId('status').textContent = text('cursorAt', x, y)),
  pick,
});

// ---- Messages

function showNotice(message, help, kind = '') {
  byId('notice-message').textContent = sentence(message);
  byId('notice-help').textContent = sentence(help ?? '');
  byId('notice').dataset.kind = kind;
  byId('notice').hidden = false;
}

function hideNotice(kind) {
  if (kind === undefined || byId('notice').dataset.kind === kind) byId('notice').hidden = true;
}

/** Shows an error from the engine or the worker. */
function showError(error) {
  if (shown === null) panes.clear();
  if (error.code === 'worker-died') showNotice(text('died', error.message), text('diedHelp'), 'engine');
  else showNotice(error.message, error.help, 'engine');
}
client.onStop = (error) => {
  if (lesson) showError(error);
};
byId('notice-close').addEventListener('click', () => hideNotice());
