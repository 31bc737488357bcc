// A colour: a swatch that opens sliders for hue, saturation and brightness, and a field for hexadecimal sRGB.
import {hexOf, hexOfHsv, hsvOf, isHex} from "./colour.js";
import {make, newId} from "./dom.js";
import {closeWith, openBeside} from "./menu.js";

const usual = ["#ffffff", "#c8c8c8", "#808080", "#202020", "#b03030", "#d07030", "#d8b040", "#50803c", "#2f6f80", "#3050a0", "#6a4090", "#8a5a3a"];
const sliders = [["Hue", 360], ["Saturation", 100], ["Brightness", 100]];

let measured = []; // {name, group, color} of the catalogue

export function setMeasuredColours(colours) {
  measured = colours.map(({name, group, color}) => ({name, group, hex: hexOf(color), text: name.replaceAll("_", " ").replace(/(?<=[a-z])(?=\d)/, " ")}));
}

// A patch in the colour of a measured substance, or null.
export function measuredSwatch(name) {
  const found = measured.find((one) => one.name === name);
  if (!found) return null;
  const swatch = make("span", {class: "swatch", "aria-hidden": "true"});
  swatch.style.setProperty("--swatch", found.hex);
  return swatch;
}

export class ColourField {
  #hex = "#808080";
  #changed;
  #label;
  #popup = null;

  // `changed` gets hexadecimal sRGB and the name of the gesture.
  constructor(label, changed) {
    this.#changed = changed;
    this.#label = label;
    this.button = make("button", {
      type: "button", class: "swatch-button", "aria-label": `${label}: choose a colour`, "aria-haspopup": "dialog", "aria-expanded": "false",
      onclick: () => this.#open(),
    });
    this.input = make("input", {
      type: "text", class: "hex", spellcheck: false, autocomplete: "off", "aria-label": `${label}, as hexadecimal sRGB`,
      onchange: () => this.#type(this.input),
    });
    this.element = make("div", {class: "colour"}, this.button, this.input);
  }
  show(colour, isDefault = false) {
    this.#hex = hexOf(colour);
    this.button.style.setProperty("--swatch", this.#hex);
    if (this.input !== document.activeElement) this.input.value = isDefault ? "" : this.#hex;
    this.input.placeholder = this.#hex;
  }
  showNone() {
    this.button.style.setProperty("--swatch", "transparent");
    this.input.placeholder = "none";
  }
  #type(input) {
    if (!isHex(input.value)) {
      input.value = this.#hex;
      return;
    }
    const text = input.value.trim().toLowerCase();
    const digits = text.replace("#", "");
    this.#set(`#${digits.length === 3 ? [...digits].map((d) => d + d).join("") : digits}`, null);
  }
  #set(hex, gesture) {
    this.show(hex);
    this.#changed(hex, gesture);
  }
  #open() {
    const hsv = hsvOf(this.#hex), popup = make("div", {class: "popup colours", role: "dialog", "aria-label": this.#label, popover: "auto"});
    const preview = make("div", {class: "preview"});
    let gesture = newId("colour");
    const showAll = () => {
      preview.style.setProperty("--swatch", this.#hex);
      popup.style.setProperty("--hue", hexOfHsv([hsv[0], 1, 1]));
      popup.style.setProperty("--full", hexOfHsv([hsv[0], hsv[1], 1]));
    };
    const inputs = sliders.map(([name, most], i) => {
      const input = make("input", {
        type: "range", min: 0, max: most, step: 1, value: String(Math.round(hsv[i] * (i === 0 ? 1 : 100))), class: name.toLowerCase(),
        oninput: () => {
          hsv[i] = Number(input.value) / (i === 0 ? 1 : 100);
          this.#set(hexOfHsv(hsv), gesture);
          showAll();
        },
        onchange: () => { gesture = newId("colour"); },
      });
      popup.append(make("label", {}, name, input));
      return input;
    });
    const choose = (hex) => {
      hsvOf(hex).forEach((x, i) => {
        hsv[i] = x;
        inputs[i].value = Math.round(x * (i === 0 ? 1 : 100));
      });
      this.#set(hex, null);
      showAll();
    };
    const patches = (title, colours) => make("div", {class: "swatches", role: "group", "aria-label": title}, colours.map(({hex, text}) => {
      const button = make("button", {type: "button", class: "swatch-button", "aria-label": text, title: text, onclick: () => choose(hex)});
      button.style.setProperty("--swatch", hex);
      return button;
    }));
    popup.append(patches("Usual colours", usual.map((hex) => ({hex, text: hex}))));
    for (const group of [...new Set(measured.map((one) => one.group))])
      popup.append(make("h3", {}, `Measured ${group}`), patches(`Measured ${group}`, measured.filter((one) => one.group === group)));
    popup.prepend(preview);
    showAll();
    closeWith(popup, this.button);
    openBeside(popup, this.button);
    this.button.setAttribute("aria-expanded", "true");
    inputs[0].focus();
  }
}
