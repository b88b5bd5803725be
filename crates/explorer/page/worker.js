// The worker that runs the engine, so that the page never blocks.
//
// `{id, start: {native, files, base}}`, `{id, file: {name, bytes}}` and `{id, query}` are answered with `{id, contentType,
// bytes}` or `{id, error: {code, message, help}}`. An error without a code means that the engine is lost.

let engine = null;

/** Starts the engine, either on the server or in WebAssembly. */
async function startEngine({ native, files, base }) {
  const urlOf = (path) => files?.[path] ?? new URL(path, base).href;
  const { startEngine: start } = await import(urlOf(native ? 'engine_native.js' : 'engine_wasm.js'));
  engine = await start(urlOf);
}

async function answerMessage({ start, file, query }) {
  if (start) return startEngine(start);
  return file ? engine.addFile(file.name, file.bytes) : engine.answer(query);
}

// Messages are processed in turn, because the engine keeps models and scenes between them.
let previous = Promise.resolve();
addEventListener('message', ({ data }) => {
  previous = previous.then(() => answerMessage(data)).then(
    (answer) => {
      const bytes = answer?.bytes;
      postMessage({ id: data.id, contentType: answer?.contentType, bytes }, bytes ? [bytes.buffer] : []);
    },
    (error) => postMessage({ id: data.id, error: describeError(error) }),
  );
});

/** Returns the parts of an engine error. Other errors have no code. */
function describeError(error) {
  const { code, message, help } = error ?? {};
  return { code: typeof code === 'string' ? code : null, message: String(message ?? error), help: help ?? '' };
}
