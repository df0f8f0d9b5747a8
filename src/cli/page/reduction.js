/** Points of a block, which is drawn or left out as a whole. */
const BLOCK = 64;
/** Points that are stroked at once: one long path is drawn much more slowly than many short ones. */
const PATH_POINTS = 1024;
/** Effort of drawing a point, in pixels of a line. */
const POINT_EFFORT = 8;
/** Pixels by which a line may miss its points. */
const TOLERANCE = 0.25;
/** Levels of detail that are kept. */
const LEVELS_KEPT = 16;

/**
 * Points of a line that are enough for a scale: straight lines through them pass all others within
 * a quarter of a pixel.
 * @typedef {object} DetailLevel
 * @property {Uint32Array} rows rows of the points, increasing
 * @property {Float64Array} boxes least x, greatest x, least y and greatest y of each block and of
 *   the point after it
 * @property {Float32Array} efforts of drawing each block
 */

/**
 * Window on a plane: pixels right of and below the upper left corner are
 * `width / 2 + (x - x0) * scaleX` and `height / 2 - (y - y0) * scaleY`.
 * @typedef {object} PlaneWindow
 * @property {number} x0 point in the middle
 * @property {number} y0
 * @property {number} scaleX pixels per unit
 * @property {number} scaleY
 * @property {number} width pixels
 * @property {number} height
 */

/**
 * A line through points of a plane. It is drawn with no more points than the scale shows, and only
 * where it is in the window.
 */
export class Polyline {
  /** @type {Map<string, DetailLevel>} */
  #levels = new Map();
  /** @type {[number, number, number, number] | undefined} */
  #bounds;

  /**
   * @param {Float64Array} xs
   * @param {Float64Array} ys points with NaN are left out
   */
  constructor(xs, ys) {
    this.xs = xs;
    this.ys = ys;
  }

  /**
   * Returns least x, greatest x, least y and greatest y.
   * @returns {[number, number, number, number]}
   */
  bounds() {
    this.#bounds ??= boundsOf(this.xs, this.ys, 0, this.xs.length);
    return this.#bounds;
  }

  /**
   * Returns the effort of drawing the line in a window: about its length in pixels.
   * @param {PlaneWindow} view
   */
  effort(view) {
    const { boxes, efforts } = this.#level(view);
    let sum = 0;
    for (let block = 0; block < efforts.length; block += 1) if (!isOutside(boxes, block, view)) sum += efforts[block];
    return sum;
  }

  /**
   * Strokes the line in the context's style.
   * @param {CanvasRenderingContext2D} context
   * @param {PlaneWindow} view
   */
  stroke(context, view) {
    let [points, end] = [0, -1];
    context.beginPath();
    for (const [from, to] of this.#blocks(view)) {
      if (points > PATH_POINTS) {
        context.stroke();
        context.beginPath();
        [points, end] = [0, -1];
      }
      this.#each(view, from, to, (x0, y0, x1, y1, k) => {
        if (k === from && end !== from) context.moveTo(x0, y0);
        context.lineTo(x1, y1);
      });
      points += BLOCK;
      end = to;
    }
    context.stroke();
  }

  /**
   * Draws the line into a mask, block by block; yields the effort of each.
   * @param {import("./linemask.js").LineMask} mask
   * @param {PlaneWindow} view
   * @param {number} ratio pixels of the mask to one of the window
   * @returns {Generator<number, void>}
   */
  *mask(mask, view, ratio) {
    const { efforts } = this.#level(view);
    for (const [from, to] of this.#blocks(view)) {
      this.#each(view, from, to, (x0, y0, x1, y1) => mask.line(ratio * x0, ratio * y0, ratio * x1, ratio * y1));
      yield efforts[from / BLOCK];
    }
  }

  /**
   * Lists the blocks in a window, each with the points at its begin and at its end.
   * @param {PlaneWindow} view
   * @returns {Generator<[number, number], void>}
   */
  *#blocks(view) {
    const { rows, boxes } = this.#level(view);
    for (let block = 0; 4 * block < boxes.length; block += 1) {
      if (isOutside(boxes, block, view)) continue;
      yield [block * BLOCK, Math.min(rows.length - 1, (block + 1) * BLOCK)];
    }
  }

  /**
   * Goes over lines between points, in pixels. A single point is a line of no length.
   * @param {PlaneWindow} view
   * @param {number} from point
   * @param {number} to point
   * @param {(x0: number, y0: number, x1: number, y1: number, from: number) => void} draw
   */
  #each(view, from, to, draw) {
    const { rows } = this.#level(view);
    const { x0, y0, scaleX, scaleY, width, height } = view;
    const { xs, ys } = this;
    let [right, down] = [width / 2 + (xs[rows[from]] - x0) * scaleX, height / 2 - (ys[rows[from]] - y0) * scaleY];
    for (let k = from; k < to || k === from; k += 1) {
      const row = rows[Math.min(k + 1, to)];
      const [nextRight, nextDown] = [width / 2 + (xs[row] - x0) * scaleX, height / 2 - (ys[row] - y0) * scaleY];
      draw(right, down, nextRight, nextDown, k);
      [right, down] = [nextRight, nextDown];
    }
  }

  /**
   * Returns the row whose point is nearest to a pixel, or null if the line is farther away than
   * `reach` pixels. Of points that are as near, the one whose row is nearest to `preferred` counts:
   * a path may pass a place many times.
   * @param {PlaneWindow} view
   * @param {number} right pixels
   * @param {number} down pixels
   * @param {number} reach
   * @param {number} preferred
   * @returns {number | null}
   */
  nearest(view, right, down, reach, preferred) {
    const { rows, boxes } = this.#level(view);
    const x = view.x0 + (right - view.width / 2) / view.scaleX;
    const y = view.y0 - (down - view.height / 2) / view.scaleY;
    let [best, bestRow, from, to] = [reach, -1, 0, 0];
    for (let block = 0; 4 * block < boxes.length; block += 1) {
      const box = 4 * block;
      const beside = Math.max(boxes[box] - x, x - boxes[box + 1], 0) * view.scaleX;
      const above = Math.max(boxes[box + 2] - y, y - boxes[box + 3], 0) * view.scaleY;
      if (Math.hypot(beside, above) > best + 1) continue;
      const last = Math.min(rows.length - 1, (block + 1) * BLOCK);
      for (let k = block * BLOCK; k <= last; k += 1) {
        const next = Math.min(k + 1, last);
        const [distance, part] = this.#toSegment(view, x, y, rows[k], rows[next]);
        const row = Math.round(rows[k] + part * (rows[next] - rows[k]));
        const nearer = distance < best - 1;
        const asNear = distance < best + 1 && distance <= reach;
        const preferable = Math.abs(row - preferred) < Math.abs(bestRow - preferred);
        if (nearer || (asNear && (bestRow < 0 || preferable))) {
          best = Math.min(best, distance);
          [bestRow, from, to] = [row, rows[k], rows[next]];
        }
      }
    }
    return bestRow < 0 ? null : this.#nearestRow(view, x, y, from, to);
  }

  /**
   * Returns the row from `from` to `to` whose point is nearest.
   * @param {PlaneWindow} view
   * @param {number} x
   * @param {number} y
   * @param {number} from
   * @param {number} to
   */
  #nearestRow(view, x, y, from, to) {
    let [best, bestRow] = [Infinity, from];
    for (let row = from; row <= to; row += 1) {
      const [beside, above] = [(this.xs[row] - x) * view.scaleX, (this.ys[row] - y) * view.scaleY];
      const square = beside * beside + above * above;
      if (square < best) [best, bestRow] = [square, row];
    }
    return bestRow;
  }

  /**
   * Returns the distance to a segment in pixels, and where its nearest point is, from 0 to 1.
   * @param {PlaneWindow} view
   * @param {number} x
   * @param {number} y
   * @param {number} from row
   * @param {number} to row
   * @returns {[number, number]}
   */
  #toSegment(view, x, y, from, to) {
    const [alongX, alongY] = [(this.xs[to] - this.xs[from]) * view.scaleX, (this.ys[to] - this.ys[from]) * view.scaleY];
    const [fromX, fromY] = [(x - this.xs[from]) * view.scaleX, (y - this.ys[from]) * view.scaleY];
    const square = alongX * alongX + alongY * alongY;
    const part = square > 0 ? Math.min(1, Math.max(0, (fromX * alongX + fromY * alongY) / square)) : 0;
    return [Math.hypot(fromX - part * alongX, fromY - part * alongY), part];
  }

  /**
   * Returns the points for a scale. Scales are taken in powers of two, so that a zoom seldom needs
   * another level.
   * @param {PlaneWindow} view
   */
  #level(view) {
    const [powerX, powerY] = [view.scaleX, view.scaleY].map((scale) => Math.ceil(Math.log2(scale)));
    const key = `${powerX} ${powerY}`;
    const known = this.#levels.get(key);
    if (known) return known;
    const level = detailLevel(this.xs, this.ys, 2 ** powerX, 2 ** powerY);
    if (this.#levels.size >= LEVELS_KEPT) this.#levels.delete(this.#levels.keys().next().value ?? "");
    this.#levels.set(key, level);
    return level;
  }
}

/**
 * @param {Float64Array} boxes
 * @param {number} block
 * @param {PlaneWindow} view
 */
function isOutside(boxes, block, { x0, y0, scaleX, scaleY, width, height }) {
  const [box, halfX, halfY] = [4 * block, width / 2 / scaleX, height / 2 / scaleY];
  return boxes[box] > x0 + halfX || boxes[box + 1] < x0 - halfX || boxes[box + 2] > y0 + halfY || boxes[box + 3] < y0 - halfY;
}

/**
 * @param {Float64Array} xs
 * @param {Float64Array} ys
 * @param {number} scaleX pixels per unit
 * @param {number} scaleY
 * @returns {DetailLevel}
 */
function detailLevel(xs, ys, scaleX, scaleY) {
  const rows = keptRows(xs, ys, scaleX, scaleY);
  const boxes = new Float64Array(4 * Math.ceil(rows.length / BLOCK));
  const efforts = new Float32Array(boxes.length / 4);
  for (let block = 0; block * BLOCK < rows.length; block += 1) {
    let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
    let [before, effort] = [rows[block * BLOCK], 0];
    for (let k = block * BLOCK; k <= Math.min(rows.length - 1, (block + 1) * BLOCK); k += 1) {
      const [x, y] = [xs[rows[k]], ys[rows[k]]];
      if (x < left) left = x;
      if (x > right) right = x;
      if (y < bottom) bottom = y;
      if (y > top) top = y;
      effort += POINT_EFFORT + Math.abs(x - xs[before]) * scaleX + Math.abs(y - ys[before]) * scaleY;
      before = rows[k];
    }
    boxes.set([left, right, bottom, top], 4 * block);
    efforts[block] = effort;
  }
  return { rows, boxes, efforts };
}

/**
 * Returns rows between whose points straight lines pass all others within the tolerance, in one
 * pass: from the last point kept, the directions that pass all points since then are a sector, which
 * narrows. A point outside of it, or one that turns back, begins the next line.
 * @param {Float64Array} xs
 * @param {Float64Array} ys
 * @param {number} scaleX pixels per unit
 * @param {number} scaleY
 */
function keptRows(xs, ys, scaleX, scaleY) {
  const kept = new Uint32Array(xs.length + 1);
  let [count, anchor, before, farthest] = [0, -1, -1, -1];
  // Sides of the sector, and the distance of the farthest point.
  let [lowX, lowY, highX, highY, reach] = [0, 0, 0, 0, 0];
  const keep = (/** @type {number} */ row) => {
    if (count === 0 || kept[count - 1] !== row) kept[count++] = row;
    [anchor, farthest, reach] = [row, -1, 0];
  };
  for (let row = 0; row < xs.length; row += 1) {
    if (xs[row] !== xs[row] || ys[row] !== ys[row]) continue;
    if (anchor < 0) keep(row);
    for (;;) {
      const [right, up] = [(xs[row] - xs[anchor]) * scaleX, (ys[row] - ys[anchor]) * scaleY];
      const distance = Math.sqrt(right * right + up * up);
      if (reach > 0) {
        if (distance < reach - TOLERANCE) {
          keep(farthest);
          continue;
        }
        if (lowX * up - lowY * right < 0 || highX * up - highY * right > 0) {
          keep(before);
          continue;
        }
      }
      if (distance > TOLERANCE) {
        // Directions to the ends of the tolerance across the line of sight.
        const side = TOLERANCE / distance;
        const [fromX, fromY, toX, toY] = [right + up * side, up - right * side, right - up * side, up + right * side];
        if (reach === 0 || lowX * fromY - lowY * fromX > 0) [lowX, lowY] = [fromX, fromY];
        if (reach === 0 || highX * toY - highY * toX < 0) [highX, highY] = [toX, toY];
        if (distance > reach) [reach, farthest] = [distance, row];
      }
      break;
    }
    before = row;
  }
  if (anchor >= 0 && before !== anchor) keep(before);
  return kept.slice(0, count);
}

/**
 * @param {Float64Array} xs
 * @param {Float64Array} ys
 * @param {number} from
 * @param {number} to
 * @returns {[number, number, number, number]}
 */
function boundsOf(xs, ys, from, to) {
  let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let row = from; row < to; row += 1) {
    if (xs[row] < left) left = xs[row];
    if (xs[row] > right) right = xs[row];
    if (ys[row] < bottom) bottom = ys[row];
    if (ys[row] > top) top = ys[row];
  }
  return left <= right && bottom <= top ? [left, right, bottom, top] : [0, 0, 0, 0];
}
