// The state of the page: a query string, in the link, in questions and in the history of undo.

/** Version of the links. */
const VERSION = '1';
/** Milliseconds within which changes of the same key count as one step of undo. */
const ONE_STEP = 1000;

/** Keys and values in order; `lesson` and the parameters of the lesson are among them. */
export class State {
  /** @param {string} query as after `#` */
  constructor(query) {
    this.values = new Map(new URLSearchParams(query));
    this.values.delete('lang');
    this.values.set('v', this.values.get('v') ?? VERSION);
    this.past = [];
    this.future = [];
    this.lastChange = { key: '', time: -Infinity };
  }

  /** The value of a key, if it is set. @param {string} key */
  get(key) {
    return this.values.get(key);
  }

  /** The query string, `v` and `lesson` first. */
  query() {
    const first = ['v', 'lesson'].filter((key) => this.values.has(key));
    const rest = [...this.values.keys()].filter((key) => !first.includes(key));
    return [...first, ...rest].map((key) => `${key}=${escapeValue(this.values.get(key))}`).join('&');
  }

  /** Changes a value, as one step of undo with other changes of it shortly before. */
  set(key, value) {
    const { timeStamp: time } = new Event('change');
    if (this.lastChange.key !== key || time - this.lastChange.time > ONE_STEP) this.remember();
    this.lastChange = { key, time };
    if (value === '') this.values.delete(key);
    else this.values.set(key, value);
  }

  /** Takes all values from another query, as one step of undo. */
  replace(query) {
    this.remember();
    this.lastChange = { key: '', time: -Infinity };
    this.restore(query);
  }

  remember() {
    this.past.push(this.query());
    this.future = [];
  }

  restore(query) {
    this.values = new State(query).values;
  }

  /** Goes a step back, or forth; whether there was one. */
  undo() {
    return this.step(this.past, this.future);
  }

  redo() {
    return this.step(this.future, this.past);
  }

  step(from, to) {
    const query = from.pop();
    if (query === undefined) return false;
    to.push(this.query());
    this.lastChange = { key: '', time: -Infinity };
    this.restore(query);
    return true;
  }
}

/** Percent-encoding that leaves the commas of vectors readable. */
const escapeValue = (value) => encodeURIComponent(value).replaceAll('%2C', ',').replaceAll('%2F', '/');
