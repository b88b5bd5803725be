// Checks that the page confirms the statements of each lesson.

import { assert, assertNear } from './harness.mjs';

const RADIANS = Math.PI / 180;

/** Fails unless changing a parameter leaves the pinned point unchanged and changes the number of clipped triangles. */
async function assertOnlyClips(page, key, value) {
  const [before, trianglesBefore] = [await page.coordinates('ndc'), await page.triangles()];
  await page.type(key, value);
  const [after, triangles] = [await page.coordinates('ndc'), await page.triangles()];
  assertNear(after[0], before[0], `${key} moves x`);
  assertNear(after[1], before[1], `${key} moves y`);
  assert(JSON.stringify(triangles) !== JSON.stringify(trianglesBefore), `${key} clips nothing`);
}

/** Returns the x to which a frustum maps a point in view space, by formula GL-1 or by the formula with a moved apex (M12). */
function frustumX([x, , z], { left, right, near }, isMoved) {
  const shift = (right + left) / (right - left);
  return ((2 * near * x) / (right - left) + (isMoved ? -near : z) * shift) / -z;
}

async function frustumValues(page) {
  const keys = ['left', 'right', 'bottom', 'top', 'near', 'far'];
  return Object.fromEntries(await Promise.all(keys.map(async (key) => [key, Number(await page.value(key))])));
}

/** The statements, with their source topics and their lessons. */
export const STATEMENTS = [
  {
    name: 'C62: a small field of view enlarges the picture',
    lesson: 'perspective',
    async check(page) {
      const [x, y] = await page.coordinates('ndc');
      await page.type('fov', 20);
      const factor = Math.tan(20 * RADIANS) / Math.tan(10 * RADIANS);
      const after = await page.coordinates('ndc');
      assertNear(after[0], x * factor, 'x');
      assertNear(after[1], y * factor, 'y');
      const said = await page.consequences();
      assert(said.includes(`${factor.toFixed(2)} times`), said);
    },
  },
  {
    name: 'C62: a wrong aspect ratio distorts the picture',
    lesson: 'perspective',
    async check(page) {
      const [x, y] = await page.coordinates('ndc');
      await page.type('aspect', 3.2);
      const after = await page.coordinates('ndc');
      assertNear(after[0], x / 2, 'x');
      assertNear(after[1], y, 'y');
      const said = await page.consequences();
      assert(said.includes('0.5 times as wide'), said);
    },
  },
  {
    name: 'C62: near and far only clip',
    lesson: 'perspective',
    async check(page) {
      await assertOnlyClips(page, 'near', 9);
      await page.type('near', 4);
      await assertOnlyClips(page, 'far', 11.5);
    },
  },
  {
    name: 'C64: near changes the angle of the lens',
    lesson: 'frustum',
    async check(page) {
      for (const near of [3, 6]) {
        await page.type('near', near);
        const { bottom, top } = await frustumValues(page);
        const angle = (Math.atan(top / near) - Math.atan(bottom / near)) / RADIANS;
        const said = await page.consequences();
        assert(said.includes(`${angle.toFixed(1)}°`), `${angle}: ${said}`);
      }
    },
  },
  {
    name: 'C64: far only clips',
    lesson: 'frustum',
    check: (page) => assertOnlyClips(page, 'far', 11.5),
  },
  {
    name: 'C64, M12: left and right move the window; the moved apex gives a different picture',
    lesson: 'frustum',
    async check(page) {
      await page.type('right', 1);
      const values = await frustumValues(page);
      assert(values.left + values.right !== 0, 'the window is centered');
      const view = await page.coordinates('view');
      const [x] = await page.coordinates('ndc');
      assertNear(x, frustumX(view, values, false), 'glFrustum');
      await page.choose('apex', 'moved');
      const [moved] = await page.coordinates('ndc');
      assertNear(moved, frustumX(view, values, true), 'the moved apex');
      assert(Math.abs(moved - x) > 0.01, 'both apexes give the same x');
    },
  },
  {
    name: 'C65: two eyes have crossed parallax in front of the plane of convergence and uncrossed parallax behind it',
    lesson: 'stereo',
    async check(page) {
      const eyes = Number(await page.value('eyes'));
      for (const convergence of [9, 12]) {
        await page.type('convergence', convergence);
        const said = await page.consequences();
        const found = [...said.matchAll(/distance ([\d.]+)\): (crossed )?parallax ([\d.]+)/g)];
        assert(found.length === 2, said);
        for (const [, distance, crossed, amount] of found) {
          const parallax = eyes * (1 - convergence / Number(distance));
          assert(Math.abs(Math.abs(parallax) - Number(amount)) < 0.002, `${parallax}: ${said}`);
          assert((parallax < 0) === (crossed !== undefined), said);
        }
      }
    },
  },
  {
    name: 'C94: in an orthographic projection, distance has no effect, and a smaller window enlarges the picture',
    lesson: 'ortho',
    async check(page) {
      const clip = await page.coordinates('clip');
      assert(clip[3] === 1, `w is ${clip[3]}`);
      const view = await page.coordinates('view');
      for (const [left, right] of [[-4.8, 4.8], [-2.4, 2.4]]) {
        await page.type('left', left);
        await page.type('right', right);
        const [x] = await page.coordinates('ndc');
        assertNear(x, (2 * view[0]) / (right - left), 'x');
        const said = await page.consequences();
        assert(said.includes(`one unit is ${(640 / (right - left)).toFixed(1)} pixels`), said);
      }
      await assertOnlyClips(page, 'near', 9);
    },
  },
  {
    name: 'C36: divided before it is clipped, the floor appears in the sky, and this picture cannot be copied as a scene',
    lesson: 'tear',
    async check(page) {
      const skyPixels = () =>
        page.page.evaluate(() => {
          const sky = document.createElement('canvas').getContext('2d');
          sky.drawImage(document.getElementById('picture'), 0, 0);
          const pixels = new Uint32Array(sky.getImageData(0, 0, 300, 80).data.buffer);
          return pixels.filter((pixel) => pixel !== 0xfff5f2ee).length;
        });
      const copying = () => page.page.locator('#copy-command:disabled, #copy-scene:disabled').count();
      assert((await skyPixels()) === 0 && (await copying()) === 0, 'clipped first');
      await page.choose('order', 'divide');
      assert((await skyPixels()) > 5000 && (await copying()) === 2, `divided first: ${await skyPixels()}`);
      const said = await page.consequences();
      assert(said.includes('upside down above the horizon') && said.includes('cannot be copied'), said);
      await page.page.locator('#picture').click();
      await page.page.locator('#notice').waitFor();
      assert((await page.text('#notice')).includes('not where they appear'), await page.text('#notice'));
      await page.choose('order', 'clip');
      assert((await skyPixels()) === 0 && (await copying()) === 0, 'clipped again');
      const [, clipped, outside] = (await page.consequences()).match(/in total, (\d+) (?:is|are) clipped and (\d+) (?:is|are) entirely outside/);
      assert(JSON.stringify(await page.triangles()).includes(`"clipped":${clipped},"outside":${outside}`), 'totals');
    },
  },
  {
    name: 'C68: half of the depth range ends at 2FN / (F + N)',
    lesson: 'depth-table',
    async check(page) {
      await page.type('near', 1);
      const far = Number(await page.value('far'));
      const said = await page.consequences();
      assertNear(Number(said.match(/at distance ([\d.]+)/)?.[1]), (2 * far) / (far + 1), said);
    },
  },
];
