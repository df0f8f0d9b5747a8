import { ChangeColumn, UNKNOWN_X, UNKNOWN_Z } from "./column.js";
import { DumpError } from "./dump.js";
import { ByteReader, inflated, unpackLz4 } from "./unpack.js";

/** @typedef {import("./fst_hierarchy.js").FstWidth} FstWidth */
/** @typedef {import("./dump.js").DumpSignal} DumpSignal */

/**
 * Section of a file: times, and where the changes of each signal stand.
 * @typedef {object} FstSection
 * @property {Float64Array} times
 * @property {Int32Array} chains position of each signal's chain from `base`; 0 if it has none
 * @property {Int32Array} starts all positions, ascending, and the end of the last chain
 * @property {number} base
 * @property {number} packing
 */

/** Reader of the changes of single signals. */
export class FstChanges {
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
