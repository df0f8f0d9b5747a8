// The page: chooses what runs, runs it, and hands the result to the panes.
import { CircuitPane } from "./circuit.js";
import { append, clear, element } from "./dom.js";
import { downloadLink, downloadsView } from "./downloads.js";
import { commandOf, fileWith, jobOf, linkOf, progressIn, wantedIn } from "./job.js";
import { LawPane } from "./law.js";
import { NoteDialog } from "./notedialog.js";
import { NOTES_FOLDER } from "./notes.js";
import { readNpy } from "./npy.js";
import { PathPane } from "./path.js";
import { Playhead } from "./playhead.js";
import { problemView } from "./problem.js";
import { readFst } from "./fst.js";
import { readSave } from "./savefile.js";
import { readSeries } from "./series.js";
import { Cancelled } from "./runner.js";
import { fromDirectory } from "./settingkeys.js";
import { SettingsForm } from "./settings.js";
import { finished, notesOf, readStart, runnerOf } from "./start.js";
import { summaryView } from "./summary.js";
import { Tabs } from "./tabs.js";
import { givenIn } from "./toml.js";
import { listsOfTables } from "./tomlvalue.js";
import { realUnits } from "./valueformat.js";
import { readVcd } from "./vcd.js";
import { WavesPane } from "./waves.js";

/** @typedef {import("./job.js").Wanted} Wanted */
/** @typedef {import("./worker.js").Result} Result */

/** Names of the panes, in the order of the tabs. */
const PANES = ["Path", "Waves", "Circuit", "Try a law", "Summary"];

/** Those that need the program. */
const RUNNING = ["Circuit", "Try a law"];

/** Circuits on which a drawing or a part program runs, and the one that takes a position log. */
const CIRCUITS = ["pulse_interpolator", "linear_interpolator", "arc_generator", "trajectory_controller"];
const LOGGED = "lead_angle";

/** Panes that show a run. */
const SHOWN = ["Path", "Waves", "Circuit", "Summary"];

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
    /** Time from which the path so far is shown again, in ms. */
    this.sofarFrom = 0;
    /** @type {Map<string, Promise<any>>} */
    this.listed = new Map();
    // A page of one run has no program.
    this.tabs = new Tabs(PANES.filter((name) => this.runner || !RUNNING.includes(name)));
    this.path = new PathPane(this.pane("Path"), this.playhead);
    this.waves = new WavesPane(this.pane("Waves"), this.playhead);
    const note = this.notes && new NoteDialog(this.notes);
    this.circuit = new CircuitPane(this.pane("Circuit"), {
      circuit: (name) => this.circuitOf(name),
      value: (path) => this.waves.valueAtCursor(path),
      show: (path) => {
        this.tabs.open("Waves");
        void this.waves.add(path);
      },
      note: note && ((circuit) => void note.open(circuit)),
    });
    this.law = new LawPane(this.pane("Try a law"), {
      run: (words, signal) => this.prove(words, signal),
      circuit: async (name) => ({ properties: (await this.circuitOf(name)).properties ?? [] }),
      counterexample: (result, paths) => void this.counterexample(result, paths),
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
      element("div", { class: "layout" }, this.side(), this.tabs.node),
    );
    this.tabs.open("Path");
  }

  /** The column of the scenario, the settings and the run. */
  side() {
    const { scenarios } = this.start;
    const options = scenarios.map(({ file, about }) => element("option", { value: file, title: about }, file.replace(/^waves\/|\.toml$/g, "")));
    this.choice = element("select", { id: "scenario", onchange: () => void this.choose({ file: this.choice?.value ?? FIRST, changes: [] }) }, options);
    this.about = element("p", { class: "faint" });
    const file = element("input", { id: "file", type: "file", multiple: true, accept: ".toml,.hpgl,.plt,.ngc,.gcode,.nc,.csv", onclick: () => { file.value = ""; }, onchange: () => void this.take([...(file.files ?? [])]) });
    this.file = file;
    this.on = element("select", { id: "on", onchange: () => void this.choose({ ...this.wanted, circuit: this.on?.value, changes: [] }) },
      [...CIRCUITS, LOGGED].map((name) => element("option", { value: name }, name)));
    this.onRow = element("div", { class: "field", hidden: true }, element("label", { for: "on" }, "Circuit"), this.on);
    this.go = element("button", { type: "button", class: "go", onclick: () => void this.run(this.settings?.changes) }, "Run");
    this.stop = element("button", { type: "button", disabled: true, onclick: () => this.running?.abort() }, "Cancel");
    this.bar = element("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress of the run" });
    this.problem = element("div", { class: "problem", role: "alert" });
    const settings = element("div", { class: "settings" });
    this.settings = new SettingsForm(settings);
    this.settings.addEventListener("change", () => this.settingChanged());
    this.files = element("div", { class: "files" });
    if (!this.runner) return element("aside", { class: "side", "aria-label": "Run" }, this.status, this.problem, this.files);
    const side = element(
      "aside",
      { class: "side", "aria-label": "Scenario and settings" },
      element("div", { class: "field" }, element("label", { for: "scenario" }, "Scenario"), this.choice),
      this.about,
      element("div", { class: "field" }, element("label", { for: "file" }, "Or a drawing, part program or scenario of yours, with its files"), file),
      this.onRow,
      element("div", { class: "buttons" }, this.go, this.stop),
      this.bar, this.status, this.problem, this.files,
      element("details", { class: "more" }, element("summary", {}, "Settings"), settings),
    );
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      void this.take([...(event.dataTransfer?.files ?? [])]);
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
    window.addEventListener("hashchange", () => {
      const wanted = wantedIn(location.hash);
      if (wanted) void this.choose(wanted);
    });
    await this.choose(wantedIn(location.hash) ?? this.wanted);
    const { circuits } = JSON.parse((await this.runner.run({ words: ["list", "--json"], files: [] })).out);
    this.law.show(circuits);
  }

  /** @param {string} name */
  pane(name) {
    return this.tabs.pane(name);
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

  toggleTheme() {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const now = document.documentElement.dataset.theme ?? (dark ? "dark" : "light");
    document.documentElement.dataset.theme = now === "dark" ? "light" : "dark";
    this.path.redraw();
    this.waves.redraw();
  }

  /**
   * Takes files of the reader's: a scenario with the files that it names, or one to be run.
   * @param {File[]} files
   */
  async take(files) {
    const main = files.find(({ name }) => name.endsWith(".toml")) ?? files[0];
    if (!main) return;
    const given = await Promise.all(files.map(async (file) => /** @type {[string, Uint8Array<ArrayBuffer>]} */ ([file.name, new Uint8Array(await file.arrayBuffer())])));
    await this.choose({ file: main.name, given, circuit: this.circuitFor(main.name), changes: [] });
  }

  /**
   * The circuit on which a file of the reader's runs; a scenario names its own.
   * @param {string} name
   */
  circuitFor(name) {
    if (name.endsWith(".toml")) return undefined;
    if (name.endsWith(".csv")) return LOGGED;
    return this.on?.value === LOGGED ? CIRCUITS[0] : this.on?.value;
  }

  /**
   * Chooses what runs, shows its settings, and runs it.
   * @param {Wanted} wanted
   */
  async choose(wanted) {
    this.wanted = wanted;
    const scenario = this.start.scenarios.find(({ file }) => file === wanted.file);
    if (this.choice) this.choice.value = scenario?.file ?? "";
    if (this.about) this.about.textContent = wanted.given ? wanted.file : (scenario?.about ?? "");
    if (this.onRow) this.onRow.hidden = wanted.circuit === undefined;
    if (this.on && wanted.circuit) this.on.value = wanted.circuit;
    if (this.file && !wanted.given) this.file.value = "";
    const own = wanted.circuit ? undefined : wanted.given?.find(([name]) => name === wanted.file)?.[1];
    const text = wanted.given ? new TextDecoder().decode(own) : (scenario?.text ?? "");
    this.text = wanted.circuit
      ? { circuit: JSON.stringify(wanted.circuit), input: JSON.stringify(wanted.file) }
      : { ...givenIn(text), ...listsOfTables(text) };
    await this.run(wanted.changes);
    await this.showSettings(wanted.changes);
  }

  /**
   * Shows the settings of the circuit that runs.
   * @param {string[]} changes KEY=VALUE
   */
  async showSettings(changes) {
    const changed = changes.findLast((change) => change.startsWith("circuit="))?.slice("circuit=".length);
    const circuit = [changed, this.wanted.circuit, this.text?.circuit].find((name) => name)?.replaceAll('"', "") ?? "pulse_interpolator";
    this.shown = circuit;
    const keys = await this.program().run({ words: ["keys", circuit, "--json"], files: [] });
    if (keys.code !== 0 || this.shown !== circuit) return;
    const printed = JSON.parse(keys.out);
    this.settings?.show(printed, fromDirectory(this.text ?? {}, printed.scenario ?? [], this.wanted.file), changes);
  }

  /** Another circuit has other settings; those that are changed stay, as far as it has them. */
  settingChanged() {
    const changes = this.settings?.changes ?? [];
    const circuit = this.settings?.value("circuit");
    if (!circuit || circuit === this.shown) return;
    if (this.on && this.wanted.circuit) this.on.value = circuit;
    void this.showSettings(changes);
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
    // Files of the reader's are in no link.
    history.replaceState(null, "", this.wanted.given ? location.pathname + location.search : linkOf(this.wanted));
    this.busy(true);
    this.outdate();
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

  /** What is shown is of an earlier run until this one has something to show. */
  outdate() {
    for (const name of SHOWN) this.pane(name).classList.add("outdated");
    clear(/** @type {HTMLElement} */ (this.files));
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
    const began = performance.now();
    if (began < this.sofarFrom) return;
    const whole = bytes.subarray(0, bytes.lastIndexOf(10) + 1);
    const series = readSeries(whole);
    if (series.rows > 1) {
      this.path.show(series, { clockHz: 0, title: "so far" });
      this.pane("Path").classList.remove("outdated");
    }
    // A long series takes a fifth of the time at most.
    this.sofarFrom = performance.now() + 4 * (performance.now() - began);
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
    for (const name of SHOWN) this.pane(name).classList.remove("outdated");
    clear(this.pane("Summary")).append(summaryView(result.out));
    const [csv, npy] = [fileWith(result, ".csv"), fileWith(result, ".npy")];
    const series = csv ? readSeries(csv) : npy && readNpy(npy);
    const clockHz = summary.clock_hz;
    this.playhead.limit(0, Math.max(0, summary.ticks - 1));
    if (series) this.path.show(series, { clockHz, title: summary.input });
    clear(/** @type {HTMLElement} */ (this.files)).append(downloadsView(result, this.runner && (() => void this.vcd())));
    const fst = fileWith(result, ".fst");
    const save = fileWith(result, ".gtkw");
    if (!fst) return;
    const dump = await readFst(fst);
    await this.waves.show(dump, { clockHz, save: save && readSave(new TextDecoder().decode(save)), units: realUnits(summary) });
    const top = dump.signals[0]?.scope[0] ?? summary.circuit;
    if (this.runner) await this.circuit.show(top, [top]).catch(() => this.circuit.show(summary.circuit, [top]));
  }

  /**
   * Shows the waves of a counterexample: those of these paths, or the first of the result.
   * @param {Result} result
   * @param {string[]} [paths]
   */
  async counterexample(result, paths) {
    const vcd = fileWith(result, ".vcd", paths);
    const save = fileWith(result, ".gtkw", paths);
    if (!vcd) return;
    const dump = readVcd(vcd);
    this.playhead.limit(0, 1e6);
    await this.waves.show(dump, { clockHz: 0, save: save && readSave(new TextDecoder().decode(save)) });
    this.tabs.open("Waves");
    this.pane("Waves").classList.remove("outdated");
    this.say("The waves are those of the counterexample. Run brings those of the scenario.");
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

  /** Runs again for the waves as VCD, which is large, and saves them. */
  async vcd() {
    const result = await this.program().run(jobOf(this.wanted, "vcd"));
    for (const [path, bytes] of result.files) if (path.endsWith(".vcd")) downloadLink(path, bytes).click();
  }
}

const page = new Page();
// For tests, and for the curious.
Object.assign(window, { motionRtl: page });
void page.begin();
