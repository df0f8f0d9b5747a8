import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { inlinesOf, bareText } from "../../../src/cli/page/inlines.js";
import { blocksOf } from "../../../src/cli/page/markdown.js";
import { Notes, leadsTo, noteOf } from "../../../src/cli/page/notes.js";
import { noteView } from "../../../src/cli/page/noteview.js";
import { run } from "./program.mjs";

/** The notes as a page has them beside it. */
const texts = await new Notes(async () => notesFile()).texts();

function notesFile() {
  const folder = mkdtempSync(join(tmpdir(), "motion-rtl-"));
  try {
    const wasm = join(folder, "empty.wasm");
    writeFileSync(wasm, "\0asm");
    const { code, errors } = run("page", wasm, "--out", folder);
    assert.equal(code, 0, errors);
    return readFileSync(join(folder, "notes.json"));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** All blocks of a note, those within others too. */
function within(blocks) {
  return blocks.flatMap((block) => {
    if (block.kind === "list") return [block, ...within(block.items.flat())];
    return block.kind === "quote" ? [block, ...within(block.blocks)] : [block];
  });
}

/** Texts of a block that stand on the page outside code. */
function inlinesIn(block) {
  if (block.kind === "table") return [block.head, ...block.rows].flat();
  return block.kind === "heading" || block.kind === "paragraph" ? [block.inner] : [];
}

/** The pieces of a text, those within others too, with the text of code left out. */
function pieces(inlines) {
  return inlines.flatMap((inline) => (typeof inline === "string" || inline.kind === "code" ? [inline] : [inline, ...pieces(inline.inner)]));
}

/** A plain scan of a note: lines outside fences and comments, what stands after each fence, and lines in fences. */
function scan(text) {
  const found = { lines: [], fences: [], code: [] };
  let fence;
  for (const line of text.split("\n")) {
    const mark = /^ *(```+)(.*)/.exec(line);
    if (fence === undefined && mark) {
      fence = mark[1];
      found.fences.push(mark[2]);
    } else if (mark && mark[1].startsWith(fence) && mark[2] === "") fence = undefined;
    else if (fence !== undefined) found.code.push(line);
    else if (!line.startsWith("<!--")) found.lines.push(line);
  }
  return found;
}

test("every note has the headings, tables, rows and fences of a plain scan", () => {
  assert.ok(texts.size > 120);
  for (const [path, text] of texts) {
    const blocks = within(blocksOf(text));
    const of = (kind) => blocks.filter((block) => block.kind === kind);
    const { lines, fences } = scan(text);
    const headings = lines.filter((line) => /^#+ /.test(line)).map((line) => line.search(/ /));
    assert.deepEqual(of("heading").map(({ level }) => level), headings, path);
    assert.equal(of("table").length, lines.filter((line) => /^\|(-+\|)+$/.test(line.replaceAll(/[: ]/g, ""))).length, `${path}: tables`);
    const rows = of("table").reduce((sum, { rows }) => sum + 2 + rows.length, 0);
    assert.equal(rows, lines.filter((line) => line.startsWith("|")).length, `${path}: rows`);
    const indented = of("code").filter(({ info }) => info === "").length - fences.filter((info) => info === "").length;
    assert.deepEqual(of("code").map(({ info }) => info).filter(Boolean), fences.filter(Boolean), `${path}: fences`);
    assert.equal(indented > 0, lines.some((line) => /^ {4}\w/.test(line)), `${path}: indented code`);
    const items = of("list").reduce((sum, { items }) => sum + items.length, 0);
    assert.equal(items, lines.filter((line) => /^ *([-*]|\d+\.) /.test(line)).length, `${path}: items`);
  }
});

test("no mark of Markdown is left in a text outside code", () => {
  for (const [path, text] of texts) {
    for (const inline of within(blocksOf(text)).flatMap(inlinesIn).flatMap(pieces)) {
      if (typeof inline !== "string") continue;
      assert.doesNotMatch(inline, /`|\*\*|\]\(|<!--|^#+ |^\| |\\[|*`]/m, path);
      assert.doesNotMatch(inline, /(^|\s)\*\S[^*]*\S\*(\s|$)/, path);
    }
  }
});

test("no word of a note is lost", () => {
  const words = (text) => text.match(/[\p{L}\p{N}_]+/gu) ?? [];
  for (const [path, text] of texts) {
    const shown = within(blocksOf(text)).flatMap((block) => (block.kind === "code" ? [block.info, block.text] : inlinesIn(block).map(bareText)));
    const { lines, fences, code } = scan(text);
    // Numbers of items and targets of links are not shown.
    const bare = lines.map((line) => line.replace(/^ *\d+\. /, "").replaceAll(/\]\([^()\s]*\)/g, "]"));
    const expected = words([...bare, ...fences, ...code].join("\n"));
    const found = words(shown.join("\n"));
    assert.deepEqual(found.sort(), expected.sort(), path);
  }
});

/** As much of the document as the view of a note needs. */
class FakeNode {
  constructor(tag, text = "") {
    Object.assign(this, { tag, text, children: [], attributes: {} });
  }
  setAttribute(name, value) {
    this.attributes[name] = value;
  }
  addEventListener() {}
  appendChild(child) {
    this.children.push(child);
  }
  get textContent() {
    return this.text + this.children.map((child) => child.textContent).join("");
  }
  all(tag) {
    return [...(this.tag === tag ? [this] : []), ...this.children.flatMap((child) => child.all(tag))];
  }
}

test("the view of a note has its texts, and its links where they lead somewhere", () => {
  Object.assign(globalThis, {
    Node: FakeNode,
    document: { createElement: (tag) => new FakeNode(tag), createTextNode: (text) => new FakeNode("", text) },
  });
  for (const [path, text] of texts) {
    const blocks = blocksOf(text);
    const targets = [];
    const link = (target, children) => {
      targets.push(target);
      if (!leadsTo(path, target, texts)) return undefined;
      const node = new FakeNode("a");
      for (const child of children) node.appendChild(child instanceof FakeNode ? child : new FakeNode("", child));
      return node;
    };
    const whole = new FakeNode("div");
    for (const node of noteView(blocks, link)) whole.appendChild(node);
    const count = (tag) => whole.all(tag).length;
    const of = (kind) => within(blocks).filter((block) => block.kind === kind);
    assert.equal(count("table"), of("table").length, path);
    assert.equal(count("pre"), of("code").length, path);
    assert.equal(count("figure"), of("code").filter(({ info }) => info.startsWith("chart ")).length, path);
    assert.equal(count("a"), targets.filter((target) => leadsTo(path, target, texts)).length, path);
    const shown = within(blocks).flatMap((block) => (block.kind === "code" ? [block.text] : inlinesIn(block).map(bareText)));
    const letters = (text) => [...text.replaceAll(/\s/g, "")].length;
    const captions = whole.all("figcaption").map((node) => node.textContent).join("");
    assert.equal(letters(whole.textContent), letters(shown.join("")) + letters(captions), path);
  }
});

test("every circuit has a note, and links between notes lead to a heading", () => {
  const { circuits } = JSON.parse(run("list", "--json").out);
  assert.ok(circuits.length >= 114);
  const headings = new Map([...texts].map(([path, text]) => [path, within(blocksOf(text)).filter(({ kind }) => kind === "heading").map(({ id }) => id)]));
  for (const { name } of circuits) {
    const place = noteOf(texts, name);
    assert.ok(place, name);
    if (place.path.endsWith(`/${name}.md`)) assert.equal(place.heading, undefined);
    else assert.ok(headings.get(place.path).includes(place.heading), `${name}: ${place.heading}`);
  }
  assert.deepEqual(noteOf(texts, "unit_time_register"), { path: "rtl_notes/pulse_interpolator/unit_time.md", heading: "unit-time-register" });
  assert.equal(noteOf(texts, "no_such_circuit"), undefined);
  let links = 0;
  for (const [path, text] of texts) {
    const inlines = within(blocksOf(text)).flatMap(inlinesIn).flatMap(pieces);
    for (const { target } of inlines.filter(({ kind }) => kind === "link")) {
      const to = leadsTo(path, target, texts);
      if (!to?.path) continue;
      links += 1;
      if (to.heading !== undefined) assert.ok(headings.get(to.path).includes(to.heading), `${path}: ${target}`);
    }
  }
  assert.ok(links > 400, `${links} links`);
});

test("a link leads to a note, another site, or nowhere", () => {
  const from = "rtl_notes/blocks/cordic.md";
  assert.deepEqual(leadsTo(from, "#start", texts), { path: from, heading: "start" });
  assert.deepEqual(leadsTo(from, "../machine/README.md#clock", texts), { path: "rtl_notes/machine/README.md", heading: "clock" });
  assert.deepEqual(leadsTo(from, "./shifter.md", texts), { path: "rtl_notes/blocks/shifter.md", heading: undefined });
  assert.deepEqual(leadsTo(from, "https://wasi.dev", texts), { address: "https://wasi.dev" });
  for (const target of ["../../src/lib.rs", "javascript:alert(1)", "none.md"]) assert.equal(leadsTo(from, target, texts), undefined, target);
});

test("pieces of text", () => {
  const cases = [
    ["a `b*c` d", ["a ", { kind: "code", text: "b*c" }, " d"]],
    ["``a`b`` `c", [{ kind: "code", text: "a`b" }, " `c"]],
    ["**a *b* c** d", [{ kind: "strong", inner: ["a ", { kind: "em", inner: ["b"] }, " c"] }, " d"]],
    ["2 * 3 * 4", ["2 * 3 * 4"]],
    ["\\*a\\* [5]", ["*a* [5]"]],
    ["[`x` y](z.md#a)!", [{ kind: "link", target: "z.md#a", inner: [{ kind: "code", text: "x" }, " y"] }, "!"]],
    ["[`a]`](b)", [{ kind: "link", target: "b", inner: [{ kind: "code", text: "a]" }] }]],
    ["![two *waves*](w.png)", ["two waves"]],
    ["<b>a</b>", ["<b>a</b>"]],
    ["[a](b c)", ["[a](b c)"]],
  ];
  for (const [text, expected] of cases) assert.deepEqual(inlinesOf(text), expected, text);
});

test("blocks", () => {
  const paragraph = (...inner) => ({ kind: "paragraph", inner });
  const cases = [
    ["a\nb\n\nc", [paragraph("a\nb"), paragraph("c")]],
    ["# A *b*\n## A b\n## A b", [[1, "a-b", "A "], [2, "a-b-1", "A b"], [2, "a-b-2", "A b"]].map(([level, id, text]) => ({ kind: "heading", level, id, inner: id === "a-b" ? [text, { kind: "em", inner: ["b"] }] : [text] }))],
    ["````x y\n```\n# a\n```\n````\nb", [{ kind: "code", info: "x y", text: "```\n# a\n```" }, paragraph("b")]],
    ["- a\n  b\n\n  ```\n  c\n   d\n  ```\n- e\nf\n\n1. g", [
      { kind: "list", ordered: false, items: [[paragraph("a\nb"), { kind: "code", info: "", text: "c\n d" }], [paragraph("e\nf")]] },
      { kind: "list", ordered: true, items: [[paragraph("g")]] },
    ]],
    ["- a\n  - b\n- c", [{ kind: "list", ordered: false, items: [[paragraph("a"), { kind: "list", ordered: false, items: [[paragraph("b")]] }], [paragraph("c")]] }]],
    ["| a | `b\\|c` |\n|---|:-:|\n| d |\nend", [{ kind: "table", head: [["a"], [{ kind: "code", text: "b|c" }]], rows: [[["d"], []]] }, paragraph("end")]],
    ["> a\n> - b", [{ kind: "quote", blocks: [paragraph("a"), { kind: "list", ordered: false, items: [[paragraph("b")]] }] }]],
    ["<!-- a\nb -->\nc", [paragraph("c")]],
    ["a\n\n    b\n     c\n\nd", [paragraph("a"), { kind: "code", info: "", text: "b\n c" }, paragraph("d")]],
  ];
  for (const [text, expected] of cases) assert.deepEqual(blocksOf(text), expected, text);
});

test("a load that failed is tried again, one that did not is kept", async () => {
  const answers = [Promise.reject(new Error("gone")), Promise.resolve(Buffer.from('{"a.md": "# A"}'))];
  const notes = new Notes(() => answers.shift());
  await assert.rejects(notes.texts(), /gone/);
  assert.equal((await notes.texts()).get("a.md"), "# A");
  assert.deepEqual((await notes.files()).map(([path, bytes]) => [path, new TextDecoder().decode(bytes)]), [["a.md", "# A"]]);
});
