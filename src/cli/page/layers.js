import { element } from "./dom.js";

/**
 * Draws into a canvas whose unit is a CSS pixel.
 * @callback LayerDrawing
 * @param {CanvasRenderingContext2D} context
 * @param {number} width
 * @param {number} height
 * @returns {void}
 */

/**
 * Two canvases on each other: one for what seldom changes, and one above it for what follows the
 * pointer and the play head. Each is drawn in the next frame after it was marked.
 */
export class CanvasLayers {
  /** Element that holds both; its size decides theirs. */
  node;
  width = 0;
  height = 0;
  #layers;
  #frame = 0;

  /**
   * @param {Record<string, import("./dom.js").AttributeValue>} attributes of the upper canvas, which takes keys and the pointer
   * @param {LayerDrawing} drawBase
   * @param {LayerDrawing} drawAbove
   */
  constructor(attributes, drawBase, drawAbove) {
    const base = element("canvas", { "aria-hidden": "true" });
    const above = element("canvas", { tabindex: 0, ...attributes });
    this.node = element("div", { class: "layers" }, base, above);
    this.above = above;
    this.#layers = [
      { canvas: base, draw: drawBase, marked: true },
      { canvas: above, draw: drawAbove, marked: true },
    ];
    new ResizeObserver(() => this.#resize()).observe(this.node);
  }

  /** Has both drawn again. */
  markAll() {
    for (const layer of this.#layers) layer.marked = true;
    this.#request();
  }

  /** Has the lower one drawn again. */
  markBase() {
    this.#layers[0].marked = true;
    this.#request();
  }

  /** Has the upper one drawn again. */
  markAbove() {
    this.#layers[1].marked = true;
    this.#request();
  }

  /**
   * Returns the pointer's place in CSS pixels from the upper left corner.
   * @param {MouseEvent} event
   * @returns {[number, number]}
   */
  place(event) {
    const box = this.above.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #resize() {
    const box = this.node.getBoundingClientRect();
    if (box.width === this.width && box.height === this.height) return;
    this.width = box.width;
    this.height = box.height;
    this.node.dispatchEvent(new CustomEvent("layout"));
    this.markAll();
  }

  #request() {
    if (this.#frame === 0) this.#frame = requestAnimationFrame(() => this.#draw());
  }

  #draw() {
    this.#frame = 0;
    if (this.width === 0 || this.height === 0) return;
    const ratio = window.devicePixelRatio || 1;
    for (const layer of this.#layers) {
      if (!layer.marked) continue;
      layer.marked = false;
      const { canvas } = layer;
      const [wide, high] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
      if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
      const context = canvas.getContext("2d");
      if (!context) continue;
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, this.width, this.height);
      layer.draw(context, this.width, this.height);
    }
  }
}
