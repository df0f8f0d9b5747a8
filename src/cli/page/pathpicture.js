import { LineMask } from "./linemask.js";

/** @typedef {import("./reduction.js").PlaneWindow} PlaneWindow */

/**
 * A line as it is drawn.
 * @typedef {object} DrawnLine
 * @property {import("./reduction.js").Polyline} line
 * @property {string} colour as `rgb(R, G, B)`
 * @property {number} thickness pixels
 */

/**
 * A drawing of a window, or of so much of it as there is.
 * @typedef {object} Picture
 * @property {HTMLCanvasElement} canvas
 * @property {PlaneWindow} view
 * @property {Iterator<unknown>} work draws on; yields after each part
 */

/** Time of a frame in which a picture is drawn on, in ms. */
const FRAME_WORK = 6;

/**
 * Drawing of lines that take longer than a frame. They are drawn into a picture by and by while the
 * window rests; until it is complete, and while the window moves, the picture before is shown as it
 * lies in the window. Around it the first picture is shown, which mostly has all of the lines.
 */
export class PathPicture {
  /** @type {Picture | null} */
  #first = null;
  /** @type {Picture | null} */
  #shown = null;
  /** @type {Picture | null} */
  #next = null;
  #lines;

  /** @param {() => DrawnLine[]} lines the upper one last */
  constructor(lines) {
    this.#lines = lines;
  }

  /** Forgets all pictures, as the lines or their colours have changed. */
  clear() {
    this.#first = this.#shown = this.#next = null;
  }

  /**
   * Shows the window.
   * @param {CanvasRenderingContext2D} context
   * @param {PlaneWindow} view
   * @param {boolean} rests the window does not move
   * @returns {boolean} true if there is more to draw in the next frame
   */
  show(context, view, rests) {
    // The first picture is drawn on however the window moves: there is no other.
    if (rests || !this.#shown) this.#drawOn(view, rests);
    const picture = this.#shown ?? this.#next;
    if (!picture) return false;
    const box = placeOf(picture.view, view);
    if (this.#first && this.#first !== picture && !covers(box, view)) {
      context.save();
      context.beginPath();
      context.rect(0, 0, view.width, view.height);
      context.rect(...box);
      context.clip("evenodd");
      paste(context, this.#first, view);
      context.restore();
    }
    paste(context, picture, view);
    return this.#next !== null && (rests || !this.#shown);
  }

  /**
   * @param {PlaneWindow} view
   * @param {boolean} rests
   */
  #drawOn(view, rests) {
    if (this.#shown && isSame(this.#shown.view, view)) {
      this.#next = null;
      return;
    }
    if (!this.#next || (rests && !isSame(this.#next.view, view))) this.#next = this.#begin(view);
    for (const end = performance.now() + FRAME_WORK; performance.now() < end; ) {
      if (!this.#next.work.next().done) continue;
      this.#first ??= this.#next;
      this.#shown = this.#next;
      this.#next = null;
      return;
    }
  }

  /** @param {PlaneWindow} view @returns {Picture} */
  #begin(view) {
    const ratio = window.devicePixelRatio || 1;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [Math.round(view.width * ratio), Math.round(view.height * ratio)];
    const kept = { ...view };
    return { canvas, view: kept, work: drawLines(canvas, this.#lines(), kept, ratio) };
  }
}

/**
 * Draws lines into a canvas, part by part.
 * @param {HTMLCanvasElement} canvas
 * @param {DrawnLine[]} lines
 * @param {PlaneWindow} view
 * @param {number} ratio pixels of the canvas to one of the window
 */
function* drawLines(canvas, lines, view, ratio) {
  const image = new ImageData(canvas.width, canvas.height);
  for (const { line, colour, thickness } of lines) {
    const mask = new LineMask(canvas.width, canvas.height, ratio * thickness);
    yield* line.mask(mask, view, ratio);
    mask.over(image.data, (colour.match(/[\d.]+/g) ?? []).slice(0, 3).map(Number));
    canvas.getContext("2d")?.putImageData(image, 0, 0);
    yield;
  }
}

/** @param {PlaneWindow} first @param {PlaneWindow} second */
function isSame(first, second) {
  const keys = /** @type {const} */ (["x0", "y0", "scaleX", "scaleY", "width", "height"]);
  return keys.every((key) => first[key] === second[key]);
}

/**
 * Returns left, top, width and height in pixels at which one window lies in another.
 * @param {PlaneWindow} inner
 * @param {PlaneWindow} outer
 * @returns {[number, number, number, number]}
 */
function placeOf(inner, outer) {
  const [growsX, growsY] = [outer.scaleX / inner.scaleX, outer.scaleY / inner.scaleY];
  const [width, height] = [inner.width * growsX, inner.height * growsY];
  const right = outer.width / 2 + (inner.x0 - outer.x0) * outer.scaleX;
  const down = outer.height / 2 - (inner.y0 - outer.y0) * outer.scaleY;
  return [right - width / 2, down - height / 2, width, height];
}

/**
 * @param {[number, number, number, number]} box
 * @param {PlaneWindow} view
 */
function covers([left, top, width, height], view) {
  return left <= 0 && top <= 0 && left + width >= view.width && top + height >= view.height;
}

/**
 * Draws the part of a picture that is in the window: of one that is much magnified it is small.
 * @param {CanvasRenderingContext2D} context
 * @param {Picture} picture
 * @param {PlaneWindow} view
 */
function paste(context, { canvas, view: from }, view) {
  const [left, top, width, height] = placeOf(from, view);
  const [x, y] = [Math.max(0, left), Math.max(0, top)];
  const [right, bottom] = [Math.min(view.width, left + width), Math.min(view.height, top + height)];
  if (right <= x || bottom <= y) return;
  const [perX, perY] = [canvas.width / width, canvas.height / height];
  context.drawImage(canvas, (x - left) * perX, (y - top) * perY, (right - x) * perX, (bottom - y) * perY, x, y, right - x, bottom - y);
}
