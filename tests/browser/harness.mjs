// Starts a server for the explorer or for static files, opens a browser, and drives the page in it.

import { spawn } from 'node:child_process';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

/** The root of the project. */
export const ROOT = fileURLToPath(new URL('../..', import.meta.url));
const AXE = createRequire(import.meta.url).resolve('axe-core/axe.min.js');

/** Fails with a message unless a condition is true. */
export function assert(condition, message) {
  if (!condition) throw new Error(message);
}

/** Fails unless two numbers are equal to the precision that the page shows. */
export function assertNear(actual, expected, message) {
  const tolerance = 2e-4 * Math.max(1, Math.abs(expected));
  assert(Math.abs(actual - expected) <= tolerance, `${message}: ${actual}, expected ${expected}`);
}

/** Starts `alberti explore`; returns its address and a function that stops it. */
export async function startProgram(program, args) {
  const child = spawn(program, ['explore', ...args], { cwd: path.join(ROOT, 'scenes/models'), stdio: ['ignore', 'pipe', 'ignore'] });
  const address = await new Promise((resolve, reject) => {
    child.stdout.once('data', (line) => resolve(String(line).trim()));
    child.once('exit', () => reject(new Error('the server exited')));
  });
  return { address, stop: () => child.kill('SIGINT') };
}

const TYPES = { html: 'text/html', css: 'text/css', js: 'text/javascript', svg: 'image/svg+xml', wasm: 'application/wasm' };

/** Serves a folder as a static web host would. */
export async function serveFolder(folder) {
  const server = createServer(async ({ url }, response) => {
    const name = new URL(url, 'http://a').pathname.replace(/\/$/, '/index.html');
    try {
      const bytes = await readFile(path.join(folder, path.normalize(name)));
      response.writeHead(200, { 'content-type': TYPES[name.split('.').pop()] ?? 'application/octet-stream' }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { address: `http://127.0.0.1:${server.address().port}/`, stop: () => server.close() };
}

/** Launches a headless browser. */
export const launchBrowser = () =>
  chromium.launch({ executablePath: '/usr/bin/chromium', args: process.getuid?.() === 0 ? ['--no-sandbox'] : [] });

/** An explorer page, with the actions and queries that tests need. */
export class Explorer {
  /** Opens the page in a separate context. */
  static async open(browser, address, { hash = '', ...options } = {}) {
    const context = await browser.newContext({ locale: 'en-US', viewport: { width: 1280, height: 900 }, ...options });
    await context.grantPermissions(['clipboard-read', 'clipboard-write']);
    const page = await context.newPage();
    const explorer = new Explorer(page, address);
    await page.goto(address + hash);
    return explorer;
  }

  constructor(page, address) {
    this.page = page;
    this.address = address;
    /** Events that a page must not cause: console output, errors, and requests to other hosts. */
    this.faults = [];
    page.on('console', (message) => this.faults.push(`console: ${message.text()}`));
    page.on('pageerror', (error) => this.faults.push(`error: ${error.message}`));
    page.on('request', (request) => {
      const url = new URL(request.url());
      const isOwn = url.host === new URL(address).host || ['blob:', 'data:'].includes(url.protocol);
      if (!isOwn) this.faults.push(`request: ${url}`);
    });
  }

  async close() {
    await this.page.context().close();
    assert(this.faults.length === 0, this.faults.join('; '));
  }

  /** Waits until the whole page shows the current state. */
  settled() {
    return this.page.waitForFunction(() => document.body.dataset.settled !== undefined, null, { timeout: 60_000 });
  }

  /** Opens a state by its link. */
  async goTo(hash) {
    await this.page.evaluate((to) => {
      if (location.hash === to) return;
      delete document.body.dataset.settled;
      location.hash = to;
    }, hash);
    await this.settled();
  }

  text(selector) {
    return this.page.locator(selector).innerText();
  }

  consequences() {
    return this.text('#consequences');
  }

  /** Returns the coordinates of the pinned point in a space, as the page shows them. */
  async coordinates(space) {
    const cells = await this.page.locator(`tr[data-space=${space}] td`).allInnerTexts();
    return cells.filter((cell) => cell !== '').map((cell) => Number(cell.replace('−', '-')));
  }

  /** Returns the triangle counts in the legend of the world view. */
  async triangles() {
    const entries = await this.page.locator('.legend[data-of=world] li').allInnerTexts();
    return Object.fromEntries(entries.map((entry) => entry.split(': ')).map(([name, count]) => [name, Number(count)]));
  }

  /** Types a value into the number field of a parameter. */
  async type(key, value) {
    await this.page.locator(`#parameter-${key}-number`).fill(String(value));
    await this.settled();
  }

  async choose(key, value) {
    await this.page.locator(`#parameter-${key}`).selectOption(value);
    await this.settled();
  }

  value(key) {
    return this.page.locator(`#parameter-${key}`).inputValue();
  }

  /** Returns the accessibility violations that axe finds. */
  async violations() {
    // The script is injected, because the content security policy of the page blocks other scripts.
    await this.page.evaluate(await readFile(AXE, 'utf8'));
    const { violations } = await this.page.evaluate(() => globalThis.axe.run());
    return violations.map(({ id, nodes }) => `${id} (${nodes.map(({ target }) => target.join(' ')).join(', ')})`);
  }

  /** Returns the number of colors in the canvas of a pane, counted up to 50. */
  colors(pane) {
    return this.page.evaluate((id) => {
      const canvas = document.getElementById(id);
      const { width, height } = canvas;
      // A copy, because Chromium warns about canvases that are read often.
      const copy = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d');
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, width, height);
      const found = new Set();
      for (const color of new Uint32Array(data.buffer)) if (found.add(color).size >= 50) break;
      return found.size;
    }, pane);
  }
}
