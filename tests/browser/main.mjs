// Tests the explorer in a real browser: `node main.mjs PROGRAM [FOLDER|--first]`.
//
// PROGRAM is `alberti`, whose explorer computes on the server. FOLDER is the output of `cargo xtask web`, a page that computes in WebAssembly.
// `--first` tests only the first lesson.
// Prints one line per test; the exit code is 1 if a test failed.

import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { readFile } from 'node:fs/promises';
import path from 'node:path';
import { Explorer, ROOT, assert, launchBrowser, serveFolder, startProgram } from './harness.mjs';
import { STATEMENTS } from './lessons.mjs';
import { testOwnModel } from './own_model.mjs';
import { testShown } from './shown.mjs';

const isFirst = process.argv.includes('--first');
const [program, folder] = process.argv.slice(2).filter((one) => one !== '--first').map((one) => path.resolve(one));
let failures = 0;

async function test(name, run) {
  try {
    await run();
    console.log(`ok      ${name}`);
  } catch (error) {
    failures += 1;
    console.log(`FAILED  ${name}: ${error.message}`);
  }
}

const hashOf = (bytes) => createHash('sha256').update(bytes).digest('hex');

/** Returns the program's picture of a scene, rendered in the folder of the scene's models. */
function programPicture(scene, isOwn) {
  const cwd = path.join(ROOT, isOwn ? 'scenes/models' : 'scenes');
  return execFileSync(program, ['render', '-', '-o', '-', '--format', 'png'], { input: scene, cwd, maxBuffer: 1 << 26 });
}

/** Presses a button that downloads a file, and returns the file. */
async function saved(explorer, button) {
  const [download] = await Promise.all([explorer.page.waitForEvent('download'), explorer.page.click(button)]);
  return readFile(await download.path());
}

async function copied(explorer, button) {
  await explorer.page.click(button);
  await explorer.page.waitForFunction(() => document.getElementById('status').textContent !== '');
  return explorer.page.evaluate(() => navigator.clipboard.readText());
}

/** Changes the first control of the lesson with the mouse, and then with the keyboard. */
async function moveControls({ page }) {
  const state = () => page.evaluate(() => location.hash);
  const control = page.locator('#parameters input[type=range], #parameters select').first();
  const isRange = (await control.getAttribute('type')) === 'range';
  const before = await state();
  await control.scrollIntoViewIfNeeded();
  if (isRange) {
    const box = await control.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    for (const part of [0.55, 0.6, 0.65, 0.7]) await page.mouse.move(box.x + box.width * part, box.y + box.height / 2);
    await page.mouse.up();
  } else {
    await control.selectOption({ index: 1 });
  }
  await page.waitForFunction((old) => location.hash !== old, before);
  const dragged = await state();
  await control.focus();
  await page.keyboard.press(isRange ? 'ArrowLeft' : 'ArrowUp');
  await page.waitForFunction((old) => location.hash !== old, dragged);
}

/** Tests every lesson: opens it by its link, checks it, changes a control and saves the picture. */
async function testLessons(browser, server, engine, model) {
  const catalogue = await Explorer.open(browser, server.address);
  await catalogue.settled();
  const lessons = await catalogue.page.locator('#lesson option').evaluateAll((all) => all.map((one) => one.value));
  await catalogue.close();
  assert(lessons.length >= 20, `only ${lessons.length} lessons`);
  for (const lesson of isFirst ? lessons.slice(0, 1) : lessons) {
    const isOwn = lesson === 'model';
    if (lesson === 'scene' || (isOwn && !model)) continue;
    await test(`${engine}: ${lesson}: link, accessibility, mouse and keyboard, the program's bytes`, async () => {
      const hash = `#v=1&lesson=${lesson}${isOwn ? `&model=${model}` : ''}`;
      const explorer = await Explorer.open(browser, server.address, { hash });
      await explorer.settled();
      assert((await explorer.page.locator('#lesson').inputValue()) === lesson, 'wrong lesson');
      assert((await explorer.text('#statement')).length > 40, 'no statement');
      assert(await explorer.page.locator('#notice').isHidden(), await explorer.text('#notice'));
      for (const pane of ['picture', 'world', 'volume']) {
        if (await explorer.page.locator(`#${pane}`).isVisible()) assert((await explorer.colors(pane)) > 2, `${pane} is empty`);
      }
      const violations = await explorer.violations();
      assert(violations.length === 0, violations.join('; '));
      await moveControls(explorer);
      await explorer.settled();
      await explorer.page.click('summary >> nth=0');
      const [picture, scene] = [await saved(explorer, '#save-picture'), await copied(explorer, '#copy-scene')];
      assert(hashOf(picture) === hashOf(programPicture(scene, isOwn)), 'the saved picture differs from the rendered picture');
      await explorer.close();
    });
  }
  for (const { name, lesson, check } of isFirst ? [] : STATEMENTS) {
    await test(`${engine}: ${name}`, async () => {
      const explorer = await Explorer.open(browser, server.address, { hash: `#v=1&lesson=${lesson}` });
      await explorer.settled();
      await check(explorer);
      await explorer.close();
    });
  }
}

/** Tests the page itself: keys, history, links, languages, themes, widths, errors. */
async function testPage(browser, server, engine) {
  const open = async (options) => {
    const explorer = await Explorer.open(browser, server.address, options);
    await explorer.settled();
    return explorer;
  };

  await test(`${engine}: the keyboard reaches every control, pins a point and orbits`, async () => {
    const explorer = await open();
    const { page } = explorer;
    const focusOn = async (id) => {
      for (let i = 0; i < 80; i += 1) {
        if (await page.evaluate((wanted) => document.activeElement.id === wanted, id)) return;
        await page.keyboard.press('Tab');
      }
      throw new Error(`Tab does not reach ${id}`);
    };
    await focusOn('parameter-fov');
    await page.keyboard.press('End');
    await page.waitForFunction(() => location.hash.includes('fov=120'));
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => !location.hash.includes('fov=120'));
    await focusOn('picture');
    for (const key of ['ArrowDown', 'ArrowLeft', 'Shift+ArrowUp', 'Enter']) await page.keyboard.press(key);
    await page.locator('#pick .verdict').waitFor();
    await page.waitForFunction(() => location.hash.includes('pin='));
    await focusOn('world');
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => location.hash.includes('&orbit='));
    await focusOn('volume');
    await page.keyboard.press('ArrowUp');
    await page.waitForFunction(() => location.hash.includes('volume_orbit='));
    await explorer.close();
  });

  await test(`${engine}: undo, redo and reset`, async () => {
    const explorer = await open();
    await explorer.type('near', 6);
    await explorer.type('fov', 60);
    await explorer.page.click('#undo');
    assert((await explorer.value('fov')) === '40' && (await explorer.value('near')) === '6', 'undo');
    await explorer.page.click('#redo');
    assert((await explorer.value('fov')) === '60', 'redo');
    await explorer.page.click('#reset');
    assert((await explorer.value('fov')) === '40' && (await explorer.value('near')) === '4', 'reset');
    await explorer.page.click('#undo');
    assert((await explorer.value('fov')) === '60', 'undo of reset');
    await explorer.settled();
    await explorer.close();
  });

  await test(`${engine}: a copied link restores the state, and a copied command is valid`, async () => {
    const explorer = await open({ hash: '#v=1&lesson=frustum&near=6' });
    await explorer.type('right', 1);
    await explorer.page.click('summary >> nth=0');
    const link = await copied(explorer, '#copy-link');
    const command = await copied(explorer, '#copy-command');
    assert(command.startsWith('alberti render - -o frustum.png'), command);
    const [clip, consequences] = [await explorer.coordinates('clip'), await explorer.consequences()];
    await explorer.close();
    const again = await open({ hash: new URL(link).hash });
    assert((await again.coordinates('clip')).join() === clip.join(), 'different coordinates');
    assert((await again.consequences()) === consequences, 'different consequences');
    await again.close();
  });

  await test(`${engine}: a number out of range is marked, with its limits, until it is valid`, async () => {
    const explorer = await open();
    const { page } = explorer;
    const field = page.locator('#parameter-fov-number');
    const border = () => field.evaluate((one) => getComputedStyle(one).borderColor);
    const valid = await border();
    for (const [language, limits] of [['en', 'Use a number from 10 to 120.'], ['zh', '请输入 10 到 120 之间的数。']]) {
      await page.selectOption('#language', language);
      for (const [value, isValid] of [['200', false], ['60', true], ['-1', false], ['50', true]]) {
        await field.fill(value);
        await field.blur();
        const shown = (await page.locator('main').innerText()).includes(limits);
        assert(shown === !isValid, `${value}: ${shown ? 'a message' : 'no message'}`);
        assert((await field.getAttribute('aria-invalid')) === String(!isValid), `${value}: aria-invalid`);
        assert(((await border()) === valid) === isValid, `${value}: border`);
        assert((await explorer.violations()).length === 0, value);
      }
    }
    await explorer.settled();
    await explorer.close();
  });

  await test(`${engine}: an invalid link is reported, and the page still works`, async () => {
    for (const hash of ['#v=1&lesson=perspective&naer=2', '#v=9', '#v=1&lesson=none', '#%zz', '#v=1&lesson=perspective&near=x', '#near=1&near=2']) {
      const explorer = await open({ hash });
      const notice = explorer.page.locator('#notice');
      assert(await notice.isVisible(), `${hash}: no message`);
      assert((await notice.innerText()).length > 20, hash);
      await explorer.type('near', 5);
      await explorer.close();
    }
  });

  await test(`${engine}: a click pins the point under the cursor`, async () => {
    const explorer = await open();
    const { page } = explorer;
    const box = await page.locator('#picture').boundingBox();
    await page.mouse.click(box.x + box.width * 0.5, box.y + box.height * 0.6);
    await page.waitForFunction(() => location.hash.includes('pin='));
    await explorer.settled();
    // The lesson counts y from the bottom, as OpenGL does. The mouse position is rounded to a pixel of the larger picture on the page.
    const [x, y] = await explorer.coordinates('screen');
    assert(Math.abs(x - 320) <= 2.5 && Math.abs(400 - y - 240) <= 2.5, `${x}, ${y}`);
    const w = (await explorer.coordinates('clip'))[3];
    const [, , z] = await explorer.coordinates('view');
    assert(Math.abs(w + z) < 1e-3, `w ${w}, z ${z}`);
    await explorer.close();
  });

  await test(`${engine}: the browser's language selects Chinese, and the language can be switched`, async () => {
    const explorer = await open({ locale: 'zh-CN' });
    assert((await explorer.text('#title')) === '透视投影', await explorer.text('#title'));
    assert((await explorer.page.locator('html').getAttribute('lang')) === 'zh-CN', 'lang');
    const violations = await explorer.violations();
    assert(violations.length === 0, violations.join('; '));
    await explorer.page.selectOption('#language', 'en');
    assert((await explorer.text('#title')) === 'Perspective', 'English');
    await explorer.settled();
    await explorer.close();
  });

  await test(`${engine}: dark, narrow and wide pages fit and are accessible`, async () => {
    for (const [width, height, colorScheme] of [[320, 640, 'light'], [800, 600, 'dark'], [1440, 900, 'dark'], [3840, 2160, 'light']]) {
      const explorer = await open({ viewport: { width, height }, colorScheme });
      const over = await explorer.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert(over <= 0, `${width}: ${over} pixels too wide`);
      const violations = await explorer.violations();
      assert(violations.length === 0, `${width} ${colorScheme}: ${violations.join('; ')}`);
      await explorer.close();
    }
  });

  await test(`${engine}: a crashed worker is reported and restarted`, async () => {
    const explorer = await open();
    await explorer.page.workers()[0].evaluate(() => { setTimeout(() => { throw new Error('out of memory'); }); });
    await explorer.page.locator('#notice').waitFor();
    assert((await explorer.text('#notice')).includes('out of memory'), await explorer.text('#notice'));
    explorer.faults.length = 0;
    await explorer.type('near', 6);
    assert(await explorer.page.locator('#notice').isHidden(), 'the message is still visible');
    await explorer.close();
  });

  await test(`${engine}: a lesson that is opened again keeps its state`, async () => {
    const explorer = await open({ hash: '#v=1&lesson=perspective&fov=70' });
    const choose = async (lesson) => {
      await explorer.page.selectOption('#lesson', lesson);
      await explorer.page.waitForFunction((id) => location.hash.includes(`lesson=${id}`), lesson);
      await explorer.settled();
    };
    await choose('ortho');
    await choose('perspective');
    assert((await explorer.value('fov')) === '70', 'the parameter is lost');
    await explorer.page.click('#reset');
    assert((await explorer.value('fov')) === '40', 'reset');
    await explorer.settled();
    await explorer.close();
  });

  await test(`${engine}: sentences for students have no codes`, async () => {
    const explorer = await open({ hash: '#v=1&lesson=frustum' });
    const text = await explorer.page.locator('.lesson-text, .what-follows').allInnerTexts();
    assert(!/\b[CM]\d/.test(text.join(' ')), text.join(' '));
    assert(!(await (await explorer.goTo('#v=1&lesson=perspective'), explorer.consequences())).includes(' 1 times'), '1 times');
    await explorer.close();
  });

  await test(`${engine}: the codes above the matrices lead to their entries on a server`, async () => {
    const explorer = await open({ hash: '#v=1&lesson=perspective' });
    const links = explorer.page.locator('#matrix .formula a');
    if (engine === 'native') {
      const [entry] = await Promise.all([explorer.page.context().waitForEvent('page'), links.first().click()]);
      const [code, text] = [await links.first().innerText(), await entry.locator('body').innerText()];
      assert(text.startsWith(code) && text.includes('Book: '), text);
    } else {
      assert((await links.count()) === 0, 'a link without a server');
    }
    await explorer.close();
  });

  await test(`${engine}: a lesson that needs a file says how to begin without one, and shows nothing else`, async () => {
    const isNative = engine === 'native';
    for (const [language, words] of [['en', 'To begin'], ['zh', isNative ? '启动程序' : '选择文件']]) {
      const explorer = await open();
      const { page } = explorer;
      await page.selectOption('#language', language);
      for (const lesson of ['model', 'scene']) {
        const isOffered = (await page.locator(`#lesson option[value=${lesson}]`).count()) > 0;
        assert(isOffered === !isNative, `${lesson} is ${isOffered ? '' : 'not '}offered`);
        await explorer.goTo(`#v=1&lesson=${lesson}`);
        assert((await explorer.text('#statement')).includes(words), await explorer.text('#statement'));
        for (const one of ['.panes', '#parameters', '#copy-link', '#notice']) assert(await page.locator(one).isHidden(), one);
        assert((await page.locator('#files').isHidden()) === isNative, 'files');
        assert(!(await explorer.text('body')).includes('inside:'), 'the last lesson is still visible');
        assert((await explorer.violations()).length === 0, (await explorer.violations()).join());
      }
      await explorer.goTo('#v=1&lesson=ortho');
      assert((await explorer.text('.panes')).length > 200 && (await page.locator('#copy-link').count()) === 1, 'the next lesson');
      await explorer.close();
    }
  });

  if (engine === 'native') return;
  await test(`${engine}: broken files and files that are not models are reported`, async () => {
    const explorer = await open();
    const give = async (name, text) => {
      await explorer.page.setInputFiles('#files', { name, mimeType: 'application/octet-stream', buffer: Buffer.from(text) });
      await explorer.page.locator('#notice').waitFor();
      assert((await explorer.text('#notice-message')).length > 10, name);
      await explorer.page.click('#notice-close');
    };
    await give('words.txt', 'no model');
    await give('broken.glb', 'glTF');
    await explorer.goTo('#v=1&lesson=frustum');
    await explorer.type('near', 6);
    await explorer.close();
  });
}

const browser = await launchBrowser();
const native = await startProgram(program, ['--native', 'teapot.glb']);
await testLessons(browser, native, 'native', 'teapot.glb');
if (!isFirst) {
  await testShown(browser, native, 'native', { model: 'teapot.glb' }, test);
  const plain = await startProgram(program, ['--native']);
  await testPage(browser, plain, 'native');
  plain.stop();
  await testOwnModel(browser, program, test);
}
native.stop();
if (folder) {
  const site = await serveFolder(folder);
  await testLessons(browser, site, 'WebAssembly', null);
  await testShown(browser, site, 'WebAssembly', {}, test);
  await testPage(browser, site, 'WebAssembly');
  site.stop();
}
await browser.close();
if (failures > 0) {
  console.log(`${failures} failed`);
  process.exitCode = 1;
}
