// The page: chooses what runs, runs it, and hands the result to the panes.
import { CircuitPane } from "./circuit.js";
import { append, clear, element } from "./dom.js";
import { commandOf, fileWith, jobOf, linkOf, progressIn, wantedIn } from "./job.js";
import { LawPane } from "./law.js";
import { NoteDialog } from "./notedialog.js";
import { NOTES_FOLDER } from "./notes.js";
import { PathPane } from "./path.js";
import { Playhead } from "./playhead.js";
import { problemView } from "./problem.js";
import { readFst } from "./fst.js";
import { readSave } from "./savefile.js";
import { readSeries } from "./series.js";
import { Cancelled } from "./runner.js";
import { SettingsForm } from "./settings.js";
import { finished, notesOf, readStart, runnerOf } from "./start.js";
import { summaryView } from "./summary.js";
import { givenIn } from "./toml.js";
import { listsOfTables } from "./tomlvalue.js";
import { readVcd } from "./vcd.js";
import { WavesPane } from "./waves.js";

/** @typedef {import("./job.js").Wanted} Wanted */
/** @typedef {import("./worker.js").Result} Result */

/** Names of the panes, in the order of the tabs. */
const PANES = ["Path", "Waves", "Circuit", "Try a law", "Summary"];

/** Those that need the program. */
const RUNNING = ["Circuit", "Try a law"];

/** Circuits on which a drawing or a part program runs. */
const CIRCUITS = ["pulse_interpolator", "linear_interpolator", "arc_generator", "trajectory_controller"];

/** Scenario that is shown first. */
const FIRST = "waves/bracket.toml";

class Page {
  constructor() {
    this.start = readStart();
    this.runner = runnerOf(this.start.program);
    this.notes = notesOf(this.start.notes);
    this.playhead = new Playhead();
    /** @type {Wanted} */
    this.wanted = { file: FIRST, changes: [] };
    /** @type {AbortController | undefined} */
    this.running = undefined;
    /** @type {Map<string, HTMLElement>} */
    this.panes = new Map();
    /** @type {Map<string, Promise<any>>} */
    this.listed = new Map();
    const tabs = element("div", { role: "tablist", "aria-label": "Panes", class: "tabs" });
    const centre = element("main", { class: "panes" }, tabs);
    for (const name of PANES) {
      const id = name.toLowerCase().replaceAll(" ", "-");
      const pane = element("section", { role: "tabpanel", id: `pane-${id}`, "aria-labelledby": `tab-${id}`, class: `pane pane-${id}`, hidden: true });
      // A page of one run has no program.
      const gone = !this.runner && RUNNING.includes(name);
      const tab = element("button", { type: "button", role: "tab", hidden: gone, id: `tab-${id}`, "aria-controls": `pane-${id}`, onclick: () => this.open(name) }, name);
      tabs.append(tab);
      centre.append(pane);
      this.panes.set(name, pane);
    }
    tabs.addEventListener("keydown", (event) => this.walk(event));
    this.path = new PathPane(this.pane("Path"), this.playhead);
    this.waves = new WavesPane(this.pane("Waves"), this.playhead);
    const note = this.notes && new NoteDialog(this.notes);
    this.circuit = new CircuitPane(this.pane("Circuit"), {
      circuit: (name) => this.circuitOf(name),
      value: (path) => this.waves.valueAtCursor(path),
      show: (path) => {
        this.open("Waves");
        void this.waves.add(path);
      },
      note: note && ((circuit) => void note.open(circuit)),
    });
    this.law = new LawPane(this.pane("Try a law"), {
      run: (words, signal) => this.prove(words, signal),
      counterexample: (result) => void this.counterexample(result),
    });
    this.playhead.addEventListener("change", () => this.circuit.update());
    this.waves.addEventListener("values", () => this.circuit.update());
    this.status = element("p", { class: "status", role: "status" });
    append(
      document.getElementById("page") ?? document.body,
      element(
        "header",
        { class: "top" },
        element("h1", {}, "motion-rtl"),
        element("p", {}, "Five motion-control patents as cycle-accurate circuits"),
        element("button", { type: "button", onclick: () => this.toggleTheme() }, "Light or dark"),
      ),
      element("div", { class: "layout" }, this.side(), centre),
    );
    this.open("Path");
  }

  /** The column of the scenario, the settings and the run. */
  side() {
    const { scenarios } = this.start;
    const options = scenarios.map(({ file, about }) => element("option", { value: file, title: about }, file.replace(/^waves\/|\.toml$/g, "")));
    this.choice = element("select", { id: "scenario", onchange: () => void this.choose({ file: this.choice?.value ?? FIRST, changes: [] }) }, options);
    this.about = element("p", { class: "faint" });
    const file = element("input", { id: "file", type: "file", accept: ".toml,.hpgl,.plt,.ngc,.gcode,.nc,.csv", onchange: () => void this.take(file.files?.[0]) });
    this.on = element("select", { id: "on", onchange: () => void this.choose({ ...this.wanted, circuit: this.on?.value, changes: [] }) },
      CIRCUITS.map((name) => element("option", { value: name }, name)));
    this.onRow = element("div", { class: "field", hidden: true }, element("label", { for: "on" }, "Circuit"), this.on);
    this.go = element("button", { type: "button", class: "go", onclick: () => void this.run(this.settings?.changes) }, "Run");
    this.stop = element("button", { type: "button", disabled: true, onclick: () => this.running?.abort() }, "Cancel");
    this.bar = element("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress of the run" });
    this.problem = element("div", { class: "problem", role: "alert" });
    const settings = element("div", { class: "settings" });
    this.settings = new SettingsForm(settings);
    this.files = element("div", { class: "files" });
    if (!this.runner) return element("aside", { class: "side", "aria-label": "Run" }, this.status, this.problem, this.files);
    const side = element(
      "aside",
      { class: "side", "aria-label": "Scenario and settings" },
      element("div", { class: "field" }, element("label", { for: "scenario" }, "Scenario"), this.choice),
      this.about,
      element("div", { class: "field" }, element("label", { for: "file" }, "Or a drawing, part program or scenario of yours"), file),
      this.onRow,
      element("div", { class: "buttons" }, this.go, this.stop),
      this.bar, this.status, this.problem, this.files,
      element("details", { class: "more" }, element("summary", {}, "Settings"), settings),
    );
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      void this.take(event.dataTransfer?.files[0]);
    });
    return side;
  }

  /** Begins: with the run in the page, else with what the link or nothing names. */
  async begin() {
    const { run } = this.start;
    if (run) {
      const { words, result } = finished(run);
      this.say(`motion-rtl ${words.join(" ")}`);
      await this.show(result);
    }
    if (!this.runner) return;
    void this.runner.ready();
    await this.choose(wantedIn(location.hash) ?? this.wanted);
    const { circuits } = JSON.parse((await this.runner.run({ words: ["list", "--json"], files: [] })).out);
    this.law.show(circuits);
  }

  /** @param {string} name */
  pane(name) {
    return /** @type {HTMLElement} */ (this.panes.get(name));
  }

  program() {
    if (!this.runner) throw new Error("this page has no program: it shows one run");
    return this.runner;
  }

  /**
   * Runs a command of the pane of laws. Faults are looked for with the charts of the notes.
   * @param {string[]} words
   * @param {AbortSignal} signal
   */
  async prove(words, signal) {
    if (words[0] !== "mutate" || !this.notes) return this.program().run({ words, files: [] }, {}, signal);
    const files = await this.notes.files();
    return this.program().run({ words: [...words, "--charts", NOTES_FOLDER], files }, {}, signal);
  }

  /** @param {string} text */
  say(text) {
    if (this.status) this.status.textContent = text;
  }

  /** @param {string} name */
  open(name) {
    for (const [other, pane] of this.panes) {
      pane.hidden = other !== name;
      const tab = document.getElementById(pane.getAttribute("aria-labelledby") ?? "");
      tab?.setAttribute("aria-selected", String(other === name));
      tab?.setAttribute("tabindex", other === name ? "0" : "-1");
    }
    // A pane that was hidden had no size.
    window.dispatchEvent(new Event("resize"));
  }

  /** Arrow keys go from tab to tab. @param {KeyboardEvent} event */
  walk(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    const names = this.runner ? PANES : PANES.filter((name) => !RUNNING.includes(name));
    const open = names.findIndex((name) => !this.pane(name).hidden);
    const next = names[(open + step + names.length) % names.length];
    this.open(next);
    document.getElementById(this.pane(next).getAttribute("aria-labelledby") ?? "")?.focus();
  }

  toggleTheme() {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const now = document.documentElement.dataset.theme ?? (dark ? "dark" : "light");
    document.documentElement.dataset.theme = now === "dark" ? "light" : "dark";
    this.path.redraw();
    this.waves.redraw();
  }

  /**
   * Takes a file of the reader's.
   * @param {File | undefined} file
   */
  async take(file) {
    if (!file) return;
    const bytes = new Uint8Array(await file.arrayBuffer());
    const circuit = file.name.endsWith(".toml") ? undefined : this.on?.value;
    await this.choose({ file: file.name, bytes, circuit, changes: [] });
  }

  /**
   * Chooses what runs, shows its settings, and runs it.
   * @param {Wanted} wanted
   */
  async choose(wanted) {
    this.wanted = wanted;
    const scenario = this.start.scenarios.find(({ file }) => file === wanted.file);
    if (this.choice) this.choice.value = scenario?.file ?? "";
    if (this.about) this.about.textContent = wanted.bytes ? wanted.file : (scenario?.about ?? "");
    if (this.onRow) this.onRow.hidden = wanted.circuit === undefined;
    const text = wanted.bytes && !wanted.circuit ? new TextDecoder().decode(wanted.bytes) : (scenario?.text ?? "");
    const given = { ...givenIn(text), ...listsOfTables(text) };
    const circuit = wanted.circuit ?? given.circuit?.replaceAll('"', "") ?? "pulse_interpolator";
    await this.run(wanted.changes);
    const keys = await this.program().run({ words: ["keys", circuit, "--json"], files: [] });
    if (keys.code === 0) this.settings?.show(JSON.parse(keys.out), given, wanted.changes);
  }

  /**
   * Runs what was chosen.
   * @param {string[]} [changes] KEY=VALUE
   */
  async run(changes = []) {
    this.running?.abort();
    const running = new AbortController();
    this.running = running;
    this.wanted = { ...this.wanted, changes };
    if (!this.wanted.bytes) history.replaceState(null, "", linkOf(this.wanted));
    this.busy(true);
    clear(/** @type {HTMLElement} */ (this.problem));
    try {
      const began = performance.now();
      const result = await this.program().run(jobOf(this.wanted), {
        said: (text) => this.progress(text),
        grown: (series) => void this.sofar(series),
      }, running.signal);
      if (this.running !== running) return;
      this.say(`${commandOf(this.wanted)}: exit code ${result.code} after ${((performance.now() - began) / 1000).toFixed(2)} s`);
      await this.show(result);
    } catch (error) {
      if (this.running === running) this.say(error instanceof Cancelled ? "Cancelled." : String(error));
    } finally {
      if (this.running === running) this.busy(false);
    }
  }

  /** @param {boolean} busy */
  busy(busy) {
    if (this.go) this.go.disabled = busy;
    if (this.stop) this.stop.disabled = !busy;
    if (this.bar) {
      this.bar.hidden = !busy;
      this.bar.removeAttribute("value");
    }
    if (busy) this.say("Running …");
  }

  /** @param {string} said */
  progress(said) {
    const { part, line } = progressIn(said);
    if (part !== undefined && this.bar) this.bar.value = part;
    this.say(line);
  }

  /**
   * Shows the path so far.
   * @param {Uint8Array} bytes
   */
  sofar(bytes) {
    const whole = bytes.subarray(0, bytes.lastIndexOf(10) + 1);
    const series = readSeries(whole);
    if (series.rows > 1) this.path.show(series, { clockHz: 0, title: "so far" });
  }

  /**
   * Shows what a run has brought.
   * @param {Result} result
   */
  async show(result) {
    const summary = result.out.trim() ? JSON.parse(result.out) : {};
    if (summary.error || result.code !== 0) this.problem?.append(problemView(result.errors));
    if (summary.error) {
      this.settings?.refuse(summary.error.faults ?? []);
      return;
    }
    clear(this.pane("Summary")).append(summaryView(result.out));
    const series = fileWith(result, ".csv");
    const clockHz = summary.clock_hz;
    this.playhead.limit(0, Math.max(0, summary.ticks - 1));
    if (series) this.path.show(readSeries(series), { clockHz, title: summary.input });
    this.downloads(result);
    const fst = fileWith(result, ".fst");
    const save = fileWith(result, ".gtkw");
    if (!fst) return;
    const dump = await readFst(fst);
    await this.waves.show(dump, { clockHz, save: save && readSave(new TextDecoder().decode(save)) });
    const top = dump.signals[0]?.scope[0] ?? summary.circuit;
    if (this.runner) await this.circuit.show(top, [top]).catch(() => this.circuit.show(summary.circuit, [top]));
  }

  /**
   * Shows the waves of a counterexample.
   * @param {Result} result
   */
  async counterexample(result) {
    const vcd = fileWith(result, ".vcd");
    const save = fileWith(result, ".gtkw");
    if (!vcd) return;
    const dump = readVcd(vcd);
    this.playhead.limit(0, 1e6);
    await this.waves.show(dump, { clockHz: 0, save: save && readSave(new TextDecoder().decode(save)) });
    this.open("Waves");
  }

  /** @param {string} name @returns {Promise<import("./diagram.js").Circuit>} */
  circuitOf(name) {
    const listed = this.listed.get(name) ?? this.program().run({ words: ["list", name, "--json"], files: [] }).then(({ code, out, errors }) => {
      if (code !== 0) throw new Error(errors);
      return JSON.parse(out).circuits[0];
    });
    this.listed.set(name, listed);
    return listed;
  }

  /**
   * Lists the files of a run to be saved.
   * @param {Result} result
   */
  downloads(result) {
    const links = [...result.files].map(([path, bytes]) => download(path.replace(/^.*\//, ""), bytes));
    links.push(download("summary.json", new TextEncoder().encode(result.out)));
    const vcd = this.runner && element("button", { type: "button", onclick: () => void this.vcd() }, "VCD: run again");
    clear(/** @type {HTMLElement} */ (this.files)).append(
      element("details", {}, element("summary", {}, "Files of the run"), element("ul", {}, links.map((link) => element("li", {}, link))), vcd ?? ""),
    );
  }

  /** Runs again for the waves as VCD, which is large, and saves them. */
  async vcd() {
    const result = await this.program().run(jobOf(this.wanted, "vcd"));
    for (const [path, bytes] of result.files) if (path.endsWith(".vcd")) download(path.replace(/^.*\//, ""), bytes).click();
  }
}

/**
 * A link that saves a file.
 * @param {string} name
 * @param {Uint8Array<ArrayBuffer>} bytes
 */
function download(name, bytes) {
  const href = URL.createObjectURL(new Blob([bytes]));
  return element("a", { href, download: name }, `${name} (${bytes.length.toLocaleString("en")} bytes)`);
}

const page = new Page();
// For tests, and for the curious.
Object.assign(window, { motionRtl: page });
void page.begin();
