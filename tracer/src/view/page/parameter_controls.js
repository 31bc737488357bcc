// The controls of the inspector's rows: which sort fits a parameter with its value, and how each is made.
import {hexOf, linearOf} from "./colour.js";
import {ColourField, measuredSwatch} from "./colour_field.js";
import {CurveField} from "./curve_field.js";
import {FileField} from "./file_field.js";
import {make, refill} from "./dom.js";
import {parsed, written} from "./json_text.js";
import {ListField} from "./list_field.js";
import {Choice} from "./menu.js";
import {NumberField, VectorField} from "./number_field.js";
import {RampField} from "./ramp_field.js";
import {lookOf, swatchOf} from "./swatch.js";

const isNumbers = (value, n) => Array.isArray(value) && (n === undefined || value.length === n) && value.every((x) => typeof x === "number");
const isColour = (value) => isNumbers(value, 3) || (typeof value === "string" && value.startsWith("#"));

const isPoints = (value) => Array.isArray(value) && value.every((item) => isNumbers(item, 2) || isNumbers(item, 3)) && new Set(value.map((item) => item.length)).size < 2;
const isCurve = (value) => Array.isArray(value) && value.every((item) => isNumbers(item, 2));
const isRamp = (value) => Array.isArray(value) && value.every((item) => Array.isArray(item) && item.length === 2 && typeof item[0] === "number");

// Whether a default is of the sort that a control shows; others are only mentioned in the help.
export const isShown = {
  number: (value) => typeof value === "number", vector: (value) => isNumbers(value), color: isColour, boolean: (value) => typeof value === "boolean",
  text: (value) => typeof value === "string", list: (value) => isNumbers(value), points: isPoints, curve: isCurve,
};

// The sort of control for a parameter with a value, or null if it has none.
export function sortOf(spec, value) {
  const isNumber = value === null || typeof value === "number";
  switch (spec.control) {
    case "length": case "angle": case "number": case "integer": return isNumber ? "number" : "json";
    case "vector": case "direction": case "point": return value === null || isNumbers(value) ? "vector" : "json";
    case "color": return value === null || isColour(value) ? "color" : "json";
    case "spectrum": return isCurve(value) || value === null || typeof value.blackbody === "number" ? "spectrum" : isColour(value) ? "color" : "json";
    case "curve": return value === null ? "json" : isCurve(value) ? "curve" : isRamp(value) ? "ramp" : "json";
    case "phase": case "phases": return Array.isArray(value) ? "phases" : "phase";
    case "boolean": return typeof value === "boolean" || value === null ? "boolean" : "json";
    case "choice": return typeof value === "string" || value === null ? "choice" : "json";
    case "text": case "file": return typeof value === "string" || value === null ? spec.control : "json";
    default: return sortOfList(spec.type ?? "", value);
  }
}

// Lists of numbers or of points; in some parameters, one number stands for all.
function sortOfList(type, value) {
  if (type === "number or list of numbers" && (value === null || typeof value === "number")) return "listed";
  if (value === null) return type === "list of numbers" ? "list" : /^list of \[x, y(, z)?\]$/.test(type) ? "points" : "json";
  return isNumbers(value) && (value.length > 0 || type.includes("list of numbers")) ? "list" : isPoints(value) && (value.length > 0 || type.startsWith("list of [x")) ? "points" : "json";
}

// What a field of numbers needs to know: limits, unit, and the usual size of a value.
function limitsOf(row) {
  const {low, high, low_open: lowIsOpen, unit, control} = row.spec; // the catalogue gives lengths in m, whatever the scene's unit is
  const hasRange = Number.isFinite(low) && Number.isFinite(high) && high - low < 1e3;
  const scale = control === "angle" ? 90 : hasRange ? high - low : control === "length" || unit === "m" ? row.context.radius() : 1;
  return {low, high, lowIsOpen, unit: row.unit, isInteger: control === "integer", scale};
}

// Each makes {element, show(value, fallback, text), input} for a row.
export const makers = {
  number(row) {
    const field = new NumberField({label: row.title, ...limitsOf(row)}, (value, gesture) => row.change(value, gesture));
    return {element: field.element, show: (value, fallback) => field.show(value, fallback), input: field.input};
  },
  vector(row) {
    const length = (row.value ?? row.fallback ?? [0, 0, 0]).length;
    const isOfColours = row.spec.type === "[r, g, b]", letters = isOfColours ? ["R", "G", "B"] : ["x", "y", "z", "w"];
    if (length > 4) return makers.json(row);
    const names = letters.slice(0, length), scale = isOfColours || row.spec.control === "direction" ? 1 : row.context.radius();
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
    let chosen = new Set();
    const press = (button, name) => {
      if (!chosen.delete(name)) chosen.add(name);
      button.setAttribute("aria-pressed", String(chosen.has(name)));
      row.change([...chosen], null);
    };
    const show = (value) => {
      chosen = new Set(value ?? []);
      const names = row.context.phases();
      refill(element, names.map(lookOf).join(), () => names.map((name) => make("button", {
        type: "button", class: "chip", onclick: (event) => press(event.currentTarget, name),
      }, swatchOf(name), name)));
      names.forEach((name, i) => element.children[i].setAttribute("aria-pressed", String(chosen.has(name))));
    };
    return {element, show};
  },
  boolean(row) {
    const input = make("input", {type: "checkbox", class: "switch", "aria-label": row.title, onchange: () => row.change(input.checked, null)});
    return {element: input, show: (value, fallback) => { input.checked = value ?? fallback ?? false; }, input};
  },
  choice(row) {
    const choice = new Choice(row.title, (value) => row.change(value, null));
    const options = (row.spec.choices ?? []).map((value) => ({
      value, text: String(value).replaceAll("_", " "), swatch: ["metal", "medium"].includes(row.spec.name) ? () => measuredSwatch(value) : undefined,
    }));
    return {element: choice.element, show: (value, fallback) => choice.show(options, value ?? fallback, "none")};
  },
  text(row) {
    const input = make("input", {
      type: "text", class: "line", spellcheck: false, autocomplete: "off", "aria-label": row.title, onchange: () => row.change(input.value, null),
    });
    const show = (value, fallback) => {
      if (input !== document.activeElement) input.value = value ?? "";
      input.placeholder = fallback ?? "none";
    };
    return {element: input, show, input};
  },
  file(row) {
    const field = new FileField(row.title, () => row.kind, (name) => row.change(name, null));
    return {element: field.element, show: (value, fallback) => field.show(value, fallback ?? "name of a file"), input: field.input};
  },
  // Numbers at wavelengths, or the temperature of a black body.
  spectrum(row) {
    const curve = new CurveField({label: row.title, x: "wavelength", xUnit: "nm", y: "value", low: row.spec.low, high: row.spec.high}, (points, gesture, i) => row.change(points, gesture, i));
    const kelvin = new NumberField({label: `${row.title}, temperature`, low: 100, unit: "K", scale: 4000}, (value, gesture) => row.change({blackbody: value}, gesture));
    const useCurve = make("button", {type: "button", onclick: () => row.change([[400, 1], [550, 1], [700, 1]], null)}, "Use a curve");
    const useHeat = make("button", {type: "button", onclick: () => row.change({blackbody: 3000}, null)}, "Use a black body");
    const takesHeat = row.spec.type?.includes("blackbody") ?? false;
    const show = (value) => {
      const isList = Array.isArray(value), isHeat = value !== null && !isList;
      curve.element.hidden = !isList;
      kelvin.element.hidden = !isHeat;
      useCurve.hidden = isList;
      useHeat.hidden = isHeat || !takesHeat;
      if (isList) curve.show(value);
      if (isHeat) kelvin.show(value.blackbody);
    };
    return {element: make("div", {class: "spectrum"}, curve.element, kelvin.element, make("div", {class: "buttons"}, useCurve, useHeat)), show};
  },
  curve(row) {
    const field = new CurveField({label: row.title, x: "position", y: "value", low: row.spec.low, high: row.spec.high}, (points, gesture, i) => row.change(points, gesture, i));
    return {element: field.element, show: (value, fallback) => field.show(value ?? fallback ?? [])};
  },
  ramp(row) {
    const field = new RampField(row.title, (stops, gesture, i) => row.change(stops, gesture, i));
    return {element: field.element, show: (value) => field.show(value)};
  },
  list(row) {
    const field = new ListField({label: row.title, size: 0, ...limitsOf(row)}, (values, gesture, i) => row.change(values, gesture, i));
    const all = make("button", {type: "button", onclick: () => row.change(row.value[0], null), hidden: !row.spec.type?.startsWith("number or")}, "One number for all");
    const show = (value, fallback) => {
      field.show(value ?? fallback ?? []);
      all.disabled = (value ?? []).length === 0;
    };
    return {element: make("div", {}, field.element, all), show};
  },
  // One number that stands for a list.
  listed(row) {
    const number = makers.number(row);
    const each = make("button", {type: "button", onclick: () => row.change([row.value, row.value], null)}, "A number for each");
    const show = (value, fallback) => {
      number.show(value, typeof fallback === "number" ? fallback : null);
      each.disabled = value === null;
    };
    return {element: make("div", {class: "listed"}, number.element, each), show, input: number.input};
  },
  points(row) {
    const size = (row.value?.[0] ?? (row.spec.type?.includes("[x, y]") ? [0, 0] : [0, 0, 0])).length;
    const field = new ListField({label: row.title, size, scale: row.context.radius()}, (values, gesture, i) => row.change(values, gesture, i));
    return {element: field.element, show: (value, fallback) => field.show(value ?? fallback ?? [])};
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
