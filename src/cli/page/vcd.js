import { ChangeColumn, UNKNOWN_X, UNKNOWN_Z } from "./column.js";
import { Dump, DumpError } from "./dump.js";

/** @typedef {import("./dump.js").DumpSignal} DumpSignal */
/** @typedef {import("./column.js").Changes} Changes */

/** Units of a VCD as powers of ten of a second. */
const VCD_UNITS = { s: 0, ms: -3, us: -6, ns: -9, ps: -12, fs: -15 };
/** Ending of the name of a text that shows a state by name, beside the state itself. */
const VCD_NAMES = "_name";

/**
 * Variable of a dump, which may have several names.
 * @typedef {{id: number, kind: DumpSignal["kind"], column: ChangeColumn}} VcdVariable
 */

/**
 * Reads a value change dump. A text `x_name` beside a word `x` gives its values their names.
 * Words with some unknown bits are unknown as a whole.
 * @param {Uint8Array} bytes
 * @returns {Dump}
 * @throws {DumpError} if it is no dump, or a line cannot be read
 */
export function readVcd(bytes) {
  const header = new VcdHeader(new VcdWords(bytes, 0));
  const body = new VcdBody(bytes, header.words.at, header.variables);
  /** @type {Map<number, Changes>} */
  const changes = new Map();
  for (const { id, column } of header.variables.values()) changes.set(id, column.finish());
  const columns = new Map([...header.variables.values()].map((each) => [each.id, each.column]));
  const byPath = new Map(header.signals.map((signal) => [signal.path, signal]));
  for (const signal of header.signals) {
    if (signal.kind !== "text") continue;
    signal.table = columns.get(signal.id)?.table ?? null;
    const state = signal.name.endsWith(VCD_NAMES)
      ? byPath.get(signal.path.slice(0, -VCD_NAMES.length))
      : undefined;
    const own = changes.get(signal.id);
    const codes = state && changes.get(state.id);
    if (state && own && codes && signal.table) state.table = vcdStates(codes, own, signal.table);
  }
  return new Dump({
    signals: header.signals,
    start: body.start,
    end: body.end,
    unit: header.unit,
    comments: header.comments,
    load: (signal) => changes.get(signal.id) ?? new ChangeColumn(signal.width).finish(),
  });
}

/**
 * Returns the names of the codes that occur, if both change at the same times.
 * @param {Changes} codes
 * @param {Changes} names
 * @param {Map<number, string>} texts
 */
function vcdStates(codes, names, texts) {
  if (codes.times.length !== names.times.length) return null;
  const states = new Map();
  for (let i = 0; i < codes.times.length; i++) {
    if (!codes.unknown?.[i]) states.set(Number(codes.values[i]), texts.get(Number(names.values[i])));
  }
  return states;
}

/** Words of a dump, separated by white space. */
class VcdWords {
  #bytes;
  #decoder = new TextDecoder();

  /**
   * @param {Uint8Array} bytes
   * @param {number} at
   */
  constructor(bytes, at) {
    this.#bytes = bytes;
    this.at = at;
  }

  /** Returns the next word; "" at the end. */
  next() {
    const bytes = this.#bytes;
    while (this.at < bytes.length && bytes[this.at] <= 32) this.at++;
    const from = this.at;
    while (this.at < bytes.length && bytes[this.at] > 32) this.at++;
    return this.#decoder.decode(bytes.subarray(from, this.at));
  }

  /** Returns the words up to `$end`. */
  upToEnd() {
    const words = [];
    for (let word = this.next(); word !== "$end"; word = this.next()) {
      if (word === "") throw new DumpError("The header of the VCD file has no end.");
      words.push(word);
    }
    return words;
  }
}

/** Declarations at the head of a dump. */
class VcdHeader {
  unit = 1e-9;
  /** @type {string[]} */
  comments = [];
  /** @type {DumpSignal[]} */
  signals = [];
  /** @type {Map<number | string, VcdVariable>} */
  variables = new Map();
  /** @type {string[]} */
  #scope = [];

  /** @param {VcdWords} words */
  constructor(words) {
    this.words = words;
    for (;;) {
      const word = words.next();
      if (!word.startsWith("$")) throw new DumpError("This is no VCD file.");
      const rest = words.upToEnd();
      if (word === "$enddefinitions") break;
      this.#entry(word, rest);
    }
    this.#ports();
  }

  /**
   * @param {string} word
   * @param {string[]} rest
   */
  #entry(word, rest) {
    if (word === "$comment") this.comments.push(rest.join(" "));
    else if (word === "$scope") this.#scope = [...this.#scope, rest[1] ?? ""];
    else if (word === "$upscope") this.#scope = this.#scope.slice(0, -1);
    else if (word === "$timescale") this.unit = vcdUnit(rest.join(""));
    else if (word === "$var") this.#variable(rest);
  }

  /** @param {string[]} rest kind, width, code, name, range */
  #variable([kindName, size, code, name, ...range]) {
    const isReal = kindName.startsWith("real");
    const kind = isReal ? "real" : kindName === "string" ? "text" : "bits";
    const width = kind === "bits" ? Number(size) : 0;
    if (name === undefined || !Number.isInteger(width)) {
      throw new DumpError(`The VCD file declares a signal that cannot be read: ${code ?? ""}.`);
    }
    const key = codeKey(code);
    let variable = this.variables.get(key);
    if (!variable) {
      variable = { id: this.variables.size, kind, column: new ChangeColumn(width) };
      this.variables.set(key, variable);
    }
    // An element of a vector has its index behind it, and the index tells it from the others.
    const element = range.join("");
    const own = width === 1 && element !== "" ? name + element : name.replace(/\[\d+:\d+\]$/, "");
    /** @type {DumpSignal["role"]} */
    const role = kindName === "reg" ? "register" : "net";
    const path = [...this.#scope, own].join(".");
    const { id } = variable;
    this.signals.push({ path, scope: this.#scope, name: own, width, kind, role, table: null, id });
  }

  /** Reads the list of output ports. */
  #ports() {
    const list = this.comments.find((comment) => comment.startsWith("ports out: "));
    if (!list) return;
    const ports = new Set(list.slice("ports out: ".length).split(" "));
    for (const signal of this.signals) if (ports.has(signal.path)) signal.role = "output";
  }
}

/**
 * Returns the unit of time in seconds.
 * @param {string} text such as `10ns`
 */
function vcdUnit(text) {
  const [, factor, name] = /^(1|10|100)(s|ms|us|ns|ps|fs)$/.exec(text) ?? [];
  if (!name) throw new DumpError(`The time unit ${text} of the VCD file cannot be read.`);
  const exponent = VCD_UNITS[/** @type {keyof VCD_UNITS} */ (name)] + factor.length - 1;
  // A product is not the nearest number.
  return Number(`1e${exponent}`);
}

/**
 * Returns the key of a variable: a number for the short codes that all programs write.
 * @param {string} code
 */
function codeKey(code) {
  if (code.length > 7) return code;
  let key = 0;
  for (let i = code.length - 1; i >= 0; i--) key = key * 94 + code.charCodeAt(i) - 32;
  return key;
}

/** Reader of the changes, which fills the columns of the variables. */
class VcdBody {
  /** @type {number | undefined} */
  #start;
  end = 0;
  #bytes;
  #at;
  #variables;

  /**
   * @param {Uint8Array} bytes
   * @param {number} at
   * @param {Map<number | string, VcdVariable>} variables
   */
  constructor(bytes, at, variables) {
    this.#bytes = bytes;
    this.#at = at;
    this.#variables = variables;
    this.#read();
  }

  get start() {
    return this.#start ?? 0;
  }

  #read() {
    const bytes = this.#bytes;
    for (;;) {
      while (this.#at < bytes.length && bytes[this.#at] <= 32) this.#at++;
      if (this.#at >= bytes.length) return;
      const from = this.#at++;
      const first = bytes[from];
      switch (first) {
        case 0x23: // #
          this.#time(from);
          break;
        case 0x24: // $
          this.#section(this.#word(from));
          break;
        case 0x42: // B
        case 0x62: // b
          this.#rest();
          this.#vector(from + 1, this.#at);
          break;
        case 0x52: // R
        case 0x72: // r
        case 0x53: // S
        case 0x73: // s
          this.#text(this.#word(from).slice(1));
          break;
        default:
          this.#scalar(first);
      }
    }
  }

  /** Moves to the end of the word. */
  #rest() {
    const bytes = this.#bytes;
    while (this.#at < bytes.length && bytes[this.#at] > 32) this.#at++;
  }

  /** @param {number} from */
  #word(from) {
    this.#rest();
    return new TextDecoder().decode(this.#bytes.subarray(from, this.#at));
  }

  /** @param {number} from */
  #time(from) {
    const bytes = this.#bytes;
    let time = 0;
    for (; this.#at < bytes.length && bytes[this.#at] > 32; this.#at++) {
      time = time * 10 + bytes[this.#at] - 48;
    }
    if (!(time >= this.end)) {
      throw new DumpError(`The VCD file has a wrong time: ${this.#word(from)}.`);
    }
    this.#start ??= time;
    this.end = time;
  }

  /** @param {string} word */
  #section(word) {
    if (word !== "$comment") return;
    const words = new VcdWords(this.#bytes, this.#at);
    words.upToEnd();
    this.#at = words.at;
  }

  /** Reads a code and returns its variable. */
  #variable() {
    const bytes = this.#bytes;
    while (this.#at < bytes.length && bytes[this.#at] <= 32) this.#at++;
    const from = this.#at;
    let key = 0;
    let factor = 1;
    for (; this.#at < bytes.length && bytes[this.#at] > 32; this.#at++) {
      key += (bytes[this.#at] - 32) * factor;
      factor *= 94;
    }
    const isLong = this.#at - from > 7;
    const variable = this.#variables.get(isLong ? this.#word(from) : key);
    // Values before the first time are initial ones.
    this.#start ??= 0;
    if (!variable) {
      const code = new TextDecoder().decode(bytes.subarray(from, this.#at));
      throw new DumpError(`The VCD file changes a signal that it does not declare: ${code}.`);
    }
    return variable;
  }

  /** @param {number} digit */
  #scalar(digit) {
    const { column } = this.#variable();
    if (digit === 0x30 || digit === 0x31) {
      if (column.isWord || column.isWide) column.pushDigits(this.end, [digit], 0, 1);
      else column.push(this.end, digit - 0x30);
    } else {
      column.pushUnknown(this.end, (digit | 32) === 0x7a ? UNKNOWN_Z : UNKNOWN_X);
    }
  }

  /**
   * @param {number} from
   * @param {number} to
   */
  #vector(from, to) {
    this.#variable().column.pushDigits(this.end, this.#bytes, from, to);
  }

  /** @param {string} text real number or name */
  #text(text) {
    const { kind, column } = this.#variable();
    if (kind === "real") column.push(this.end, Number(text));
    else column.pushText(this.end, text);
  }
}
