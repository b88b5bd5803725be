// File input and output: models from the user, text to the clipboard, pictures to disk.

import { byId } from './dom.js';

/** Extensions of model files. */
const MODEL = /\.(glb|gltf|stl|obj|ply|3mf)$/i;
/** Maximum total size in bytes of the files that the page tries to read. */
const MAX_BYTES = 512 * 2 ** 20;

/** Whether a file is a model. @param {string} name */
export const isModel = (name) => MODEL.test(name);

/** Whether a file is a scene. @param {string} name */
export const isScene = (name) => /\.ron$/i.test(name);

/** Finds the scene or model among files. @param {File[]} files */
export function findModel(files) {
  const bytes = files.reduce((sum, file) => sum + file.size, 0);
  return { model: files.find(({ name }) => isScene(name)) ?? files.find(({ name }) => isModel(name)), isHuge: bytes > MAX_BYTES, megabytes: MAX_BYTES / 2 ** 20 };
}

/** References to other files in glTF, scenes, OBJ and MTL. */
const REFERENCES = /(?:"uri"|\bpath)\s*:\s*"([^"]+)"|^\s*(?:mtllib|map_\w+|bump|norm|disp)\s.*?(\S+)\s*$/gm;

/**
 * Returns files under the names that models use for them, because a browser drops the folder of `textures/wood.png`.
 * @param {File[]} files @returns {Promise<[string, File][]>}
 */
export async function namedFiles(files) {
  const named = files.map((file) => /** @type {[string, File]} */ ([file.name, file]));
  for (const file of files.filter(({ name }) => /\.(gltf|ron|obj|mtl)$/i.test(name))) {
    for (const [, uri, word] of (await file.text()).matchAll(REFERENCES)) {
      const path = decode(uri ?? word);
      const found = path.includes('/') && files.find(({ name }) => path.endsWith(`/${name}`));
      if (found) named.push([path, found]);
    }
  }
  return named;
}

function decode(uri) {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
}

/** Calls back with files that are dropped on the page. @param {(files: File[]) => void} open */
export function acceptDrops(open) {
  addEventListener('dragover', (event) => {
    event.preventDefault();
    document.body.classList.add('dropping');
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) document.body.classList.remove('dropping');
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    const files = [...event.dataTransfer.files];
    if (files.length > 0) open(files);
  });
}

/** Copies text, or shows it if the clipboard is blocked. Returns whether the text was copied. */
export async function copyText(words) {
  try {
    await navigator.clipboard.writeText(words);
    return true;
  } catch {
    byId('copy-text').value = words;
    byId('copy-dialog').showModal();
    byId('copy-text').select();
    return false;
  }
}

/** Saves bytes as a file. */
export function saveFile(name, type, bytes) {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
