/** A number of JSON with the text that it has there, so that nothing is rounded. */
export class ExactNumber {
  /** @param {string} text */
  constructor(text) {
    this.text = text;
  }

  valueOf() {
    return Number(this.text);
  }

  toString() {
    return this.text;
  }
}

/**
 * A value of JSON whose numbers keep their text.
 * @typedef {null | boolean | string | ExactNumber | any[] | Map<string, any>} ExactJson
 */

const JSON_TOKEN = /\s*(?:([{}[\],:])|("(?:[^"\\]|\\.)*")|(-?(?:0|[1-9]\d*)(?:\.\d+)?(?:[eE][+-]?\d+)?)|(true|false|null))/y;

/**
 * Reads JSON; objects become maps, numbers keep their text.
 * @param {string} text
 * @returns {ExactJson}
 * @throws {SyntaxError}
 */
export function readExactJson(text) {
  const tokens = jsonTokens(text);
  let place = 0;
  const take = () => tokens[place++];
  const list = () => {
    /** @type {ExactJson[]} */
    const values = [];
    if (tokens[place] === "]") return take(), values;
    do values.push(value()); while (take() === ",");
    if (tokens[place - 1] !== "]") throw new SyntaxError("A list of JSON does not end");
    return values;
  };
  const table = () => {
    /** @type {Map<string, ExactJson>} */
    const values = new Map();
    if (tokens[place] === "}") return take(), values;
    do {
      const key = JSON.parse(take() ?? "");
      if (take() !== ":") throw new SyntaxError(`No colon after ${key}`);
      values.set(key, value());
    } while (take() === ",");
    if (tokens[place - 1] !== "}") throw new SyntaxError("An object of JSON does not end");
    return values;
  };
  /** @returns {ExactJson} */
  const value = () => {
    const token = take();
    if (token === undefined) throw new SyntaxError("JSON ends early");
    if (token === "[") return list();
    if (token === "{") return table();
    return /^[-\d]/.test(token) ? new ExactNumber(token) : JSON.parse(token);
  };
  const whole = value();
  if (place !== tokens.length) throw new SyntaxError("Text after the end of JSON");
  return whole;
}

/** @param {string} text */
function jsonTokens(text) {
  const tokens = [];
  const end = text.trimEnd().length;
  JSON_TOKEN.lastIndex = 0;
  while (JSON_TOKEN.lastIndex < end) {
    const from = JSON_TOKEN.lastIndex;
    const found = JSON_TOKEN.exec(text);
    if (!found) throw new SyntaxError(`No JSON at character ${from + 1}`);
    tokens.push(found[1] ?? found[2] ?? found[3] ?? found[4]);
  }
  return tokens;
}
