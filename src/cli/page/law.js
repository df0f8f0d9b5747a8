// The pane of proofs: a circuit at a small width, its laws, and single faults of it.
import { clear, element } from "./dom.js";

/** @typedef {import("./worker.js").Result} Result */

/**
 * A row of `check --json`.
 * @typedef {object} Proof
 * @property {string} circuit
 * @property {Record<string, number>} widths
 * @property {string[]} invariants
 * @property {string} ended
 * @property {number | null} states
 * @property {number | null} transitions
 * @property {number | null} depth
 * @property {number} seconds
 * @property {string | null} fault
 */

/**
 * A fault of `mutate --json`: what is wrong, and what finds it.
 * @typedef {{ fault: string, fate: string, by: string | null }} Suspect
 */

/**
 * What the pane asks of others: to run the program, and to show the waves of a counterexample.
 * @typedef {object} Laws
 * @property {(words: string[], signal: AbortSignal) => Promise<Result>} run
 * @property {(result: Result) => void} counterexample
 */

export class LawPane {
  /**
   * @param {HTMLElement} host
   * @param {Laws} laws
   */
  constructor(host, laws) {
    this.host = host;
    this.laws = laws;
    /** @type {AbortController | undefined} */
    this.running = undefined;
  }

  /**
   * Shows the form.
   * @param {{ name: string, about: string, keys: Record<string, { full: string | null, small: string | null }> }[]} circuits
   */
  show(circuits) {
    const choices = circuits.map(({ name }) => element("option", { value: name }, name));
    this.circuit = element("select", { id: "law-circuit", onchange: () => this.chosen(circuits) }, choices);
    this.circuit.value = "unit_law";
    this.width = element("input", { id: "law-width", type: "number", min: 1, max: 64 });
    this.changes = element("input", { id: "law-set", type: "text", placeholder: "variant=literal", spellcheck: "false" });
    this.prove = element("button", { type: "submit" }, "Prove");
    this.faults = element("button", { type: "button", onclick: () => void this.mutate() }, "Inject faults");
    this.cancel = element("button", { type: "button", disabled: true, onclick: () => this.running?.abort() }, "Cancel");
    this.about = element("p", { class: "faint" });
    this.result = element("div", { class: "law-result", "aria-live": "polite" });
    const form = element(
      "form",
      {
        class: "law-form",
        onsubmit: (/** @type {Event} */ event) => {
          event.preventDefault();
          void this.check();
        },
      },
      element("label", { for: "law-circuit" }, "Circuit"), this.circuit,
      element("label", { for: "law-width" }, "Width in bits"), this.width,
      element("label", { for: "law-set" }, "Settings, KEY=VALUE"), this.changes,
      element("div", { class: "buttons" }, this.prove, this.faults, this.cancel),
    );
    clear(this.host).append(
      element("p", {}, "A proof visits every state with every input. It holds at the width that is shown."),
      form, this.about, this.result,
    );
    this.chosen(circuits);
  }

  /** @param {{ name: string, about: string, keys: Record<string, { small: string | null }> }[]} circuits */
  chosen(circuits) {
    const circuit = circuits.find(({ name }) => name === this.circuit?.value);
    const small = circuit?.keys.width?.small;
    if (this.width) {
      this.width.disabled = small === undefined;
      this.width.value = small ?? "";
    }
    if (this.about) this.about.textContent = circuit?.about ?? "";
  }

  /** Words that name the circuit and its settings. */
  words() {
    const width = this.width?.disabled || !this.width?.value ? [] : ["--width", this.width.value];
    const changes = (this.changes?.value ?? "").split(/\s+/).filter(Boolean);
    return [this.circuit?.value ?? "", ...width, ...changes.flatMap((change) => ["--set", change])];
  }

  async check() {
    const result = await this.attempt(["check", ...this.words(), "--json", "--out", "out"]);
    if (!result) return;
    const { rows, error } = JSON.parse(result.out);
    this.say(error ? [element("pre", {}, result.errors)] : rows.map((/** @type {Proof} */ row) => this.proof(row, result)));
  }

  async mutate() {
    const result = await this.attempt(["mutate", ...this.words(), "--json"]);
    if (!result) return;
    const { circuits, error } = JSON.parse(result.out);
    if (error) return this.say([element("pre", {}, result.errors)]);
    const { faults, missed, suspects } = circuits[0];
    const rows = suspects.map((/** @type {Suspect} */ { fault, fate, by }) =>
      element("tr", {}, element("td", {}, fault), element("td", {}, fate), element("td", {}, by ?? "")));
    const head = ["Fault", "Found by", "Which"].map((text) => element("th", { scope: "col" }, text));
    this.say([
      element("p", {}, `${faults} single faults; ${missed} that show at a port and are not found.`),
      element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Faults" }, element("table", {}, element("thead", {}, element("tr", {}, head)), element("tbody", {}, rows))),
    ]);
  }

  /**
   * Runs the program, unless the reader cancels it.
   * @param {string[]} words
   */
  async attempt(words) {
    this.running?.abort();
    const running = new AbortController();
    this.running = running;
    this.busy(true);
    this.say([element("p", {}, "Running …")]);
    try {
      return await this.laws.run(words, running.signal);
    } catch (error) {
      if (this.running === running) this.say([element("p", {}, String(error))]);
      return undefined;
    } finally {
      if (this.running === running) this.busy(false);
    }
  }

  /** @param {boolean} busy */
  busy(busy) {
    for (const button of [this.prove, this.faults]) if (button) button.disabled = busy;
    if (this.cancel) this.cancel.disabled = !busy;
  }

  /** @param {Node[]} nodes */
  say(nodes) {
    if (this.result) clear(this.result).append(...nodes);
  }

  /**
   * @param {Proof} row
   * @param {Result} result
   */
  proof({ circuit, widths, invariants, ended, states, transitions, depth, fault }, result) {
    const at = Object.entries(widths).map(([key, bits]) => `${key} ${bits}`).join(", ");
    const holds = ended === "holds";
    const broken = ended === "broken";
    const counts = states === null ? "" : `${states} states, ${transitions} transitions, depth ${depth}`;
    const waves = broken && element("button", { type: "button", onclick: () => this.laws.counterexample(result) }, "Show the counterexample in the waves");
    return element(
      "section",
      {},
      element("h2", {}, element("span", { class: holds ? "good" : "bad" }, ended), ` ${circuit}`, at && ` at ${at}`),
      element("p", {}, counts),
      fault && element("pre", {}, fault.split("\nwaves: ")[0]),
      waves,
      element("ul", {}, invariants.map((law) => element("li", {}, law))),
    );
  }
}
