// Files and directories in memory.

/** A regular file. Its bytes are the first `size` of `room`, which grows by doubling. */
export class MemoryFile {
  /** @param {Uint8Array<ArrayBuffer>} bytes */
  constructor(bytes = new Uint8Array(0)) {
    this.room = bytes;
    this.size = bytes.length;
    this.inode = nextInode++;
  }

  /** The contents, without a copy: valid until the next write. */
  get bytes() {
    return this.room.subarray(0, this.size);
  }

  /**
   * Sets the size in bytes; new bytes are 0.
   * @param {number} size
   */
  resize(size) {
    if (size > this.room.length) {
      const room = new Uint8Array(Math.max(size, 2 * this.room.length, 4096));
      room.set(this.bytes);
      this.room = room;
    } else if (size < this.size) {
      this.room.fill(0, size, this.size);
    }
    this.size = size;
  }

  /**
   * Writes bytes at an offset, behind the end too.
   * @param {Uint8Array} bytes
   * @param {number} offset
   */
  write(bytes, offset) {
    this.resize(Math.max(this.size, offset + bytes.length));
    this.room.set(bytes, offset);
  }
}

/** A directory: its entries by name. */
export class MemoryDirectory {
  constructor() {
    /** @type {Map<string, MemoryFile | MemoryDirectory>} */
    this.entries = new Map();
    this.inode = nextInode++;
  }
}

let nextInode = 1;

/** A tree of files. Paths have no symbolic links; `.` and `..` are followed, never above the root. */
export class MemoryTree {
  constructor() {
    this.root = new MemoryDirectory();
  }

  /**
   * The names on a path.
   * @param {string} path
   */
  static names(path) {
    /** @type {string[]} */
    const names = [];
    for (const name of path.split("/")) {
      if (name === "..") names.pop();
      else if (name !== "" && name !== ".") names.push(name);
    }
    return names;
  }

  /**
   * Returns the entry at a path, if there is one.
   * @param {string} path
   */
  find(path) {
    /** @type {MemoryFile | MemoryDirectory | undefined} */
    let entry = this.root;
    for (const name of MemoryTree.names(path)) {
      if (!(entry instanceof MemoryDirectory)) return undefined;
      entry = entry.entries.get(name);
    }
    return entry;
  }

  /**
   * Returns the directory in which a path's last name stands, and that name; `undefined` if there
   * is no such directory.
   * @param {string} path
   */
  place(path) {
    const names = MemoryTree.names(path);
    const name = names.pop();
    const directory = this.find(names.join("/"));
    if (name === undefined || !(directory instanceof MemoryDirectory)) return undefined;
    return { directory, name };
  }

  /**
   * Puts a file at a path, and creates its directories.
   * @param {string} path
   * @param {Uint8Array<ArrayBuffer>} bytes
   */
  put(path, bytes) {
    const names = MemoryTree.names(path);
    const name = names.pop();
    if (name === undefined) throw new Error(`${path}: no name of a file`);
    let directory = this.root;
    for (const part of names) {
      let entry = directory.entries.get(part);
      if (!(entry instanceof MemoryDirectory)) {
        entry = new MemoryDirectory();
        directory.entries.set(part, entry);
      }
      directory = entry;
    }
    directory.entries.set(name, new MemoryFile(bytes));
  }

  /**
   * All files below a path, as [path, bytes], in the order in which they were created.
   * @param {string} path
   * @returns {[string, Uint8Array<ArrayBuffer>][]}
   */
  list(path = "") {
    const entry = this.find(path);
    if (entry instanceof MemoryFile) return [[path, entry.bytes]];
    if (!entry) return [];
    return [...entry.entries.keys()].flatMap((name) => this.list(path ? `${path}/${name}` : name));
  }
}
