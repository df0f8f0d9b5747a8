// System calls of WASI preview 1 for a program that runs once, on files in memory.
import { Circuits } from "./circuits.js";
import { MemoryDirectory, MemoryFile, MemoryTree } from "./files.js";

/** Error numbers of WASI. */
const ERRNO = {
  success: 0,
  badf: 8,
  exist: 20,
  inval: 28,
  isdir: 31,
  noent: 44,
  nosys: 52,
  notdir: 54,
  notempty: 55,
  spipe: 70,
};

/** Types of files. */
const CHARACTER_DEVICE = 2;
const DIRECTORY = 3;
const REGULAR_FILE = 4;

/** Flags of `path_open` and of descriptors. */
const CREATE = 1;
const DIRECTORY_ONLY = 2;
const EXCLUSIVE = 4;
const TRUNCATE = 8;
const APPEND = 1;

/** Descriptor of the root directory, the only one that is open at the beginning. */
const ROOT = 3;

/** Thrown when the program ends. */
export class Exit extends Error {
  /** @param {number} code */
  constructor(code) {
    super(`exit code ${code}`);
    this.code = code;
  }
}

/**
 * An open file or directory.
 * @typedef {{ entry: MemoryFile | MemoryDirectory, path: string, offset: number, append: boolean }} Open
 */

/** The system of one run. */
export class System {
  /**
   * @param {object} options
   * @param {string[]} options.words command line; the first is the program's name
   * @param {MemoryTree} options.tree files; the working directory is the root
   * @param {Record<string, string>} [options.environment]
   * @param {Uint8Array} [options.input] standard input
   * @param {(bytes: Uint8Array, stream: 1 | 2) => void} options.print standard output and error
   * @param {(path: string, file: MemoryFile) => void} [options.wrote] called after each write
   */
  constructor({ words, tree, environment = {}, input = new Uint8Array(0), print, wrote }) {
    this.words = words.map(terminated);
    this.environment = Object.entries(environment).map(([key, value]) => terminated(`${key}=${value}`));
    this.tree = tree;
    this.input = input;
    this.inputRead = 0;
    this.print = print;
    this.wrote = wrote;
    /** @type {Map<number, Open>} */
    this.open = new Map([[ROOT, { entry: tree.root, path: "", offset: 0, append: false }]]);
    /** @type {WebAssembly.Memory | undefined} */
    this.memory = undefined;
  }

  /**
   * Runs a compiled program to its end; returns its exit code.
   * @param {WebAssembly.Module} module
   */
  async run(module) {
    /** @type {Record<string, Function>} */
    const calls = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
      if (from === "motion_rtl") continue;
      if (from !== "wasi_snapshot_preview1") throw new Error(`the program wants ${from}.${name}`);
      const call = /** @type {Record<string, unknown>} */ (/** @type {unknown} */ (this))[name];
      calls[name] = typeof call === "function" ? call.bind(this) : () => ERRNO.nosys;
    }
    const circuits = new Circuits();
    const imports = /** @type {any} */ ({ wasi_snapshot_preview1: calls, motion_rtl: circuits.calls });
    const { exports } = await WebAssembly.instantiate(module, imports);
    const program = /** @type {import("./circuits.js").Exports & { _start: () => void }} */ (
      /** @type {unknown} */ (exports)
    );
    this.memory = program.memory;
    circuits.program = program;
    try {
      program._start();
      return 0;
    } catch (error) {
      if (error instanceof Exit) return error.code;
      throw error;
    }
  }

  // The memory may have grown since the last call, after which older views are empty.
  get view() {
    return new DataView(/** @type {WebAssembly.Memory} */ (this.memory).buffer);
  }

  /** @param {number} at @param {number} length */
  bytes(at, length) {
    return new Uint8Array(/** @type {WebAssembly.Memory} */ (this.memory).buffer, at, length);
  }

  /** @param {number} at @param {number} length */
  text(at, length) {
    return decoder.decode(this.bytes(at, length));
  }

  /** @param {Uint8Array[]} texts @param {number} pointers @param {number} at */
  putTexts(texts, pointers, at) {
    for (const [place, text] of texts.entries()) {
      this.view.setUint32(pointers + 4 * place, at, true);
      this.bytes(at, text.length).set(text);
      at += text.length;
    }
    return ERRNO.success;
  }

  /** @param {Uint8Array[]} texts @param {number} count @param {number} size */
  putSizes(texts, count, size) {
    this.view.setUint32(count, texts.length, true);
    this.view.setUint32(size, texts.reduce((sum, text) => sum + text.length, 0), true);
    return ERRNO.success;
  }

  /** @param {number} pointers @param {number} at */
  args_get(pointers, at) {
    return this.putTexts(this.words, pointers, at);
  }

  /** @param {number} count @param {number} size */
  args_sizes_get(count, size) {
    return this.putSizes(this.words, count, size);
  }

  /** @param {number} pointers @param {number} at */
  environ_get(pointers, at) {
    return this.putTexts(this.environment, pointers, at);
  }

  /** @param {number} count @param {number} size */
  environ_sizes_get(count, size) {
    return this.putSizes(this.environment, count, size);
  }

  /** @param {number} clock @param {bigint} _precision @param {number} at */
  clock_time_get(clock, _precision, at) {
    const milliseconds = clock === 0 ? Date.now() : performance.now();
    this.view.setBigUint64(at, BigInt(Math.round(milliseconds * 1e6)), true);
    return ERRNO.success;
  }

  /** @param {number} _clock @param {number} at */
  clock_res_get(_clock, at) {
    this.view.setBigUint64(at, 1_000_000n, true);
    return ERRNO.success;
  }

  /** @param {number} at @param {number} length */
  random_get(at, length) {
    // A call takes 65,536 bytes at most.
    for (let from = 0; from < length; from += 65536) {
      crypto.getRandomValues(this.bytes(at + from, Math.min(65536, length - from)));
    }
    return ERRNO.success;
  }

  sched_yield() {
    return ERRNO.success;
  }

  /**
   * Waits: there is nothing that could happen meanwhile, so the time is over at once.
   * @param {number} subscriptions @param {number} events @param {number} count @param {number} at
   */
  poll_oneoff(subscriptions, events, count, at) {
    for (let place = 0; place < count; place++) {
      const event = events + 32 * place;
      this.bytes(event, 32).fill(0);
      this.view.setBigUint64(event, this.view.getBigUint64(subscriptions + 48 * place, true), true);
      this.view.setUint8(event + 10, this.view.getUint8(subscriptions + 48 * place + 8));
    }
    this.view.setUint32(at, count, true);
    return ERRNO.success;
  }

  /** @param {number} code */
  proc_exit(code) {
    throw new Exit(code);
  }

  /** @param {number} fd */
  fd_close(fd) {
    return this.open.delete(fd) ? ERRNO.success : ERRNO.badf;
  }

  /** @param {number} fd @param {number} at */
  fd_fdstat_get(fd, at) {
    const open = this.open.get(fd);
    if (!open && fd > 2) return ERRNO.badf;
    this.bytes(at, 24).fill(0);
    this.view.setUint8(at, open ? typeOf(open.entry) : CHARACTER_DEVICE);
    this.view.setUint16(at + 2, open?.append ? APPEND : 0, true);
    this.view.setBigUint64(at + 8, 0x1fff_ffffn, true);
    this.view.setBigUint64(at + 16, 0x1fff_ffffn, true);
    return ERRNO.success;
  }

  fd_fdstat_set_flags() {
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} at */
  fd_filestat_get(fd, at) {
    const open = this.open.get(fd);
    if (!open && fd > 2) return ERRNO.badf;
    return this.putStatus(open?.entry, at);
  }

  /** @param {MemoryFile | MemoryDirectory | undefined} entry @param {number} at */
  putStatus(entry, at) {
    this.bytes(at, 64).fill(0);
    this.view.setBigUint64(at + 8, BigInt(entry?.inode ?? 0), true);
    this.view.setUint8(at + 16, entry ? typeOf(entry) : CHARACTER_DEVICE);
    this.view.setBigUint64(at + 24, 1n, true);
    this.view.setBigUint64(at + 32, BigInt(entry instanceof MemoryFile ? entry.size : 0), true);
    return ERRNO.success;
  }

  /** @param {number} fd @param {bigint} size */
  fd_filestat_set_size(fd, size) {
    const file = this.open.get(fd)?.entry;
    if (!(file instanceof MemoryFile)) return ERRNO.badf;
    file.resize(Number(size));
    return ERRNO.success;
  }

  fd_filestat_set_times() {
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} at */
  fd_prestat_get(fd, at) {
    if (fd !== ROOT) return ERRNO.badf;
    this.view.setUint32(at, 0, true);
    this.view.setUint32(at + 4, 1, true);
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} at */
  fd_prestat_dir_name(fd, at) {
    if (fd !== ROOT) return ERRNO.badf;
    this.view.setUint8(at, "/".charCodeAt(0));
    return ERRNO.success;
  }

  /** @param {number} vectors @param {number} count */
  vectors(vectors, count) {
    const { view } = this;
    return Array.from({ length: count }, (_, place) => {
      const at = vectors + 8 * place;
      return this.bytes(view.getUint32(at, true), view.getUint32(at + 4, true));
    });
  }

  /** @param {number} fd @param {number} vectors @param {number} count @param {number} at */
  fd_read(fd, vectors, count, at) {
    const open = this.open.get(fd);
    if (fd === 0) {
      const rest = this.input.subarray(this.inputRead);
      this.inputRead += this.scatter(rest, vectors, count, at);
      return ERRNO.success;
    }
    if (!(open?.entry instanceof MemoryFile)) return open ? ERRNO.isdir : ERRNO.badf;
    open.offset += this.scatter(open.entry.bytes.subarray(open.offset), vectors, count, at);
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} vectors @param {number} count @param {bigint} offset @param {number} at */
  fd_pread(fd, vectors, count, offset, at) {
    const file = this.open.get(fd)?.entry;
    if (!(file instanceof MemoryFile)) return ERRNO.badf;
    this.scatter(file.bytes.subarray(Number(offset)), vectors, count, at);
    return ERRNO.success;
  }

  /** @param {Uint8Array} from @param {number} vectors @param {number} count @param {number} at */
  scatter(from, vectors, count, at) {
    let read = 0;
    for (const to of this.vectors(vectors, count)) {
      const part = from.subarray(read, read + to.length);
      to.set(part);
      read += part.length;
    }
    this.view.setUint32(at, read, true);
    return read;
  }

  /** @param {number} fd @param {number} vectors @param {number} count @param {number} at */
  fd_write(fd, vectors, count, at) {
    const open = this.open.get(fd);
    let written = 0;
    for (const from of this.vectors(vectors, count)) {
      if (fd === 1 || fd === 2) {
        // Copied: the memory goes on to change.
        this.print(from.slice(), fd);
      } else if (open?.entry instanceof MemoryFile) {
        const offset = open.append ? open.entry.size : open.offset;
        open.entry.write(from, offset);
        open.offset = offset + from.length;
      } else {
        return ERRNO.badf;
      }
      written += from.length;
    }
    if (open?.entry instanceof MemoryFile) this.wrote?.(open.path, open.entry);
    this.view.setUint32(at, written, true);
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} vectors @param {number} count @param {bigint} offset @param {number} at */
  fd_pwrite(fd, vectors, count, offset, at) {
    const file = this.open.get(fd)?.entry;
    if (!(file instanceof MemoryFile)) return ERRNO.badf;
    let written = 0;
    for (const from of this.vectors(vectors, count)) {
      file.write(from, Number(offset) + written);
      written += from.length;
    }
    this.view.setUint32(at, written, true);
    return ERRNO.success;
  }

  /** @param {number} fd @param {bigint} by @param {number} from @param {number} at */
  fd_seek(fd, by, from, at) {
    const open = this.open.get(fd);
    if (!open) return fd > 2 ? ERRNO.badf : ERRNO.spipe;
    const size = open.entry instanceof MemoryFile ? open.entry.size : 0;
    const to = [0, open.offset, size][from] + Number(by);
    if (to < 0) return ERRNO.inval;
    open.offset = to;
    this.view.setBigUint64(at, BigInt(to), true);
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} at */
  fd_tell(fd, at) {
    return this.fd_seek(fd, 0n, 1, at);
  }

  fd_sync() {
    return ERRNO.success;
  }

  fd_datasync() {
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} at @param {number} room @param {bigint} cookie @param {number} used */
  fd_readdir(fd, at, room, cookie, used) {
    const directory = this.open.get(fd)?.entry;
    if (!(directory instanceof MemoryDirectory)) return ERRNO.badf;
    let filled = 0;
    for (const [place, [name, entry]] of [...directory.entries].entries()) {
      if (place < cookie) continue;
      const text = encoder.encode(name);
      const record = new Uint8Array(24 + text.length);
      const view = new DataView(record.buffer);
      view.setBigUint64(0, BigInt(place + 1), true);
      view.setBigUint64(8, BigInt(entry.inode), true);
      view.setUint32(16, text.length, true);
      view.setUint8(20, typeOf(entry));
      record.set(text, 24);
      // An entry that is cut off fills the room, which tells that there are more.
      const part = record.subarray(0, room - filled);
      this.bytes(at + filled, part.length).set(part);
      filled += part.length;
      if (filled === room) break;
    }
    this.view.setUint32(used, filled, true);
    return ERRNO.success;
  }

  /**
   * The path that a call means.
   * @param {number} fd @param {number} at @param {number} length
   */
  path(fd, at, length) {
    return `${this.open.get(fd)?.path ?? ""}/${this.text(at, length)}`;
  }

  /**
   * @param {number} fd @param {number} _lookup @param {number} at @param {number} length
   * @param {number} how @param {bigint} _rights @param {bigint} _inheriting @param {number} flags
   * @param {number} result
   */
  path_open(fd, _lookup, at, length, how, _rights, _inheriting, flags, result) {
    const path = this.path(fd, at, length);
    let entry = this.tree.find(path);
    if (entry && how & CREATE && how & EXCLUSIVE) return ERRNO.exist;
    if (entry && how & DIRECTORY_ONLY && entry instanceof MemoryFile) return ERRNO.notdir;
    if (!entry) {
      const place = this.tree.place(path);
      if (!(how & CREATE) || !place) return ERRNO.noent;
      entry = new MemoryFile();
      place.directory.entries.set(place.name, entry);
    }
    if (how & TRUNCATE && entry instanceof MemoryFile) entry.resize(0);
    let free = ROOT + 1;
    while (this.open.has(free)) free++;
    this.open.set(free, { entry, path, offset: 0, append: (flags & APPEND) !== 0 });
    this.view.setUint32(result, free, true);
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} at @param {number} length */
  path_create_directory(fd, at, length) {
    const place = this.tree.place(this.path(fd, at, length));
    if (!place) return ERRNO.noent;
    if (place.directory.entries.has(place.name)) return ERRNO.exist;
    place.directory.entries.set(place.name, new MemoryDirectory());
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} _flags @param {number} at @param {number} length @param {number} result */
  path_filestat_get(fd, _flags, at, length, result) {
    const entry = this.tree.find(this.path(fd, at, length));
    return entry ? this.putStatus(entry, result) : ERRNO.noent;
  }

  path_filestat_set_times() {
    return ERRNO.success;
  }

  // There are no links: a program then takes another way, or says so.
  path_link() {
    return ERRNO.nosys;
  }

  path_symlink() {
    return ERRNO.nosys;
  }

  /** @param {number} fd @param {number} at @param {number} length */
  path_readlink(fd, at, length) {
    return this.tree.find(this.path(fd, at, length)) ? ERRNO.inval : ERRNO.noent;
  }

  /** @param {number} fd @param {number} at @param {number} length */
  path_remove_directory(fd, at, length) {
    const place = this.tree.place(this.path(fd, at, length));
    const entry = place?.directory.entries.get(place.name);
    if (!place || !entry) return ERRNO.noent;
    if (entry instanceof MemoryFile) return ERRNO.notdir;
    if (entry.entries.size > 0) return ERRNO.notempty;
    place.directory.entries.delete(place.name);
    return ERRNO.success;
  }

  /** @param {number} fd @param {number} at @param {number} length */
  path_unlink_file(fd, at, length) {
    const place = this.tree.place(this.path(fd, at, length));
    const entry = place?.directory.entries.get(place.name);
    if (!place || !entry) return ERRNO.noent;
    if (entry instanceof MemoryDirectory) return ERRNO.isdir;
    place.directory.entries.delete(place.name);
    return ERRNO.success;
  }

  /**
   * @param {number} fd @param {number} at @param {number} length
   * @param {number} toFd @param {number} toAt @param {number} toLength
   */
  path_rename(fd, at, length, toFd, toAt, toLength) {
    const from = this.tree.place(this.path(fd, at, length));
    const to = this.tree.place(this.path(toFd, toAt, toLength));
    const entry = from?.directory.entries.get(from.name);
    if (!from || !to || !entry) return ERRNO.noent;
    if (to.directory.entries.get(to.name) instanceof MemoryDirectory) return ERRNO.isdir;
    from.directory.entries.delete(from.name);
    to.directory.entries.set(to.name, entry);
    return ERRNO.success;
  }
}

const decoder = new TextDecoder();
const encoder = new TextEncoder();

/** @param {string} text */
function terminated(text) {
  return encoder.encode(`${text}\0`);
}

/** @param {MemoryFile | MemoryDirectory} entry */
function typeOf(entry) {
  return entry instanceof MemoryFile ? REGULAR_FILE : DIRECTORY;
}
