/** Coverage of pixels by a line, drawn with smooth edges: 255 is a covered pixel. */
export class LineMask {
  #width;
  #height;
  #half;
  coverage;

  /**
   * @param {number} width pixels
   * @param {number} height
   * @param {number} thickness of the line in pixels
   */
  constructor(width, height, thickness) {
    this.#width = width;
    this.#height = height;
    this.#half = thickness / 2;
    this.coverage = new Uint8Array(width * height);
  }

  /**
   * Draws a straight line. The effort is its length in the window.
   * @param {number} x0 pixels right of the left edge
   * @param {number} y0 pixels below the upper edge
   * @param {number} x1
   * @param {number} y1
   */
  line(x0, y0, x1, y1) {
    const [width, height] = [this.#width, this.#height];
    if (Math.abs(x1 - x0) >= Math.abs(y1 - y0)) this.#along(x0, y0, x1, y1, width, height, 1, width);
    else this.#along(y0, x0, y1, x1, height, width, width, 1);
  }

  /**
   * Draws a line by its longer direction: at each step along, the pixels across it.
   * @param {number} from along
   * @param {number} begin across, at `from`
   * @param {number} to along
   * @param {number} end across, at `to`
   * @param {number} most steps along
   * @param {number} wide pixels across
   * @param {number} step index from a pixel to the next one along
   * @param {number} stride index from a pixel to the next one across
   */
  #along(from, begin, to, end, most, wide, step, stride) {
    if (from > to) [from, begin, to, end] = [to, end, from, begin];
    const slope = to > from ? (end - begin) / (to - from) : 0;
    // Across it is farther by the slope.
    const narrows = 255 / Math.sqrt(1 + slope * slope);
    // Ends are cut along the pixels, far enough to fill the corners between lines.
    const beyond = (this.#half * narrows) / 255;
    const first = Math.max(0, Math.round(from - beyond - 0.5));
    const last = Math.min(most - 1, Math.round(to + beyond - 0.5));
    const reach = (this.#half + 0.5) * (255 / narrows);
    const edge = 255 * (this.#half + 0.5);
    const { coverage } = this;
    let middle = begin + (first + 0.5 - from) * slope;
    for (let along = first; along <= last; along += 1, middle += slope) {
      const low = Math.max(0, Math.ceil(middle - reach - 0.5));
      const high = Math.min(wide - 1, Math.floor(middle + reach - 0.5));
      let index = along * step + low * stride;
      for (let across = low; across <= high; across += 1, index += stride) {
        const distance = across + 0.5 - middle;
        const covered = edge - (distance < 0 ? -distance : distance) * narrows;
        if (covered > coverage[index]) coverage[index] = covered > 255 ? 255 : covered;
      }
    }
  }

  /**
   * Puts a colour into an image where the line is, over what is there.
   * @param {Uint8ClampedArray} pixels red, green, blue and opacity of each
   * @param {number[]} colour red, green and blue
   */
  over(pixels, [red, green, blue]) {
    const { coverage } = this;
    for (let k = 0, at = 0; k < coverage.length; k += 1, at += 4) {
      if (coverage[k] === 0) continue;
      const above = coverage[k] / 255;
      const below = (pixels[at + 3] / 255) * (1 - above);
      const whole = above + below;
      pixels[at] = (red * above + pixels[at] * below) / whole;
      pixels[at + 1] = (green * above + pixels[at + 1] * below) / whole;
      pixels[at + 2] = (blue * above + pixels[at + 2] * below) / whole;
      pixels[at + 3] = 255 * whole;
    }
  }
}
