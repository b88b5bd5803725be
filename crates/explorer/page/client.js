// The page's side of the worker: questions, answers, and a new worker where one has died.

import { resourceUrl, server } from './resources.js';
import { currentLanguage } from './texts.js';

/** Milliseconds after which a worker that says nothing counts as dead; reading a large model takes long. */
const TIME_LIMIT = 120_000;

/** An error that can be shown: a sentence, what to do, and a code for programs. */
export class EngineError extends Error {
  /** @param {{code?: string|null, message: string, help?: string}} parts */
  constructor({ code, message, help }) {
    super(message);
    this.code = code;
    this.help = help ?? '';
  }
}

/** Asks the worker; starts another one if it dies. */
export class EngineClient {
  /** @param {boolean} native whether the server computes */
  constructor(native) {
    this.native = native;
    this.waiting = new Map();
    /** Files of the user by their names, for a worker that is started again. @type {Map<string, Blob>} */
    this.files = new Map();
    this.lastId = 0;
    this.ready = null;
  }

  /** Starts the worker, or gives the one that runs. */
  start() {
    this.ready ??= this.startWorker();
    return this.ready;
  }

  async startWorker() {
    try {
      await 0; // `start` returns first.
      // No module: Chromium refuses those of a page in one file that has no server.
      this.worker = new Worker(resourceUrl('worker.js'));
      this.worker.onmessage = ({ data }) => this.settle(data);
      this.worker.onerror = (event) => {
        event.preventDefault();
        this.stop(event.message || 'the worker could not be started');
      };
      await this.post({ start: { native: this.native, files: globalThis.explorerFiles, base: document.baseURI } });
      if (!this.native) {
        for (const name of server.files ?? []) await this.postFile(name, await (await fetch(resourceUrl(`files/${encodeURIComponent(name)}`))).blob());
      }
      for (const [name, blob] of this.files) await this.postFile(name, blob);
    } catch (error) {
      this.stop(error.message);
      throw error;
    }
  }

  /** The answer to a question. @returns {Promise<{contentType: string, bytes: Uint8Array}>} */
  async ask(query) {
    await this.start();
    return this.post({ query: `${query}&lang=${currentLanguage()}` });
  }

  /** The answer to a question, as an object. @param {string} query */
  async askJson(query) {
    return JSON.parse(new TextDecoder().decode((await this.ask(query)).bytes));
  }

  /** Gives the engine a file of the user. @param {string} name @param {Blob} blob */
  async addFile(name, blob) {
    await this.start();
    await this.postFile(name, blob);
    this.files.set(name, blob);
  }

  async postFile(name, blob) {
    const bytes = new Uint8Array(await blob.arrayBuffer());
    return this.post({ file: { name, bytes } }, [bytes.buffer]);
  }

  post(message, transfer = []) {
    const id = (this.lastId += 1);
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => this.stop('it has not answered for two minutes'), TIME_LIMIT);
      this.waiting.set(id, { resolve, reject, timer });
      this.worker.postMessage({ id, ...message }, transfer);
    });
  }

  settle({ id, error, contentType, bytes }) {
    const waiting = this.waiting.get(id);
    if (!waiting) return;
    if (error && error.code === null) {
      this.stop(error.message);
      return;
    }
    this.waiting.delete(id);
    clearTimeout(waiting.timer);
    if (error) waiting.reject(new EngineError(error));
    else waiting.resolve({ contentType, bytes });
  }

  /** Ends the worker; the next question starts another one. */
  stop(reason) {
    this.worker?.terminate();
    this.ready = null;
    const error = new EngineError({ code: 'worker-died', message: reason });
    for (const { reject, timer } of this.waiting.values()) {
      clearTimeout(timer);
      reject(error);
    }
    this.waiting.clear();
    this.onStop?.(error);
  }
}
