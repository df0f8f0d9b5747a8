/** Reader of the numbers of a binary file. */
export class ByteReader {
  /**
   * @param {Uint8Array} bytes
   * @param {number} at position of the next byte
   */
  constructor(bytes, at) {
    if (at < 0) throw new RangeError("before the first byte");
    this.bytes = bytes;
    this.at = at;
  }

  /** Reads a byte. */
  byte() {
    if (this.at >= this.bytes.length) throw new RangeError("after the last byte");
    return this.bytes[this.at++];
  }

  /** Reads eight bytes, the highest first; rounded above 2⁵³. */
  u64() {
    let number = 0;
    for (let i = 0; i < 8; i++) number = number * 256 + this.byte();
    return number;
  }

  /** Reads a number of seven bits per byte, the lowest first. */
  varint() {
    const { bytes } = this;
    // Most numbers have one or two bytes.
    const first = bytes[this.at];
    if (first < 0x80) {
      this.at++;
      return first;
    }
    let number = 0;
    let factor = 1;
    for (;;) {
      const byte = this.byte();
      number += (byte & 0x7f) * factor;
      if (byte < 0x80) return number;
      factor *= 128;
    }
  }

  /** Reads a signed number of seven bits per byte. */
  signed() {
    const from = this.at;
    const number = this.varint();
    const range = 128 ** (this.at - from);
    return number >= range / 2 ? number - range : number;
  }

  /** Reads characters up to a zero byte. */
  text() {
    const end = this.bytes.indexOf(0, this.at);
    if (end < 0) throw new RangeError("text without an end");
    const text = new TextDecoder().decode(this.bytes.subarray(this.at, end));
    this.at = end + 1;
    return text;
  }
}

/**
 * Unpacks zlib ("deflate") or gzip.
 * @param {Uint8Array} bytes
 * @param {"deflate" | "gzip"} format
 * @returns {Promise<Uint8Array>}
 */
export async function inflated(bytes, format) {
  const stream = new Blob([/** @type {any} */ (bytes)]).stream();
  const unpacked = stream.pipeThrough(new DecompressionStream(format));
  return new Uint8Array(await new Response(unpacked).arrayBuffer());
}

/** Length in bytes up to which bytes are copied one by one. */
const LZ4_SHORT = 48;

/**
 * Unpacks an LZ4 block.
 * @param {Uint8Array} packed
 * @param {number} size of the contents
 * @returns {Uint8Array}
 * @throws {RangeError} if the block is damaged
 */
export function unpackLz4(packed, size) {
  const out = new Uint8Array(size);
  let at = 0;
  let to = 0;
  const extension = () => {
    let length = 0;
    let more;
    do {
      more = packed[at++];
      length += more;
    } while (more === 255);
    return length;
  };
  while (at < packed.length) {
    const token = packed[at++];
    let literals = token >>> 4;
    if (literals === 15) literals += extension();
    if (at + literals > packed.length || to + literals > size) throw new RangeError("damaged LZ4 block");
    // A call costs more than a short copy.
    if (literals > LZ4_SHORT) out.set(packed.subarray(at, at + literals), to);
    else for (let i = 0; i < literals; i++) out[to + i] = packed[at + i];
    at += literals;
    to += literals;
    if (at >= packed.length || to >= size) break;
    const distance = packed[at] | (packed[at + 1] << 8);
    at += 2;
    let length = (token & 15) + 4;
    if (length === 19) length += extension();
    if (distance === 0 || distance > to || to + length > size) {
      throw new RangeError("damaged LZ4 block");
    }
    // Source and target may overlap: what is copied is repeated.
    if (distance >= length && length > LZ4_SHORT) out.copyWithin(to, to - distance, to - distance + length);
    else for (let i = 0; i < length; i++) out[to + i] = out[to + i - distance];
    to += length;
  }
  if (to !== size) throw new RangeError("damaged LZ4 block");
  return out;
}
