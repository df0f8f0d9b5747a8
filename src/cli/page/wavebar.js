import { element } from "./dom.js";
import { WAVE_KEYS } from "./wavekeys.js";

/** @typedef {import("./wavekeys.js").WaveActions} WaveActions */

/**
 * Returns the buttons of the waves.
 * @param {WaveActions} actions
 * @param {HTMLElement} side tree of signals, which a button hides
 * @param {HTMLElement} readout
 */
export function waveBar(actions, side, readout) {
  /**
   * @param {string} text
   * @param {string} title
   * @param {() => void} onclick
   */
  const button = (text, title, onclick) =>
    element("button", { type: "button", title, "aria-label": title, onclick }, text);
  const signals = button("Signals", "Show or hide the tree of signals", () => {
    const isHidden = side.classList.toggle("waves-hidden");
    signals.setAttribute("aria-expanded", String(!isHidden));
  });
  signals.setAttribute("aria-expanded", "true");
  const keys = WAVE_KEYS.map(([key, text]) => [element("dt", {}, key), element("dd", {}, text)]);
  return element(
    "div",
    { class: "waves-bar", role: "toolbar", "aria-label": "Waves" },
    signals,
    button("Fit", "Fit: show all (F)", actions.fit),
    button("+", "Zoom in (+)", () => actions.zoom(1 / 2)),
    button("−", "Zoom out (−)", () => actions.zoom(2)),
    button("Between", "Between marker and cursor: zoom to these times (Z)", actions.zoomToSelection),
    button("◂ Edge", "Edge before the cursor, of the selected row (P)", () => actions.edge(-1)),
    button("Edge ▸", "Edge after the cursor, of the selected row (N)", () => actions.edge(1)),
    button("Marker", "Marker at the cursor (M)", actions.mark),
    button("Format", "Format of the selected row (Enter)", actions.open),
    button("Remove", "Remove the selected row (Delete)", actions.remove),
    readout,
    element(
      "details",
      { class: "waves-keys" },
      element("summary", {}, "Keys"),
      element("dl", {}, keys.flat()),
    ),
  );
}
