import { element } from "./dom.js";

/**
 * The files of a run, each with a link that saves it.
 * @param {import("./worker.js").Result} result
 * @param {(() => void) | undefined} vcd runs again for the waves as VCD; none in a page without the program
 */
export function downloadsView(result, vcd) {
  const links = [...result.files].map(([path, bytes]) => downloadLink(path, bytes));
  links.push(downloadLink("summary.json", new TextEncoder().encode(result.out)));
  const again = vcd && element("button", { type: "button", onclick: vcd }, "VCD: run again");
  return element("details", {}, element("summary", {}, "Files of the run"), element("ul", {}, links.map((link) => element("li", {}, link))), again ?? "");
}

/**
 * A link that saves a file.
 * @param {string} path
 * @param {Uint8Array<ArrayBuffer>} bytes
 */
export function downloadLink(path, bytes) {
  const name = path.replace(/^.*\//, "");
  const href = URL.createObjectURL(new Blob([bytes]));
  return element("a", { href, download: name }, `${name} (${bytes.length.toLocaleString("en")} bytes)`);
}
