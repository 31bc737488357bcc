// The scene's text, with line numbers. What is typed becomes part of the scene after a short pause, and a mistake is
// marked at its line; the picture stays as it was until the text is right again.
import {completions} from "./completion.js";
import {make, newId} from "./dom.js";

const pauseOfTyping = 500; // milliseconds

export class TextDrawer {
  #elements;
  #scene;
  #timer = null;
  #gesture = null;
  #isTyped = false;
  #proposed = null; // {typed, names}
  catalogue = null;

  // `elements` are those of the drawer: drawer, area, lines, problem, names.
  constructor(elements, scene) {
    this.#elements = elements;
    this.#scene = scene;
    const {area, lines} = elements;
    area.addEventListener("input", () => {
      this.#isTyped = true;
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
  async #send() {
    clearTimeout(this.#timer);
    const text = this.#elements.area.value;
    if (text === this.#scene.text) {
      this.#isTyped = false;
      return;
    }
    try {
      await this.#scene.perform({label: "Edit the text", operations: [{text}], merge: this.#gesture, strict: false});
      if (this.#elements.area.value === text) this.#isTyped = false;
    } catch (error) {
      this.#showProblem(error.place ?? {message: error.message});
    }
  }
  show() {
    const {area} = this.#elements;
    if (!this.isOpen) return;
    if (!this.#isTyped && area.value !== this.#scene.text) {
      const {selectionStart, scrollTop} = area;
      area.value = this.#scene.text;
      area.setSelectionRange(selectionStart, selectionStart);
      area.scrollTop = scrollTop;
    }
    this.#number();
    this.#showProblem(this.#scene.error);
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
    problem.textContent = error.line ? `Line ${error.line}: ${error.message}` : error.message;
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
