// A list of numbers or of points, a row for each. Rows are added at the end, and removed.
import {make} from "./dom.js";
import {icon} from "./icons.js";
import {NumberField, VectorField} from "./number_field.js";

const mostRows = 60;

export class ListField {
  #values = [];
  #rows = [];
  #options;
  #changed;

  // `options` has label, size (of a point, or 0 for numbers) and those of the number fields. `changed(values, gesture, i)`
  // gets the index of the only item that has changed, or undefined.
  constructor(options, changed) {
    this.#options = options;
    this.#changed = changed;
    this.rows = make("div", {class: "list-rows"});
    this.more = make("p", {class: "faint"});
    this.add = make("button", {type: "button", class: "slot-add", onclick: () => this.#append()}, icon("add"), "Add");
    this.element = make("div", {class: "list", role: "group", "aria-label": options.label}, this.rows, this.more, this.add);
  }
  show(values) {
    this.#values = values;
    const count = Math.min(values.length, mostRows);
    if (this.#rows.length !== count) {
      this.#rows = values.slice(0, count).map((_, i) => this.#row(i));
      this.rows.replaceChildren(...this.#rows.map((row) => row.element));
    }
    this.#rows.forEach((row, i) => row.field.show(values[i]));
    this.more.hidden = values.length <= mostRows;
    this.more.textContent = `${values.length - mostRows} more, which the text has.`;
  }
  #row(i) {
    const {label, size, ...options} = this.#options, common = {...options, label: `${label} ${i + 1}`};
    const set = (value, gesture) => {
      this.#values = this.#values.map((old, j) => (i === j ? value : old));
      this.#changed(this.#values, gesture, i);
    };
    const field = size > 0 ? new VectorField({...common, names: ["x", "y", "z"].slice(0, size)}, set) : new NumberField(common, set);
    const remove = make("button", {type: "button", class: "icon-button small", "aria-label": `Remove ${label} ${i + 1}`, title: "Remove", onclick: () => {
      const left = this.#values.filter((_, j) => j !== i);
      this.show(left);
      this.#changed(left, null);
    }}, icon("delete"));
    return {field, element: make("div", {class: "list-row"}, field.element, remove)};
  }
  // Continues as the last two go on.
  #append() {
    const [before, last] = [this.#values.at(-2), this.#values.at(-1)], {size, scale = 1} = this.#options;
    const next = (a, b) => Number((2 * b - a).toPrecision(5));
    const value = size > 0 ? (before ? last.map((x, i) => next(before[i], x)) : last ? last.map((x, i) => (i === 0 ? next(x - scale / 4, x) : x)) : Array(size).fill(0)) : last ?? scale;
    this.show([...this.#values, value]);
    this.#changed(this.#values, null);
  }
}
