// One parameter in the inspector: its name, the control that fits it, a button that restores the default, its help, and
// what is wrong with it.
import {plainText} from "./catalogue.js";
import {hexOf, linearOf} from "./colour.js";
import {ColourField} from "./colour_field.js";
import {make, newId} from "./dom.js";
import {icon} from "./icons.js";
import {parsed, written} from "./json_text.js";
import {Choice} from "./menu.js";
import {NumberField, VectorField} from "./number_field.js";
import {swatchOf} from "./swatch.js";

const isNumbers = (value, n) => Array.isArray(value) && (n === undefined || value.length === n) && value.every((x) => typeof x === "number");
const isColour = (value) => isNumbers(value, 3) || (typeof value === "string" && value.startsWith("#"));

// Whether a default is of the sort that a control shows; others are only mentioned in the help.
const isShown = {
  number: (value) => typeof value === "number", vector: (value) => isNumbers(value), color: isColour, boolean: (value) => typeof value === "boolean",
  text: (value) => typeof value === "string",
};

// The sort of control for a parameter with a value, or null if it has none.
function sortOf(spec, value) {
  const isNumber = value === null || typeof value === "number";
  switch (spec.control) {
    case "length": case "angle": case "number": case "integer": return isNumber ? "number" : "json";
    case "vector": case "direction": case "point": return value === null || isNumbers(value) ? "vector" : "json";
    case "color": return value === null || isColour(value) ? "color" : "json";
    case "spectrum": return isColour(value) ? "color" : "json";
    case "phase": case "phases": return Array.isArray(value) ? "phases" : "phase";
    case "boolean": return typeof value === "boolean" || value === null ? "boolean" : "json";
    case "choice": return typeof value === "string" || value === null ? "choice" : "json";
    case "text": case "file": return typeof value === "string" || value === null ? "text" : "json";
    default: return "json";
  }
}

const titles = {of: "content", fov: "field of view", ior: "refractive index", n: "n"};
export const titleOf = (name) => {
  const text = titles[name] ?? name.replaceAll("_", " ").replaceAll("color", "colour");
  return text.charAt(0).toUpperCase() + text.slice(1);
};

const makers = {
  number(row) {
    const {low, high, low_open: lowIsOpen, unit, control} = row.spec;
    const hasRange = Number.isFinite(low) && Number.isFinite(high) && high - low < 1e3;
    const scale = control === "angle" ? 90 : hasRange ? high - low : control === "length" ? row.context.radius() : 1;
    const field = new NumberField({label: row.title, low, high, lowIsOpen, unit, isInteger: control === "integer", scale}, (value, gesture) => row.change(value, gesture));
    return {element: field.element, show: (value, fallback) => field.show(value, fallback), input: field.input};
  },
  vector(row) {
    const length = (row.value ?? row.fallback ?? [0, 0, 0]).length;
    const names = length <= 4 ? ["x", "y", "z", "w"].slice(0, length) : undefined;
    if (!names) return makers.json(row);
    const scale = row.spec.control === "direction" ? 1 : row.context.radius();
    const field = new VectorField({label: row.title, names, scale}, (value, gesture) => row.change(value, gesture));
    return {element: field.element, show: (value, fallback) => field.show(value, fallback)};
  },
  // A linear colour may be brighter than white: its brightest component is then a strength of its own.
  color(row) {
    let strength = 1, isText = false, hex = "#808080";
    const send = (gesture) => {
      if (isText && strength === 1) row.change(hex, gesture);
      else row.change(linearOf(hex).map((x) => Number((x * strength).toPrecision(4))), gesture);
    };
    const field = new ColourField(row.title, (next, gesture) => {
      hex = next;
      send(gesture);
    });
    const power = new NumberField({label: `${row.title}, strength`, low: 0, scale: 2, unit: "×"}, (value, gesture) => {
      strength = value;
      send(gesture);
    });
    const element = make("div", {class: "colour-strength"}, field.element, power.element);
    const show = (value, fallback) => {
      const colour = value ?? fallback ?? [0.5, 0.5, 0.5];
      isText = typeof colour === "string";
      strength = isText ? 1 : Math.max(1, ...colour);
      hex = hexOf(isText ? colour : colour.map((x) => x / strength));
      power.element.hidden = strength === 1;
      power.show(strength);
      field.show(hex, value === null);
      if (value === null && fallback === null) field.showNone();
    };
    return {element, show};
  },
  phase(row) {
    const choice = new Choice(row.title, (value) => row.change(value, null));
    const show = (value, fallback) => {
      const options = row.context.phases().map((name) => ({value: name, text: name, swatch: () => swatchOf(name)}));
      choice.show(options, value ?? fallback, row.spec.required ? "choose a phase" : row.spec.name === "phases" ? "all phases" : "none");
    };
    return {element: choice.element, show};
  },
  // Several phases: each is a switch.
  phases(row) {
    const element = make("div", {class: "phases", role: "group", "aria-label": row.title});
    const show = (value) => {
      const chosen = new Set(value ?? []);
      element.replaceChildren(...row.context.phases().map((name) => make("button", {
        type: "button", class: "chip", "aria-pressed": String(chosen.has(name)),
        onclick: () => {
          if (!chosen.delete(name)) chosen.add(name);
          row.change([...chosen], null);
        },
      }, swatchOf(name), name)));
    };
    return {element, show};
  },
  boolean(row) {
    const input = make("input", {type: "checkbox", class: "switch", "aria-label": row.title, onchange: () => row.change(input.checked, null)});
    return {element: input, show: (value, fallback) => { input.checked = value ?? fallback ?? false; }, input};
  },
  choice(row) {
    const choice = new Choice(row.title, (value) => row.change(value, null));
    const options = (row.spec.choices ?? []).map((value) => ({value, text: String(value).replaceAll("_", " ")}));
    return {element: choice.element, show: (value, fallback) => choice.show(options, value ?? fallback, "none")};
  },
  text(row) {
    const input = make("input", {
      type: "text", class: "line", spellcheck: false, autocomplete: "off", "aria-label": row.title, onchange: () => row.change(input.value, null),
    });
    const show = (value, fallback) => {
      if (input !== document.activeElement) input.value = value ?? "";
      input.placeholder = fallback ?? (row.spec.control === "file" ? "name of a file" : "none");
    };
    return {element: input, show, input};
  },
  json(row) {
    const input = make("textarea", {
      class: "json", rows: 1, spellcheck: false, "aria-label": `${row.title}, as text of the scene file`,
      onchange: () => {
        try {
          parsed(input.value);
          row.changeText(input.value, null);
        } catch (error) {
          row.fail(`${error.message}. Write it as in a scene file.`);
        }
      },
      oninput: () => fit(),
    });
    const fit = () => { input.rows = Math.min(8, Math.max(1, Math.ceil(input.value.length / 34), input.value.split("\n").length)); };
    const show = (_, fallback, text) => {
      if (input !== document.activeElement) input.value = text ?? "";
      input.placeholder = fallback === null ? "none" : written(fallback);
      fit();
    };
    return {element: input, show, input};
  },
};

export class ParameterRow {
  #sort = null;
  #control = null;
  #entry = null;

  // `context` has radius(), phases(), set(entry, name, text, gesture, row), reset(entry, name, row) and fill(entry, slot),
  // which puts a texture or the like in the place of a value.
  constructor(spec, context) {
    this.spec = spec;
    this.context = context;
    this.title = titleOf(spec.name);
    this.value = null;
    this.fallback = spec.default === null || spec.default === undefined ? null : parsed(spec.default);
    const id = newId("help");
    this.help = make("p", {class: "help", id, hidden: true}, this.#helpText());
    this.label = make("button", {
      type: "button", class: "label", title: this.help.textContent, "aria-expanded": "false", "aria-controls": id, tabIndex: -1,
      onclick: () => {
        this.help.hidden = !this.help.hidden;
        this.label.setAttribute("aria-expanded", String(!this.help.hidden));
      },
    }, this.title);
    this.place = make("div", {class: "control"});
    const {instead} = spec;
    this.insteadButton = instead && !instead.list && instead.type !== "keys" ? make("button", {
      type: "button", class: "icon-button small", "aria-label": `${this.title}: use a ${instead.type.replaceAll("_", " ")} instead`,
      title: `Use a ${instead.type.replaceAll("_", " ")} instead`, onclick: () => this.context.fill(this.#entry, {name: spec.name, ...instead}),
    }, icon("texture")) : null;
    this.resetButton = make("button", {
      type: "button", class: "icon-button small reset", "aria-label": `Reset ${this.title} to its default`, title: "Reset to default",
      onclick: () => this.context.reset(this.#entry, spec.name, this),
    }, icon("reset"));
    this.problem = make("p", {class: "problem", role: "alert", hidden: true});
    this.element = make("div", {class: "parameter", "data-parameter": spec.name}, this.label, this.place, make("div", {class: "beside"}, this.insteadButton, this.resetButton), this.problem, this.help);
  }
  #helpText() {
    const {help, low, high, low_open: lowIsOpen, unit, required} = this.spec;
    const limits = [Number.isFinite(low) ? `${lowIsOpen ? "more than" : "at least"} ${low}` : "", Number.isFinite(high) ? `at most ${high}` : ""].filter(Boolean).join(", ");
    const said = this.fallback === null ? "" : `Default: ${written(this.fallback)}.`;
    return [plainText(help ?? ""), limits ? `Limits: ${limits}${unit ? ` ${unit}` : ""}.` : "", said, required ? "Required." : ""].filter(Boolean).join(" ");
  }
  get isPresent() {
    return this.#entry?.parameters?.[this.spec.name] !== undefined;
  }
  show(entry) {
    this.#entry = entry;
    const parameter = entry.parameters?.[this.spec.name];
    const text = parameter?.text ?? null;
    try {
      this.value = text === null ? null : parsed(text);
    } catch {
      this.value = text;
    }
    const sort = parameter?.keyed ? "json" : sortOf(this.spec, this.value);
    if (sort !== this.#sort) {
      this.#sort = sort;
      this.#control = makers[sort](this);
      this.#control.input?.setAttribute("aria-describedby", this.help.id);
      this.place.replaceChildren(this.#control.element);
      this.element.classList.toggle("wide", sort === "vector" || sort === "json" || sort === "phases");
    }
    const fits = isShown[sort] ?? (() => true);
    this.#control.show(this.value, fits(this.fallback) ? this.fallback : null, text);
    this.resetButton.hidden = parameter === undefined || Boolean(this.spec.required);
    this.element.classList.toggle("present", parameter !== undefined);
  }
  change(value, gesture) {
    this.value = value;
    this.changeText(written(value), gesture);
  }
  changeText(text, gesture) {
    this.context.set(this.#entry, this.spec.name, text, gesture, this);
  }
  fail(message) {
    this.problem.textContent = message;
    this.problem.hidden = message === "";
    this.element.classList.toggle("wrong", message !== "");
  }
  focus() {
    this.place.querySelector("input, button, textarea")?.focus();
  }
}
