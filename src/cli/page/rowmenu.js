import { element } from "./dom.js";
import { RADICES } from "./valueformat.js";

/** @typedef {import("./waverows.js").WaveRow} WaveRow */

/** Texts of the radices. */
const RADIX_NAMES = {
  binary: "Binary",
  hex: "Hexadecimal",
  unsigned: "Unsigned",
  signed: "Signed",
  state: "Name of the state",
};
/** Texts of the curves. */
const CURVE_NAMES = { no: "No curve", step: "Steps", line: "Lines" };
/** Greatest height of a row in rows of text. */
export const MOST_HEIGHT = 12;

/** Form with the format of a row. */
export class RowMenu {
  /** @type {WaveRow | null} */
  #row = null;
  #changed;
  #radix = choice(RADICES.map((radix) => [radix, RADIX_NAMES[radix]]));
  #curve = choice(Object.entries(CURVE_NAMES));
  #height = element("input", { type: "number", min: 1, max: MOST_HEIGHT, step: 1 });
  #fraction = element("input", { type: "number", min: 0, max: 64, step: 1 });
  #scale = element("input", { type: "number", step: "any" });
  #unit = element("input", { type: "text", size: 8, maxlength: 16 });
  #title = element("h3", {});
  #real = element("div", { class: "buttons" });

  /** @param {(row: WaveRow) => void} changed */
  constructor(changed) {
    this.#changed = changed;
    /**
     * @param {string} text
     * @param {HTMLElement} input
     */
    const field = (text, input) => element("label", {}, element("span", {}, text), input);
    this.node = element(
      "dialog",
      {
        class: "waves-menu",
        "aria-label": "Format of the row",
        onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event),
      },
      this.#title,
      element(
        "form",
        { method: "dialog", oninput: () => this.#take() },
        field("Values", this.#radix),
        field("Fraction bits", this.#fraction),
        field("Multiplied by", this.#scale),
        field("Unit", this.#unit),
        this.#real,
        field("Curve", this.#curve),
        field("Height in rows", this.#height),
        element("button", { type: "submit" }, "Close"),
      ),
    );
  }

  /**
   * Offers units in which counts of the run are real ones.
   * @param {import("./valueformat.js").RealUnit[]} units
   */
  offer(units) {
    const buttons = units.map(({ name, scale, text }) =>
      element("button", { type: "button", onclick: () => this.#show({ radix: "signed", scale: String(scale), unit: name }) }, text));
    this.#real.replaceChildren(...buttons);
  }

  /**
   * Puts a unit into the form and takes it; fraction bits stay.
   * @param {{ radix: string, scale: string, unit: string }} format
   */
  #show({ radix, scale, unit }) {
    if (!this.#radix.disabled) this.#radix.value = radix;
    this.#scale.value = scale;
    this.#unit.value = unit;
    this.#take();
  }

  /**
   * Shows the format of a row.
   * @param {WaveRow} row
   */
  open(row) {
    this.#row = row;
    const { format } = row;
    this.#title.textContent = row.label;
    this.#radix.value = format.radix;
    this.#curve.value = row.curve;
    this.#height.value = String(row.height);
    this.#fraction.value = String(format.fraction ?? 0);
    this.#scale.value = String(format.scale ?? 1);
    this.#unit.value = format.unit ?? "";
    const hasBits = row.signal?.kind === "bits";
    this.#radix.disabled = !hasBits;
    this.#fraction.disabled = !hasBits;
    if (!this.node.open) this.node.show();
    this.#radix.focus();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    // The keys of the pane are letters.
    event.stopPropagation();
    if (event.key === "Escape") this.node.close();
  }

  #take() {
    const row = this.#row;
    if (!row) return;
    row.format = { radix: /** @type {WaveRow["format"]["radix"]} */ (this.#radix.value) };
    const fraction = Math.min(64, Math.floor(Number(this.#fraction.value)));
    const scale = Number(this.#scale.value);
    if (fraction > 0) row.format.fraction = fraction;
    if (Number.isFinite(scale) && scale !== 0 && scale !== 1) row.format.scale = scale;
    if (this.#unit.value !== "") row.format.unit = this.#unit.value;
    row.curve = /** @type {WaveRow["curve"]} */ (this.#curve.value);
    const height = Math.floor(Number(this.#height.value));
    if (height >= 1) row.height = Math.min(MOST_HEIGHT, height);
    this.#changed(row);
  }
}

/** @param {[string, string][]} options values and texts */
function choice(options) {
  return element(
    "select",
    {},
    options.map(([value, text]) => element("option", { value }, text)),
  );
}
