// A ramp of colours: a bar with a stop for each colour. Stops are dragged along it, added by a click on the bar, and
// removed by Delete. A stop may also be a texture, which is edited in the outline.
import {hexOf, linearOf} from "./colour.js";
import {ColourField} from "./colour_field.js";
import {make, newId} from "./dom.js";
import {icon} from "./icons.js";
import {NumberField} from "./number_field.js";

const samples = 32;
const precise = (x) => Number(x.toPrecision(5));
const isColour = (value) => typeof value === "string" || (Array.isArray(value) && value.every((x) => typeof x === "number"));
const linear = (value) => (isColour(value) ? (typeof value === "string" ? linearOf(value) : value) : [0.5, 0.5, 0.5]);

function colourAt(stops, x) {
  const after = stops.findIndex(([at]) => at > x);
  if (after === 0 || stops.length === 0) return linear(stops[0]?.[1]);
  if (after < 0) return linear(stops.at(-1)[1]);
  const [[a, from], [b, to]] = [stops[after - 1], stops[after]], share = (x - a) / (b - a);
  return linear(from).map((c, i) => c + share * (linear(to)[i] - c));
}

export class RampField {
  #stops = [];
  #chosen = 0;
  #range = [0, 1];
  #isDragged = false;
  #label;
  #changed;

  // `changed(stops, gesture, i)` gets the index of the only stop that has changed, or undefined.
  constructor(label, changed) {
    this.#label = label;
    this.#changed = changed;
    this.bar = make("div", {class: "ramp-bar", onpointerdown: (event) => this.#add(event)});
    this.line = make("div", {class: "ramp-stops", role: "group", "aria-label": label});
    this.position = new NumberField({label: `${label}, position`}, (value, gesture) => this.#move(this.#chosen, [value, this.#stops[this.#chosen][1]], gesture));
    this.colour = new ColourField(`${label}, colour`, (hex, gesture) => this.#move(this.#chosen, [this.#stops[this.#chosen][0], linearOf(hex).map(precise)], gesture));
    this.texture = make("p", {class: "faint"}, "a texture");
    this.remove = make("button", {type: "button", class: "icon-button small", "aria-label": "Remove the stop", title: "Remove the stop (Delete)", onclick: () => this.#delete(this.#chosen)}, icon("delete"));
    this.element = make("div", {class: "ramp"}, this.bar, this.line, make("div", {class: "point-fields"}, this.position.element, this.colour.element, this.texture, this.remove));
  }
  show(stops) {
    this.#stops = stops;
    this.#chosen = Math.max(0, Math.min(this.#chosen, stops.length - 1));
    const at = stops.map(([x]) => x), [low, high] = stops.length > 0 ? [Math.min(...at), Math.max(...at)] : [0, 1];
    const isShare = low >= 0 && high <= 1, pad = 0.1 * (high - low) || 0.5;
    if (!this.#isDragged) this.#range = isShare ? [0, 1] : [low - pad, high + pad];
    this.#draw();
  }
  #draw() {
    const [low, high] = this.#range, share = (x) => (x - low) / (high - low), hadFocus = this.line.contains(document.activeElement);
    const colours = Array.from({length: samples + 1}, (_, i) => `${hexOf(colourAt(this.#stops, low + (high - low) * i / samples))} ${100 * i / samples}%`);
    this.bar.style.background = `linear-gradient(to right, ${colours.join(", ")})`;
    if (this.line.childElementCount !== this.#stops.length) this.line.replaceChildren(...this.#stops.map((_, i) => this.#stop(i)));
    [...this.line.children].forEach((button, i) => {
      const [x, colour] = this.#stops[i];
      button.style.left = `${100 * Math.max(0, Math.min(1, share(x)))}%`;
      button.style.setProperty("--swatch", isColour(colour) ? hexOf(colour) : "#808080");
      button.classList.toggle("chosen", i === this.#chosen);
      button.tabIndex = i === this.#chosen ? 0 : -1;
      button.setAttribute("aria-label", `Stop ${i + 1} of ${this.#stops.length}, at ${precise(x)}`);
    });
    if (hadFocus) this.line.children[this.#chosen]?.focus();
    const [x, colour] = this.#stops[this.#chosen] ?? [null, null];
    this.position.show(x);
    this.texture.hidden = colour === null || isColour(colour);
    this.colour.element.hidden = !this.texture.hidden;
    if (isColour(colour)) this.colour.show(colour);
    this.remove.disabled = this.#stops.length <= 1;
  }
  #stop(i) {
    return make("button", {
      type: "button", class: "ramp-stop", "data-point": i, onfocus: () => this.#choose(i), onpointerdown: (event) => this.#grab(event, i), onkeydown: (event) => this.#press(event, i),
    });
  }
  #choose(i) {
    if (i === this.#chosen) return;
    this.#chosen = i;
    this.#draw();
  }
  #move(i, [x, colour], gesture) {
    const [low, high] = this.#range, gap = 1e-4 * (high - low);
    const at = precise(Math.max((this.#stops[i - 1]?.[0] ?? -Infinity) + gap, Math.min((this.#stops[i + 1]?.[0] ?? Infinity) - gap, x)));
    this.show(this.#stops.map((old, j) => (i === j ? [at, colour] : old)));
    this.#changed(this.#stops, gesture, i);
  }
  #delete(i) {
    if (this.#stops.length <= 1) return;
    this.show(this.#stops.filter((_, j) => j !== i));
    this.#changed(this.#stops, null);
  }
  #xAt(event) {
    const box = this.bar.getBoundingClientRect(), [low, high] = this.#range;
    return low + (event.clientX - box.left) / box.width * (high - low);
  }
  #add(event) {
    if (event.button !== 0) return;
    event.preventDefault();
    const x = precise(this.#xAt(event)), after = this.#stops.findIndex(([at]) => at > x), i = after < 0 ? this.#stops.length : after;
    const colour = colourAt(this.#stops, x).map(precise);
    this.#chosen = i;
    this.show(this.#stops.toSpliced(i, 0, [x, colour]));
    this.#changed(this.#stops, null);
    this.line.children[i].focus();
  }
  #grab(event, i) {
    if (event.button !== 0) return;
    event.preventDefault();
    const button = event.currentTarget, gesture = newId("ramp"), from = this.#xAt(event), base = this.#stops[i][0];
    button.focus();
    this.#isDragged = true;
    const move = (now) => this.#move(i, [precise(base + (now.shiftKey ? 0.1 : 1) * (this.#xAt(now) - from)), this.#stops[i][1]], gesture);
    const end = () => {
      button.removeEventListener("pointermove", move);
      this.#isDragged = false;
      this.show(this.#stops);
    };
    button.setPointerCapture(event.pointerId);
    button.addEventListener("pointermove", move);
    button.addEventListener("pointerup", end, {once: true});
    button.addEventListener("pointercancel", end, {once: true});
  }
  #press(event, i) {
    const [low, high] = this.#range, by = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (by) this.#move(i, [this.#stops[i][0] + by * (event.shiftKey ? 0.001 : 0.01) * (high - low), this.#stops[i][1]], "ramp-keys");
    else if (event.key === "Delete" || event.key === "Backspace") this.#delete(i);
    else if (event.key === "PageDown" || event.key === "PageUp") this.line.children[Math.max(0, Math.min(this.#stops.length - 1, i + (event.key === "PageDown" ? 1 : -1)))].focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
