// The connection to the worker: requests, answers, and a new worker when one dies.

import { resourceUrl, server } from './resources.js';
import { currentLanguage } from './texts.js';

/** Milliseconds after which a silent worker is considered dead, long enough to load large models. */
const TIME_LIMIT = 120_000;

/** An error to show: a message, a remedy and a code for programs. */
export class EngineError extends Error {
  /** @param {{code?: string|null, message: string, help?: string}} parts */
  constructor({ code, message, help }) {
    super(message);
    this.code = code;
    this.help = help ?? '';
  }
}

/** Sends requests to the worker, and replaces the worker if it dies. */
export class EngineClient {
  /** @param {boolean} native whether the server does the computation */
  constructor(native) {
    this.native = native;
    this.waiting = new Map();
    /** The user's files by name, for a restarted worker. @type {Map<string, Blob>} */
    this.files = new Map();
    this.lastId = 0;
    this.ready = null;
  }

  /** Starts the worker, or returns the running worker. */
  start() {
    this.ready ??= this.startWorker();
    return this.ready;
  }

  async startWorker() {
    try {
      await 0; // Lets `start` return first.
      // Not a module, because Chromium rejects modules of a single-file page without a server.
      this.worker = new Worker(resourceUrl('worker.js'));
      this.worker.onmessage = ({ data }) => this.settle(data);
      this.worker.onerror = (event) => {
        event.preventDefault();
        this.stop(event.message || 'the worker did not start');
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

  /** Sends a request and returns the answer. @returns {Promise<{contentType: string, bytes: Uint8Array}>} */
  async ask(query) {
    await this.start();
    return this.post({ query: `${query}&lang=${currentLanguage()}` });
  }

  /** Sends a request and returns the answer as an object. @param {string} query */
  async askJson(query) {
    return JSON.parse(new TextDecoder().decode((await this.ask(query)).bytes));
  }

  /** Passes one of the user's files to the engine. @param {string} name @param {Blob} blob */
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
      const timer = setTimeout(() => this.stop('no answer for two minutes'), TIME_LIMIT);
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

  /** Stops the worker; the next request starts a new worker. */
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
