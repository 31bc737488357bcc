// The numbers in the scene file, as sliders. Only a few are shown at a time: those whose path in the file contains the
// words of the filter, or those of one node.

const mostRows = 12;

// The names on the path to a number, without those that occur in every tree: "translate by 2".
function placeOf(pointer) {
  const names = pointer.slice(1).split("/").map((name) => name.replaceAll("~1", "/").replaceAll("~0", "~"));
  const telling = names.filter((name) => !["tree", "of"].includes(name));
  return telling.slice(-4).join(" ");
}

// A slider ranges from zero to twice the file's value.
function rangeAround(value) {
  return value === 0 ? [-1, 1] : [Math.min(0, 2 * value), Math.max(0, 2 * value)];
}

class Row {
  constructor(number, changed) {
    this.number = number;
    this.element = document.createElement("div");
    const label = document.createElement("label");
    const name = `${placeOf(number.pointer)} (line ${number.line})`;
    label.textContent = name;
    label.title = number.pointer;
    const [min, max] = rangeAround(number.value);
    this.slider = Object.assign(document.createElement("input"), {type: "range", min, max, step: "any"});
    this.field = Object.assign(document.createElement("input"), {type: "number", step: "any"});
    this.field.setAttribute("aria-label", `${name}, as a number`);
    label.append(this.slider);
    this.slider.addEventListener("input", () => this.#set(Number(Number(this.slider.value).toPrecision(4)), changed));
    this.field.addEventListener("change", () => {
      if (this.field.value !== "" && this.field.checkValidity()) this.#set(Number(this.field.value), changed);
    });
    this.element.append(label, this.field);
  }
  #set(value, changed) {
    this.show(value);
    changed(this.number, value);
  }
  show(value) {
    if (this.slider !== document.activeElement || Number(this.slider.value) !== value) this.slider.value = value;
    this.field.value = value;
    this.slider.setAttribute("aria-valuetext", String(value));
    this.element.classList.toggle("changed", value !== this.number.value);
  }
}

export class Numbers {
  #elements;
  #changed;
  #all = [];
  #hasMore = false;
  #rows = [];
  #edits = {};
  #version = null;
  #node = null;

  // `elements` are those of the section: filter, rows, said. `changed` receives all numbers that differ from the
  // file's.
  constructor(elements, changed) {
    this.#elements = elements;
    this.#changed = changed;
    elements.filter.addEventListener("input", () => {
      this.#node = null;
      this.#make();
    });
  }
  // Shows the numbers of one node: those whose pointers begin with the node's.
  showNode(name, pointer) {
    this.#node = {name, pointer};
    this.#elements.filter.value = "";
    this.#make();
  }
  reset() {
    this.#changed({numbers: {}});
  }
  // Requests the numbers if the file has been read again.
  async show(state, ask) {
    this.#edits = state.numbers;
    if (state.numbers_version !== this.#version) {
      const version = state.numbers_version;
      this.#version = version;
      const told = await ask().catch((error) => {
        if (this.#version === version) this.#version = null; // request them again
        throw error;
      });
      // The file has been read again, and a newer answer may already have arrived.
      if (this.#version !== version) return;
      this.#all = told.numbers;
      this.#hasMore = told.has_more;
      this.#make();
    }
    this.#showValues();
  }
  #isShown(number) {
    if (this.#node) return number.pointer === this.#node.pointer || number.pointer.startsWith(`${this.#node.pointer}/`);
    const place = number.pointer.toLowerCase();
    return this.#elements.filter.value.toLowerCase().split(/\s+/).every((word) => place.includes(word));
  }
  #make() {
    const shown = this.#all.filter((number) => this.#isShown(number));
    const change = (number, value) => {
      const edits = {...this.#edits, [number.pointer]: value};
      if (value === number.value) delete edits[number.pointer];
      this.#edits = edits;
      this.#changed({numbers: edits});
    };
    this.#rows = shown.slice(0, mostRows).map((number) => new Row(number, change));
    this.#elements.rows.replaceChildren(...this.#rows.map((row) => row.element));
    const of = this.#node ? ` of ${this.#node.name}` : "";
    const more = shown.length > mostRows ? `The first ${mostRows} of ${shown.length}${of}.` : `${shown.length}${of}.`;
    this.#elements.said.textContent = more + (this.#hasMore ? " The file contains more numbers, which are not listed." : "");
    this.#showValues();
  }
  #showValues() {
    for (const row of this.#rows)
      if (row.field !== document.activeElement) row.show(this.#edits[row.number.pointer] ?? row.number.value);
  }
}
