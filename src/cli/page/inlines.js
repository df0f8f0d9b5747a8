// Text of a paragraph, a heading or a cell in Markdown: code, emphasis and links.

/**
 * A piece of text. Pictures are their alternative text.
 * @typedef {string | { kind: "code", text: string } | { kind: "strong" | "em", inner: Inline[] } | { kind: "link", target: string, inner: Inline[] }} Inline
 */

/**
 * Reads text; marks without a partner stay text.
 * @param {string} text
 * @returns {Inline[]}
 */
export function inlinesOf(text) {
  /** @type {Inline[]} */
  const found = [];
  let plain = "";
  /** @param {Inline} inline */
  const push = (inline) => {
    if (plain !== "") found.push(plain);
    plain = "";
    found.push(inline);
  };
  let at = 0;
  while (at < text.length) {
    const read = codeAt(text, at) ?? linkAt(text, at) ?? emphasisAt(text, at);
    if (read) {
      if (typeof read.inline === "string") plain += read.inline;
      else push(read.inline);
      at = read.end;
    } else {
      if (text[at] === "\\" && /[!-/:-@[-`{-~]/.test(text[at + 1] ?? "")) at += 1;
      plain += text[at];
      at += 1;
    }
  }
  if (plain !== "") found.push(plain);
  return found;
}

/**
 * Text without its marks.
 * @param {Inline[]} inlines
 * @returns {string}
 */
export function bareText(inlines) {
  const texts = inlines.map((inline) => {
    if (typeof inline === "string") return inline;
    return inline.kind === "code" ? inline.text : bareText(inline.inner);
  });
  return texts.join("");
}

/** What stands at a place, and where it ends. @typedef {{ inline: Inline, end: number } | undefined} Read */

/**
 * Code between equal runs of backticks. Backticks without a partner are text.
 * @param {string} text
 * @param {number} at
 * @returns {Read}
 */
function codeAt(text, at) {
  const ticks = /^`+/.exec(text.slice(at))?.[0];
  if (ticks === undefined) return undefined;
  const from = at + ticks.length;
  for (let end = text.indexOf(ticks, from); end >= 0; end = text.indexOf(ticks, end)) {
    const run = /^`+/.exec(text.slice(end))?.[0] ?? "";
    if (run.length === ticks.length) {
      // A space at each end stands off backticks of the code.
      const code = text.slice(from, end).replaceAll("\n", " ").replace(/^ (.*\S.*) $/, "$1");
      return { inline: { kind: "code", text: code }, end: end + run.length };
    }
    end += run.length;
  }
  return { inline: ticks, end: from };
}

/**
 * A link, or a picture, of which the alternative text is kept.
 * @param {string} text
 * @param {number} at
 * @returns {Read}
 */
function linkAt(text, at) {
  const isPicture = text.startsWith("![", at);
  if (!isPicture && text[at] !== "[") return undefined;
  const from = at + (isPicture ? 2 : 1);
  const close = closing(text, from);
  const target = close < 0 ? null : /^\]\(([^()\s]*)\)/.exec(text.slice(close));
  if (!target) return undefined;
  const inner = inlinesOf(text.slice(from, close));
  const end = close + target[0].length;
  return { inline: isPicture ? bareText(inner) : { kind: "link", target: target[1], inner }, end };
}

/**
 * Place of the bracket that closes the one before `from`; -1 if none does.
 * @param {string} text
 * @param {number} from
 */
function closing(text, from) {
  let open = 1;
  for (let at = from; at < text.length; at++) {
    const code = codeAt(text, at);
    if (code) at = code.end - 1;
    else if (text[at] === "\\") at += 1;
    else if (text[at] === "[") open += 1;
    else if (text[at] === "]" && --open === 0) return at;
  }
  return -1;
}

/**
 * Text between asterisks, one or two.
 * @param {string} text
 * @param {number} at
 * @returns {Read}
 */
function emphasisAt(text, at) {
  const mark = text.startsWith("**", at) ? "**" : "*";
  const from = at + mark.length;
  if (!text.startsWith(mark, at) || !/[^\s*]/.test(text[from] ?? "")) return undefined;
  for (let end = from; end < text.length; end++) {
    const code = codeAt(text, end);
    if (code) end = code.end - 1;
    else if (text[end] === "\\") end += 1;
    else if (text.startsWith("**", end) && mark === "*") end += 1;
    else if (text.startsWith(mark, end) && !/\s/.test(text[end - 1])) {
      const kind = mark === "**" ? "strong" : "em";
      return { inline: { kind, inner: inlinesOf(text.slice(from, end)) }, end: end + mark.length };
    }
  }
  return undefined;
}
