// A number that is dragged, typed or stepped by the arrow keys. Shift is finer, Ctrl is coarser. Values of one gesture
// carry the same name, so that they become one step of undo.
import {make, newId} from "./dom.js";
import {onEscape} from "./press.js";

const pixelsToStart = 3;
const pauseOfKeys = 900; // milliseconds between key presses of one gesture

const precise = (x) => Number(x.toPrecision(6));

// The value of sums and products of numbers, such as 1/3 or 2*0.4; NaN if the text is not an arithmetic expression.
export function calculated(text) {
  const tokens = text.replaceAll(",", ".").match(/\d*\.?\d+(?:e[-+]?\d+)?|[-+*/()]|\S/gi) ?? [];
  let at = 0;
  const atom = () => {
    const token = tokens[at++];
    if (token === "-") return -atom();
    if (token === "(") {
      const value = sum();
      return tokens[at++] === ")" ? value : NaN;
    }
    return /^[\d.]/.test(token ?? "") ? Number(token) : NaN;
  };
  const product = () => {
    let value = atom();
    while (tokens[at] === "*" || tokens[at] === "/") value = tokens[at++] === "*" ? value * atom() : value / atom();
    return value;
  };
  const sum = () => {
    let value = product();
    while (tokens[at] === "+" || tokens[at] === "-") value = tokens[at++] === "+" ? value + product() : value - product();
    return value;
  };
  const value = sum();
  return at === tokens.length ? value : NaN;
}

export class NumberField {
  #value = null;
  #shown = [null, null]; // the last value and fallback
  #sent = null;          // text that has been typed and sent
  #options;
  #changed;
  #keyGesture = {name: "", until: 0};

  // `options` has label, unit, low, high, lowIsOpen (whether the value must be above it), isInteger, and scale: the usual
  // size of a value.
  constructor(options, changed) {
    this.#options = options;
    this.#changed = changed;
    this.input = make("input", {
      type: "text", inputMode: "decimal", spellcheck: false, autocomplete: "off", role: "spinbutton", "aria-label": options.label,
      onfocus: () => this.input.select(),
      onblur: () => this.#type(),
      oninput: () => { this.input.dataset.typed = "yes"; },
      onkeydown: (event) => this.#press(event),
    });
    if (Number.isFinite(options.low)) this.input.setAttribute("aria-valuemin", options.low);
    if (Number.isFinite(options.high)) this.input.setAttribute("aria-valuemax", options.high);
    this.element = make("div", {class: "number", title: "Drag to change. Click to type."},
      options.tag ? make("span", {class: `tag ${options.tag}`, "aria-hidden": "true"}, options.tag) : null, this.input,
      options.unit ? make("span", {class: "unit", "aria-hidden": "true"}, options.unit) : null);
    this.element.addEventListener("pointerdown", (event) => this.#grab(event));
  }
  get value() {
    return this.#value;
  }
  show(value, fallback = null) {
    this.#value = value ?? fallback;
    this.#shown = [value, fallback];
    if (this.input === document.activeElement && this.input.dataset.typed) return;
    this.#sent = null;
    const text = value === null ? "" : String(precise(value)), {selectionStart, selectionEnd} = this.input;
    if (this.input.value !== text) {
      const isWhole = selectionStart === 0 && selectionEnd === this.input.value.length;
      this.input.value = text;
      // The next key replaces the number, as it would have replaced the one before.
      if (isWhole && this.input === document.activeElement) this.input.select();
    }
    this.input.placeholder = fallback === null ? "none" : String(precise(fallback));
    if (this.#value !== null) this.input.setAttribute("aria-valuenow", this.#value);
  }
  #limited(value) {
    const {low, high, lowIsOpen, isInteger} = this.#options;
    const whole = isInteger ? Math.round(value) : value;
    if (lowIsOpen && whole <= low) return this.#value;
    return Math.max(low ?? -Infinity, Math.min(high ?? Infinity, whole));
  }
  #set(value, gesture) {
    const next = this.#limited(value);
    this.show(next);
    this.#changed(next, gesture);
  }
  // The change for one step: a nice fraction of the value or of the usual size.
  get #step() {
    const {isInteger, scale = 1} = this.#options;
    if (isInteger) return 1;
    const size = Math.max(Math.abs(this.#value ?? 0), scale / 4);
    return 10 ** Math.floor(Math.log10(size)) / 10;
  }
  #grab(event) {
    if (event.button !== 0 || this.input === document.activeElement) return;
    event.preventDefault();
    const from = event.clientX, base = this.#value ?? 0, step = this.#step, gesture = newId("drag");
    let isDragged = false;
    const move = (now) => {
      const by = now.clientX - from;
      if (!isDragged && Math.abs(by) < pixelsToStart) return;
      isDragged = true;
      this.element.classList.add("dragged");
      const size = step * (now.shiftKey ? 0.1 : now.ctrlKey ? 10 : 1) * (this.#options.isInteger ? 0.1 : 0.25);
      const grid = this.#options.isInteger ? 1 : step * (now.shiftKey ? 0.01 : 0.1);
      this.#set(precise(Math.round((base + by * size) / grid) * grid), gesture);
    };
    const end = () => {
      stopEscape();
      this.element.removeEventListener("pointermove", move);
      this.element.classList.remove("dragged");
      if (!isDragged) this.input.focus();
    };
    const stopEscape = onEscape(() => {
      end();
      if (isDragged) this.element.dispatchEvent(new CustomEvent("cancelgesture", {bubbles: true, detail: gesture}));
    });
    this.element.setPointerCapture(event.pointerId);
    this.element.addEventListener("pointermove", move);
    this.element.addEventListener("pointerup", end, {once: true});
    this.element.addEventListener("pointercancel", end, {once: true});
  }
  #press(event) {
    const direction = {ArrowUp: 1, ArrowDown: -1}[event.key];
    if (direction) {
      event.preventDefault();
      const now = performance.now();
      if (now > this.#keyGesture.until) this.#keyGesture.name = newId("keys");
      this.#keyGesture.until = now + pauseOfKeys;
      const typed = this.input.dataset.typed ? calculated(this.input.value.trim()) : NaN;
      if (Number.isFinite(typed)) this.#value = typed;
      const step = this.#step * (event.shiftKey && !this.#options.isInteger ? 0.1 : event.ctrlKey ? 10 : 1);
      delete this.input.dataset.typed;
      this.#set(precise((this.#value ?? 0) + direction * step), this.#keyGesture.name);
      this.input.select();
    } else if (event.key === "Enter") {
      this.#type(true);
      this.input.select();
    } else if (event.key === "Escape") {
      delete this.input.dataset.typed;
      this.show(...this.#shown);
      this.input.blur();
    }
    if (event.key !== "Tab" && !event.ctrlKey && !event.metaKey) event.stopPropagation();
  }
  // What was sent already is sent again only on request, for example because the server did not answer.
  #type(isAgain = false) {
    delete this.input.dataset.typed;
    const text = this.input.value.trim();
    if (this.#sent === null ? text === String(precise(this.#value ?? NaN)) : text === this.#sent && !isAgain) return;
    const value = calculated(text);
    if (!Number.isFinite(value)) {
      this.input.dispatchEvent(new CustomEvent("nonsense", {bubbles: true, detail: text}));
      return this.show(...this.#shown);
    }
    this.#sent = text;
    this.#changed(this.#options.isInteger ? Math.round(value) : precise(value), null);
  }
}

// Several numbers in a row, such as a vector.
export class VectorField {
  #fields;
  #values = [];

  constructor({label, names = ["x", "y", "z"], ...options}, changed) {
    this.#fields = names.map((name, i) => new NumberField({...options, label: `${label}, ${name}`, tag: name}, (value, gesture) => {
      const next = this.#values.map((old, j) => (i === j ? value : old ?? 0));
      this.#values = next;
      changed(next, gesture);
    }));
    this.element = make("div", {class: "vector", role: "group", "aria-label": label}, this.#fields.map((field) => field.element));
  }
  show(values, fallback) {
    this.#values = this.#fields.map((_, i) => values?.[i] ?? fallback?.[i] ?? 0);
    this.#fields.forEach((field, i) => field.show(values?.[i] ?? null, fallback?.[i] ?? null));
  }
}
