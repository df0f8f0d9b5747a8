import { seriesOf } from "./series.js";

/** Marks of a file in format 1.0. */
const NPY_MAGIC = [0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59, 1, 0];

/** Bytes of each column: `<u8` and `<f8`. */
const NPY_CELL = 8;

/**
 * Reads a series as a structured array of NumPy: `tick` as `<u8`, all others as `<f8`.
 * @param {Uint8Array} bytes
 * @returns {import("./series.js").Series}
 * @throws {Error} if the file is not such an array
 */
export function readNpy(bytes) {
  if (!NPY_MAGIC.every((byte, k) => bytes[k] === byte)) throw new Error("no array of NumPy in format 1.0");
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const begin = NPY_MAGIC.length + 2 + view.getUint16(NPY_MAGIC.length, true);
  const head = new TextDecoder().decode(bytes.subarray(NPY_MAGIC.length + 2, begin));
  const fields = [...head.matchAll(/\('([^']+)', '([^']+)'\)/g)];
  const rows = Number(/'shape': \((\d+),\)/.exec(head)?.[1]);
  if (fields.some(([, , type]) => type !== "<u8" && type !== "<f8") || bytes.length !== begin + rows * fields.length * NPY_CELL) {
    throw new Error("no array of 64-bit numbers as long as its header says");
  }
  const columns = fields.map(([, , type], k) => {
    const column = new Float64Array(rows);
    for (let row = 0; row < rows; row += 1) {
      const at = begin + (row * fields.length + k) * NPY_CELL;
      column[row] = type === "<u8" ? Number(view.getBigUint64(at, true)) : view.getFloat64(at, true);
    }
    return column;
  });
  return seriesOf(fields.map(([, name]) => name), columns);
}
