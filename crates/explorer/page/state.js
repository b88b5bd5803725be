// The page state: a query string, used in the link, in requests and in the undo history.

/** Version of the links. */
const VERSION = '1';
/** Milliseconds within which changes to the same key count as one undo step. */
const ONE_STEP = 1000;

/** Keys and values in order, including `lesson` and its parameters. */
export class State {
  /** @param {string} query the part after `#` */
  constructor(query) {
    this.values = new Map(new URLSearchParams(query));
    this.values.delete('lang');
    this.values.set('v', this.values.get('v') ?? VERSION);
    this.past = [];
    this.future = [];
    this.lastChange = { key: '', time: -Infinity };
  }

  /** Returns the value of a key, if it is set. @param {string} key */
  get(key) {
    return this.values.get(key);
  }

  /** Returns the query string, beginning with `v` and `lesson`. */
  query() {
    const first = ['v', 'lesson'].filter((key) => this.values.has(key));
    const rest = [...this.values.keys()].filter((key) => !first.includes(key));
    return [...first, ...rest].map((key) => `${key}=${escapeValue(this.values.get(key))}`).join('&');
  }

  /** Changes a value. Changes to the same key in quick succession are one undo step. */
  set(key, value) {
    const { timeStamp: time } = new Event('change');
    if (this.lastChange.key !== key || time - this.lastChange.time > ONE_STEP) this.remember();
    this.lastChange = { key, time };
    if (value === '') this.values.delete(key);
    else this.values.set(key, value);
  }

  /** Replaces all values with another query's values, as one undo step. */
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

  /** Goes one step back. Returns whether there was a step. */
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

/** Percent-encodes a value, but keeps commas and slashes readable. */
const escapeValue = (value) => encodeURIComponent(value).replaceAll('%2C', ',').replaceAll('%2F', '/');
