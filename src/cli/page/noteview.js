// Shows the blocks of a note.
import { element } from "./dom.js";
import { bareText } from "./inlines.js";

/** @typedef {import("./inlines.js").Inline} Inline */
/** @typedef {import("./markdown.js").Block} Block */

/**
 * Makes the element of a link; `undefined` if it leads nowhere, and its text stays text.
 * @typedef {(target: string, children: (Node | string)[]) => HTMLElement | undefined} Link
 */

/** Prefix of a heading's id, apart from other ids of the page. */
export const HEADING_ID = "note-";

/** Titles of a dialog's parts begin at the second level. */
const LEVELS = /** @type {const} */ (["h2", "h3", "h4", "h5", "h6", "h6"]);

/**
 * Elements of a note.
 * @param {Block[]} blocks
 * @param {Link} link
 * @returns {HTMLElement[]}
 */
export function noteView(blocks, link) {
  return blocks.map((block) => blockView(block, link));
}

/**
 * @param {Block} block
 * @param {Link} link
 * @returns {HTMLElement}
 */
function blockView(block, link) {
  const texts = (/** @type {Inline[]} */ inner) => inlinesView(inner, link);
  switch (block.kind) {
    case "heading":
      return element(LEVELS[block.level - 1], { id: HEADING_ID + block.id }, texts(block.inner));
    case "paragraph":
      return element("p", {}, texts(block.inner));
    case "code":
      return codeView(block.info, block.text);
    case "list":
      return element(block.ordered ? "ol" : "ul", {}, block.items.map((item) => element("li", {}, itemView(item, link))));
    case "quote":
      return element("blockquote", {}, noteView(block.blocks, link));
    case "table": {
      const head = block.head.map((cell) => element("th", { scope: "col" }, texts(cell)));
      const rows = block.rows.map((row) => element("tr", {}, row.map((cell) => element("td", {}, texts(cell)))));
      const label = `Table: ${block.head.map(bareText).join(", ")}`;
      return element("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": label },
        element("table", {}, element("thead", {}, element("tr", {}, head)), element("tbody", {}, rows)));
    }
  }
}

/**
 * Code; a timing chart has its circuit and its title above it.
 * @param {string} info
 * @param {string} text
 */
function codeView(info, text) {
  const chart = /^chart (\w+)(?:\[.*?\])? +(.*)$/.exec(info);
  const code = element("pre", { tabindex: 0 }, element("code", {}, text));
  return chart ? element("figure", {}, element("figcaption", {}, `${chart[1]}: ${chart[2]}`), code) : code;
}

/**
 * Contents of an item: without a paragraph of its own if it is one line of text.
 * @param {Block[]} item
 * @param {Link} link
 */
function itemView(item, link) {
  const [first, ...rest] = item;
  if (first?.kind !== "paragraph") return noteView(item, link);
  return [...inlinesView(first.inner, link), ...noteView(rest, link)];
}

/**
 * @param {Inline[]} inlines
 * @param {Link} link
 * @returns {(Node | string)[]}
 */
function inlinesView(inlines, link) {
  return inlines.flatMap((inline) => {
    if (typeof inline === "string") return inline;
    if (inline.kind === "code") return element("code", {}, inline.text);
    const inner = inlinesView(inline.inner, link);
    if (inline.kind === "link") return link(inline.target, inner) ?? inner;
    return element(inline.kind, {}, inner);
  });
}
