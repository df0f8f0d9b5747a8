import { append, clear, element } from "./dom.js";
import { ExactNumber, readExactJson } from "./exactjson.js";
import { isPlain, plainText, sortedRows, summaryPart } from "./summaryparts.js";

/** @typedef {import("./exactjson.js").ExactJson} ExactJson */
/** @typedef {import("./summaryparts.js").SummaryPart} SummaryPart */
/** @typedef {import("./summaryparts.js").SummaryTable} SummaryTable */

/** Rows of a table that are shown at first. */
const FIRST_ROWS = 100;

/**
 * Shows the summary of a run, of any circuit: complaints and warnings, plain values, then parts and
 * tables. Numbers are shown as the JSON has them.
 * @param {string | object} json JSON as text, which keeps the numbers' texts, or as a value
 * @returns {HTMLElement}
 */
export function summaryView(json) {
  const text = typeof json === "string" ? json : JSON.stringify(json, null, 2);
  const whole = readExactJson(text);
  const map = whole instanceof Map ? new Map(whole) : new Map([["value", whole]]);
  const told = [notices(map, "complaints", "No complaints"), notices(map, "warnings", "No warnings")];
  map.delete("complaints");
  map.delete("warnings");
  // A summary is a part even if all its values are alike.
  const plain = [...map].filter(([, value]) => isPlain(value));
  const parts = [...map].filter(([, value]) => !isPlain(value)).map(([key, value]) => summaryPart(key, value));
  return element("div", { class: "summary" },
    element("div", { class: "summary-bar" }, copyButton(text)),
    told, plainTable(plain), parts.map((part) => partView(part, 2)));
}

/**
 * @param {Map<string, ExactJson>} map
 * @param {string} key
 * @param {string} none
 */
function notices(map, key, none) {
  const list = map.get(key);
  if (!Array.isArray(list)) return null;
  if (list.length === 0) return element("p", { class: "summary-good" }, none);
  return element("section", { class: `summary-${key}` },
    element("h3", {}, key === "complaints" ? "Complaints" : "Warnings"),
    element("ul", {}, list.map((each) => element("li", {}, plainText(each)))));
}

/** @param {string} text */
function copyButton(text) {
  const told = element("span", { role: "status" });
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text);
      told.textContent = "Copied";
    } catch {
      told.textContent = "The browser does not allow it";
    }
  };
  return [element("button", { type: "button", onclick: () => void copy() }, "Copy JSON"), told];
}

/**
 * @param {SummaryPart} part
 * @param {number} level of the heading
 * @returns {HTMLElement}
 */
function partView(part, level) {
  const tag = /** @type {"h3" | "h4" | "h5" | "h6"} */ (`h${Math.min(6, level)}`);
  const view = element("section", { class: "summary-part" }, element(tag, {}, part.name));
  if (part.plain.length > 0) append(view, plainTable(part.plain));
  if (part.table) append(view, tableView(part.table, part.name));
  append(view, part.parts.map((inner) => partView(inner, level + 1)));
  return view;
}

/** @param {[string, ExactJson][]} values */
function plainTable(values) {
  const rows = values.map(([key, value]) =>
    element("tr", {}, element("th", { scope: "row" }, key), element("td", { class: classOf(value) }, plainText(value))));
  return element("table", { class: "summary-values" }, element("tbody", {}, rows));
}

/**
 * Shows a table whose rows are sorted by a click on a column's head.
 * @param {SummaryTable} table
 * @param {string} name
 * @returns {HTMLElement}
 */
function tableView(table, name) {
  const body = element("tbody");
  const more = element("button", { type: "button", hidden: true }, `Show all ${table.rows.length} rows`);
  let [sortedBy, falling, most] = [-1, false, FIRST_ROWS];
  const fill = () => {
    const rows = sortedBy < 0 ? table.rows : sortedRows(table, sortedBy, falling);
    append(clear(body), rows.slice(0, most).map((row) => element("tr", {}, row.map((value, k) => cell(value, `${name} ${table.columns[k]}`)))));
    more.hidden = rows.length <= most;
  };
  const heads = table.columns.map((column, k) => {
    const sort = () => {
      falling = sortedBy === k && !falling;
      sortedBy = k;
      heads.forEach((head, other) => head.setAttribute("aria-sort", other === k ? (falling ? "descending" : "ascending") : "none"));
      fill();
    };
    return element("th", { scope: "col", "aria-sort": "none" },
      element("button", { type: "button", onclick: sort }, column === "" ? "name" : column));
  });
  more.addEventListener("click", () => {
    most = Infinity;
    fill();
  });
  fill();
  return element("div", { class: "summary-scroll", tabindex: 0, role: "region", "aria-label": name },
    element("table", { class: "summary-table" }, element("thead", {}, element("tr", {}, heads)), body), more);
}

/**
 * @param {ExactJson | undefined} value
 * @param {string} name
 */
function cell(value, name) {
  if (value === undefined || isPlain(value)) return element("td", { class: classOf(value) }, plainText(value));
  const inner = summaryPart(name, value);
  const details = element("details", {}, element("summary", {}, Array.isArray(value) ? `${value.length} rows` : "values"));
  // Tables in tables are built when they are opened: there may be thousands.
  details.addEventListener("toggle", () => {
    if (inner.table) append(details, tableView(inner.table, name));
    else append(details, plainText(value));
  }, { once: true });
  return element("td", {}, details);
}

/** @param {ExactJson | undefined} value */
function classOf(value) {
  if (value instanceof ExactNumber) return "number";
  if (value === null || value === undefined) return "none";
  if (value === false || value === true) return "flag";
  return Array.isArray(value) && value.length > 0 && value.every((each) => each instanceof ExactNumber) ? "number" : null;
}
