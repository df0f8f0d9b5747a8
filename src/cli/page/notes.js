// Notes on circuits: their texts, which are loaded when they are first asked for, and links between them.

/** Texts of the notes, by path. @typedef {Map<string, string>} Texts */

/** Folder of the notes, as the program takes it. */
export const NOTES_FOLDER = "rtl_notes";

export class Notes {
  /** @param {() => Promise<ArrayBuffer>} load JSON: an object with the text of each note by its path */
  constructor(load) {
    this.load = load;
    /** @type {Promise<Texts> | undefined} */
    this.loaded = undefined;
  }

  /** The texts. A load that failed is tried again. */
  texts() {
    this.loaded ??= this.load().then(
      (bytes) => new Map(Object.entries(JSON.parse(new TextDecoder().decode(bytes)))),
      (error) => {
        this.loaded = undefined;
        throw error;
      },
    );
    return this.loaded;
  }

  /**
   * The notes as files of a job.
   * @returns {Promise<[string, Uint8Array<ArrayBuffer>][]>}
   */
  async files() {
    const encoder = new TextEncoder();
    return [...(await this.texts())].map(([path, text]) => [path, encoder.encode(text)]);
  }
}

/**
 * Place in a note: its path, and a heading in it as links name it.
 * @typedef {{ path: string, heading?: string }} Place
 */

/**
 * The note on a circuit: the one with the table of its signals. Circuits that share a note have
 * headings in it.
 * @param {Texts} texts
 * @param {string} circuit
 * @returns {Place | undefined}
 */
export function noteOf(texts, circuit) {
  const mark = `- begin generated: signals ${circuit} -`;
  const notes = [...texts].filter(([, text]) => text.includes(mark));
  // An example may have that table too.
  const own = notes.find(([path]) => path.endsWith(`/${circuit}.md`));
  if (own || notes.length === 0) return own && { path: own[0] };
  const [path, text] = notes[0];
  const before = text.slice(0, text.indexOf(mark)).match(/^##+ .*$/gm)?.at(-1);
  return { path, heading: before && headingName(before.replace(/^#+ +/, "")) };
}

/**
 * The name of a heading in links, as GitHub makes it of its text.
 * @param {string} text
 */
export function headingName(text) {
  return text.toLowerCase().replace(/[^\p{L}\p{M}\p{N}\p{Pc}\- ]/gu, "").replaceAll(" ", "-");
}

/**
 * Where a link in a note leads: to a note, to another site, or to neither, as a file of the
 * repository.
 * @param {string} from path of the note
 * @param {string} target
 * @param {Texts} texts
 * @returns {Place | { address: string } | undefined}
 */
export function leadsTo(from, target, texts) {
  if (/^https?:/.test(target)) return { address: target };
  const [file, heading] = target.split("#");
  const path = file === "" ? from : joinedPath(from.replace(/[^/]*$/, "") + file);
  return texts.has(path) ? { path, heading } : undefined;
}

/**
 * A path without `.` and `..`.
 * @param {string} path
 */
function joinedPath(path) {
  /** @type {string[]} */
  const parts = [];
  for (const part of path.split("/")) {
    if (part === "..") parts.pop();
    else if (part !== "." && part !== "") parts.push(part);
  }
  return parts.join("/");
}
