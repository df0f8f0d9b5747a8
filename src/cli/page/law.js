// The pane of proofs: a circuit at a small width, its properties, and single faults of it.
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
 * @typedef {{ number: number, fault: string, fate: string, by?: string }} Suspect
 */

/**
 * A run on which a single fault shows, of `mutate --fault --json`.
 * @typedef {object} FaultRun
 * @property {"chart" | "proof" | "law" | "around" | "random"} by
 * @property {string} name
 * @property {string} circuit
 * @property {number} tick
 * @property {string} report
 * @property {string | null} first_difference
 * @property {string[]} waves
 */

/**
 * Checks that find a single fault, and properties that do not: `mutate --fault --json`.
 * @typedef {object} SingleFault
 * @property {number} number
 * @property {string} fault
 * @property {FaultRun[]} found
 * @property {string[]} hold
 * @property {string[]} undecided
 * @property {string | null} undecided_because
 * @property {FaultRun | null} random
 * @property {string | null} refused
 */

/**
 * What the pane asks of others: to run the program, the properties of a circuit, and to show waves:
 * those of `paths`, or the first of the result.
 * @typedef {object} Laws
 * @property {(words: string[], signal: AbortSignal) => Promise<Result>} run
 * @property {(name: string) => Promise<{ properties: string[] }>} circuit
 * @property {(result: Result, paths?: string[]) => void} counterexample
 */

/** Headings of what finds a fault, before its name; in this order. */
const FOUND_BY = {
  proof: "found by the property", law: "found by the law", chart: "found by the chart",
  around: "found by a chart of", random: "shown by",
};

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
    this.property = element("select", { id: "law-property" });
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
      element("label", { for: "law-property" }, "Property"), this.property,
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
    void this.list(circuit?.name ?? "");
  }

  /**
   * Offers the properties of a circuit.
   * @param {string} name
   */
  async list(name) {
    const { property } = this;
    if (!property) return;
    clear(property).append(element("option", { value: "" }, "all"));
    property.disabled = true;
    // A circuit that cannot be listed is proved as a whole; the program says what is wrong.
    const { properties } = await this.laws.circuit(name).catch(() => ({ properties: [] }));
    if (this.circuit?.value !== name) return;
    property.append(...properties.map((text) => element("option", { value: text }, text)));
    property.disabled = properties.length < 2;
  }

  /** Words that name the circuit and its settings. */
  words() {
    const width = this.width?.disabled || !this.width?.value ? [] : ["--width", this.width.value];
    const changes = (this.changes?.value ?? "").split(/\s+/).filter(Boolean);
    return [this.circuit?.value ?? "", ...width, ...changes.flatMap((change) => ["--set", change])];
  }

  async check() {
    const property = this.property?.value ? ["--property", this.property.value] : [];
    const result = await this.attempt(["check", ...this.words(), ...property, "--json", "--out", "out"]);
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
    const words = this.words();
    const rows = suspects.map((/** @type {Suspect} */ { number, fault, fate, by }) => {
      const attempt = () => void this.single(words, number, list);
      const label = `Try fault ${number}: ${fault}`;
      const button = element("button", { type: "button", "aria-label": label, onclick: attempt }, "Try");
      return element("tr", {}, [button, fault, fate, by ?? ""].map((cell) => element("td", {}, cell)));
    });
    const head = ["Try", "Fault", "Found by", "Which"].map((text) => element("th", { scope: "col" }, text));
    const list = [
      element("p", {}, `${faults} single faults; ${missed} that show at a port and are not found.`),
      element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Faults" }, element("table", {}, element("thead", {}, element("tr", {}, head)), element("tbody", {}, rows))),
    ];
    this.say(list);
  }

  /**
   * Injects a single fault, and shows what finds it above the list of all.
   * @param {string[]} words
   * @param {number} number
   * @param {Node[]} list
   */
  async single(words, number, list) {
    const result = await this.attempt(["mutate", ...words, "--fault", String(number), "--json", "--out", "out"], list);
    if (!result) return;
    const single = JSON.parse(result.out);
    this.say([single.error ? element("pre", {}, result.errors) : this.fault(single, result), ...list]);
    this.result?.scrollIntoView({ block: "start" });
  }

  /**
   * @param {SingleFault} single
   * @param {Result} result
   */
  fault({ number, fault, found, hold, undecided, undecided_because, random, refused }, result) {
    const order = Object.keys(FOUND_BY);
    const runs = random ? [...found, random] : [...found];
    runs.sort((a, b) => order.indexOf(a.by) - order.indexOf(b.by));
    const none = refused ?? (found.length === 0 && (random
      ? "No chart, property or law finds it."
      : "No check finds it, and no random run shows it at a port."));
    const held = hold.map((property) => element("li", {}, `holds in spite of it: ${property}`));
    const open = undecided.map((property) => element("li", {}, `not decided: ${property}: ${undecided_because}`));
    return element(
      "section",
      { class: "law-fault" },
      element("h2", {}, `Fault ${number}: ${fault}`),
      none && element("p", {}, none),
      runs.map((run) => this.run(run, result)),
      held.length + open.length > 0 && element("ul", {}, held, open),
    );
  }

  /**
   * A run on which a fault shows, with a button for its waves.
   * @param {FaultRun} run
   * @param {Result} result
   */
  run({ by, name, circuit, report, first_difference, waves }, result) {
    const title = by === "around" ? `${circuit}: ${name}` : name;
    const show = () => this.laws.counterexample(result, waves);
    return element(
      "section",
      {},
      element("h3", {}, element("span", { class: by === "random" ? "bad" : "good" }, FOUND_BY[by]), ` ${title}`),
      first_difference && element("p", {}, `First difference: ${first_difference}`),
      element("details", {}, element("summary", {}, "Report"), element("pre", {}, report)),
      waves.length > 0 && element("button", { type: "button", onclick: show }, "Show it in the waves"),
    );
  }

  /**
   * Runs the program, unless the reader cancels it. What is below the progress stays.
   * @param {string[]} words
   * @param {Node[]} [below]
   */
  async attempt(words, below = []) {
    this.running?.abort();
    const running = new AbortController();
    this.running = running;
    this.busy(true);
    this.say([element("p", {}, "Running …"), ...below]);
    try {
      return await this.laws.run(words, running.signal);
    } catch (error) {
      if (this.running === running) this.say([element("p", {}, String(error)), ...below]);
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
