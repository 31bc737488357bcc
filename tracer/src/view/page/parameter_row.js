// One parameter in the inspector: its name, which focuses its control, the control that fits it, a button that restores the
// default, a button for keys, one for its help, and what is wrong with it.
import {plainText} from "./catalogue.js";
import {make, newId} from "./dom.js";
import {icon} from "./icons.js";
import {parsed, written} from "./json_text.js";
import {firstKeys, isKeyed, keyNear, nowOf, present, set, withKey, withoutKey} from "./keyframes.js";
import {isShown, makers, sortOf} from "./parameter_controls.js";

const titles = {of: "content", fov: "field of view", ior: "refractive index", n: "n"};
export const titleOf = (name) => {
  const text = titles[name] ?? name.replaceAll("_", " ").replaceAll("color", "colour");
  return text.charAt(0).toUpperCase() + text.slice(1);
};

export class ParameterRow {
  #sort = null;
  #control = null;
  #entry = null;
  #pending = 0;          // changes that the server has not answered yet
  #rejected = undefined; // what the file had when it rejected what is typed here

  // `context` has radius(), phases(), set(entry, name, text, gesture, row, index), where `index` is that of an item, reset(entry, name, row)
  // and fill(entry, slot), which puts a texture or the like in the place of a value.
  constructor(spec, context) {
    this.spec = spec;
    this.context = context;
    this.title = titleOf(spec.name);
    this.value = null;
    this.fallback = spec.default === null || spec.default === undefined ? null : parsed(spec.default);
    const id = newId("help");
    this.help = make("p", {class: "help", id, hidden: true}, this.#helpText());
    this.label = make("label", {class: "label", title: this.help.textContent, onclick: (event) => this.#press(event)}, this.title);
    this.helpButton = make("button", {
      type: "button", class: "icon-button small about-it", "aria-label": `Help on ${this.title}`, title: this.help.textContent, "aria-expanded": "false", "aria-controls": id,
      onclick: () => {
        this.help.hidden = !this.help.hidden;
        this.helpButton.setAttribute("aria-expanded", String(!this.help.hidden));
      },
    }, icon("help"));
    this.place = make("div", {class: "control"});
    this.place.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || this.#rejected === undefined) return;
      this.#rejected = undefined;
      this.fail("");
    }, {capture: true});
    const {instead} = spec;
    this.insteadButton = instead && !instead.list && instead.type !== "keys" ? make("button", {
      type: "button", class: "icon-button small", "aria-label": `${this.title}: use a ${instead.type.replaceAll("_", " ")} instead`,
      title: `Use a ${instead.type.replaceAll("_", " ")} instead`, onclick: () => this.context.fill(this.#entry, {name: spec.name, ...instead}),
    }, icon("texture")) : null;
    this.resetButton = make("button", {
      type: "button", class: "icon-button small reset", "aria-label": `Reset ${this.title} to its default`, title: "Reset to default",
      onclick: () => this.context.reset(this.#entry, spec.name, this),
    }, icon("reset"));
    this.keyButton = spec.may_be_keyed ? make("button", {type: "button", class: "icon-button small key", onclick: () => this.#toggleKey()}, icon("key")) : null;
    this.problem = make("p", {class: "problem", role: "alert", hidden: true});
    this.element = make("div", {class: "parameter", "data-parameter": spec.name}, this.label, this.place, make("div", {class: "beside"}, this.insteadButton, this.resetButton, this.keyButton, this.helpButton), this.problem, this.help);
  }
  #helpText() {
    const {help, low, high, low_open: lowIsOpen, required} = this.spec, {unit} = this;
    const limits = [Number.isFinite(low) ? `${lowIsOpen ? "more than" : "at least"} ${low}` : "", Number.isFinite(high) ? `at most ${high}` : ""].filter(Boolean).join(", ");
    const said = this.fallback === null ? "" : `Default: ${written(this.fallback)}.`;
    return [plainText(help ?? ""), limits ? `Limits: ${limits}${unit ? ` ${unit}` : ""}.` : "", said, required ? "Required." : ""].filter(Boolean).join(" ");
  }
  // The unit to show: for lengths, the scene's unit, if it has one.
  get unit() {
    return this.spec.unit === "m" ? this.context.unit() : this.spec.unit;
  }
  // What the parameter belongs to.
  get kind() {
    return {type: this.#entry.type, kind: this.#entry.kind};
  }
  get isPresent() {
    return this.#entry?.parameters?.[this.spec.name] !== undefined;
  }
  show(entry) {
    this.#entry = entry;
    const parameter = entry.parameters?.[this.spec.name];
    const text = parameter?.text ?? null;
    this.resetButton.hidden = parameter === undefined || Boolean(this.spec.required);
    this.element.classList.toggle("present", parameter !== undefined);
    // What has been changed here is newer than the scene, and what was rejected stays to be corrected.
    if (this.#pending > 0 || this.#rejected === text) return;
    if (this.#rejected !== undefined) this.fail("");
    this.#rejected = undefined;
    try {
      this.written = text === null ? null : parsed(text);
    } catch {
      this.written = text;
    }
    this.value = nowOf(this.written);
    const sort = sortOf(this.spec, this.value);
    if (sort !== this.#sort) {
      this.#sort = sort;
      this.#control = makers[sort](this);
      this.#control.input?.setAttribute("aria-describedby", this.help.id);
      this.place.replaceChildren(this.#control.element);
      this.element.classList.toggle("wide", ["vector", "json", "phases", "spectrum", "curve", "ramp", "list", "points"].includes(sort));
    }
    const fits = isShown[sort] ?? (() => true);
    this.#control.show(this.value, fits(this.fallback) ? this.fallback : null, text);
    this.#showKey();
  }
  // `index` says which item of a list is the only one that has changed.
  change(value, gesture, index) {
    const isItem = index !== undefined && Array.isArray(this.written) && this.written.length === value.length;
    this.value = value;
    const whole = set(this.written, value);
    this.written = whole;
    if (isItem) this.#send(written(value[index]), gesture, index);
    else this.#send(written(whole), gesture);
  }
  changeText(text, gesture) {
    this.written = parsed(text);
    this.#send(text, gesture);
  }
  async #send(text, gesture, index) {
    this.#pending += 1;
    const isAccepted = await this.context.set(this.#entry, this.spec.name, text, gesture, this, index);
    this.#pending -= 1;
    if (this.#pending > 0) return;
    this.#rejected = isAccepted || gesture !== null ? undefined : this.#entry.parameters?.[this.spec.name]?.text ?? null;
    this.show(this.#entry);
  }
  // A key at the time of the picture is made, or removed. Without keys, the value has two at first.
  #toggleKey() {
    const value = this.value ?? this.fallback;
    if (value === null || value === undefined) return this.fail("Set a value first, which the keys can begin with.");
    const at = isKeyed(this.written) ? keyNear(this.written, present.seconds) : -1;
    this.changeText(written(!isKeyed(this.written) ? firstKeys(value) : at < 0 ? withKey(this.written, present.seconds, value) : withoutKey(this.written, at)), null);
  }
  #showKey() {
    if (!this.keyButton) return;
    const isOn = isKeyed(this.written), isNow = isOn && keyNear(this.written, present.seconds) >= 0;
    this.keyButton.classList.toggle("keyed", isOn);
    this.keyButton.classList.toggle("now", isNow);
    const text = isNow ? "Remove this key" : isOn ? "Add a key at this time" : "Change it with time, by keys";
    this.keyButton.title = text;
    this.keyButton.setAttribute("aria-label", `${this.title}: ${text.charAt(0).toLowerCase()}${text.slice(1)}`);
  }
  // Drops what was rejected, because the scene has been changed elsewhere since, unless it is still being corrected.
  forgetFailure() {
    if (this.element.contains(document.activeElement)) return;
    this.#rejected = undefined;
    this.fail("");
  }
  fail(message) {
    this.problem.textContent = message;
    this.problem.hidden = message === "";
    this.element.classList.toggle("wrong", message !== "");
  }
  // The label does what its control does: a switch changes, and anything else gets the focus.
  #press(event) {
    event.preventDefault();
    const control = this.place.querySelector("input, button, textarea");
    if (control?.type === "checkbox") control.click();
    control?.focus();
  }
  focus() {
    this.place.querySelector("input, button, textarea")?.focus();
  }
}
