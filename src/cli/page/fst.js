import { ChangeColumn, UNKNOWN_X, UNKNOWN_Z } from "./column.js";
import { Dump, DumpError } from "./dump.js";
import { fstHierarchy, fstWidths } from "./fst_hierarchy.js";
import { ByteReader, inflated, unpackLz4 } from "./unpack.js";

/** @typedef {import("./fst_hierarchy.js").FstWidth} FstWidth */
/** @typedef {import("./dump.js").DumpSignal} DumpSignal */

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

/**
 * Section of a file: times, and where the changes of each signal stand.
 * @typedef {object} FstSection
 * @property {Float64Array} times
 * @property {Int32Array} chains position of each signal's chain from `base`; 0 if it has none
 * @property {Int32Array} starts all positions, ascending, and the end of the last chain
 * @property {number} base
 * @property {number} packing
 */

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

/** Reader of the changes of single signals. */
class FstChanges {
  #bytes;
  #widths;
  #sections;
  #frame;
  #start;
  /** Position of each signal in the frame. */
  #places;

  /**
   * @param {Uint8Array} bytes
   * @param {FstWidth[]} widths
   * @param {FstSection[]} sections
   * @param {Uint8Array} frame
   * @param {number} start
   */
  constructor(bytes, widths, sections, frame, start) {
    this.#bytes = bytes;
    this.#widths = widths;
    this.#sections = sections;
    this.#frame = frame;
    this.#start = start;
    let place = 0;
    this.#places = widths.map(({ bytes: length }) => (place += length) - length);
  }

  /**
   * Reads all changes of a signal; texts are put into its table.
   * @param {DumpSignal} signal
   */
  async changes(signal) {
    const { kind, bits, bytes: length } = this.#widths[signal.id];
    const column = new ChangeColumn(bits);
    const place = this.#places[signal.id];
    if (place + length <= this.#frame.length) {
      const frame = this.#frame.subarray(place, place + length);
      if (kind === "bits") column.pushDigits(this.#start, frame, 0, length);
      if (kind === "real") column.push(this.#start, fstReal(frame, 0));
    }
    for (const section of this.#sections) {
      const position = section.chains[signal.id];
      if (!position) continue;
      const chain = await this.#chain(section, position);
      if (kind === "text") fstTexts(column, chain, section.times);
      else if (kind === "real") fstReals(column, chain, section.times);
      else if (bits === 1) fstBits(column, chain, section.times);
      else fstWords(column, chain, section.times, bits);
    }
    if (kind === "text") signal.table = column.table;
    return column.finish();
  }

  /**
   * @param {FstSection} section
   * @param {number} position
   * @returns {Promise<Uint8Array> | Uint8Array}
   */
  #chain({ starts, base, packing }, position) {
    const next = starts[starts.indexOf(position) + 1];
    const reader = new ByteReader(this.#bytes, base + position);
    const unpacked = reader.varint();
    const packed = this.#bytes.subarray(reader.at, base + next);
    if (unpacked === 0) return packed;
    if (packing === 0x34) return unpackLz4(packed, unpacked);
    if (packing === 0x5a || packing === 0x21) return inflated(packed, "deflate");
    throw new DumpError("The FST file is packed by FastLZ, which is not supported.");
  }
}

/**
 * @param {Uint8Array} bytes
 * @param {number} at
 */
function fstReal(bytes, at) {
  return new DataView(bytes.buffer, bytes.byteOffset + at, 8).getFloat64(0, true);
}

/**
 * @param {ChangeColumn} column
 * @param {Uint8Array} chain
 * @param {Float64Array} times
 */
function fstBits(column, chain, times) {
  const reader = new ByteReader(chain, 0);
  let place = 0;
  while (reader.at < chain.length) {
    const number = reader.varint();
    if ((number & 1) === 0) {
      place += Math.floor(number / 4);
      column.push(times[place], (number >>> 1) & 1);
    } else {
      place += Math.floor(number / 16);
      column.pushUnknown(times[place], ((number >>> 1) & 7) === 1 ? UNKNOWN_Z : UNKNOWN_X);
    }
  }
}

/**
 * @param {ChangeColumn} column
 * @param {Uint8Array} chain
 * @param {Float64Array} times
 * @param {number} bits
 */
function fstWords(column, chain, times, bits) {
  const reader = new ByteReader(chain, 0);
  const bytes = Math.ceil(bits / 8);
  // Bits are aligned to the highest of the first byte.
  const spare = 8 * bytes - bits;
  let place = 0;
  while (reader.at < chain.length) {
    const number = reader.varint();
    place += Math.floor(number / 2);
    const time = times[place];
    const at = reader.at;
    if (number & 1) {
      column.pushDigits(time, chain, at, at + bits);
      reader.at += bits;
      continue;
    }
    reader.at += bytes;
    if (column.isWide) {
      let value = 0n;
      for (let i = at; i < at + bytes; i++) value = (value << 8n) | BigInt(chain[i]);
      column.pushWide(time, value >> BigInt(spare));
      continue;
    }
    let value = 0;
    if (!column.isWord) {
      for (let i = at; i < at + bytes; i++) value = value * 256 + chain[i];
      // The quotient is exact: all spare bits are 0.
      column.push(time, value / 2 ** spare);
      continue;
    }
    let high = 0;
    for (let i = at; i < at + bytes; i++) {
      high = ((high << 8) | (value >>> 24)) >>> 0;
      value = ((value << 8) | chain[i]) >>> 0;
    }
    const low = spare === 0 ? value : ((value >>> spare) | (high << (32 - spare))) >>> 0;
    column.pushPair(time, high >>> spare, low);
  }
}

/**
 * @param {ChangeColumn} column
 * @param {Uint8Array} chain
 * @param {Float64Array} times
 */
function fstReals(column, chain, times) {
  const reader = new ByteReader(chain, 0);
  let place = 0;
  while (reader.at < chain.length) {
    place += Math.floor(reader.varint() / 2);
    column.push(times[place], fstReal(chain, reader.at));
    reader.at += 8;
  }
}

/**
 * @param {ChangeColumn} column
 * @param {Uint8Array} chain
 * @param {Float64Array} times
 */
function fstTexts(column, chain, times) {
  const reader = new ByteReader(chain, 0);
  const decoder = new TextDecoder();
  let place = 0;
  while (reader.at < chain.length) {
    place += Math.floor(reader.varint() / 2);
    const length = reader.varint();
    const text = chain.subarray(reader.at, reader.at + length);
    column.pushText(times[place], decoder.decode(text));
    reader.at += length;
  }
}
