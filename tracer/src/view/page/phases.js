// The list of phases: a checkbox for each, and the editable properties of its material. The elements are recreated only
// if the phases or the kinds of their materials change, so that the focus is kept.
import {hexOf} from "./colour.js";
import {ColourField} from "./colour_field.js";

const usualIor = 1.5, usualRoughness = 0;

// {name: look} of the phases that differ from the file.
function looksOf(phases) {
  const changed = phases.filter((phase) => Object.keys(phase.look).length > 0);
  return Object.fromEntries(changed.map((phase) => [phase.name, {...phase.look}]));
}

function labelled(text, type, members) {
  const label = document.createElement("label"), input = document.createElement("input");
  Object.assign(input, {type, ...members});
  label.append(text, input);
  return {label, input};
}

const colourOf = (phase) => hexOf(phase.look.color ?? phase.color ?? [0.5, 0.5, 0.5]);
const valuesOf = {
  ior: (phase) => phase.ior ?? usualIor,
  roughness: (phase) => phase.roughness ?? usualRoughness,
};

class Row {
  #phase;
  #inputs = {};
  #colour = null;

  constructor(phase, actions) {
    this.element = document.createElement("div");
    const shown = labelled("", "checkbox", {value: phase.name});
    shown.label.append(phase.name);
    this.box = shown.input;
    this.box.addEventListener("change", () => actions.hide());
    const details = document.createElement("details"), summary = document.createElement("summary");
    summary.textContent = `Material of ${phase.name}`;
    details.append(summary, ...this.#editors(phase, actions));
    this.element.append(shown.label, details);
  }
  #editors(phase, actions) {
    const edit = (member) => actions.look(phase.name, member);
    const clear = labelled("", "checkbox", {});
    clear.label.append("Clear");
    clear.input.addEventListener("change", () => edit({clear: clear.input.checked}));
    this.#inputs.clear = clear.input;
    const parts = [clear.label];
    const add = (member, text, type, members) => {
      const {label, input} = labelled(text, type, members);
      input.addEventListener("input", () => edit({[member]: Number(input.value)}));
      this.#inputs[member] = input;
      parts.push(label);
    };
    if (phase.has.color) {
      this.#colour = new ColourField(`Colour of ${phase.name}`, (hex) => edit({color: hex}));
      parts.push(this.#colour.element);
    }
    if (phase.has.ior) add("ior", "Index", "range", {min: 1, max: 2.5, step: 0.01});
    if (phase.has.roughness) add("roughness", "Roughness", "range", {min: 0, max: 1, step: 0.01});
    const reset = document.createElement("button");
    Object.assign(reset, {type: "button", textContent: "Reset material"});
    reset.setAttribute("aria-label", `Reset material of ${phase.name}`);
    reset.addEventListener("click", () => actions.look(phase.name, null));
    parts.push(reset);
    return parts;
  }
  isOf(phase) {
    return this.#phase.name === phase.name && this.#phase.kind === phase.kind;
  }
  show(phase) {
    this.#phase = phase;
    this.box.checked = !phase.hidden;
    this.#inputs.clear.checked = phase.kind === "clear";
    // A phase that is clear in the file stays clear.
    this.#inputs.clear.disabled = phase.kind_in_file === "clear";
    this.#colour?.show(colourOf(phase));
    for (const [member, value] of Object.entries(valuesOf)) {
      const input = this.#inputs[member];
      if (!input) continue;
      if (input !== document.activeElement) input.value = value(phase);
      if (input.type === "range") input.setAttribute("aria-valuetext", Number(input.value).toFixed(2));
    }
  }
}

export class PhaseList {
  #fieldset;
  #changed;
  #rows = [];
  #looks = {};

  constructor(fieldset, changed) {
    this.#fieldset = fieldset;
    this.#changed = changed;
  }
  show(phases) {
    this.#looks = looksOf(phases);
    const isSame = this.#rows.length === phases.length && this.#rows.every((row, i) => row.isOf(phases[i]));
    if (!isSame) this.#make(phases);
    this.#rows.forEach((row, i) => row.show(phases[i]));
  }
  #make(phases) {
    const actions = {
      hide: () => this.#changed({hidden: this.#rows.filter((row) => !row.box.checked).map((row) => row.box.value)}),
      look: (name, member) => {
        if (member === null) delete this.#looks[name];
        else this.#looks[name] = {...this.#looks[name], ...member};
        this.#changed({looks: {...this.#looks}});
      },
    };
    const open = new Set(this.#rows.filter((row) => row.element.querySelector("details").open).map((row) => row.box.value));
    const focused = document.activeElement?.closest?.("#phases > div")?.querySelector("input")?.value;
    this.#rows.forEach((row) => row.element.remove());
    this.#rows = phases.map((phase) => new Row(phase, actions));
    this.#rows.forEach((row, i) => {
      row.element.querySelector("details").open = open.has(phases[i].name);
      this.#fieldset.append(row.element);
      // A material of another kind has other sliders, so move the keyboard focus to the phase.
      if (focused === phases[i].name) row.element.querySelector("details input").focus();
    });
    this.#rows.forEach((row, i) => row.show(phases[i]));
  }
}
