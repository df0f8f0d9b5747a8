import { element } from "./dom.js";
import { valueAt } from "./dump.js";
import { MOST_HEIGHT, RowMenu } from "./rowmenu.js";
import { usualFormat, valueText } from "./valueformat.js";
import { waveBar } from "./wavebar.js";
import { WaveCanvas } from "./wavecanvas.js";
import { WaveCursor } from "./wavecursor.js";
import { waveKey } from "./wavekeys.js";
import { WaveNames } from "./wavenames.js";
import { WaveRows, savedRows, scopeRows, signalRow } from "./waverows.js";
import { ScopeTree } from "./wavetree.js";

/** @typedef {import("./dump.js").Dump} Dump */
/** @typedef {import("./dump.js").DumpSignal} DumpSignal */
/** @typedef {import("./playhead.js").Playhead} Playhead */
/** @typedef {import("./valueformat.js").ValueFormat} ValueFormat */
/** @typedef {import("./waverows.js").WaveRow} WaveRow */

/** Milliseconds after which a cursor rests. */
const REST = 250;

/**
 * The waves of a dump: rows that the reader chooses, over time. The cursor is the play head.
 * Dispatches `rows` if the rows change, and `values` if the values at the cursor do.
 */
export class WavesPane extends EventTarget {
  /** @type {Dump | null} */
  #dump = null;
  #rows = new WaveRows();
  /** @type {WaveRow | null} */
  #selected = null;
  /** @type {Map<string, ValueFormat>} */
  #formats = new Map();
  #isLate = false;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #telling;
  /** Time of the cursor when it was last shown; NaN before. */
  #lastTime = NaN;
  #cursor;
  #canvas;
  #names;
  #tree;
  #menu = new RowMenu(() => this.#rows.update());
  #spacer = element("div", {});
  /** @type {HTMLElement} */
  #scroll;
  #readout = element("output", { class: "waves-readout" });
  #live = element("p", { class: "waves-live", "aria-live": "polite" });
  #actions;

  /**
   * @param {HTMLElement} host
   * @param {Playhead} playhead
   */
  constructor(host, playhead) {
    super();
    this.#cursor = new WaveCursor(playhead);
    const onkeydown = (/** @type {KeyboardEvent} */ event) => {
      if (this.#dump && waveKey(event, this.#actions)) event.preventDefault();
    };
    this.#canvas = new WaveCanvas(host, this.#rows, this.#cursor, {
      sight: () => this.#names.sight,
      scroll: () => this.#scroll.scrollTop,
      selected: () => this.#selected,
      changes: (signal) => this.#changes(signal),
      select: (row) => this.#select(row),
      layout: () => this.#revealSelected(),
      key: onkeydown,
    });
    this.#actions = this.#waveActions();
    this.#names = new WaveNames(
      this.#rows,
      {
        value: (row) => this.#valueText(row.signal, row.format),
        select: (row) => this.#select(row),
        menu: (row) => this.#menu.open(row),
      },
      onkeydown,
    );
    const view = element("div", { class: "waves-view" }, this.#names.node, this.#canvas.node);
    this.#scroll = element("div", { class: "waves-scroll", onscroll: () => this.#showRows() }, view, this.#spacer);
    const side = element("aside", { class: "waves-tree", "aria-label": "Signals of the run" });
    this.#tree = new ScopeTree(side, {
      addSignal: (signal) => this.#add([signalRow(signal, 0)]),
      addScope: (scope) => this.#add(scopeRows(scope, 0)),
    });
    host.append(
      element(
        "div",
        { class: "waves" },
        waveBar(this.#actions, side, this.#readout),
        element(
          "div",
          { class: "waves-body" },
          side,
          element(
            "div",
            { class: "waves-main" },
            element("div", { class: "waves-head" }, element("span", {}, "Row"), element("span", {}, "At the cursor"), this.#canvas.axis),
            element("div", { class: "waves-frame" }, this.#scroll),
            this.#menu.node,
          ),
        ),
        this.#live,
      ),
    );
    this.#rows.addEventListener("rows", () => {
      this.#showRows();
      this.dispatchEvent(new Event("rows"));
    });
    this.#cursor.addEventListener("change", () => this.#showCursor());
  }

  /** Rows of the waves, also those in closed groups. */
  get rows() {
    return this.#rows.all;
  }

  /**
   * Shows a dump.
   * @param {Dump} dump
   * @param {{clockHz?: number, save?: import("./savefile.js").SaveFile | null, units?: import("./valueformat.js").RealUnit[]}} [given]
   *   rate of the reference clock, which is found in the dump if it is 0 or left out, the first
   *   rows, and real units of counts
   */
  async show(dump, { clockHz = 0, save = null, units = [] } = {}) {
    this.#menu.offer(units);
    if (clockHz > 0) dump.setClock(clockHz);
    else await dump.findClock();
    this.#dump = dump;
    this.#selected = null;
    this.#tree.show(dump);
    const saved = save ? savedRows(save.rows, dump) : [];
    const [top] = dump.scopes;
    this.#formats = new Map(saved.flatMap((row) => (row.signal ? [[row.signal.path, row.format]] : [])));
    this.#scroll.scrollTop = 0;
    this.#rows.reset(saved.length > 0 ? saved : (top?.signals ?? []).map((signal) => signalRow(signal, 0)));
    const shown = save?.shown ? inUnits(save.shown, dump.unit) : null;
    this.#canvas.show(dump, shown);
    this.#lastTime = NaN;
    this.#cursor.show(dump);
    // Values at the cursor are those of a place that is seen.
    const isSeen = !shown || (this.#cursor.time >= shown.start && this.#cursor.time <= shown.end);
    if (!isSeen) this.#cursor.goToTickAt((shown.start + shown.end) / 2);
  }

  /**
   * Adds the row of a signal if it has none in sight, selects it and shows it.
   * @param {string} path
   */
  async add(path) {
    const signal = this.#dump?.find(path);
    if (!signal) return;
    const known = this.#rows.visible.find((row) => row.signal === signal);
    const row = known ?? signalRow(signal, 0);
    const format = this.#formats.get(signal.path);
    if (!known) {
      if (format) row.format = format;
      this.#add([row]);
    }
    this.#select(row);
  }

  /**
   * Returns the value of a signal at the cursor as text: "" if there is no such signal or value, or
   * if its changes are being read; `values` is dispatched when they are.
   * @param {string} path
   */
  valueAtCursor(path) {
    const signal = this.#dump?.find(path);
    if (!signal) return "";
    const row = this.#rows.all.find((each) => each.signal === signal);
    const format = row?.format ?? this.#formats.get(signal.path) ?? usualFormat(signal);
    return this.#valueText(signal, format);
  }

  /** Draws all anew, such as after a change of colours. */
  redraw() {
    this.#canvas.redraw();
  }

  /** @returns {import("./wavekeys.js").WaveActions} */
  #waveActions() {
    const { view } = this.#canvas;
    /** @param {(row: WaveRow) => void} change */
    const change = (change) => {
      if (this.#selected?.type !== "signal") return;
      change(this.#selected);
      this.#rows.update();
    };
    /** @param {() => void} move */
    const look = (move) => {
      move();
      this.redraw();
    };
    const curves = /** @type {const} */ ({ no: "step", step: "line", line: "no" });
    return {
      step: (ticks) => this.#moved(() => this.#cursor.step(ticks)),
      edge: (direction) => {
        const signal = this.#selected?.signal;
        if (signal) void this.#moved(() => this.#cursor.goToEdge(signal, direction));
      },
      pan: (part) => look(() => view.pan(part * view.width)),
      zoom: (factor) => look(() => view.zoom(factor, this.#zoomPlace())),
      fit: () => look(() => view.fit()),
      zoomToSelection: () => {
        const { marker, time } = this.#cursor;
        if (marker !== null) look(() => view.show(Math.min(marker, time), Math.max(marker, time)));
      },
      mark: () => this.#cursor.mark(this.#cursor.time),
      goToEnd: (end) => {
        const time = end > 0 ? Infinity : -Infinity;
        void this.#moved(() => this.#cursor.goToTickAt(time));
      },
      select: (rows) => this.#selectNext(rows),
      shift: (rows) => {
        if (this.#selected) this.#rows.shift(this.#selected, rows);
        this.#revealSelected();
      },
      remove: () => this.#remove(),
      open: () => {
        if (this.#selected?.type === "group") this.#rows.toggle(this.#selected);
        if (this.#selected?.type === "signal") this.#menu.open(this.#selected);
      },
      radix: (radix) => change((row) => (row.format = { ...row.format, radix })),
      curve: () =>
        change((row) => {
          row.curve = curves[row.curve];
          if (row.curve === "step" && row.height === 1) row.height = 3;
          if (row.curve === "no") row.height = 1;
        }),
      grow: (rows) =>
        change((row) => (row.height = Math.max(1, Math.min(MOST_HEIGHT, row.height + rows)))),
      search: () => this.#tree.focus(),
    };
  }

  /**
   * Moves the cursor, and the window with it.
   * @param {() => void | Promise<void>} move
   */
  async #moved(move) {
    await move();
    this.#canvas.view.reveal(this.#cursor.time);
    this.redraw();
  }

  /** Returns the place that stays when keys zoom: the cursor or the middle. */
  #zoomPlace() {
    const x = this.#canvas.view.x(this.#cursor.time);
    return x >= 0 && x <= this.#canvas.view.width ? x : this.#canvas.view.width / 2;
  }

  /** @param {WaveRow[]} rows */
  #add(rows) {
    this.#rows.add(rows, this.#selected);
    this.#select(rows[0]);
  }

  #remove() {
    const row = this.#selected;
    if (!row) return;
    const index = this.#rows.visible.indexOf(row);
    this.#selected = this.#rows.visible[index + 1] ?? this.#rows.visible[index - 1] ?? null;
    this.#rows.remove(row);
    // The rows of a group are removed with it.
    if (this.#selected && !this.#rows.all.includes(this.#selected)) this.#selected = null;
  }

  /** @param {1 | -1} step */
  #selectNext(step) {
    const { visible } = this.#rows;
    const index = this.#selected ? visible.indexOf(this.#selected) : -1;
    const next = visible[Math.min(visible.length - 1, Math.max(0, index + step))];
    if (next) this.#select(next);
  }

  /** @param {WaveRow} row */
  #select(row) {
    this.#selected = row;
    this.#revealSelected();
    this.#tell();
  }

  /** Scrolls just so far that the selected row is in sight. */
  #revealSelected() {
    const index = this.#selected ? this.#rows.visible.indexOf(this.#selected) : -1;
    if (index >= 0) {
      const height = this.#scroll.clientHeight;
      if (height === 0) return;
      const top = this.#rows.top(index);
      const bottom = this.#rows.top(index + 1);
      if (top < this.#scroll.scrollTop) this.#scroll.scrollTop = top;
      else if (bottom > this.#scroll.scrollTop + height) this.#scroll.scrollTop = bottom - height;
    }
    this.#showRows();
  }

  #showRows() {
    const height = this.#scroll.clientHeight;
    this.#spacer.style.height = `${Math.max(0, this.#rows.height - height)}px`;
    this.#names.show(this.#scroll.scrollTop, height, this.#selected);
    this.#canvas.redraw();
  }

  #showCursor() {
    const { view } = this.#canvas;
    const { time } = this.#cursor;
    // The window follows a play head that leaves it, and stays if it is elsewhere.
    if (view.has(this.#lastTime) && !view.has(time)) {
      view.reveal(time);
      this.redraw();
    }
    this.#lastTime = time;
    this.#readout.textContent = this.#cursor.text();
    this.#names.showValues();
    this.#canvas.redrawCursor();
    this.#tell();
    this.dispatchEvent(new Event("values"));
  }

  /** Has the value of the selected row read out as soon as the cursor rests. */
  #tell() {
    clearTimeout(this.#telling);
    this.#telling = setTimeout(() => {
      const row = this.#selected;
      const value = row?.signal ? `, ${row.label} ${this.#valueText(row.signal, row.format)}` : "";
      this.#live.textContent = this.#cursor.text() + value;
    }, REST);
  }

  /**
   * @param {DumpSignal | null} signal
   * @param {ValueFormat} format
   */
  #valueText(signal, format) {
    const dump = this.#dump;
    if (!dump || !signal || this.#cursor.time < dump.start || this.#cursor.time > dump.end) return "";
    const changes = this.#changes(signal);
    return changes ? valueText(valueAt(changes, this.#cursor.time), signal, format) : "";
  }

  /**
   * Returns the changes of a signal or, if they are not read yet, nothing; they are shown later.
   * @param {DumpSignal} signal
   */
  #changes(signal) {
    const dump = this.#dump;
    const changes = dump?.loaded(signal);
    if (changes || !dump) return changes;
    void dump.changes(signal).then(() => this.#later(), (error) => {
      this.#readout.textContent = error instanceof Error ? error.message : String(error);
    });
    return undefined;
  }

  /** Shows what was read, once for all that was read in a frame. */
  #later() {
    if (this.#isLate) return;
    this.#isLate = true;
    requestAnimationFrame(() => {
      this.#isLate = false;
      this.#names.showValues();
      this.redraw();
      this.dispatchEvent(new Event("values"));
    });
  }
}

/**
 * Returns times in units of a dump.
 * @param {{start: number, end: number}} times in whole s, ms, … fs
 * @param {number} unit in seconds: one, ten or a hundred of them
 */
function inUnits({ start, end }, unit) {
  const exponent = Math.round(Math.log10(unit));
  const factor = 10 ** (exponent - 3 * Math.floor(exponent / 3));
  return { start: start / factor, end: end / factor };
}
