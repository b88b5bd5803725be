// The panes that show pictures: the order of their requests, and drawing to the canvas.
//
// A change marks every pane as outdated. One request is sent at a time: the picture alternates with the other panes.
// Pictures have one sample per pixel at first, and are refined to four when nothing changes for a moment.

import { byId } from './dom.js';

/** Width and height of all pictures in pixels. */
export const SIZE = [640, 400];
const [WIDTH, HEIGHT] = SIZE;
/** Rows in a band with four samples per pixel. */
const BAND = 80;
/** Milliseconds without a change before pictures are refined. */
const REST = 150;

/** The remaining work for a pane. */
const Work = { none: 0, fine: 1, coarse: 2 };

/** Keeps the panes up to date. */
export class Panes {
  /**
   * @param {import('./client.js').EngineClient} client
   * @param {{query: () => string, showState: (state: object) => void, fail: (error: Error) => void, settled: () => void}} page
   */
  constructor(client, page) {
    this.client = client;
    this.page = page;
    /** @type {{what: string, work: number, row: number, turn: number}[]} */
    this.panes = [];
    this.turn = 0;
    this.epoch = 0;
    this.isBusy = false;
    this.failed = false;
    /** Milliseconds from a change to its coarse picture, for measurements. @type {number[]} */
    this.frameTimes = [];
  }

  /** Shows these panes and `state`, the pane of text and numbers; `null` shows none. @param {string[] | null} names */
  select(names) {
    this.panes = ['picture', 'state', 'world', 'volume', 'depth']
      .filter((what) => names && (what === 'state' || names.includes(what)))
      .map((what) => ({ what, work: Work.coarse, row: 0, turn: 0 }));
  }

  /** Clears the panes, which still show another lesson. */
  clear() {
    for (const name of ['picture', 'world', 'volume']) byId(name).getContext('2d').clearRect(0, 0, WIDTH, HEIGHT);
    byId('depth').removeAttribute('src');
  }

  /** Marks all panes, or the named panes, as outdated. @param {string[]} [names] */
  change(names) {
    this.epoch += 1;
    this.failed = false;
    for (const pane of this.panes) {
      if (!names || names.includes(pane.what)) {
        pane.work = Work.coarse;
        pane.row = 0;
        pane.since ??= performance.now();
      }
    }
    clearTimeout(this.timer);
    this.isResting = false;
    this.timer = setTimeout(() => {
      this.isResting = true;
      this.run();
    }, REST);
    this.run();
  }

  /** Returns the next pane to request. */
  next() {
    const coarse = this.panes.filter((pane) => pane.work === Work.coarse);
    const picture = coarse.find((pane) => pane.what === 'picture');
    if (picture && this.lastWhat !== 'picture') return picture;
    const others = coarse.filter((pane) => pane !== picture).sort((a, b) => a.turn - b.turn);
    if (others.length > 0 || picture) return others[0] ?? picture;
    return this.isResting ? this.panes.find((pane) => pane.work === Work.fine) : undefined;
  }

  async run() {
    if (this.isBusy) return;
    this.isBusy = true;
    for (let pane = this.next(); pane && !this.failed; pane = this.next()) {
      const epoch = this.epoch;
      this.lastWhat = pane.what;
      pane.turn = this.turn += 1;
      try {
        await this.refresh(pane);
      } catch (error) {
        // Retries with the newest state unless that is the failed state.
        if (epoch === this.epoch) {
          this.failed = true;
          this.page.fail(error);
        }
      }
    }
    this.isBusy = false;
    if (!this.failed && this.panes.every((pane) => pane.work === Work.none)) this.page.settled();
  }

  /** Sends one request for a pane and shows the answer. */
  async refresh(pane) {
    const { what } = pane;
    const base = `${this.page.query()}&what=${what}`;
    if (what === 'state') {
      pane.work = Work.none;
      this.page.showState(await this.client.askJson(`${base}&size=${WIDTH}x${HEIGHT}`));
    } else if (what === 'depth') {
      pane.work = Work.none;
      showSvg(byId('depth'), await this.client.ask(base));
    } else if (pane.work === Work.coarse) {
      pane.work = Work.fine;
      const { bytes } = await this.client.ask(`${base}&size=${WIDTH}x${HEIGHT}&samples=1`);
      drawRows(byId(what), bytes, 0);
      if (what === 'picture') this.frameTimes.push(performance.now() - pane.since);
      pane.since = undefined;
    } else {
      const end = Math.min(pane.row + BAND, HEIGHT);
      const rows = `${pane.row}-${end}`;
      const { bytes } = await this.client.ask(`${base}&size=${WIDTH}x${HEIGHT}&samples=4&rows=${rows}`);
      if (pane.work !== Work.fine) return;
      drawRows(byId(what), bytes, pane.row);
      pane.row = end;
      if (end === HEIGHT) pane.work = Work.none;
    }
  }
}

/** Draws rows of RGBA on a canvas. */
function drawRows(canvas, bytes, row) {
  const pixels = new Uint8ClampedArray(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  canvas.getContext('2d').putImageData(new ImageData(pixels, WIDTH), 0, row);
}

/** Shows a drawing as an image, so that no script in it can run. */
function showSvg(image, { bytes }) {
  const url = URL.createObjectURL(new Blob([bytes], { type: 'image/svg+xml' }));
  const old = image.src;
  image.src = url;
  if (old.startsWith('blob:')) image.decode().catch(() => {}).then(() => URL.revokeObjectURL(old));
}

/** Degrees per dragged pixel and per arrow key. */
const DRAG = 0.4;
const STEP = 5;
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * Lets the view in a canvas be orbited by dragging or with the arrow keys.
 * @param {HTMLCanvasElement} canvas
 * @param {{angles: () => number[], turn: (angles: number[]) => void}} orbit angles in degrees: azimuth, elevation
 */
export function makeOrbit(canvas, orbit) {
  const turnBy = (azimuth, elevation) => {
    const [a, e] = orbit.angles();
    const around = ((((a + azimuth + 180) % 360) + 360) % 360) - 180;
    const up = Math.max(-89, Math.min(89, e + elevation));
    orbit.turn([around, up].map((angle) => Math.round(angle * 10) / 10));
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button === 0) canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) turnBy(-event.movementX * DRAG, event.movementY * DRAG);
  });
  canvas.addEventListener('keydown', (event) => {
    const arrow = ARROWS[event.key];
    if (!arrow || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    turnBy(arrow[0] * STEP, arrow[1] * STEP);
  });
}

/**
 * Picks a pixel by a click, or by a cursor that the arrow keys move.
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLElement} cursor
 * @param {{move: (pixel: number[]) => void, pick: (pixel: number[]) => void}} page
 */
export function makePick(canvas, cursor, page) {
  let at = [WIDTH / 2, HEIGHT / 2];
  const moveTo = ([x, y]) => {
    at = [Math.max(0, Math.min(WIDTH - 1, Math.floor(x))), Math.max(0, Math.min(HEIGHT - 1, Math.floor(y)))];
    cursor.style.left = `${(100 * (at[0] + 0.5)) / WIDTH}%`;
    cursor.style.top = `${(100 * (at[1] + 0.5)) / HEIGHT}%`;
    cursor.hidden = false;
  };
  canvas.addEventListener('click', (event) => {
    const box = canvas.getBoundingClientRect();
    moveTo([((event.clientX - box.left) / box.width) * WIDTH, ((event.clientY - box.top) / box.height) * HEIGHT]);
    page.pick(at);
  });
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = ARROWS[event.key];
    const step = event.shiftKey ? 1 : 10;
    if (arrow) {
      event.preventDefault();
      moveTo([at[0] + arrow[0] * step, at[1] - arrow[1] * step]);
      page.move(at);
    } else if (event.key === 'Enter' || event.key === ' ') {
      event.preventDefault();
      moveTo(at);
      page.pick(at);
    } else if (event.key === 'Escape') {
      cursor.hidden = true;
    }
  });
}
