// The circuit pane: a block with its diagram, its signals and their values at the play head.
import { clear, element, withCode } from "./dom.js";
import { diagram } from "./diagram.js";

/** @typedef {import("./diagram.js").Part} Part */

/** @typedef {import("./diagram.js").Circuit} Circuit */
/** @typedef {import("./diagram.js").Port} Port */

/**
 * What the pane asks of others: a circuit by name, the value of a signal by its path in the waves,
 * to show a signal in the waves, and to open the note on a circuit, if there are notes.
 * @typedef {object} Sources
 * @property {(name: string) => Promise<Circuit>} circuit
 * @property {(path: string) => string | undefined} value
 * @property {(path: string) => void} show
 * @property {(circuit: string) => void} [note]
 */

export class CircuitPane {
  /**
   * @param {HTMLElement} host
   * @param {Sources} sources
   */
  constructor(host, sources) {
    this.host = host;
    this.sources = sources;
    /** Cells of values, by the path of the signal. @type {Map<string, HTMLElement>} */
    this.cells = new Map();
  }

  /**
   * Shows a circuit.
   * @param {string} name the circuit's
   * @param {string[]} path its instances in the waves, from the top
   */
  async show(name, path) {
    const circuit = await this.sources.circuit(name);
    this.cells.clear();
    const { parts, nets, registers, outputs } = circuit.connections;
    const drivers = new Map(outputs.map((port) => [port.name, port.driver]));
    const { note } = this.sources;
    const out = circuit.outputs.map((port) => ({ ...port, driver: drivers.get(port.name) }));
    clear(this.host).append(
      this.trail(path),
      element("div", { class: "circuit-title" }, element("h2", {}, circuit.name), note && element("button", { type: "button", onclick: () => note(name) }, "Note")),
      element("p", {}, withCode(circuit.about), ". Source: ", circuit.source, "."),
    );
    const enter = (/** @type {Part} */ part) => {
      this.circuits.set([...path, part.name].join("."), part.circuit);
      void this.show(part.circuit, [...path, part.name]);
    };
    if (parts.length > 0) {
      this.host.append(element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Block diagram" }, /** @type {any} */ (diagram(circuit, enter))));
    }
    this.circuits.set(path.join("."), name);
    this.parts(parts, enter);
    this.table("Ports in", circuit.inputs, path);
    this.table("Ports out", out, path);
    this.table("Registers", registers, path);
    this.table("Nets", nets, path);
    this.update();
  }

  /** Circuits of the instances that were shown, by path. @type {Map<string, string>} */
  circuits = new Map();

  /** Reads the values at the play head anew. */
  update() {
    for (const [path, cell] of this.cells) cell.textContent = this.sources.value(path) ?? "";
  }

  /** @param {string[]} path */
  trail(path) {
    const steps = path.map((name, depth) => {
      const at = path.slice(0, depth + 1);
      const circuit = this.circuits.get(at.join("."));
      if (depth === path.length - 1 || circuit === undefined) return element("span", { "aria-current": "true" }, name);
      return element("button", { type: "button", onclick: () => void this.show(circuit, at) }, name);
    });
    return element("nav", { class: "trail", "aria-label": "Instances" }, steps);
  }

  /**
   * @param {Part[]} parts
   * @param {(part: Part) => void} enter called where the reader chooses a part
   */
  parts(parts, enter) {
    const rows = parts.map((part) => {
      const open = element("button", { type: "button", title: "Show the part", onclick: () => enter(part) }, part.name);
      return [element("th", { scope: "row" }, open), element("td", {}, part.circuit), element("td", {}, part.source)];
    });
    this.rows("Parts", ["Instance", "Circuit", "Source"], rows);
  }

  /**
   * @param {string} title
   * @param {Port[]} signals
   * @param {string[]} path
   */
  table(title, signals, path) {
    const rows = signals.map((signal) => {
      const name = [...path, signal.name].join(".");
      const cell = element("td", { class: "value" });
      this.cells.set(name, cell);
      const look = element("button", { type: "button", title: "Show in the waves", onclick: () => this.sources.show(name) }, signal.name);
      const width = signal.signed ? `${signal.width}, signed` : signal.width;
      return [element("th", { scope: "row" }, look), element("td", {}, width), cell, element("td", { class: "driver" }, signal.driver ?? ""), element("td", {}, withCode(signal.about ?? ""))];
    });
    this.rows(title, ["Signal", "Bits", "Value", "Driver", "Meaning"], rows);
  }

  /**
   * Adds a table, unless it would be empty.
   * @param {string} title
   * @param {string[]} columns
   * @param {HTMLElement[][]} rows
   */
  rows(title, columns, rows) {
    if (rows.length === 0) return;
    const head = columns.map((text) => element("th", { scope: "col" }, text));
    this.host.append(
      element("h3", {}, title),
      element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": title }, element("table", {}, element("thead", {}, element("tr", {}, head)), element("tbody", {}, rows.map((row) => element("tr", {}, row))))),
    );
  }
}
