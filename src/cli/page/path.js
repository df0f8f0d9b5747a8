import { append, clear, element } from "./dom.js";
import { ErrorStrip } from "./errorstrip.js";
import { PathCanvas } from "./pathcanvas.js";
import { largestError, pathViews } from "./pathviews.js";
import { Player } from "./player.js";
import { readable, readableTime } from "./quantities.js";
import { initialMagnification } from "./series.js";

/** @typedef {import("./series.js").Series} Series */
/** @typedef {import("./pathviews.js").PathView} PathView */

/** 1, 2, 5, 10, … 10⁶: a rounding to counts of a long path needs the last ones. */
const MAGNIFICATIONS = Array.from({ length: 19 }, (_, k) => [1, 2, 5][k % 3] * 10 ** Math.floor(k / 3));
const SPEEDS = [0.001, 0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10];

const PATH_KEYS = [
  ["← →", "one row back or on; with Shift, a hundredth of the run"],
  ["Home End", "begin, end"],
  ["Space", "play or pause"],
  ["+ −", "zoom about the play head"],
  ["W A S D", "move the drawing"],
  ["0", "fit"],
  ["[ ]", "magnify the error less or more"],
  ["Wheel, drag", "zoom at the pointer, move"],
];

/**
 * The path of a run: commanded and actual positions, the error magnified, and the error of each axis
 * over time, at the play head that all panes share.
 */
export class PathPane {
  /** @type {Series | null} */
  #series = null;
  /** @type {PathView[]} */
  #views = [];
  #playhead;
  #player;
  #canvas = new PathCanvas({ class: "path-canvas", role: "application" });
  #strip = new ErrorStrip({ class: "path-errors", role: "application" });
  #view = element("select", { onchange: () => this.#chooseView(false) });
  #magnification = element("input", {
    type: "range", min: 0, max: MAGNIFICATIONS.length - 1, step: 1, oninput: () => this.#magnify(),
  });
  #factor = element("output", { class: "path-factor" });
  #play = element("button", { type: "button", class: "path-play", onclick: () => this.#player.toggle() }, "Play");
  #speed = element("select", { onchange: () => (this.#player.speed = Number(this.#speed.value)) });
  #slider = element("input", {
    type: "range", min: 0, max: 0, oninput: () => this.#playhead.set(Number(this.#slider.value), this),
  });
  #readout = element("p", { class: "path-readout", role: "status", "aria-live": "polite" });
  #hover = element("p", { class: "path-hover" });
  #body;
  #empty = element("p", { class: "path-empty" }, "No path yet. Run a scenario.");

  /**
   * @param {HTMLElement} host
   * @param {import("./playhead.js").Playhead} playhead
   */
  constructor(host, playhead) {
    this.#playhead = playhead;
    this.#player = new Player(playhead);
    for (const speed of SPEEDS) append(this.#speed, element("option", { value: speed, selected: speed === 1 }, `${speed}×`));
    this.#body = element("div", { class: "path", hidden: true }, this.#toolbar(), this.#canvas.node,
      this.#readout, this.#hover, this.#transport(), this.#strip.node, keyList());
    append(host, this.#empty, this.#body);
    this.#listen();
  }

  /**
   * Shows a series. View, zoom and magnification stay if it continues the one before.
   * @param {Series | null} series null if the run has none
   * @param {{ clockHz: number, title: string }} about ticks per second, 0 if not known, and the
   *   name of the run
   */
  show(series, { clockHz, title }) {
    const before = this.#series;
    this.#series = series && series.rows > 0 ? series : null;
    const goesOn = before !== null && (this.#series?.continues(before) ?? false);
    if (!goesOn) this.#player.pause();
    this.#body.hidden = this.#series === null;
    this.#empty.hidden = this.#series !== null;
    if (!this.#series) return;
    this.#player.clockHz = clockHz || this.#series.clockHz;
    const name = `Path of ${title}: commanded and actual`;
    this.#canvas.node.querySelector("[tabindex]")?.setAttribute("aria-label", name);
    this.#strip.node.querySelector("[tabindex]")?.setAttribute("aria-label", `Errors of the axes over time, ${title}`);
    const label = this.#views[Number(this.#view.value)]?.label;
    this.#views = pathViews(this.#series);
    clear(this.#view);
    this.#views.forEach((view, k) => append(this.#view, element("option", { value: k, selected: view.label === label }, view.label)));
    this.#limitSlider(this.#series.ticks);
    this.#strip.show(this.#series);
    this.#chooseView(goesOn);
    this.#follow();
  }

  /** Draws again, with the colours that there are now. */
  redraw() {
    this.#canvas.redraw();
    this.#strip.redraw();
  }

  #toolbar() {
    const legend = element("span", { class: "path-legend" },
      element("span", { class: "path-commanded" }, "commanded"),
      element("span", { class: "path-actual" }, "actual"));
    return element("div", { class: "path-bar" },
      element("label", {}, "View ", this.#view),
      element("label", { class: "path-magnification" }, "Error ", this.#magnification, this.#factor),
      element("button", { type: "button", onclick: () => this.#canvas.zoomAtHead(1.5), "aria-label": "Zoom in" }, "+"),
      element("button", { type: "button", onclick: () => this.#canvas.zoomAtHead(1 / 1.5), "aria-label": "Zoom out" }, "−"),
      element("button", { type: "button", onclick: () => this.#fit() }, "Fit"),
      legend);
  }

  #transport() {
    return element("div", { class: "path-bar" }, this.#play,
      element("label", {}, "Speed ", this.#speed),
      element("label", { class: "path-slider" }, element("span", { class: "path-hidden" }, "Tick"), this.#slider));
  }

  #listen() {
    this.#playhead.addEventListener("change", () => this.#follow());
    this.#player.addEventListener("state", () => {
      this.#play.textContent = this.#player.playing ? "Pause" : "Play";
      // Sixty values a second are not read aloud.
      this.#readout.setAttribute("aria-live", this.#player.playing ? "off" : "polite");
    });
    for (const target of [this.#canvas, this.#strip]) {
      target.addEventListener("place", (event) => this.#goTo(/** @type {CustomEvent<number>} */ (event).detail));
    }
    this.#canvas.addEventListener("hover", (event) => {
      const row = /** @type {CustomEvent<number | null>} */ (event).detail;
      this.#hover.textContent = row === null ? "" : `At the pointer: ${this.#text(row)}`;
    });
    this.#canvas.node.addEventListener("keydown", (event) => this.#key(event, false));
    this.#strip.node.addEventListener("keydown", (event) => this.#key(event, true));
  }

  /** @param {boolean} keeps magnification and zoom */
  #chooseView(keeps) {
    const view = this.#views[Number(this.#view.value)];
    if (!this.#series || !view) return;
    if (!keeps) {
      const wanted = initialMagnification(largestError(view.axes), extentOf(view));
      const place = MAGNIFICATIONS.findLastIndex((factor) => factor <= wanted * 1.001);
      this.#magnification.value = String(place);
    }
    this.#canvas.show(this.#series, view, this.#factorShown(), keeps);
    this.#describe();
  }

  #factorShown() {
    return MAGNIFICATIONS[Number(this.#magnification.value)];
  }

  #magnify() {
    this.#canvas.magnify(this.#factorShown());
    this.#describe();
  }

  #describe() {
    const text = `${this.#factorShown()}×`;
    this.#factor.textContent = text;
    this.#magnification.setAttribute("aria-valuetext", text);
    this.#magnification.title = `The actual path is drawn at commanded + ${this.#factorShown()} × (actual − commanded).`;
    this.#readout.textContent = this.#text(this.#row());
  }

  #fit() {
    this.#canvas.fit();
    this.#strip.fit();
  }

  /** @param {Float64Array} ticks */
  #limitSlider(ticks) {
    const [first, last] = [ticks[0], ticks[ticks.length - 1]];
    this.#slider.min = String(first);
    this.#slider.max = String(last);
    // A key moves it by a thousandth of the run.
    this.#slider.step = String(Math.max(1, Math.floor((last - first) / 1000)));
  }

  /** Row at the play head. */
  #row() {
    return this.#series?.rowAtTick(this.#playhead.tick) ?? 0;
  }

  /** @param {number} row */
  #goTo(row) {
    if (!this.#series) return;
    const within = Math.min(this.#series.rows - 1, Math.max(0, row));
    this.#playhead.set(this.#series.ticks[within], this);
  }

  #follow() {
    if (!this.#series) return;
    const row = this.#row();
    this.#canvas.moveTo(row);
    this.#strip.moveTo(row);
    this.#slider.value = String(this.#playhead.tick);
    const text = this.#text(row);
    this.#slider.setAttribute("aria-valuetext", text);
    if (this.#readout.textContent !== text) this.#readout.textContent = text;
  }

  /**
   * Says what is in a row: time, position, distance, speed and errors of the group in view.
   * @param {number} row
   */
  #text(row) {
    const view = this.#views[Number(this.#view.value)];
    if (!this.#series || !view) return "";
    const { group } = view;
    const values = (/** @type {Float64Array[]} */ columns) => columns.map((column) => readable(column[row])).join(", ");
    const names = group.axes.map((axis) => axis.name).join(", ");
    return [
      `${readableTime(this.#series.times[row])}, tick ${this.#series.ticks[row]}`,
      `${names} = ${values(group.axes.map((axis) => axis.commanded))} ${group.unit}`,
      `error ${values(group.axes.map((axis) => axis.error))} ${group.unit}`,
      `distance ${readable(this.#series.distance(group)[row])} ${group.unit}`,
      `speed ${readable(this.#series.speed(group)[row])} ${group.unit}/s`,
    ].join("; ");
  }

  /**
   * @param {KeyboardEvent} event
   * @param {boolean} inStrip
   */
  #key(event, inStrip) {
    if (!this.#series || event.ctrlKey || event.metaKey || event.altKey) return;
    const row = this.#row();
    const step = event.shiftKey ? Math.max(1, Math.round(this.#series.rows / 100)) : 1;
    const pan = (/** @type {number} */ right, /** @type {number} */ down) => () =>
      inStrip ? this.#strip.pan(-right / 400) : this.#canvas.pan(right, down);
    const zoom = (/** @type {number} */ factor) => () => (inStrip ? this.#strip : this.#canvas).zoomAtHead(factor);
    /** @type {Record<string, () => void>} */
    const actions = {
      ArrowLeft: () => this.#goTo(row - step),
      ArrowRight: () => this.#goTo(row + step),
      Home: () => this.#goTo(0),
      End: () => this.#goTo(Infinity),
      " ": () => this.#player.toggle(),
      "+": zoom(1.25), "=": zoom(1.25), "-": zoom(0.8),
      w: pan(0, 40), s: pan(0, -40), a: pan(40, 0), d: pan(-40, 0),
      0: () => this.#fit(),
      "[": () => this.#stepMagnification(-1),
      "]": () => this.#stepMagnification(1),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** @param {number} by */
  #stepMagnification(by) {
    this.#magnification.value = String(Number(this.#magnification.value) + by);
    this.#magnify();
  }
}

/**
 * Returns the larger extent of the commanded path of a view's axes.
 * @param {PathView} view
 */
function extentOf(view) {
  const extents = view.axes.map(({ commanded }) => {
    let [least, greatest] = [Infinity, -Infinity];
    for (const value of commanded) {
      if (value < least) least = value;
      if (value > greatest) greatest = value;
    }
    return greatest - least;
  });
  return Math.max(0, ...extents);
}

function keyList() {
  const rows = PATH_KEYS.map(([keys, about]) => element("tr", {}, element("th", { scope: "row" }, keys), element("td", {}, about)));
  return element("details", { class: "path-keys" }, element("summary", {}, "Keys in the drawings"), element("table", {}, rows));
}
