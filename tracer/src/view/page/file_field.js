// A file name: typed, or chosen from the files beside the scene that the parameter can read.
import {make} from "./dom.js";
import {icon} from "./icons.js";
import {openMenu} from "./menu.js";
import {askFiles} from "./server.js";

const most = 200; // in the list

export class FileField {
  #changed;
  #of;

  // `of()` returns {type, kind} of the entry that the file belongs to.
  constructor(label, of, changed) {
    this.#changed = changed;
    this.#of = of;
    this.label = label;
    this.input = make("input", {type: "text", class: "line", spellcheck: false, autocomplete: "off", "aria-label": label, onchange: () => changed(this.input.value)});
    this.button = make("button", {
      type: "button", class: "icon-button small", "aria-label": `${label}: choose a file`, title: "Choose a file from the scene's folder", "aria-haspopup": "listbox", "aria-expanded": "false",
      onclick: () => this.#open(),
    }, icon("folder"));
    this.element = make("div", {class: "file-field"}, this.input, this.button);
  }
  async #open() {
    const {type, kind} = this.#of();
    let told;
    try {
      told = await askFiles(type, kind);
    } catch (error) {
      told = {names: [], has_more: false, why: error.message};
    }
    const items = told.names.slice(0, most).map((name) => ({text: name, isChosen: name === this.input.value, run: () => this.#choose(name)}));
    const say = (text) => items.push({text, isOff: true, run: () => {}});
    if (told.why) say(told.why);
    else if (items.length === 0) say("No matching files in the scene's folder or its subfolders");
    else if (told.has_more || told.names.length > most) say("There are more files. Type the name.");
    openMenu(this.button, items, {role: "listbox", label: this.label});
  }
  #choose(name) {
    this.input.value = name;
    this.#changed(name);
  }
  show(value, placeholder) {
    if (this.input !== document.activeElement) this.input.value = value ?? "";
    this.input.placeholder = placeholder;
  }
}
