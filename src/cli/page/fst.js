import { Dump, DumpError } from "./dump.js";
import { FstChanges } from "./fst_changes.js";
import { fstHierarchy, fstWidths } from "./fst_hierarchy.js";
import { ByteReader, inflated } from "./unpack.js";

/** @typedef {import("./fst_changes.js").FstSection} FstSection */

// Kinds of blocks, numbered as in GTKWave's fstapi.h.
const FST_HEADER = 0;
const FST_VALUES = 1;
const FST_GEOMETRY = 3;
const FST_HIERARCHIES = [4, 6, 7];
const FST_VALUES_ALIAS = 5;
const FST_VALUES_ALIAS_2 = 8;
const FST_WRAPPED = 254;
const FST_UNFINISHED = 255;

/** Length in bytes of the header with its kind. */
const FST_HEADER_LENGTH = 330;

/** @typedef {{start: number, end: number, exponent: number}} FstHeader */

/**
 * Reads a file in GTKWave's FST format. Names, times and the positions of all chains are read at
 * once, changes when they are asked for. Times above 2⁵³ units are rounded.
 * @param {Uint8Array} bytes
 * @returns {Promise<Dump>}
 * @throws {DumpError} if the file is no FST file, is damaged, or was not completed
 */
export async function readFst(bytes) {
  try {
    return await dumpOfFst(bytes);
  } catch (error) {
    // A number that leads out of the file.
    if (error instanceof RangeError) throw new DumpError("The FST file is damaged.");
    throw error;
  }
}

/**
 * @param {Uint8Array} bytes
 * @returns {Promise<Dump>}
 */
async function dumpOfFst(bytes) {
  const blocks = [...fstBlocks(bytes)];
  const first = blocks[0];
  if (first?.kind === FST_WRAPPED) {
    return dumpOfFst(await inflated(bytes.subarray(first.from + 8, first.to), "gzip"));
  }
  if (first?.kind === FST_UNFINISHED) throw new DumpError("The FST file was not completed.");
  if (first?.kind !== FST_HEADER || first.to < FST_HEADER_LENGTH) {
    throw new DumpError("This is no FST file.");
  }
  const header = fstHeader(new ByteReader(bytes, first.from));
  const geometry = blocks.find(({ kind }) => kind === FST_GEOMETRY);
  const names = blocks.find(({ kind }) => FST_HIERARCHIES.includes(kind));
  if (!geometry || !names) throw new DumpError("The FST file has no list of signals.");
  const widths = await fstWidths(bytes.subarray(geometry.from, geometry.to));
  const signals = await fstHierarchy(bytes.subarray(names.from, names.to), names.kind, widths);

  const values = blocks.filter(({ kind }) =>
    [FST_VALUES, FST_VALUES_ALIAS, FST_VALUES_ALIAS_2].includes(kind),
  );
  const sections = await Promise.all(values.map((block) => fstSection(bytes, block)));
  const frame = values.length > 0 ? await fstFrame(bytes, values[0].from) : new Uint8Array();
  const reader = new FstChanges(bytes, widths, sections, frame, header.start);
  return new Dump({
    signals,
    start: header.start,
    end: header.end,
    // A power computed by `**` is not the nearest number.
    unit: Number(`1e${header.exponent}`),
    load: (signal) => reader.changes(signal),
  });
}

/**
 * Lists the blocks of a file; contents begin after the length.
 * @param {Uint8Array} bytes
 * @returns {Generator<{kind: number, from: number, to: number}>}
 */
function* fstBlocks(bytes) {
  let at = 0;
  while (at + 9 <= bytes.length) {
    const length = new ByteReader(bytes, at + 1).u64();
    const to = at + 1 + length;
    if (length < 8 || to > bytes.length) {
      throw new DumpError(at === 0 ? "This is no FST file." : "The FST file is cut off.");
    }
    yield { kind: bytes[at], from: at + 9, to };
    at = to;
  }
}

/**
 * @param {ByteReader} reader
 * @returns {FstHeader}
 */
function fstHeader(reader) {
  const start = reader.u64();
  const end = reader.u64();
  // Order of bytes, memory, and four counts.
  reader.at += 6 * 8;
  return { start, end, exponent: (reader.byte() << 24) >> 24 };
}

/**
 * Reads the times and positions of a section.
 * @param {Uint8Array} bytes
 * @param {{kind: number, from: number, to: number}} block
 * @returns {Promise<FstSection>}
 */
async function fstSection(bytes, { kind, from, to }) {
  const tail = new ByteReader(bytes, to - 24);
  const unpacked = tail.u64();
  const packed = tail.u64();
  const count = tail.u64();
  const table = to - 24 - packed;
  const times = fstTimes(await fstPacked(bytes.subarray(table, to - 24), unpacked), count);

  const chainsEnd = table - 8 - new ByteReader(bytes, table - 8).u64();
  const reader = new ByteReader(bytes, from + 24);
  reader.varint();
  const frame = reader.varint();
  reader.varint();
  reader.at += frame;
  const signals = reader.varint();
  const base = reader.at;
  const packing = reader.byte();
  const index = new ByteReader(bytes.subarray(0, table - 8), chainsEnd);
  const { chains, starts } = fstChains(index, kind, signals);
  starts.push(chainsEnd - base);
  return { times, chains, starts: Int32Array.from(starts), base, packing };
}

/**
 * Inflates a table unless its length says that it is not packed.
 * @param {Uint8Array} bytes
 * @param {number} unpacked
 */
async function fstPacked(bytes, unpacked) {
  return bytes.length === unpacked ? bytes : inflated(bytes, "deflate");
}

/**
 * Reads times from their differences.
 * @param {Uint8Array} bytes
 * @param {number} count
 */
function fstTimes(bytes, count) {
  const reader = new ByteReader(bytes, 0);
  const times = new Float64Array(count);
  let time = 0;
  for (let i = 0; i < count; i++) {
    time += reader.varint();
    times[i] = time;
  }
  return times;
}

/**
 * Reads the positions of all chains. A signal without a chain has position 0, and one that equals
 * another signal has that one's.
 * @param {ByteReader} reader
 * @param {number} kind
 * @param {number} signals
 */
function fstChains(reader, kind, signals) {
  const chains = new Int32Array(signals);
  /** @type {number[]} */
  const starts = [];
  let position = 0;
  let alias = 0;
  /** @param {number} step */
  const next = (step) => {
    position += step;
    starts.push(position);
    return position;
  };
  for (let i = 0; reader.at < reader.bytes.length && i < signals; ) {
    if (kind === FST_VALUES_ALIAS_2 && reader.bytes[reader.at] & 1) {
      const step = Math.floor(reader.signed() / 2);
      if (step > 0) {
        chains[i++] = next(step);
      } else {
        if (step < 0) alias = -step - 1;
        chains[i++] = chains[alias];
      }
      continue;
    }
    const number = reader.varint();
    if (number === 0 && kind === FST_VALUES_ALIAS) {
      chains[i++] = chains[reader.varint() - 1];
    } else if (number & 1) {
      chains[i++] = next((number - 1) / 2);
    } else {
      i += number / 2;
    }
  }
  return { chains, starts };
}

/**
 * Reads the initial values of a section as characters.
 * @param {Uint8Array} bytes
 * @param {number} from
 */
async function fstFrame(bytes, from) {
  const reader = new ByteReader(bytes, from + 24);
  const unpacked = reader.varint();
  const packed = reader.varint();
  reader.varint();
  return fstPacked(bytes.subarray(reader.at, reader.at + packed), unpacked);
}
