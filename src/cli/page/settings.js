import { append, clear, element, withCode } from "./dom.js";
import { changeOf, faultIn, sameValue, settingNamed, settingsOf, shownText } from "./settingkeys.js";

/** @typedef {import("./settingkeys.js").Setting} Setting */
/** @typedef {import("./settingkeys.js").PrintedKey} PrintedKey */

/**
 * A setting with its controls.
 * @typedef {object} SettingField
 * @property {Setting} setting
 * @property {string} initial text of the scenario, or of the default
 * @property {boolean} given in the scenario
 * @property {HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement} control
 * @property {HTMLElement} row
 * @property {HTMLElement} message
 * @property {HTMLButtonElement} reset
 * @property {HTMLElement} group that the row is in
 */

/** Keys of a scenario as a form. Dispatches `change` when a value changes. */
export class SettingsForm extends EventTarget {
  /** @type {SettingField[]} */
  #fields = [];
  #search = element("input", { type: "search", oninput: () => this.#filter() });
  #which = element("select", { onchange: () => this.#filter() },
    element("option", { value: "all" }, "All"),
    element("option", { value: "given" }, "In the scenario"),
    element("option", { value: "changed" }, "Changed"));
  #count = element("p", { class: "settings-count", role: "status" });
  #refused = element("ul", { class: "settings-refused" });
  #groups = element("div", { class: "settings-groups" });

  /** @param {HTMLElement} host */
  constructor(host) {
    super();
    append(host, element("form", { class: "settings-form", onsubmit: (/** @type {Event} */ event) => event.preventDefault() },
      element("div", { class: "settings-bar" },
        element("label", {}, "Search ", this.#search),
        element("label", {}, "Show ", this.#which),
        element("button", { type: "button", onclick: () => this.#resetAll() }, "Reset all")),
      this.#count, this.#refused, this.#groups));
  }

  /**
   * Shows the keys of a job.
   * @param {{ scenario?: PrintedKey[], circuit?: PrintedKey[] }} keys JSON of `keys NAME --json`
   * @param {Record<string, string>} given TOML texts of the values that the scenario file sets, by
   *   dotted keys
   * @param {string[]} [changes] KEY=VALUE that are changed from the beginning
   */
  show(keys, given, changes = []) {
    const { settings, tables } = settingsOf(keys.scenario ?? keys.circuit ?? []);
    clear(this.#groups);
    clear(this.#refused);
    this.#fields = [];
    const names = [...new Set(settings.map((setting) => setting.group))];
    for (const name of names) this.#addGroup(name, tables.get(name) ?? "", settings.filter((setting) => setting.group === name), given);
    for (const change of changes) {
      const [, key, value] = /^([^=]+)=([^]*)$/.exec(change) ?? [];
      const field = this.#fields.find(({ setting }) => setting.key === key);
      if (field) field.control.value = shownText(field.setting, value);
    }
    for (const field of this.#fields) this.#check(field);
    this.#filter();
  }

  /**
   * Values that are not those of the scenario, as KEY=VALUE for `--set`. Wrong ones are among them,
   * for the program to refuse.
   * @returns {string[]}
   */
  get changes() {
    return this.#fields.filter(isChanged).filter(({ control }) => control.value.trim() !== "")
      .map(({ setting, control }) => changeOf(setting, control.value));
  }

  /**
   * Returns the text of a setting, if there is one of that key.
   * @param {string} key
   */
  value(key) {
    return this.#fields.find(({ setting }) => setting.key === key)?.control.value;
  }

  /**
   * Shows what the program refused at the settings that the faults name, and the rest above the form.
   * @param {import("./problem.js").ProgramFault[]} faults
   */
  refuse(faults) {
    clear(this.#refused);
    for (const field of this.#fields) this.#check(field);
    let first = true;
    for (const fault of faults) {
      const text = `${fault.problem}; allowed: ${fault.allowed}`;
      const setting = settingNamed(this.#fields.map((field) => field.setting), fault.field);
      const field = this.#fields.find((each) => each.setting === setting);
      if (!field) {
        append(this.#refused, element("li", {}, `${fault.field}: ${text}`));
        continue;
      }
      this.#tell(field, fault.field === field.setting.key ? text : `${fault.field}: ${text}`);
      field.row.hidden = false;
      if (field.group instanceof HTMLDetailsElement) field.group.open = true;
      field.group.hidden = false;
      if (first) field.row.scrollIntoView({ block: "nearest" });
      first = false;
    }
  }

  /**
   * @param {string} name
   * @param {string} about
   * @param {Setting[]} settings
   * @param {Record<string, string>} given
   */
  #addGroup(name, about, settings, given) {
    const opened = name === "" || settings.some((setting) => setting.key in given);
    const group = element("details", { class: "settings-group", open: opened },
      element("summary", {}, name === "" ? "Scenario" : `[${name}]`));
    if (about) append(group, element("p", { class: "settings-about" }, withCode(about)));
    for (const setting of settings) {
      const field = this.#field(setting, given, group);
      this.#fields.push(field);
      append(group, field.row);
    }
    append(this.#groups, group);
  }

  /**
   * @param {Setting} setting
   * @param {Record<string, string>} given
   * @param {HTMLElement} group
   * @returns {SettingField}
   */
  #field(setting, given, group) {
    const written = given[setting.key];
    const parts = Object.keys(given).some((key) => key.startsWith(`${setting.key}[]`));
    const isGiven = written !== undefined || parts;
    const initial = written === undefined ? setting.standard : shownText(setting, written);
    const id = `setting-${setting.key.replaceAll(".", "-")}`;
    const control = controlOf(setting, initial, { id, "aria-describedby": `${id}-about ${id}-message` });
    if (parts && written === undefined) control.setAttribute("placeholder", "Tables of the scenario file");
    control.value = initial;
    const message = element("p", { class: "setting-message", id: `${id}-message`, role: "status" });
    const reset = element("button", {
      type: "button", class: "setting-reset", "aria-label": `Reset ${setting.key}`, title: "Back to the value of the scenario",
    }, "Reset");
    const unit = setting.unit === "" ? null : element("span", { class: "setting-unit" }, setting.unit);
    const row = element("div", { class: "setting" },
      element("label", { for: id }, setting.name),
      element("div", { class: "setting-value" }, control, unit, reset),
      element("p", { class: "setting-about", id: `${id}-about` }, withCode(setting.about),
        element("span", { class: "setting-range" }, ` ${rangeText(setting)}`)),
      partsList(setting), message);
    const field = { setting, initial, given: isGiven, control, row, message, reset, group };
    reset.addEventListener("click", () => {
      control.value = initial;
      this.#changed(field);
      control.focus();
    });
    control.addEventListener("input", () => this.#changed(field));
    return field;
  }

  /** @param {SettingField} field */
  #changed(field) {
    this.#check(field);
    this.#tellCount();
    this.dispatchEvent(new CustomEvent("change"));
  }

  /** @param {SettingField} field */
  #check(field) {
    const { setting, control, initial, given } = field;
    const cleared = given && initial !== "" && control.value.trim() === "";
    const text = cleared ? "Set in the scenario: enter another value, or reset it." : faultIn(setting, control.value);
    const isNew = isChanged(field);
    // A required key that a list of tables of the file sets is not empty for the program.
    this.#tell(field, isNew || !given ? unlessEmpty(field, text) : "");
    field.row.classList.toggle("changed", isNew);
    field.reset.hidden = !isNew;
  }

  /**
   * @param {SettingField} field
   * @param {string} text
   */
  #tell(field, text) {
    field.message.textContent = text;
    field.control.setAttribute("aria-invalid", String(text !== ""));
  }

  #resetAll() {
    for (const field of this.#fields) {
      field.control.value = field.initial;
      this.#check(field);
    }
    clear(this.#refused);
    this.#filter();
    this.dispatchEvent(new CustomEvent("change"));
  }

  #filter() {
    const words = this.#search.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    for (const field of this.#fields) {
      const { key, about, unit } = field.setting;
      const text = `${key} ${about} ${unit}`.toLowerCase();
      const which = this.#which.value;
      const wanted = which === "all" || (which === "given" ? field.given : isChanged(field));
      field.row.hidden = !wanted || !words.every((word) => text.includes(word));
    }
    const narrowed = words.length > 0 || this.#which.value !== "all";
    for (const group of new Set(this.#fields.map((field) => field.group))) {
      const shown = this.#fields.some((field) => field.group === group && !field.row.hidden);
      group.hidden = !shown;
      if (narrowed && shown && group instanceof HTMLDetailsElement) group.open = true;
    }
    this.#tellCount();
  }

  #tellCount() {
    const shown = this.#fields.filter(({ row }) => !row.hidden).length;
    const changed = this.#fields.filter(isChanged).length;
    this.#count.textContent = `${shown} of ${this.#fields.length} settings, ${changed} changed`;
  }
}

/** @param {SettingField} field */
function isChanged({ setting, control, initial }) {
  return !sameValue(setting, control.value, initial);
}

/**
 * An empty field that was empty from the beginning is no fault yet.
 * @param {SettingField} field
 * @param {string} text
 */
function unlessEmpty({ control, initial }, text) {
  return control.value.trim() === "" && initial === "" ? "" : text;
}

/**
 * @param {Setting} setting
 * @param {string} initial
 * @param {Record<string, import("./dom.js").AttributeValue>} attributes
 */
function controlOf(setting, initial, attributes) {
  const options = (/** @type {string[]} */ names) => {
    const known = initial === "" || names.includes(initial) ? names : [initial, ...names];
    const none = setting.required || setting.standard !== "" ? [] : [element("option", { value: "" }, "(not set)")];
    return [...none, ...known.map((name) => element("option", { value: name }, name))];
  };
  switch (setting.input) {
    case "choice": return element("select", attributes, options(setting.choices));
    case "boolean": return element("select", attributes, options(["true", "false"]));
    case "tables": return element("textarea", { ...attributes, rows: Math.min(12, Math.max(2, initial.split("\n").length)), spellcheck: "false", wrap: "off" });
    case "whole": case "number": {
      const bound = (/** @type {number} */ value) => (Number.isFinite(value) ? value : null);
      // Steps are counted from the least value, so that only whole ones may have one.
      const step = setting.input === "whole" ? 1 : "any";
      return element("input", { ...attributes, type: "number", step, min: bound(setting.least), max: bound(setting.most) });
    }
    default: return element("input", { ...attributes, type: "text", spellcheck: "false" });
  }
}

/** @param {Setting} setting */
function rangeText(setting) {
  const listed = setting.input === "choice" ? "" : setting.range;
  const standard = setting.standard === "" ? (setting.required ? "Required." : "") : `Default: ${setting.standard}.`;
  return [setting.input === "toml" ? `A ${setting.kind}.` : "", listed && `Allowed: ${listed}.`, standard].filter((text) => text !== "").join(" ");
}

/** @param {Setting} setting */
function partsList(setting) {
  if (setting.parts.length === 0) return null;
  const rows = setting.parts.map((part) => [
    element("dt", {}, part.key.slice(setting.key.length + 1), part.unit ? ` (${part.unit})` : ""),
    element("dd", {}, withCode(part.about), part.range ? ` Allowed: ${part.range}.` : "", ` ${part.default === "required" ? "Required." : ""}`),
  ]);
  return element("details", { class: "setting-parts" }, element("summary", {}, "Keys of a table"), element("dl", {}, rows.flat()));
}
