// Writes the explorer as one HTML file: `node single_file.mjs SITE OUT.html`.
//
// SITE is the output of `cargo xtask web`. The HTML file contains compressed scripts, the engine and the models, which the page
// unpacks before its modules run. It therefore works from a USB stick or an email.

import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';

const [site, out] = process.argv.slice(2);
const PAGES = ['index.html', 'alberti.html'];
const INLINE = ['style.css', 'icon.svg'];

const read = (name) => readFileSync(join(site, name), 'utf8');

/** The files of the site, as paths relative to it. */
const files = readdirSync(site, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => join(entry.parentPath ?? entry.path, entry.name).slice(join(site, '/').length).replaceAll('\\', '/'))
  .filter((name) => !PAGES.includes(name))
  .sort();

/** Returns the names of the modules that a source text imports. */
const importsOf = (text) => [...text.matchAll(/from '\.\/([^']+)'/g)].map(([, name]) => name);

/** Sorts modules so that each one follows the modules that it imports. */
function inOrder(names, order = []) {
  for (const name of names) {
    if (order.includes(name)) continue;
    inOrder(importsOf(read(name)), order);
    order.push(name);
  }
  return order;
}

/** Runs in the page: unpacks the files and starts the page. */
async function start() {
  const types = { js: 'text/javascript', wasm: 'application/wasm' };
  const unpack = (text) => {
    const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip')));
  };
  // The worker gets `data:` addresses, because the worker of a page without a server cannot read `blob:` addresses.
  const dataUrl = (blob) =>
    new Promise((resolve, reject) => {
      const reader = new FileReader();
      reader.onload = () => resolve(reader.result);
      reader.onerror = () => reject(reader.error);
      reader.readAsDataURL(blob);
    });
  try {
    const files = {};
    for (const [name, text, isOfPage] of JSON.parse(document.getElementById('explorer-files').textContent)) {
      const type = types[name.split('.').pop()] ?? 'application/octet-stream';
      if (isOfPage) {
        const source = await unpack(text).text();
        const linked = source.replace(/from '\.\/([^']+)'/g, (_, other) => `from '${files[other]}'`);
        files[name] = URL.createObjectURL(new Blob([linked], { type }));
      } else {
        files[name] = await dataUrl(new Blob([await unpack(text).arrayBuffer()], { type }));
      }
    }
    globalThis.explorerFiles = files;
    await import(files['main.js']);
  } catch (error) {
    document.getElementById('notice-message').textContent = `The page could not start: ${error.message}.`;
    document.getElementById('notice-help').textContent = 'Use a browser from 2023 or later.';
    document.getElementById('notice').hidden = false;
  }
}

/** Replaces a part of the page that must occur exactly once. */
function replaceOnce(text, part, replacement) {
  const [before, after, ...others] = text.split(part);
  if (after === undefined || others.length > 0) throw new Error(`index.html must contain ${part} exactly once`);
  return before + replacement + after;
}

const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const script = `(${start})();`;
const style = `\n${read('style.css')}`;
const icon = `data:image/svg+xml;base64,${Buffer.from(read('icon.svg')).toString('base64')}`;
const ofPage = inOrder(['main.js', 'worker.js']);
const packed = [...ofPage, ...files.filter((name) => !ofPage.includes(name) && !INLINE.includes(name))].map((name) => {
  return [name, gzipSync(readFileSync(join(site, name)), { level: 9 }).toString('base64'), ofPage.includes(name)];
});
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)} blob: data: 'wasm-unsafe-eval'`,
  `style-src ${hash(style)}`,
  'img-src blob: data:',
  'connect-src blob: data:',
  'worker-src blob:',
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

let page = read('index.html');
page = replaceOnce(page, /(?<=Content-Security-Policy" content=")[^"]*/, policy);
page = replaceOnce(page, /(?<=<link rel="icon" href=")icon\.svg/, icon);
page = replaceOnce(page, '<link rel="stylesheet" href="style.css">', `<style>${style}</style>`);
page = replaceOnce(page, '<script type="module" src="main.js"></script>\n', '');
const data = `<script type="application/json" id="explorer-files">${JSON.stringify(packed)}</script>`;
page = replaceOnce(page, '</body>', `${data}\n<script>${script}</script>\n</body>`);
writeFileSync(out, page);
