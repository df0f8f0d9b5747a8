import { clear, element } from "./dom.js";

/** @typedef {import("./dump.js").Dump} Dump */
/** @typedef {import("./dump.js").DumpScope} DumpScope */
/** @typedef {import("./dump.js").DumpSignal} DumpSignal */

/** Number of entries that are shown at once: a memory has thousands of words. */
const TREE_PAGE = 200;

/**
 * What a reader chooses in the tree.
 * @typedef {object} TreeChoices
 * @property {(signal: DumpSignal) => void} addSignal
 * @property {(scope: DumpScope) => void} addScope
 */

/** Tree of the scopes and signals of a dump, with a search. */
export class ScopeTree {
  #choices;
  #list = element("ul", { class: "waves-tree-list", "aria-label": "Scopes and signals" });
  #search;
  /** @type {Dump | null} */
  #dump = null;

  /**
   * @param {HTMLElement} host
   * @param {TreeChoices} choices
   */
  constructor(host, choices) {
    this.#choices = choices;
    this.#search = element("input", {
      type: "search",
      class: "waves-search",
      placeholder: "Search signals",
      "aria-label": "Search signals and scopes",
      oninput: () => this.#fill(),
      onkeydown: (/** @type {KeyboardEvent} */ event) => {
        if (event.key === "Escape") this.#clearSearch(event);
      },
    });
    host.append(this.#search, this.#list);
  }

  /** @param {Dump} dump */
  show(dump) {
    this.#dump = dump;
    this.#search.value = "";
    this.#fill();
  }

  focus() {
    this.#search.focus();
  }

  /** @param {KeyboardEvent} event */
  #clearSearch(event) {
    if (this.#search.value === "") return;
    event.preventDefault();
    this.#search.value = "";
    this.#fill();
  }

  #fill() {
    clear(this.#list);
    if (!this.#dump) return;
    const wanted = this.#search.value.toLowerCase().split(/\s+/).filter(Boolean);
    if (wanted.length > 0) {
      const found = foundIn(this.#dump, wanted);
      if (found.length === 0) this.#list.append(element("li", { class: "waves-none" }, "Nothing found"));
      this.#page(this.#list, found);
      return;
    }
    for (const scope of this.#dump.scopes) this.#list.append(this.#scope(scope, true));
  }

  /**
   * Adds the first entries, and a button for more.
   * @param {HTMLElement} list
   * @param {(() => HTMLElement)[]} entries
   */
  #fillPage(list, entries) {
    for (const entry of entries.slice(0, TREE_PAGE)) list.append(entry());
    const rest = entries.slice(TREE_PAGE);
    if (rest.length === 0) return;
    const more = element("li", {});
    const show = () => {
      more.remove();
      this.#fillPage(list, rest);
    };
    more.append(element("button", { type: "button", onclick: show }, `${rest.length} more`));
    list.append(more);
  }

  /**
   * @param {HTMLElement} list
   * @param {(DumpSignal | DumpScope)[]} found
   */
  #page(list, found) {
    const entries = found.map((each) =>
      "scopes" in each
        ? () => this.#scope(each, false, each.path)
        : () => this.#signal(each, each.path),
    );
    this.#fillPage(list, entries);
  }

  /**
   * @param {DumpScope} scope
   * @param {boolean} open
   * @param {string} [label]
   */
  #scope(scope, open, label = scope.name) {
    const inner = element("ul", {});
    const item = element("li", {});
    let isFilled = false;
    const toggle = element("button", { type: "button", class: "waves-scope" }, label);
    /** @param {boolean} isOpen */
    const set = (isOpen) => {
      if (isOpen && !isFilled) {
        isFilled = true;
        this.#fillPage(inner, [
          ...scope.scopes.map((each) => () => this.#scope(each, false)),
          ...scope.signals.map((each) => () => this.#signal(each, each.name)),
        ]);
      }
      inner.hidden = !isOpen;
      toggle.setAttribute("aria-expanded", String(isOpen));
    };
    toggle.addEventListener("click", () => set(inner.hidden));
    const add = element(
      "button",
      {
        type: "button",
        class: "waves-add",
        title: `Add all of ${scope.path}`,
        "aria-label": `Add all of ${scope.path}`,
        onclick: () => this.#choices.addScope(scope),
      },
      "+",
    );
    item.append(element("div", { class: "waves-scope-line" }, toggle, add), inner);
    set(open);
    return item;
  }

  /**
   * @param {DumpSignal} signal
   * @param {string} label
   */
  #signal(signal, label) {
    const range = signal.width > 1 ? ` [${signal.width - 1}:0]` : "";
    const button = element(
      "button",
      {
        type: "button",
        class: "waves-signal",
        title: `Add ${signal.path}`,
        onclick: () => this.#choices.addSignal(signal),
      },
      label,
      element("small", {}, range),
    );
    return element("li", {}, button);
  }
}

/**
 * Returns the scopes and signals whose path has all words.
 * @param {Dump} dump
 * @param {string[]} wanted in lower case
 */
function foundIn(dump, wanted) {
  /** @param {string} path */
  const matches = (path) => {
    const text = path.toLowerCase();
    return wanted.every((word) => text.includes(word));
  };
  /** @type {DumpScope[]} */
  const scopes = [];
  /** @param {DumpScope} scope */
  const search = (scope) => {
    // Below a scope that is found, all others would be found too.
    if (matches(scope.path)) scopes.push(scope);
    else scope.scopes.forEach(search);
  };
  dump.scopes.forEach(search);
  return [...scopes, ...dump.signals.filter(({ path }) => matches(path))];
}
