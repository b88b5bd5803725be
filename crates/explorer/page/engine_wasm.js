// The engine in WebAssembly: the same code as the program, in this worker.

/** @param {(path: string) => string} urlOf */
export async function startEngine(urlOf) {
  if (typeof WebAssembly !== 'object') {
    throw {
      code: 'no-webassembly',
      message: 'This page needs WebAssembly, which this browser does not support.',
      help: 'Use a different browser, or run `alberti explore --native` and open the address it prints.',
    };
  }
  const module = await import(urlOf('web.js'));
  await module.default({ module_or_path: urlOf('web_bg.wasm') });
  const explorer = new module.Explorer();
  const { lessons } = JSON.parse(new TextDecoder().decode(explorer.answer('v=1&what=lessons').bytes));
  const loaded = new Set();
  return {
    async answer(query) {
      const id = new URLSearchParams(query).get('lesson');
      const lesson = lessons.find((one) => one.id === id) ?? lessons[0];
      for (const name of lesson.models.filter((one) => !loaded.has(one))) {
        explorer.add_file(name, await readModel(urlOf(name), name));
        loaded.add(name);
      }
      const { content_type: contentType, bytes } = explorer.answer(query);
      return { contentType, bytes };
    },
    addFile(name, bytes) {
      explorer.add_file(name, bytes);
    },
  };
}

/** Returns the bytes of a lesson's model. */
async function readModel(url, name) {
  const response = await fetch(url).catch(() => null);
  if (response?.ok) return new Uint8Array(await response.arrayBuffer());
  throw { code: 'no-model', message: `Cannot read ${name}, the model of this lesson.`, help: 'Reload the page or choose another lesson.' };
}
