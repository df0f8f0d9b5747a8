// Keys and values of a scenario, as far as the page shows them: the program reads the file itself.

/**
 * The keys that a scenario sets, with the text of their values; keys of tables are dotted.
 * @param {string} text
 * @returns {Record<string, string>}
 */
export function givenIn(text) {
  /** @type {Record<string, string>} */
  const given = {};
  let table = "";
  let open = "";
  for (const line of text.split("\n")) {
    const bare = withoutComment(line).trim();
    const header = /^\[([^[\]]+)\]$/.exec(bare);
    const pair = /^([\w.-]+)\s*=\s*(.*)$/.exec(bare);
    if (open !== "") {
      given[open] += ` ${bare}`;
    } else if (header) {
      table = `${header[1].trim()}.`;
    } else if (pair) {
      open = table + pair[1];
      given[open] = pair[2];
    }
    if (open !== "" && isWhole(given[open])) open = "";
    // A list of tables has no single value.
    if (bare.startsWith("[[")) table = `${bare.replace(/[[\]\s]/g, "")}[].`;
  }
  return given;
}

/** @param {string} line */
function withoutComment(line) {
  let quote = "";
  for (const [place, letter] of [...line].entries()) {
    if (quote) quote = letter === quote ? "" : quote;
    else if (letter === '"' || letter === "'") quote = letter;
    else if (letter === "#") return line.slice(0, place);
  }
  return line;
}

/** True if no bracket of a value is open. @param {string} value */
function isWhole(value) {
  const bare = value.replace(/"[^"]*"|'[^']*'/g, "");
  const count = (/** @type {RegExp} */ letters) => bare.match(letters)?.length ?? 0;
  return count(/[[{]/g) === count(/[\]}]/g);
}
