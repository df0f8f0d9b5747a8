/**
 * Colours of the page's theme for drawings on canvases, by the names of the custom properties.
 */
export class Palette {
  /** @type {CSSStyleDeclaration | null} */
  #style = null;
  #host;
  #changed;

  /**
   * @param {HTMLElement} host element whose colours count
   * @param {() => void} changed called when the theme has changed
   */
  constructor(host, changed) {
    this.#host = host;
    this.#changed = changed;
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.renew());
    const watch = { attributes: true, attributeFilter: ["data-theme"] };
    new MutationObserver(() => this.renew()).observe(document.documentElement, watch);
  }

  /** Reads the colours again. */
  renew() {
    this.#style = null;
    this.#changed();
  }

  /**
   * Returns a colour, such as that of `--accent` for `accent`.
   * @param {string} name
   */
  colour(name) {
    this.#style ??= getComputedStyle(this.#host);
    return this.#style.getPropertyValue(`--${name}`).trim() || "currentColor";
  }
}
