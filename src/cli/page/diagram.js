// Block diagram of a circuit: its parts as boxes, and which feeds which.

/** @typedef {{ name: string, width: number, signed: boolean, about?: string, driver?: string }} Port */
/** @typedef {{ name: string, circuit: string, source: string, inputs: Port[], outputs: Port[] }} Part */

/**
 * A circuit as `list NAME --json` has it.
 * @typedef {object} Circuit
 * @property {string} name
 * @property {string} about
 * @property {string} source
 * @property {Record<string, { full: string | null, small: string | null }>} keys
 * @property {Port[]} inputs
 * @property {Port[]} outputs
 * @property {{ parts: Part[], outputs: Port[], nets: Port[], registers: Port[] }} connections
 * @property {string[]} [properties] properties that `check` proves; of a circuit that is listed alone
 */

/** Where a box stands: column and row, from 0. @typedef {{ name: string, column: number, row: number }} Placed */

/** Sizes in pixels. */
const BOX = { width: 132, height: 60, across: 58, down: 22, margin: 16 };

/**
 * The parts that feed each part, through nets and registers of the circuit too; `""` stands for the
 * circuit's own ports in.
 * @param {Circuit} circuit
 * @returns {Map<string, Set<string>>}
 */
export function feeders({ connections: { parts, nets, registers, outputs }, inputs }) {
  const own = new Map([...nets, ...registers].map((signal) => [signal.name, signal.driver ?? ""]));
  const names = new Set(parts.map((part) => part.name));
  const ports = new Set(inputs.map((port) => port.name));
  /**
   * @param {string} driver
   * @param {Set<string>} from
   * @param {Set<string>} seen
   */
  const follow = (driver, from, seen) => {
    for (const [word] of driver.matchAll(/[A-Za-z_]\w*(\.\w+)*/g)) {
      const head = word.split(".")[0];
      const net = own.get(word);
      if (names.has(head) && word !== head) from.add(head);
      else if (net !== undefined && !seen.has(word)) follow(net, from, seen.add(word));
      else if (ports.has(word) || ports.has(head)) from.add("");
    }
    return from;
  };
  const of = (/** @type {Port[]} */ driven) => {
    /** @type {Set<string>} */
    const from = new Set();
    for (const { driver } of driven) follow(driver ?? "", from, new Set());
    return from;
  };
  return new Map([...parts.map((part) => /** @type {const} */ ([part.name, of(part.inputs)])), [PORTS_OUT, of(outputs)]]);
}

/** Name of the box of the ports out, which no part has. */
export const PORTS_OUT = "\0out";

/**
 * Places boxes in columns, each right of those that feed it; a feedback goes back.
 * @param {Map<string, Set<string>>} fed
 * @returns {Placed[]}
 */
export function placed(fed) {
  /** @type {Map<string, number>} */
  const columns = new Map([["", 0]]);
  const column = (/** @type {string} */ name, /** @type {Set<string>} */ path) => {
    const known = columns.get(name);
    if (known !== undefined) return known;
    const before = [...(fed.get(name) ?? [])].filter((from) => !path.has(from) && from !== name);
    const within = new Set([...path, name]);
    /** @type {number} */
    const found = 1 + Math.max(0, ...before.map((from) => column(from, within)));
    columns.set(name, found);
    return found;
  };
  for (const name of fed.keys()) if (name !== PORTS_OUT) column(name, new Set());
  columns.set(PORTS_OUT, 1 + Math.max(...columns.values()));
  /** @type {Map<number, number>} */
  const rows = new Map();
  return [...columns].map(([name, at]) => {
    const row = rows.get(at) ?? 0;
    rows.set(at, row + 1);
    return { name, column: at, row };
  });
}

/**
 * Draws a circuit.
 * @param {Circuit} circuit
 * @param {(part: Part) => void} enter called where the reader chooses a part
 */
export function diagram(circuit, enter) {
  const fed = feeders(circuit);
  const boxes = placed(fed);
  const place = new Map(boxes.map((box) => [box.name, box]));
  const columns = 1 + Math.max(...boxes.map((box) => box.column));
  const rows = 1 + Math.max(...boxes.map((box) => box.row));
  const x = (/** @type {number} */ column) => BOX.margin + column * (BOX.width + BOX.across);
  const y = (/** @type {number} */ row) => BOX.margin + row * (BOX.height + BOX.down);
  const size = [x(columns) - BOX.across + BOX.margin, y(rows) - BOX.down + BOX.margin + BOX.height / 2];
  const picture = drawn("svg", {
    viewBox: `0 0 ${size.join(" ")}`,
    width: size[0],
    height: size[1],
    role: "group",
    "aria-label": `Block diagram of ${circuit.name}`,
    class: "diagram",
  });
  picture.append(arrowHead());
  for (const [name, from] of fed) {
    for (const source of from) {
      const [start, end] = [place.get(source), place.get(name)];
      if (start && end) picture.append(wire(x(start.column), y(start.row), x(end.column), y(end.row)));
    }
  }
  for (const box of boxes) {
    const part = circuit.connections.parts.find((one) => one.name === box.name);
    const lines = part ? [part.name, part.circuit, numerals(part.source, circuit.source)] : [box.name === PORTS_OUT ? "ports out" : "ports in"];
    picture.append(boxOf(lines, part, x(box.column), y(box.row), enter));
  }
  return picture;
}

/**
 * The figure numerals of a part: its source, without the patent if that is the circuit's too.
 * @param {string} source
 * @param {string} around source of the circuit around it
 */
export function numerals(source, around) {
  const patent = /^[A-Z]{2}\w+/.exec(around)?.[0];
  const rest = patent !== undefined && source.startsWith(patent) ? source.slice(patent.length) : "";
  return rest.replace(/^,? /, "") || source;
}

/** Most characters of a line in a box. */
const LINE = 19;

/**
 * @param {string[]} lines texts in the box, one or three
 * @param {Part | undefined} part
 * @param {number} x
 * @param {number} y
 * @param {(part: Part) => void} enter
 */
function boxOf(lines, part, x, y, enter) {
  const group = drawn("g", { transform: `translate(${x} ${y})`, class: part ? "part" : "ports" });
  group.append(drawn("rect", { width: BOX.width, height: BOX.height, rx: 4 }));
  for (const [row, line] of lines.entries()) {
    const text = drawn("text", { x: BOX.width / 2, y: BOX.height / 2 + 4 + 16 * (row - (lines.length - 1) / 2), class: `line-${row}` });
    text.textContent = line.length > LINE ? `${line.slice(0, LINE - 1)}…` : line;
    group.append(text);
  }
  if (part) {
    const title = drawn("title", {});
    title.textContent = `${part.name}: ${part.circuit}, ${part.source}`;
    group.append(title);
    group.setAttribute("tabindex", "0");
    group.setAttribute("role", "button");
    group.setAttribute("aria-label", `Show part ${part.name}, ${part.circuit}, ${part.source}`);
    group.addEventListener("click", () => enter(part));
    group.addEventListener("keydown", (event) => {
      if (/** @type {KeyboardEvent} */ (event).key === "Enter") enter(part);
    });
  }
  return group;
}

/**
 * A wire from the right of one box to the left of another; back, it goes below the boxes.
 * @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1
 */
function wire(x0, y0, x1, y1) {
  const [startX, startY, endX, endY] = [x0 + BOX.width, y0 + BOX.height / 2, x1, y1 + BOX.height / 2];
  const bend = BOX.across / 2;
  const path =
    endX > startX
      ? `M${startX} ${startY}C${startX + bend} ${startY} ${endX - bend} ${endY} ${endX} ${endY}`
      : `M${startX} ${startY}C${startX + bend} ${startY + BOX.height} ${endX - bend} ${endY + BOX.height} ${endX} ${endY}`;
  return drawn("path", { d: path, class: endX > startX ? "wire" : "wire back", "marker-end": "url(#arrow)" });
}

function arrowHead() {
  const marker = drawn("marker", { id: "arrow", viewBox: "0 0 8 8", refX: 8, refY: 4, markerWidth: 7, markerHeight: 7, orient: "auto" });
  marker.append(drawn("path", { d: "M0 0L8 4L0 8z" }));
  const definitions = drawn("defs", {});
  definitions.append(marker);
  return definitions;
}

/**
 * @param {string} tag
 * @param {Record<string, string | number>} attributes
 */
function drawn(tag, attributes) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
  return node;
}
