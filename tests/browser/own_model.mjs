// The user's own model: the pinned point in the space of its mesh, and the page without a model.

import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { Explorer, assert, assertNear, startProgram } from './harness.mjs';

/** A glTF file with the square from (0, 0, 0) to (100, 100, 0) at two nodes: scaled by 0.01, and by 0.02 at x = 2. */
function twoSquares() {
  const positions = Buffer.from(new Float32Array([0, 0, 0, 100, 0, 0, 100, 100, 0, 0, 0, 0, 100, 100, 0, 0, 100, 0]).buffer);
  return JSON.stringify({
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0, 1] }],
    nodes: [{ mesh: 0, scale: [0.01, 0.01, 0.01] }, { mesh: 0, scale: [0.02, 0.02, 0.02], translation: [2, 0, 0] }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 6, type: 'VEC3', min: [0, 0, 0], max: [100, 100, 0] }],
    bufferViews: [{ buffer: 0, byteLength: 72 }],
    buffers: [{ byteLength: 72, uri: `data:application/octet-stream;base64,${positions.toString('base64')}` }],
  });
}

const fields = ({ page }) => page.locator('#pin input').evaluateAll((all) => all.map((one) => Number(one.value)));

/** Clicks a pixel of the picture, in fractions of its sides. */
async function clickPicture({ page }, x, y) {
  const before = await page.evaluate(() => location.hash);
  const box = await page.locator('#picture').boundingBox();
  await page.mouse.click(box.x + box.width * x, box.y + box.height * y);
  await page.waitForFunction((old) => location.hash !== old, before);
}

async function checkPin(explorer) {
  const { page } = explorer;
  const agree = async (scale, offset) => {
    const [world, model, typed] = [await explorer.coordinates('world'), await explorer.coordinates('model'), await fields(explorer)];
    world.forEach((value, i) => {
      assertNear(typed[i], value, 'field');
      assertNear(model[i], (value - (i === 0 ? offset : 0)) / scale, 'model');
    });
    return world;
  };
  await agree(0.01, 0);
  await page.evaluate(() => document.getElementById('picture').scrollIntoView());
  await clickPicture(explorer, 0.6, 0.5);
  await explorer.settled();
  const [x, y, z] = await agree(0.02, 2);
  assert(x > 2 && y > 0, `${x}, ${y}`);
  await page.locator('#pin-x').fill('2.5');
  await page.locator('#pin-x').press('Tab');
  await explorer.settled();
  const after = await agree(0.02, 2);
  [2.5, y, z].forEach((value, i) => assertNear(after[i], value, 'typing x keeps y and z'));
  await explorer.goTo('#v=1&lesson=model&model=squares.gltf');
  await page.locator('#pin-y').fill('0.5');
  await page.locator('#pin-y').press('Tab');
  await explorer.settled();
  assert((await explorer.coordinates('world'))[1] === 0.5, 'typed y');
}

/** Tests a server with a model whose nodes are scaled. */
export async function testOwnModel(browser, program, test) {
  const file = path.join(await mkdtemp(path.join(tmpdir(), 'explorer-')), 'squares.gltf');
  await writeFile(file, twoSquares());
  const server = await startProgram(program, ['--native', file]);
  const explorer = await Explorer.open(browser, server.address);
  await explorer.settled();
  await test('native: the pinned point has the same coordinates in fields and table, and in the space of its mesh', () => checkPin(explorer));
  await explorer.close();
  server.stop();
  await rm(path.dirname(file), { recursive: true });
}
