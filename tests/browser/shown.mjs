// What every lesson shows: texts and pictures in both languages, and the effect of every parameter.

import { Explorer, assert } from './harness.mjs';

/** Words that only a mistake in the page or the engine shows. */
const BROKEN = /undefined|NaN|\[object|Infinity|\binf\b/;

/** The panes with pictures, and the elements of the panes with text. */
const PICTURES = ['picture', 'world', 'volume', 'depth'];
const TEXTS = { consequences: '#consequences', journey: '#journey', matrix: '#matrix', table: '#depth-table' };

/** Parameters that have an effect only with other values. They are tested with these. */
const REQUIRED = {
  'exercises t': '&exercise=11',
  // Both frustums are the same if the window is centered.
  'frustum apex': '&left=-1',
};

/** The values at which clipping planes reach the model. They must be told, too. Others move by a third of their range. */
const VALUES = { near: 'max', far: 'min', n: 'min', f: 'max' };

/** The panes that a parameter must change unless this table lists it. */
const USUAL = ['picture', 'world', 'volume', 'consequences', 'matrix'];
const UNSAID = ['picture', 'world', 'volume', 'matrix'];
const MUST_CHANGE = {
  // A viewport changes neither the view volume nor what is in it. Its place is in the sentence and in the last row of the journey.
  'viewport x': ['picture', 'consequences', 'journey'],
  'viewport y': ['picture', 'consequences', 'journey'],
  'viewport width': ['picture', 'consequences', 'journey', 'matrix'],
  'viewport height': ['picture', 'consequences', 'journey', 'matrix'],
  'window-viewport fit': ['picture', 'consequences', 'journey', 'matrix'],
  'window-viewport width': ['picture', 'consequences', 'journey', 'matrix'],
  // The width limits the scale of a letterbox, so a different height only changes the bars.
  'window-viewport height': ['picture'],
  'window-viewport window_height': UNSAID,
  // The mouse does not move the camera.
  'picking x': ['world', 'volume', 'consequences'],
  'picking y': ['world', 'volume', 'consequences'],
  // Both orders have the same camera.
  'tear order': ['picture', 'volume', 'consequences'],
  // The steps lead from one view to one picture.
  'normalization step': ['volume'],
  'normalization far': UNSAID,
  // The eyes do not move. Both pictures are described by the same sentences.
  'stereo mode': ['picture', 'journey', 'matrix'],
  // The point moves along the ridge, in the same view.
  'exercises t': ['picture', 'world', 'volume', 'consequences', 'journey'],
  'two-point horizon': UNSAID,
  'two-point fraction': UNSAID,
  'three-point x': UNSAID,
  'three-point z': UNSAID,
  'three-point horizon': UNSAID,
  // The sentences are about the grid, which has the same shape from everywhere.
  'mexican-hat mesh': ['picture'],
  'mexican-hat azimuth': UNSAID,
  'mexican-hat elevation': UNSAID,
  'mexican-hat fov': UNSAID,
};

/** Opens all details, and returns the text that is visible. */
function visibleText({ page }) {
  return page.evaluate(() => {
    for (const details of document.querySelectorAll('details')) details.open = true;
    return document.body.innerText;
  });
}

/** Returns the pixels of each visible picture and the text of each visible text. */
function snapshot({ page }) {
  return page.evaluate(
    async ([pictures, texts]) => {
      for (const details of document.querySelectorAll('details')) details.open = true;
      const isVisible = (node) => node.getClientRects().length > 0;
      const found = {};
      for (const name of pictures) {
        const node = document.getElementById(name);
        if (!isVisible(node)) continue;
        const drawn = node.tagName === 'CANVAS' ? node : Object.assign(document.createElement('canvas'), { width: 640, height: 400 });
        if (drawn !== node) {
          await node.decode();
          drawn.getContext('2d').drawImage(node, 0, 0, 640, 400);
        }
        found[name] = drawn.toDataURL();
      }
      for (const [name, selector] of Object.entries(texts)) {
        const node = document.querySelector(selector);
        if (isVisible(node)) found[name] = node.innerText;
      }
      return found;
    },
    [PICTURES, TEXTS],
  );
}

/** Fails if a text shows a broken value, or a visible picture has a single color. */
async function checkShown(explorer, language) {
  const text = await visibleText(explorer);
  const broken = text.split('\n').filter((line) => BROKEN.test(line));
  assert(broken.length === 0, `${language}: ${broken.slice(0, 3).join(' | ')}`);
  for (const pane of ['picture', 'world', 'volume']) {
    if (await explorer.page.locator(`#${pane}`).isVisible()) assert((await explorer.colors(pane)) > 1, `${language}: ${pane} has one color`);
  }
}

/** Fails unless the table of depths has numbers with rising distances below the engine's words. */
async function checkDepthTable({ page }, heads) {
  const cells = await page.locator('#depth-table tr').evaluateAll((rows) => rows.map((row) => [...row.cells].map((cell) => cell.innerText)));
  assert(cells[0].join() === heads.join(), cells[0].join());
  const rows = cells.slice(1).map((row) => row.map((cell) => Number(cell.replaceAll('−', '-'))));
  assert(rows.length === 16 && rows.flat().every(Number.isFinite), JSON.stringify(rows));
  assert(rows.every((row, i) => i === 0 || (row[0] > rows[i - 1][0] && row[2] > 0)), JSON.stringify(rows));
  assert(rows[0][1] === -1 && rows[15][1] === 1, JSON.stringify(rows));
}

/** Changes a control to another option, or to another value within its limits. */
async function changeControl({ page }, { id, key, options, ...control }) {
  const before = await page.evaluate(() => location.hash);
  if (options) {
    await page.locator(`#${id}`).selectOption(key === 'style' ? 'Normals' : options.find((value) => value !== control.value));
  } else {
    const [min, max, value] = [control.min, control.max, control.value].map(Number);
    const third = value + (max - value > value - min ? max - value : min - value) / 3;
    await page.locator(`#${id}-number`).fill(control[VALUES[key]] ?? third.toFixed(2));
  }
  await page.waitForFunction((old) => location.hash !== old, before);
}

function controls({ page }) {
  return page.locator('#parameters input[type=range], #parameters select').evaluateAll((all) =>
    all.map((one) => ({
      id: one.id,
      key: one.name,
      value: one.value,
      min: one.min,
      max: one.max,
      options: one.options && [...one.options].map((option) => option.value),
    })),
  );
}

/** Tests one lesson: everything that it shows in both languages, and each of its parameters. */
async function testLesson(explorer, { id, hash }, test, engine) {
  const { page } = explorer;
  await test(`${engine}: ${id}: nothing broken is shown in either language`, async () => {
    await explorer.goTo(hash);
    for (const language of ['zh', 'en']) {
      await page.selectOption('#language', language);
      await explorer.settled();
      await checkShown(explorer, language);
    }
  });
  await test(`${engine}: ${id}: every parameter changes its panes`, async () => {
    const problems = [];
    for (const control of await controls(explorer)) {
      const name = `${id} ${control.key}`;
      await explorer.goTo(hash + (REQUIRED[name] ?? ''));
      const before = await snapshot(explorer);
      await changeControl(explorer, control);
      await explorer.settled();
      const after = await snapshot(explorer);
      const changed = Object.keys(before).filter((pane) => before[pane] !== after[pane]);
      const wanted = control.key === 'style' ? ['picture'] : (MUST_CHANGE[name] ?? USUAL);
      const missing = wanted.filter((pane) => !changed.includes(pane));
      if (missing.length > 0) problems.push(`${control.key} does not change ${missing.join(', ')}`);
    }
    assert(problems.length === 0, problems.join('; '));
  });
}

/** Tests what the lessons show and what their parameters change. `models` are the user's model and scene, if the server has them. */
export async function testShown(browser, server, engine, models, test) {
  const explorer = await Explorer.open(browser, server.address);
  await explorer.settled();
  await test(`${engine}: the table of depths shows numbers under the engine's words`, async () => {
    await explorer.goTo('#v=1&lesson=depth-table');
    await checkDepthTable(explorer, ['distance', 'depth', 'smallest step with 24 bits']);
    await explorer.page.selectOption('#language', 'zh');
    await explorer.settled();
    await checkDepthTable(explorer, ['距离', '深度', '24 位深度的最小步长']);
    await explorer.page.selectOption('#language', 'en');
    await explorer.settled();
  });
  const ids = await explorer.page.locator('#lesson option').evaluateAll((all) => all.map((one) => one.value));
  for (const id of ids) {
    const isOwn = ['model', 'scene'].includes(id);
    if (isOwn && !models?.[id]) continue;
    await testLesson(explorer, { id, hash: `#v=1&lesson=${id}${isOwn ? `&model=${models[id]}` : ''}` }, test, engine);
  }
  await explorer.close();
}
