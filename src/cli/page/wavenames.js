import { clear, element } from "./dom.js";
import { ROW_HEIGHT } from "./waverows.js";

/** @typedef {import("./waverows.js").WaveRow} WaveRow */
/** @typedef {import("./waverows.js").WaveRows} WaveRows */

/** Pixels by which a pointer moves before a row is dragged. */
const DRAG_FROM = 5;

/**
 * What the list asks and tells.
 * @typedef {object} NamesUse
 * @property {(row: WaveRow) => string} value text of the value at the cursor
 * @property {(row: WaveRow) => void} select
 * @property {(row: WaveRow) => void} menu
 */

/** List of the names and values of the rows; only those in sight are elements. */
export class WaveNames {
  #rows;
  #use;
  #from = 0;
  #to = 0;
  #scroll = 0;
  /** @type {Map<WaveRow, {value: HTMLElement}>} */
  #shown = new Map();
  /** @type {{row: WaveRow, y: number, moved: boolean} | null} */
  #drag = null;
  #drop = element("div", { class: "waves-drop" });

  /**
   * @param {WaveRows} rows
   * @param {NamesUse} use
   * @param {(event: KeyboardEvent) => void} onkeydown
   */
  constructor(rows, use, onkeydown) {
    this.#rows = rows;
    this.#use = use;
    this.node = element("div", {
      class: "waves-names",
      role: "listbox",
      tabindex: 0,
      "aria-label": "Rows. Arrow keys select, Alt with an arrow key moves the row, Enter sets the format",
      onkeydown,
      onpointerdown: (/** @type {PointerEvent} */ event) => this.#down(event),
      onpointermove: (/** @type {PointerEvent} */ event) => this.#move(event),
      onpointerup: (/** @type {PointerEvent} */ event) => this.#up(event),
      onpointercancel: () => this.#endDrag(),
      ondblclick: (/** @type {MouseEvent} */ event) => this.#open(event),
      oncontextmenu: (/** @type {MouseEvent} */ event) => this.#open(event),
    });
  }

  /**
   * Shows the rows in sight.
   * @param {number} scroll height in pixels above what is in sight
   * @param {number} height in pixels in sight
   * @param {WaveRow | null} selected
   */
  show(scroll, height, selected) {
    const rows = this.#rows;
    this.#scroll = scroll;
    this.#from = Math.max(0, rows.at(Math.max(0, scroll)));
    this.#to = this.#from;
    clear(this.node);
    this.#shown.clear();
    this.node.removeAttribute("aria-activedescendant");
    for (; this.#to < rows.visible.length && rows.top(this.#to) < scroll + height; this.#to++) {
      this.node.append(this.#element(this.#to, selected));
    }
    this.showValues();
  }

  /** Indices of the visible rows in sight, the second exclusive. */
  get sight() {
    return [this.#from, this.#to];
  }

  /** Shows the values at the cursor anew. */
  showValues() {
    for (const [row, { value }] of this.#shown) value.textContent = this.#use.value(row);
  }

  /**
   * @param {number} index
   * @param {WaveRow | null} selected
   */
  #element(index, selected) {
    const row = this.#rows.visible[index];
    const isSelected = row === selected;
    const value = element("span", { class: "waves-value" });
    const node = element(
      "div",
      {
        id: `waves-row-${index}`,
        class: `waves-row waves-row-${row.type}`,
        role: "option",
        "aria-selected": isSelected,
        title: (row.signal ? row.signal.path : row.label) || null,
      },
      row.type === "group" ? (row.open ? "▾ " : "▸ ") : null,
      element("span", { class: "waves-name" }, row.label),
      value,
    );
    node.style.top = `${this.#rows.top(index) - this.#scroll}px`;
    node.style.height = `${row.height * ROW_HEIGHT}px`;
    node.style.paddingLeft = `${6 + 12 * row.depth}px`;
    if (row.type === "group") node.setAttribute("aria-label", `${row.label}, group, ${row.open ? "open" : "closed"}`);
    if (row.type === "signal") this.#shown.set(row, { value });
    if (row.label === "") node.setAttribute("aria-label", "Empty row");
    if (isSelected) this.node.setAttribute("aria-activedescendant", node.id);
    return node;
  }

  /** @param {MouseEvent} event */
  #height(event) {
    return event.clientY - this.node.getBoundingClientRect().top + this.#scroll;
  }

  /**
   * @param {MouseEvent} event
   * @returns {WaveRow | undefined}
   */
  #rowAt(event) {
    return this.#rows.visible[this.#rows.at(this.#height(event))];
  }

  /** @param {PointerEvent} event */
  #down(event) {
    const row = event.button === 0 ? this.#rowAt(event) : undefined;
    if (!row) return;
    this.#drag = { row, y: event.clientY, moved: false };
    this.node.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const drag = this.#drag;
    if (!drag) return;
    drag.moved ||= Math.abs(event.clientY - drag.y) >= DRAG_FROM;
    if (!drag.moved) return;
    this.#drop.style.top = `${this.#rows.top(this.#place(event)) - this.#scroll}px`;
    this.node.append(this.#drop);
  }

  /** @param {PointerEvent} event */
  #up(event) {
    const drag = this.#drag;
    this.#endDrag();
    if (!drag) return;
    if (drag.moved) this.#rows.moveBefore(drag.row, this.#rows.visible[this.#place(event)] ?? null);
    else this.#rows.toggle(drag.row);
    this.#use.select(drag.row);
  }

  #endDrag() {
    this.#drag = null;
    this.#drop.remove();
  }

  /**
   * Returns the index of the visible row before which a dragged one is dropped.
   * @param {MouseEvent} event
   */
  #place(event) {
    const y = Math.max(0, this.#height(event));
    const index = this.#rows.at(y);
    if (index < 0) return this.#rows.visible.length;
    const middle = (this.#rows.top(index) + this.#rows.top(index + 1)) / 2;
    return y < middle ? index : index + 1;
  }

  /** @param {MouseEvent} event */
  #open(event) {
    const row = this.#rowAt(event);
    if (!row || row.type !== "signal") return;
    event.preventDefault();
    this.#use.select(row);
    this.#use.menu(row);
  }
}
