// The worker that computes, so that the page never waits: one engine behind messages.
//
// `{id, start: {native, files, base}}`, `{id, file: {name, bytes}}` and `{id, query}` are answered by `{id, contentType, bytes}`
// or `{id, error: {code, message, help}}`. Without a code of the engine's it is lost.

let engine = null;

/** Chooses the engine: the server's, or WebAssembly. */
async function startEngine({ native, files, base }) {
  const urlOf = (path) => files?.[path] ?? new URL(path, base).href;
  const { startEngine: start } = await import(urlOf(native ? 'engine_native.js' : 'engine_wasm.js'));
  engine = await start(urlOf);
}

async function answerMessage({ start, file, query }) {
  if (start) return startEngine(start);
  return file ? engine.addFile(file.name, file.bytes) : engine.answer(query);
}

// One message after the other: the engine keeps models and scenes between them.
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

/** The three parts of an error of the engine; any other error has no code. */
function describeError(error) {
  const { code, message, help } = error ?? {};
  return { code: typeof code === 'string' ? code : null, message: String(message ?? error), help: help ?? '' };
}
