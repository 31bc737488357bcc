// The numbers that move a grabbed point, and which of them may change.
import {make} from "./dom.js";
import {icon} from "./icons.js";
import {nameOf} from "./names.js";
import {titleOf} from "./parameter_row.js";
import {keysOf} from "./pointer.js";
import {isSection} from "./structure.js";

const shown = 8; // rows at first
const weak = 0.05; // of the strongest

const axis = (key, count) => (count <= 3 ? ["x", "y", "z"][key] : String(Number(key) + 1));

export class GrabPanel {
  #panel;
  #act;
  #rows = new Map(); // by pointer: {name, checkbox, value}
  #locked = new Set(); // as chosen by hand; stays for the next point
  #only = null;
  #said = make("p", {class: "hidden-text", role: "status"});
  catalogue = null;

  // `changed()` is called when another choice is made, and `closed()` when the panel is closed.
  constructor(panel, act) {
    this.#panel = panel;
    this.#act = act;
  }
  hide() {
    this.#panel.hidden = true;
    this.#said.textContent = "";
    this.#rows.clear();
    this.#only = null;
  }
  get chosen() {
    const pointers = [...this.#rows.keys()];
    if (this.#only) return [this.#only];
    return pointers.filter((pointer) => this.#rows.get(pointer).checkbox.checked);
  }
  show(point, scene) {
    this.hide();
    const strongest = point.influences[0].strength;
    const rows = point.influences.map((one, i) => {
      const name = this.#nameOf(one.pointer, scene);
      const checkbox = make("input", {type: "checkbox", checked: !this.#locked.has(one.pointer), "aria-label": `${name.text} may change`});
      const value = make("output", {class: "value"});
      const only = make("button", {type: "button", class: "link", "aria-label": `Only ${name.text}`}, "Only");
      const row = make("label", {class: "row", hidden: i >= shown || one.strength < weak * strongest}, checkbox,
        make("span", {class: "name"}, name.parameter), make("span", {class: "remark"}, name.of), value, only);
      this.#rows.set(one.pointer, {name, checkbox, value, row});
      checkbox.addEventListener("change", () => this.#lock(one.pointer, !checkbox.checked));
      only.addEventListener("click", (event) => {
        event.preventDefault();
        this.#chooseOnly(one.pointer);
      });
      return row;
    });
    const hidden = rows.filter((row) => row.hidden);
    const more = hidden.length === 0 ? null : make("button", {type: "button", class: "link"}, `${hidden.length} weaker`);
    more?.addEventListener("click", () => {
      for (const row of hidden) row.hidden = false;
      more.remove();
    });
    const all = make("button", {type: "button", class: "link", onclick: () => this.#chooseAll()}, "All");
    const close = make("button", {type: "button", class: "icon-button small", "aria-label": "Release the point", onclick: () => this.#act.closed()}, icon("close"));
    this.#panel.replaceChildren(make("header", {}, make("h2", {}, "May change"), all, close), ...rows, ...[more].filter(Boolean), this.#said);
    this.#panel.hidden = false;
    this.showValues(point.values);
  }
  showValues(values) {
    for (const [pointer, row] of this.#rows) row.value.value = String(Number(values[pointer].toPrecision(5)));
  }
  // "Radius of sphere is 0.62, …"
  sentence(pointers, values) {
    return pointers.map((pointer) => this.#rows.get(pointer)).filter(Boolean).slice(0, 4)
      .map((row) => `${row.name.text} is ${row.value.value}`).join(", ");
  }
  // For screen readers.
  say(text) {
    if (text && text !== this.#said.textContent) this.#said.textContent = text;
  }
  #lock(pointer, isLocked) {
    this.#only = null;
    if (isLocked) this.#locked.add(pointer);
    else this.#locked.delete(pointer);
    this.#act.changed();
  }
  #chooseOnly(pointer) {
    for (const [other, row] of this.#rows) row.checkbox.checked = other === pointer;
    this.#only = pointer;
    this.#act.changed();
  }
  #chooseAll() {
    this.#only = null;
    for (const [pointer, row] of this.#rows) {
      row.checkbox.checked = true;
      this.#locked.delete(pointer);
    }
    this.#act.changed();
  }
  // The parameter, and the node that has it.
  #nameOf(pointer, scene) {
    for (const entry of scene.entries) {
      if (isSection(entry)) continue;
      for (const [name, parameter] of Object.entries(entry.parameters)) {
        if (pointer !== parameter.pointer && !pointer.startsWith(`${parameter.pointer}/`)) continue;
        const keys = keysOf(pointer.slice(parameter.pointer.length)), count = parameter.text?.split(",").length ?? 0;
        const part = keys.length === 0 ? "" : keys.length === 1 ? ` ${axis(keys[0], count)}` : ` ${Number(keys[0]) + 1} ${axis(keys[1], 3)}`;
        const isPlain = name === "by" && part !== "";
        const title = isPlain ? part.trim() : titleOf(name) + part, of = nameOf(entry, this.catalogue);
        return {parameter: title, of, text: `${title} of ${of}`};
      }
    }
    return {parameter: keysOf(pointer).at(-1), of: "", text: pointer};
  }
}
