import { readTomlValue, tomlText } from "./tomlvalue.js";

/**
 * A key as `keys NAME --json` prints it; keys of a circuit have `type` and `full` in place of `kind`
 * and `default`.
 * @typedef {object} PrintedKey
 * @property {string} key
 * @property {string} [kind]
 * @property {string} [type]
 * @property {string} unit
 * @property {string} [default]
 * @property {string | null} [full]
 * @property {string} range
 * @property {string} about
 */

/**
 * A setting of the form. The form's text of a value is the bare text for names, texts and paths, and
 * TOML for others; an empty one is a value that is not set.
 * @typedef {object} Setting
 * @property {string} key with its tables: `motor.microsteps`
 * @property {string} group table, empty for keys outside of tables
 * @property {string} name key within the table
 * @property {"whole" | "number" | "boolean" | "choice" | "bare" | "toml" | "tables"} input
 * @property {string} kind as printed
 * @property {string} unit
 * @property {string} range as printed
 * @property {string} about
 * @property {number} least −∞ if the range does not give it as a number
 * @property {number} most
 * @property {string[]} choices
 * @property {boolean} required
 * @property {string} standard text of the default, empty for none
 * @property {PrintedKey[]} parts keys of the tables of a list
 */

/**
 * Returns the settings of printed keys, and what each table is for.
 * @param {PrintedKey[]} printed
 * @returns {{ settings: Setting[], tables: Map<string, string> }}
 */
export function settingsOf(printed) {
  const kind = (/** @type {PrintedKey} */ row) => row.kind ?? row.type ?? "";
  const rows = (/** @type {(kind: string) => boolean} */ wanted) => printed.filter((row) => wanted(kind(row)));
  const tables = new Map(rows((text) => text === "table").map((row) => [row.key, row.about]));
  const lists = rows((text) => text === "tables").map((row) => row.key);
  const defaults = tableDefaults(rows((text) => text === "table"));
  const inList = (/** @type {string} */ key) => lists.some((list) => key.startsWith(`${list}.`));
  const settings = printed
    .filter((row) => !tables.has(row.key) && !inList(row.key))
    .map((row) => settingOf(row, printed, defaults.get(row.key)));
  return { settings, tables };
}

/**
 * Returns the form's text of a value.
 * @param {Setting} setting
 * @param {string} toml text as in a scenario
 */
export function shownText(setting, toml) {
  if (setting.input === "choice" || setting.input === "bare") {
    try {
      return String(readTomlValue(toml));
    } catch {
      return toml;
    }
  }
  if (setting.input === "whole" || setting.input === "number") return toml.replaceAll("_", "").trim();
  return toml.trim();
}

/**
 * Returns the values of a scenario with paths from the working directory, as `--set` takes them; in
 * the file they are relative to it.
 * @param {Record<string, string>} given TOML texts by dotted keys
 * @param {PrintedKey[]} printed
 * @param {string} file path of the scenario
 */
export function fromDirectory(given, printed, file) {
  const directory = file.slice(0, file.lastIndexOf("/") + 1);
  const paths = printed.filter(({ kind }) => kind === "path" || kind === "list of paths").map(({ key }) => key);
  const placed = (/** @type {string} */ text) =>
    text.replace(/"([^"/\\][^"]*)"/g, (_, path) => JSON.stringify(directory + path));
  return Object.fromEntries(Object.entries(given).map(([key, text]) => {
    if (directory === "") return [key, text];
    if (paths.includes(key)) return [key, placed(text)];
    // Paths in the tables of a list.
    const names = paths.filter((path) => path.startsWith(`${key}.`)).map((path) => path.slice(key.length + 1));
    if (names.length === 0) return [key, text];
    return [key, text.replace(new RegExp(`\\b(${names.join("|")}) = "[^"]*"`, "g"), placed)];
  }));
}

/**
 * Returns what is wrong with a text, or an empty string. What only the program can tell is not wrong.
 * @param {Setting} setting
 * @param {string} text
 */
export function faultIn(setting, text) {
  if (text.trim() === "") return setting.required ? "Required." : "";
  if (setting.input === "bare") return "";
  if (setting.input === "choice") {
    return setting.choices.length === 0 || setting.choices.includes(text) ? "" : `Allowed: ${setting.choices.join(", ")}.`;
  }
  let value;
  try {
    value = readTomlValue(text);
  } catch (error) {
    return `${/** @type {Error} */ (error).message}.`;
  }
  if (setting.input === "boolean") return typeof value === "boolean" ? "" : "Allowed: true, false.";
  if (setting.input === "tables") return isListOfTables(value) ? "" : "Expected: a list of tables, [{ key = value }, …].";
  if (setting.input === "toml") return faultInList(setting, value);
  return faultInNumber(setting, value);
}

/**
 * True if two texts of the form are one value.
 * @param {Setting} setting
 * @param {string} text
 * @param {string} other
 */
export function sameValue(setting, text, other) {
  if (text.trim() === other.trim()) return true;
  if (text.trim() === "" || other.trim() === "" || setting.input === "bare" || setting.input === "choice") return false;
  try {
    return tomlText(readTomlValue(text)) === tomlText(readTomlValue(other));
  } catch {
    return false;
  }
}

/**
 * Returns KEY=VALUE for `--set`.
 * @param {Setting} setting
 * @param {string} text
 */
export function changeOf(setting, text) {
  const bare = setting.input === "bare" || setting.input === "choice";
  return `${setting.key}=${bare ? tomlText(text) : text.trim()}`;
}

/**
 * Returns the setting that a fault names: by its whole key, by the list for `step 0: target`, or by
 * its last part if no other setting has it.
 * @param {Setting[]} settings
 * @param {string} field
 */
export function settingNamed(settings, field) {
  const whole = settings.find((setting) => setting.key === field);
  if (whole) return whole;
  const list = /^([\w.]+) \d+\b/.exec(field)?.[1] ?? field.replace(/\..*$/, "");
  const ends = settings.filter((setting) => setting.key.endsWith(`.${field}`));
  const parts = settings.filter((setting) => setting.parts.some((part) => part.key === `${setting.key}.${field}`));
  const found = [...ends, ...parts];
  return settings.find((setting) => setting.key === list) ?? (found.length === 1 ? found[0] : undefined);
}

/**
 * @param {PrintedKey} row
 * @param {PrintedKey[]} printed
 * @param {string | undefined} ofTable default that the table gives
 * @returns {Setting}
 */
function settingOf(row, printed, ofTable) {
  const kind = row.kind ?? row.type ?? "";
  const dot = row.key.lastIndexOf(".");
  const given = row.default ?? row.full ?? "none";
  const written = ofTable ?? (given === "none" || given === "required" ? "" : given);
  const input = inputOf(kind);
  const choices = input === "choice" ? choicesIn(row.range) : [];
  const [least, most] = boundsIn(row.range);
  /** @type {Setting} */
  const setting = {
    key: row.key,
    group: row.key.slice(0, Math.max(0, dot)),
    name: row.key.slice(dot + 1),
    input, kind, unit: row.unit, range: row.range, about: row.about, least, most, choices,
    // A table that is left out needs none of its keys.
    required: given === "required" && ofTable === undefined && dot < 0,
    standard: "",
    parts: input === "tables" ? printed.filter((part) => part.key.startsWith(`${row.key}.`)) : [],
  };
  setting.standard = shownText(setting, written);
  return setting;
}

/**
 * Defaults of keys whose table has a default as a whole, by their keys.
 * @param {PrintedKey[]} tables
 */
function tableDefaults(tables) {
  /** @type {Map<string, string>} */
  const defaults = new Map();
  for (const { key, default: text } of tables) {
    if (!text?.startsWith("{")) continue;
    const table = /** @type {Record<string, import("./tomlvalue.js").TomlValue>} */ (readTomlValue(text));
    for (const [name, value] of Object.entries(table)) defaults.set(`${key}.${name}`, tomlText(value));
  }
  return defaults;
}

/**
 * @param {string} kind
 * @returns {Setting["input"]}
 */
function inputOf(kind) {
  switch (kind) {
    case "whole number": return "whole";
    case "number": return "number";
    case "true or false": return "boolean";
    case "name": return "choice";
    case "text": case "path": return "bare";
    case "tables": return "tables";
    default: return "toml";
  }
}

/** Names in a range: `"a", "b"` in scenarios, `a, b` in circuits. @param {string} range */
function choicesIn(range) {
  const quoted = [...range.matchAll(/"([^"]*)"/g)].map((found) => found[1]);
  return quoted.length > 0 ? quoted : range.split(", ").filter((name) => name !== "");
}

/**
 * Bounds that a range gives as numbers. Of `1 to 65535 CKs` neither is in the key's own unit, and
 * `0.001 to 9, or the negative of that` bounds no number from below.
 * @param {string} range
 * @returns {[number, number]}
 */
function boundsIn(range) {
  const both = /^(-?[\d.]+) to (-?[\d.]+)(?=$|;|,(?! or))/.exec(range);
  if (both) return [Number(both[1]), Number(both[2])];
  const least = /^(-?[\d.]+)(?: to (?![-\d])| or more(?=$|;|,))/.exec(range) ?? /^from (-?[\d.]+)$/.exec(range);
  return [least ? Number(least[1]) : -Infinity, Infinity];
}

/**
 * @param {Setting} setting
 * @param {import("./tomlvalue.js").TomlValue} value
 */
function faultInNumber(setting, value) {
  if (typeof value !== "number" || !Number.isFinite(value)) return "Expected: a number.";
  if (setting.input === "whole" && !Number.isInteger(value)) return "Expected: a whole number.";
  return value < setting.least || value > setting.most ? `Allowed: ${setting.range}.` : "";
}

/**
 * @param {Setting} setting
 * @param {import("./tomlvalue.js").TomlValue} value
 */
function faultInList(setting, value) {
  const { kind } = setting;
  if (kind.startsWith("number, or list")) {
    if (typeof value === "number") return faultInNumber(setting, value);
  }
  const expected = `Expected: ${kind}.`;
  if (kind.startsWith("table")) return typeof value === "object" && !Array.isArray(value) ? "" : expected;
  if (!Array.isArray(value)) return expected;
  const count = /^list of (\d+) /.exec(kind);
  if (count && value.length !== Number(count[1])) return expected;
  if (kind.startsWith("list of X, Y, Z") && value.length !== 3 && value.length !== 4) return expected;
  if (/^list of (texts|paths)/.test(kind)) return value.every((part) => typeof part === "string") ? "" : expected;
  if (!/number|X, Y, Z/.test(kind)) return "";
  const whole = kind.includes("whole");
  const faults = value.map((part) => faultInNumber({ ...setting, input: whole ? "whole" : "number" }, part));
  return faults.find((fault) => fault !== "") ?? "";
}

/** @param {import("./tomlvalue.js").TomlValue} value */
function isListOfTables(value) {
  return Array.isArray(value) && value.every((part) => typeof part === "object" && !Array.isArray(part));
}
