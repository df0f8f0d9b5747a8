import { element } from "./dom.js";

/**
 * Colours of the page's theme for drawings on canvases, by the names of the custom properties.
 */
export class Palette {
  /** @type {Map<string, string>} */
  #colours = new Map();
  /** Takes on each colour, as the properties have two, one for each theme. */
  #probe = element("span", { hidden: true });
  #changed;

  /**
   * @param {HTMLElement} host element whose colours count
   * @param {() => void} changed called when the theme has changed
   */
  constructor(host, changed) {
    host.append(this.#probe);
    this.#changed = changed;
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.renew());
    const watch = { attributes: true, attributeFilter: ["data-theme"] };
    new MutationObserver(() => this.renew()).observe(document.documentElement, watch);
  }

  /** Reads the colours again. */
  renew() {
    this.#colours.clear();
    this.#changed();
  }

  /**
   * Returns a colour, such as that of `--accent` for `accent`.
   * @param {string} name
   */
  colour(name) {
    let colour = this.#colours.get(name);
    if (colour === undefined) {
      this.#probe.style.color = `var(--${name})`;
      colour = getComputedStyle(this.#probe).color;
      this.#colours.set(name, colour);
    }
    return colour;
  }
}
