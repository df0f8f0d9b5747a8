import { DumpError } from "./dump.js";
import { ByteReader, inflated, unpackLz4 } from "./unpack.js";

/** @typedef {import("./dump.js").DumpSignal} DumpSignal */

/**
 * Width of a signal: in bits, 0 if it has none, and in bytes of a frame.
 * @typedef {{kind: "bits" | "real" | "text", bits: number, bytes: number}} FstWidth
 */

// Kinds of entries, numbered as in GTKWave's fstapi.h.
const FST_ATTRIBUTE = 252;
const FST_ATTRIBUTE_END = 253;
const FST_SCOPE = 254;
const FST_UP = 255;
const FST_REG = 5;
const FST_LAST_VARIABLE = 29;
const FST_ENUM_TABLE = 7;
/** Packing of the hierarchy: LZ4 once or twice; otherwise gzip. */
const FST_LZ4 = 6;
const FST_LZ4_TWICE = 7;
const FST_NO_WIDTH = 0xffffffff;

/**
 * Reads the widths of all signals.
 * @param {Uint8Array} block
 * @returns {Promise<FstWidth[]>}
 */
export async function fstWidths(block) {
  const head = new ByteReader(block, 0);
  const unpacked = head.u64();
  const count = head.u64();
  const packed = block.subarray(head.at);
  const isPacked = packed.length !== unpacked;
  const reader = new ByteReader(isPacked ? await inflated(packed, "deflate") : packed, 0);
  /** @type {FstWidth[]} */
  const widths = [];
  for (let i = 0; i < count; i++) {
    const width = reader.varint();
    if (width === 0) widths.push({ kind: "real", bits: 0, bytes: 8 });
    else if (width === FST_NO_WIDTH) widths.push({ kind: "text", bits: 0, bytes: 0 });
    else widths.push({ kind: "bits", bits: width, bytes: width });
  }
  return widths;
}

/**
 * Reads the scopes and names.
 * @param {Uint8Array} block
 * @param {number} kind
 * @param {FstWidth[]} widths
 * @returns {Promise<DumpSignal[]>}
 */
export async function fstHierarchy(block, kind, widths) {
  const head = new ByteReader(block, 0);
  const unpacked = head.u64();
  if (kind !== FST_LZ4 && kind !== FST_LZ4_TWICE) {
    return fstSignals(await inflated(block.subarray(head.at), "gzip"), widths);
  }
  if (kind === FST_LZ4) return fstSignals(unpackLz4(block.subarray(head.at), unpacked), widths);
  const once = head.varint();
  return fstSignals(unpackLz4(unpackLz4(block.subarray(head.at), once), unpacked), widths);
}

/**
 * @param {Uint8Array} bytes
 * @param {FstWidth[]} widths
 */
function fstSignals(bytes, widths) {
  const reader = new ByteReader(bytes, 0);
  /** @type {DumpSignal[]} */
  const signals = [];
  /** @type {Map<number, Map<number, string>>} */
  const tables = new Map();
  /** @type {string[]} */
  let scope = [];
  /** @type {Map<number, string> | null} */
  let table = null;
  let next = 0;
  while (reader.at < bytes.length) {
    const kind = reader.byte();
    if (kind === FST_SCOPE) {
      reader.byte();
      scope = [...scope, reader.text()];
      reader.text();
    } else if (kind === FST_UP) {
      scope = scope.slice(0, -1);
    } else if (kind === FST_ATTRIBUTE) {
      const group = reader.byte();
      const entry = reader.byte();
      const text = reader.text();
      const number = reader.varint();
      if (group === 0 && entry === FST_ENUM_TABLE) {
        if (text !== "") tables.set(number, fstTable(text));
        table = tables.get(number) ?? null;
      }
    } else if (kind <= FST_LAST_VARIABLE) {
      const direction = reader.byte();
      const name = reader.text().trim();
      reader.varint();
      const alias = reader.varint();
      const id = alias === 0 ? next++ : alias - 1;
      if (id >= widths.length) throw new RangeError("signal without a width");
      signals.push(fstSignal(scope, name, id, widths[id], roleOf(kind, direction), table));
      table = null;
    } else if (kind !== FST_ATTRIBUTE_END) {
      throw new DumpError("The list of signals in the FST file is damaged.");
    }
  }
  return signals;
}

/**
 * @param {string[]} scope
 * @param {string} text name, and the range of its bits after a space
 * @param {number} id
 * @param {FstWidth} width
 * @param {DumpSignal["role"]} role
 * @param {Map<number, string> | null} table
 * @returns {DumpSignal}
 */
function fstSignal(scope, text, id, { kind, bits }, role, table) {
  const name = text.replace(/\s+\[[-\d:]+\]$/, "");
  const path = [...scope, name].join(".");
  return { path, scope, name, width: bits, kind, role, table, id };
}

/**
 * @param {number} kind
 * @param {number} direction
 * @returns {DumpSignal["role"]}
 */
function roleOf(kind, direction) {
  if (direction === 1) return "input";
  if (direction === 2) return "output";
  return kind === FST_REG ? "register" : "net";
}

/**
 * Reads a table of states: its name, the number of states, their names and their codes.
 * @param {string} text
 */
function fstTable(text) {
  const words = text.split(" ");
  const count = Number(words[1]);
  const names = words.slice(2, 2 + count).map((name) => name.replace(/\\(.)/g, "$1"));
  const codes = words.slice(2 + count, 2 + 2 * count).map((code) => parseInt(code, 2));
  return new Map(codes.map((code, i) => [code, names[i]]));
}
