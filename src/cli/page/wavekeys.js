/**
 * What the keys of the waves do. Steps are to the right, or down, if they are positive.
 * @typedef {object} WaveActions
 * @property {(ticks: number) => void} step moves the cursor
 * @property {(direction: 1 | -1) => void} edge moves the cursor to an edge of the selected row
 * @property {(part: number) => void} pan moves the window by a part of its width
 * @property {(factor: number) => void} zoom
 * @property {() => void} fit
 * @property {() => void} zoomToSelection
 * @property {() => void} mark
 * @property {(end: 1 | -1) => void} goToEnd
 * @property {(rows: 1 | -1) => void} select
 * @property {(rows: 1 | -1) => void} shift
 * @property {() => void} remove
 * @property {() => void} open
 * @property {(radix: import("./valueformat.js").ValueFormat["radix"]) => void} radix
 * @property {() => void} curve
 * @property {(rows: 1 | -1) => void} grow
 * @property {() => void} search
 */

/** Keys and movements of the mouse, and what they do, for the reader. */
export const WAVE_KEYS = [
  ["← →", "Cursor by a tick; with Ctrl to the edge of the selected row, with Shift the window"],
  ["N, P", "Next and previous edge of the selected row"],
  ["Home, End", "Cursor to the first and last tick"],
  ["+, −", "Zoom in and out at the cursor"],
  ["F", "Fit"],
  ["M", "Marker at the cursor"],
  ["Z", "Zoom to the times between marker and cursor"],
  ["↑ ↓", "Select a row; with Alt move it"],
  ["Enter", "Format of the row, or open and close the group"],
  ["B, X, U, S, T", "Binary, hexadecimal, unsigned, signed, name of the state"],
  ["A", "Curve: none, steps, lines"],
  ["[, ]", "Lower and higher row"],
  ["Delete", "Remove the row"],
  ["/", "Search signals"],
  ["Click", "Cursor; with Shift the marker"],
  ["Wheel", "Zoom at the pointer; with Shift move the window, as dragging does"],
  ["Ctrl drag", "Zoom to the times between"],
];

/**
 * Acts on a key.
 * @param {KeyboardEvent} event
 * @param {WaveActions} actions
 * @returns {boolean} false if the key is none of the waves
 */
export function waveKey(event, actions) {
  const { key } = event;
  const isRight = key === "ArrowRight";
  if (isRight || key === "ArrowLeft") {
    const direction = isRight ? 1 : -1;
    if (event.ctrlKey || event.metaKey) actions.edge(direction);
    else if (event.shiftKey) actions.pan(direction / 8);
    else actions.step(direction);
    return true;
  }
  if (key === "ArrowUp" || key === "ArrowDown") {
    const direction = key === "ArrowDown" ? 1 : -1;
    if (event.altKey) actions.shift(direction);
    else actions.select(direction);
    return true;
  }
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  /** @type {Record<string, () => void>} */
  const plain = {
    n: () => actions.edge(1),
    p: () => actions.edge(-1),
    home: () => actions.goToEnd(-1),
    end: () => actions.goToEnd(1),
    "+": () => actions.zoom(1 / 2),
    "=": () => actions.zoom(1 / 2),
    "-": () => actions.zoom(2),
    f: actions.fit,
    m: actions.mark,
    z: actions.zoomToSelection,
    enter: actions.open,
    b: () => actions.radix("binary"),
    x: () => actions.radix("hex"),
    u: () => actions.radix("unsigned"),
    s: () => actions.radix("signed"),
    t: () => actions.radix("state"),
    a: actions.curve,
    "[": () => actions.grow(-1),
    "]": () => actions.grow(1),
    delete: actions.remove,
    "/": actions.search,
  };
  const action = plain[key.toLowerCase()];
  action?.();
  return action !== undefined;
}
