// The scene's text, with line numbers. What is typed becomes part of the scene after a short pause, and a mistake is
// marked at its line; the picture stays as it was until the text is right again.
import {completions} from "./completion.js";
import {make, newId, refill} from "./dom.js";
import {merged} from "./merge.js";

const pauseOfTyping = 500; // milliseconds

export class TextDrawer {
  #elements;
  #scene;
  #timer = null;
  #gesture = null;
  #isTyped = false;
  #base = null;     // {text, version} of the scene to which the typed text belongs
  #sent = null;     // the text that is on its way
  #isRefused = false; // whether what is typed cannot be merged with what has changed elsewhere
  #proposed = null; // {typed, names}
  catalogue = null;

  // `elements` are those of the drawer: drawer, area, lines, problem, names.
  constructor(elements, scene) {
    this.#elements = elements;
    this.#scene = scene;
    const {area, lines} = elements;
    area.addEventListener("input", () => {
      this.#begin();
      this.#gesture ??= newId("text");
      this.#number();
      this.#propose();
      clearTimeout(this.#timer);
      this.#timer = setTimeout(() => this.#send(), pauseOfTyping);
    });
    area.addEventListener("blur", () => {
      if (this.#isTyped) this.#send();
      this.#gesture = null;
      this.#propose(false);
    });
    area.addEventListener("scroll", () => { lines.scrollTop = area.scrollTop; });
    area.addEventListener("keydown", (event) => {
      if (event.key === "Tab" && !event.shiftKey) {
        event.preventDefault();
        if (this.#proposed?.names.length > 0) return this.#complete(this.#proposed.names[0]);
        area.setRangeText("  ", area.selectionStart, area.selectionEnd, "end");
        area.dispatchEvent(new Event("input"));
      }
      if (event.key === "Escape" && this.#proposed?.names.length > 0) this.#propose(false);
      else if (event.key === "Escape") this.toggle(false);
    });
  }
  get isOpen() {
    return !this.#elements.drawer.hidden;
  }
  toggle(open = !this.isOpen) {
    this.#elements.drawer.hidden = !open;
    if (open) {
      this.show();
      this.#elements.area.focus();
    }
    return open;
  }
  // Shows the names that may be meant; Tab takes the first.
  #propose(isOn = true) {
    const {area, names} = this.#elements;
    this.#proposed = isOn && this.catalogue ? completions(area.value, area.selectionStart, this.catalogue) : null;
    const found = this.#proposed?.names ?? [];
    names.hidden = found.length === 0;
    names.replaceChildren(...found.map((name, i) => make("button", {
      type: "button", class: "chip", tabIndex: -1, onpointerdown: (event) => {
        event.preventDefault();
        this.#complete(name);
      },
    }, name, i === 0 ? make("kbd", {}, "Tab") : null)));
  }
  #complete(name) {
    const {area} = this.#elements, at = area.selectionStart;
    const hasEnd = area.value[at] === '"';
    area.setRangeText(`${name}"`, at - this.#proposed.typed.length, hasEnd ? at + 1 : at, "end");
    area.dispatchEvent(new Event("input"));
  }
  // From now on, the text is a person's, and no longer replaced by the scene's.
  #begin() {
    if (!this.#isTyped) this.#base = {text: this.#shown ?? this.#scene.text, version: this.#scene.version};
    this.#isTyped = true;
  }
  #shown = null; // the last text of the scene that was shown
  #end() {
    this.#isTyped = this.#isRefused = false;
    this.#base = null;
  }
  async #send() {
    clearTimeout(this.#timer);
    const text = this.#elements.area.value;
    if (text === this.#scene.text) this.#end();
    if (!this.#isTyped || this.#isRefused || this.#sent !== null) return;
    this.#sent = text;
    let isOutdated = false;
    try {
      const version = await this.#scene.perform({label: "Edit the text", operations: [{text}], base: this.#base.version, merge: this.#gesture, strict: false});
      this.#base = {text, version};
      this.#isRefused = false;
      if (this.#elements.area.value === text) this.#end();
    } catch (error) {
      isOutdated = error.isOutdated;
      if (!isOutdated) {
        this.#sent = null;
        return this.#showProblem(error.place ?? {message: error.message});
      }
    }
    this.#sent = null;
    this.show(); // merges what has changed elsewhere meanwhile
    if (this.#isTyped && (isOutdated || this.#elements.area.value !== text)) this.#timer = setTimeout(() => this.#send(), pauseOfTyping);
  }
  show() {
    if (!this.isOpen) return;
    const {text, version} = this.#scene;
    if (!this.#isTyped) this.#put(text, (at) => at);
    else if (text !== this.#base.text && text !== this.#sent) this.#merge(text, version);
    this.#shown = text;
    this.#number();
    if (this.#isRefused) this.#showConflict();
    else this.#showProblem(this.#scene.error);
  }
  // Keeps the caret, which `moved` maps from the old text to the new one.
  #put(text, moved) {
    const {area} = this.#elements, {selectionStart, selectionEnd, scrollTop} = area;
    if (area.value === text) return;
    area.value = text;
    area.setSelectionRange(moved(selectionStart), moved(selectionEnd));
    area.scrollTop = scrollTop;
  }
  // The scene has changed elsewhere, while a text is typed here.
  #merge(text, version) {
    const both = merged(this.#base.text, this.#elements.area.value, text);
    this.#isRefused = both === null;
    if (!both) return;
    this.#put(both.text, both.move);
    this.#base = {text, version};
  }
  #showConflict() {
    const {problem} = this.#elements, choose = (text, act) => make("button", {type: "button", onclick: act}, text);
    problem.hidden = false;
    refill(problem, "conflict", () => ["The same lines have been changed elsewhere. ", choose("Keep my text", () => {
      this.#base = {text: this.#scene.text, version: this.#scene.version};
      this.#isRefused = false;
      this.#send();
    }), " ", choose("Take the other text", () => {
      this.#end();
      this.show();
    })]);
  }
  #number() {
    const {area, lines} = this.#elements, count = area.value.split("\n").length;
    if (lines.childElementCount !== count) lines.replaceChildren(...Array.from({length: count}, (_, i) => make("span", {}, String(i + 1))));
    lines.scrollTop = area.scrollTop;
  }
  #showProblem(error) {
    const {problem, lines} = this.#elements;
    for (const line of lines.querySelectorAll(".wrong")) line.classList.remove("wrong");
    problem.hidden = !error;
    if (!error) return;
    const text = error.line ? `Line ${error.line}: ${error.message}` : error.message;
    refill(problem, text, () => [text]);
    lines.children[error.line - 1]?.classList.add("wrong");
  }
  // Scrolls to a line of the text.
  reveal(line) {
    const {area} = this.#elements;
    if (!this.isOpen || document.activeElement === area || !line) return;
    const height = area.scrollHeight / Math.max(1, area.value.split("\n").length);
    area.scrollTop = Math.max(0, (line - 3) * height);
    for (const span of this.#elements.lines.children) span.classList.remove("here");
    this.#elements.lines.children[line - 1]?.classList.add("here");
  }
}
