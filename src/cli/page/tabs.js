import { element } from "./dom.js";

/** Panes of which one is shown, by tabs above them. */
export class Tabs {
  /** @type {Map<string, HTMLElement>} */
  #panes = new Map();
  #list = element("div", { role: "tablist", "aria-label": "Panes", class: "tabs" });
  /** Element to put into the page. */
  node = element("main", { class: "panes" }, this.#list);

  /** @param {string[]} names in the order of the tabs */
  constructor(names) {
    for (const name of names) {
      const id = name.toLowerCase().replaceAll(" ", "-");
      const pane = element("section", { role: "tabpanel", id: `pane-${id}`, "aria-labelledby": `tab-${id}`, class: `pane pane-${id}`, hidden: true });
      this.#list.append(element("button", { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": `pane-${id}`, onclick: () => this.open(name) }, name));
      this.node.append(pane);
      this.#panes.set(name, pane);
    }
    this.#list.addEventListener("keydown", (event) => this.#walk(event));
  }

  /** @param {string} name */
  pane(name) {
    return this.#panes.get(name) ?? element("section", {});
  }

  /** @param {string} name */
  open(name) {
    for (const [other, pane] of this.#panes) {
      pane.hidden = other !== name;
      const tab = this.#tab(pane);
      tab?.setAttribute("aria-selected", String(other === name));
      tab?.setAttribute("tabindex", other === name ? "0" : "-1");
    }
    // A pane that was hidden had no size.
    window.dispatchEvent(new Event("resize"));
  }

  /** @param {HTMLElement} pane */
  #tab(pane) {
    return /** @type {HTMLElement | null} */ (this.#list.querySelector(`[aria-controls="${pane.id}"]`));
  }

  /** Arrow keys go from tab to tab. @param {KeyboardEvent} event */
  #walk(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    const names = [...this.#panes.keys()];
    const open = names.findIndex((name) => !this.pane(name).hidden);
    const next = names[(open + step + names.length) % names.length];
    this.open(next);
    this.#tab(this.pane(next))?.focus();
  }
}
