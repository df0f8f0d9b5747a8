/**
 * A value of TOML as JavaScript has it. Dates are not values of a scenario.
 * @typedef {string | number | boolean | any[] | { [key: string]: any }} TomlValue
 */

/**
 * Reads the text of one value: a number, a string, true or false, a list or an inline table. Lists
 * and tables may span lines and have comments and a last comma.
 * @param {string} text
 * @returns {TomlValue}
 * @throws {SyntaxError} with what is expected at which place
 */
export function readTomlValue(text) {
  const reader = new TomlValueReader(text);
  const value = reader.value();
  reader.end();
  return value;
}

/**
 * Formats a value on one line. Numbers have their shortest text, so that reading gives the same.
 * @param {TomlValue} value
 * @returns {string}
 */
export function tomlText(value) {
  if (typeof value === "string") return JSON.stringify(value).replaceAll("\u007f", "\\u007f");
  if (Array.isArray(value)) return `[${value.map(tomlText).join(", ")}]`;
  if (typeof value !== "object") return String(value);
  const pairs = Object.entries(value).map(([key, part]) => `${/^[\w-]+$/.test(key) ? key : JSON.stringify(key)} = ${tomlText(part)}`);
  return pairs.length === 0 ? "{}" : `{ ${pairs.join(", ")} }`;
}

/**
 * Returns the lists of tables of a scenario, `[[NAME]]`, each as the text of a list of inline tables
 * with a line for each table. The texts of values are as they stand in the file.
 * @param {string} scenario
 * @returns {Record<string, string>}
 */
export function listsOfTables(scenario) {
  /** @type {Map<string, string[][]>} */
  const lists = new Map();
  /** @type {string[] | null} */
  let table = null;
  const lines = scenario.split("\n");
  for (let k = 0; k < lines.length; k += 1) {
    const header = /^\s*\[\[\s*([\w.-]+)\s*\]\]/.exec(lines[k]);
    const pair = /^\s*([\w.-]+)\s*=\s*(.*)$/.exec(lines[k]);
    if (header) {
      table = [];
      lists.set(header[1], [...(lists.get(header[1]) ?? []), table]);
    } else if (/^\s*\[/.test(lines[k])) {
      table = null;
    } else if (pair) {
      // A list may go on for some lines.
      let text = pair[2];
      while (!isTomlValue(text) && k + 1 < lines.length) text += `\n${lines[(k += 1)]}`;
      const reader = new TomlValueReader(text);
      reader.value();
      table?.push(`${pair[1]} = ${text.slice(0, reader.place).replace(/\s*\n\s*/g, " ")}`);
    }
  }
  const text = (/** @type {string[][]} */ tables) => `[\n${tables.map((pairs) => `  { ${pairs.join(", ")} },\n`).join("")}]`;
  return Object.fromEntries([...lists].map(([name, tables]) => [name, text(tables)]));
}

/** @param {string} text */
function isTomlValue(text) {
  try {
    readTomlValue(text);
    return true;
  } catch {
    return false;
  }
}

const TOML_NUMBER = /^[+-]?(?:inf|nan|0x[0-9a-fA-F](?:_?[0-9a-fA-F])*|0o[0-7](?:_?[0-7])*|0b[01](?:_?[01])*|(?:0|[1-9](?:_?\d)*)(?:\.\d(?:_?\d)*)?(?:[eE][+-]?\d(?:_?\d)*)?)$/;

class TomlValueReader {
  place = 0;
  #text;

  /** @param {string} text */
  constructor(text) {
    this.#text = text;
  }

  /** @returns {TomlValue} */
  value() {
    this.#skip();
    const letter = this.#text[this.place];
    if (letter === "[") return this.#list();
    if (letter === "{") return this.#table();
    if (letter === '"' || letter === "'") return this.#string(letter);
    const word = /^[^\s,\]}#]*/.exec(this.#text.slice(this.place))?.[0] ?? "";
    if (word === "") this.#fail("a value");
    if (word !== "true" && word !== "false" && !TOML_NUMBER.test(word)) {
      this.#fail(`a number, true, false or a text in quotes, not ${word}`);
    }
    this.place += word.length;
    if (word === "true" || word === "false") return word === "true";
    return tomlNumber(word.replaceAll("_", ""));
  }

  /** Throws if anything but comments follows. */
  end() {
    this.#skip();
    if (this.place < this.#text.length) this.#fail("no more after the value");
  }

  #list() {
    this.place += 1;
    /** @type {TomlValue[]} */
    const list = [];
    while (!this.#take("]")) {
      if (list.length > 0 && !this.#take(",")) this.#fail("a comma or ]");
      if (this.#take("]")) break;
      list.push(this.value());
    }
    return list;
  }

  #table() {
    this.place += 1;
    /** @type {{ [key: string]: TomlValue }} */
    const table = {};
    let first = true;
    while (!this.#take("}")) {
      if (!first && !this.#take(",")) this.#fail("a comma or }");
      first = false;
      this.#skip();
      const letter = this.#text[this.place];
      const bare = /^[\w.-]+/.exec(this.#text.slice(this.place))?.[0];
      const key = letter === '"' || letter === "'" ? this.#string(letter) : bare;
      if (key === undefined) return this.#fail("a key");
      if (key === bare) this.place += bare.length;
      if (Object.hasOwn(table, key)) this.#fail(`${key} once only`);
      if (!this.#take("=")) this.#fail("=");
      table[key] = this.value();
    }
    return table;
  }

  /** @param {string} quote */
  #string(quote) {
    let end = this.place + 1;
    while (end < this.#text.length && this.#text[end] !== quote && this.#text[end] !== "\n") {
      end += quote === '"' && this.#text[end] === "\\" ? 2 : 1;
    }
    if (this.#text[end] !== quote) this.#fail(`a text with ${quote} at its end`);
    const whole = this.#text.slice(this.place, end + 1);
    if (quote === "'") {
      this.place = end + 1;
      return whole.slice(1, -1);
    }
    try {
      // Besides those of JSON, TOML has one escape that matters little: \U with eight digits.
      const text = JSON.parse(whole.replaceAll("\t", "\\t"));
      this.place = end + 1;
      return String(text);
    } catch {
      return this.#fail("a text whose \\ escapes are those of TOML");
    }
  }

  /** @param {string} letter */
  #take(letter) {
    this.#skip();
    if (this.#text[this.place] !== letter) return false;
    this.place += 1;
    return true;
  }

  #skip() {
    this.place += /^(?:\s|#[^\n]*)*/.exec(this.#text.slice(this.place))?.[0].length ?? 0;
  }

  /**
   * @param {string} expected
   * @returns {never}
   */
  #fail(expected) {
    throw new SyntaxError(`Expected at character ${this.place + 1}: ${expected}`);
  }
}

/** @param {string} word without underscores */
function tomlNumber(word) {
  const sign = word.startsWith("-") ? -1 : 1;
  const bare = word.replace(/^[+-]/, "");
  if (bare === "inf") return sign * Infinity;
  return bare === "nan" ? NaN : sign * Number(bare);
}
