// Reads the Markdown of the notes into blocks.
import { inlinesOf, bareText } from "./inlines.js";
import { headingName } from "./notes.js";

/** @typedef {import("./inlines.js").Inline} Inline */

/**
 * A block. `id` of a heading is that of its links; `info` of code is what stands after the fence.
 * A row of a table has a cell for each column.
 * @typedef {{ kind: "heading", level: number, id: string, inner: Inline[] }
 *   | { kind: "paragraph", inner: Inline[] }
 *   | { kind: "code", info: string, text: string }
 *   | { kind: "list", ordered: boolean, items: Block[][] }
 *   | { kind: "quote", blocks: Block[] }
 *   | { kind: "table", head: Inline[][], rows: Inline[][][] }} Block
 */

const FENCE = /^ {0,3}(`{3,}|~{3,})(.*)$/;
const HEADING = /^(#{1,6}) +(.*?) *#*$/;
const ITEM = /^( {0,3})([-*+]|\d{1,9}[.)])( +)(.*)$/;
// Without the marks themselves, which HTML would read in the page's script.
const COMMENT = /^<!-{2}/;
const COMMENT_END = /-{2}>/;
const DELIMITER = /^\|(\s*:?-+:?\s*\|)+\s*$/;

/**
 * Reads a note. Comments are left out.
 * @param {string} text
 * @returns {Block[]}
 */
export function blocksOf(text) {
  /** @type {Map<string, number>} */
  const ids = new Map();
  return blocksIn(text.split("\n"), ids);
}

/**
 * @param {string[]} lines
 * @param {Map<string, number>} ids how often each heading came
 * @returns {Block[]}
 */
function blocksIn(lines, ids) {
  /** @type {Block[]} */
  const blocks = [];
  let at = 0;
  while (at < lines.length) {
    const line = lines[at];
    const heading = HEADING.exec(line);
    if (line.trim() === "") {
      at += 1;
    } else if (COMMENT.test(line)) {
      while (at < lines.length && !COMMENT_END.test(lines[at])) at += 1;
      at += 1;
    } else if (heading) {
      const inner = inlinesOf(heading[2]);
      blocks.push({ kind: "heading", level: heading[1].length, id: headingId(bareText(inner), ids), inner });
      at += 1;
    } else {
      const read = codeIn(lines, at) ?? tableIn(lines, at) ?? listIn(lines, at, ids) ?? quoteIn(lines, at, ids) ?? paragraphIn(lines, at);
      blocks.push(read.block);
      at = read.end;
    }
  }
  return blocks;
}

/**
 * The name of a heading in links; the second of its text has a number.
 * @param {string} text
 * @param {Map<string, number>} ids
 */
function headingId(text, ids) {
  const id = headingName(text);
  const count = ids.get(id) ?? 0;
  ids.set(id, count + 1);
  return count === 0 ? id : `${id}-${count}`;
}

/** A block and the line after it. @typedef {{ block: Block, end: number }} ReadBlock */

/**
 * Code between fences, or indented by four.
 * @param {string[]} lines
 * @param {number} at
 * @returns {ReadBlock | undefined}
 */
function codeIn(lines, at) {
  const fence = FENCE.exec(lines[at]);
  let end = at;
  if (!fence) {
    while (end < lines.length && /^ {4}|^\s*$/.test(lines[end])) end += 1;
    while (end > at && lines[end - 1].trim() === "") end -= 1;
    const code = lines.slice(at, end).map((line) => line.slice(4));
    return end === at ? undefined : { block: { kind: "code", info: "", text: code.join("\n") }, end };
  }
  const indent = lines[at].indexOf(fence[1]);
  const isEnd = (/** @type {string} */ line) => {
    const closed = FENCE.exec(line);
    return closed !== null && closed[1].startsWith(fence[1]) && closed[2].trim() === "";
  };
  end += 1;
  while (end < lines.length && !isEnd(lines[end])) end += 1;
  const code = lines.slice(at + 1, end).map((line) => unindented(line, indent));
  return { block: { kind: "code", info: fence[2].trim(), text: code.join("\n") }, end: end + 1 };
}

/**
 * @param {string[]} lines
 * @param {number} at
 * @returns {ReadBlock | undefined}
 */
function tableIn(lines, at) {
  if (!isTable(lines, at)) return undefined;
  let end = at + 2;
  while (end < lines.length && lines[end].startsWith("|")) end += 1;
  const head = cellsOf(lines[at]);
  const rows = lines.slice(at + 2, end).map((line) => {
    const cells = cellsOf(line);
    return head.map((_, column) => cells[column] ?? []);
  });
  return { block: { kind: "table", head, rows }, end };
}

/**
 * @param {string[]} lines
 * @param {number} at
 */
function isTable(lines, at) {
  return lines[at].startsWith("|") && DELIMITER.test(lines[at + 1] ?? "");
}

/**
 * Cells of a row. A bar in a cell has a backslash, in code too.
 * @param {string} line
 */
function cellsOf(line) {
  const row = line.trim().replace(/^\|/, "").replace(/(?<!\\)\|$/, "");
  return row.split(/(?<!\\)\|/).map((cell) => inlinesOf(cell.trim().replaceAll("\\|", "|")));
}

/**
 * @param {string[]} lines
 * @param {number} at
 * @param {Map<string, number>} ids
 * @returns {ReadBlock | undefined}
 */
function listIn(lines, at, ids) {
  const first = ITEM.exec(lines[at]);
  if (!first) return undefined;
  const ordered = /\d/.test(first[2]);
  /** @type {Block[][]} */
  const items = [];
  let end = at;
  for (let item = ITEM.exec(lines[end] ?? ""); item && /\d/.test(item[2]) === ordered; item = ITEM.exec(lines[end] ?? "")) {
    const indent = item[1].length + item[2].length + item[3].length;
    const own = [item[4]];
    end += 1;
    while (end < lines.length && isOfItem(lines, end, indent)) {
      own.push(unindented(lines[end], indent));
      end += 1;
    }
    items.push(blocksIn(own, ids));
  }
  return { block: { kind: "list", ordered, items }, end };
}

/**
 * True if a line belongs to the item before it: it is indented, or goes on with its paragraph.
 * @param {string[]} lines
 * @param {number} at
 * @param {number} indent
 */
function isOfItem(lines, at, indent) {
  const line = lines[at];
  if (line.trim() !== "") return line.search(/\S/) >= indent || (lines[at - 1].trim() !== "" && !begins(lines, at));
  const next = lines.slice(at).find((later) => later.trim() !== "");
  // Blank lines between items are of the item before.
  return next !== undefined && (next.search(/\S/) >= indent || ITEM.test(next));
}

/**
 * @param {string[]} lines
 * @param {number} at
 * @param {Map<string, number>} ids
 * @returns {ReadBlock | undefined}
 */
function quoteIn(lines, at, ids) {
  let end = at;
  while (end < lines.length && lines[end].startsWith(">")) end += 1;
  const quoted = lines.slice(at, end).map((line) => line.replace(/^> ?/, ""));
  return end === at ? undefined : { block: { kind: "quote", blocks: blocksIn(quoted, ids) }, end };
}

/**
 * @param {string[]} lines
 * @param {number} at
 * @returns {ReadBlock}
 */
function paragraphIn(lines, at) {
  let end = at + 1;
  while (end < lines.length && lines[end].trim() !== "" && !begins(lines, end)) end += 1;
  const text = lines.slice(at, end).map((line) => line.trim());
  return { block: { kind: "paragraph", inner: inlinesOf(text.join("\n")) }, end };
}

/**
 * True if a block begins at a line, even without a blank line before.
 * @param {string[]} lines
 * @param {number} at
 */
function begins(lines, at) {
  const line = lines[at];
  return [FENCE, HEADING, ITEM, /^>/, COMMENT].some((start) => start.test(line)) || isTable(lines, at);
}

/**
 * A line without up to so many spaces before it.
 * @param {string} line
 * @param {number} most
 */
function unindented(line, most) {
  const spaces = line.search(/[^ ]|$/);
  return line.slice(Math.min(spaces, most));
}
