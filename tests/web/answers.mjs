// Queries the explorer's engine in Node: `node answers.mjs SITE OUT [--file=NAME=PATH…] [NAME?QUERY…]`.
//
// SITE is a folder written by `cargo xtask web`. The files are added first; each answer is written to OUT/NAME. An engine
// error ends the program.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const [site, out, ...words] = process.argv.slice(2);
// Node treats a file with this name as a module only if it comes from a data URL.
const source = readFileSync(join(site, 'web.js')).toString('base64');
const { initSync, Explorer } = await import(`data:text/javascript;base64,${source}`);
initSync({ module: readFileSync(join(site, 'web_bg.wasm')) });

const explorer = new Explorer();
for (const word of words) {
  try {
    if (word.startsWith('--file=')) {
      const [, name, path] = /^--file=([^=]*)=(.*)$/.exec(word);
      explorer.add_file(name, readFileSync(path));
    } else {
      const at = word.indexOf('?');
      writeFileSync(join(out, word.slice(0, at)), explorer.answer(word.slice(at + 1)).bytes);
    }
  } catch (error) {
    console.error(`${word}: ${error.message ?? error} ${error.help ?? ''}`);
    process.exit(1);
  }
}
