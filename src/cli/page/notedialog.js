// A note in a dialog, over the page. Links between notes open there; Escape closes it.
import { clear, element } from "./dom.js";
import { blocksOf } from "./markdown.js";
import { leadsTo, noteOf } from "./notes.js";
import { HEADING_ID, noteView } from "./noteview.js";

/** @typedef {import("./notes.js").Place} Place */
/** @typedef {import("./notes.js").Texts} Texts */

export class NoteDialog {
  /** @param {import("./notes.js").Notes} notes */
  constructor(notes) {
    this.notes = notes;
    /** Notes that were followed, with the place of the view; the last one is shown. @type {(Place & { top?: number })[]} */
    this.trail = [];
    this.back = element("button", { type: "button", onclick: () => void this.goBack() }, "Back");
    this.path = element("span", { class: "faint note-path" });
    // The region has the focus, so that arrow keys move the text.
    this.text = element("div", { class: "note-text", tabindex: 0, autofocus: true, role: "region", "aria-label": "Note" });
    const close = element("button", { type: "button", onclick: () => this.dialog.close() }, "Close");
    this.dialog = element("dialog", { class: "note", "aria-label": "Note" }, element("div", { class: "note-bar" }, this.back, this.path, close), this.text);
    document.body.append(this.dialog);
  }

  /**
   * Opens the note on a circuit.
   * @param {string} circuit
   */
  async open(circuit) {
    this.say("Loading the notes …");
    if (!this.dialog.open) this.dialog.showModal();
    try {
      const texts = await this.notes.texts();
      const place = noteOf(texts, circuit);
      this.trail = [];
      if (place) this.follow(place, texts);
      else this.say(`There is no note on ${circuit}.`);
    } catch (error) {
      this.say(String(error));
    }
  }

  /**
   * Goes to a place, of which *Back* comes back.
   * @param {Place} place
   * @param {Texts} texts
   */
  follow(place, texts) {
    const last = this.trail.at(-1);
    if (last) last.top = this.text.scrollTop;
    this.trail.push({ ...place });
    this.show(texts);
  }

  async goBack() {
    this.trail.pop();
    this.show(await this.notes.texts());
  }

  /** @param {string} text */
  say(text) {
    this.back.hidden = true;
    this.path.textContent = "";
    clear(this.text).append(element("p", {}, text));
  }

  /**
   * Shows the last note of the trail.
   * @param {Texts} texts
   */
  show(texts) {
    const place = this.trail.at(-1);
    if (!place) return;
    const { path, heading, top } = place;
    const view = noteView(blocksOf(texts.get(path) ?? ""), (target, children) => this.link(path, target, children, texts));
    clear(this.text).append(...view);
    this.back.hidden = this.trail.length < 2;
    this.path.textContent = path;
    const at = heading && document.getElementById(HEADING_ID + heading);
    this.text.scrollTop = top ?? 0;
    this.text.focus();
    if (at && top === undefined) at.scrollIntoView();
  }

  /**
   * @param {string} from path of the note
   * @param {string} target
   * @param {(Node | string)[]} children
   * @param {Texts} texts
   */
  link(from, target, children, texts) {
    const to = leadsTo(from, target, texts);
    if (!to) return undefined;
    if ("address" in to) return element("a", { href: to.address, target: "_blank", rel: "noopener" }, children);
    const follow = (/** @type {Event} */ event) => {
      event.preventDefault();
      this.follow(to, texts);
    };
    return element("a", { href: "#", onclick: follow }, children);
  }
}
