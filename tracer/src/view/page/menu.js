// Menus, and lists to choose from. They close on Escape, on a click elsewhere, and after a choice.
import {make, newId} from "./dom.js";
import {icon} from "./icons.js";

// Places a popup below its button, or above if there is more room.
export function openBeside(popup, button) {
  document.body.append(popup);
  popup.showPopover();
  const at = button.getBoundingClientRect(), box = popup.getBoundingClientRect();
  const below = at.bottom + 4, hasRoom = below + box.height <= innerHeight || at.top < innerHeight / 2;
  popup.style.left = `${Math.max(8, Math.min(at.left, innerWidth - box.width - 8))}px`;
  popup.style.top = `${hasRoom ? Math.min(below, Math.max(8, innerHeight - box.height - 8)) : Math.max(8, at.top - box.height - 4)}px`;
}

// Removes a popup when it closes, and gives the keyboard back to its button.
export function closeWith(popup, button, after = () => {}) {
  popup.addEventListener("toggle", (event) => {
    if (event.newState !== "closed") return;
    const hadFocus = popup.contains(document.activeElement) || document.activeElement === document.body;
    popup.remove();
    button.setAttribute("aria-expanded", "false");
    if (hadFocus) button.focus();
    after();
  });
}

function moveFocus(popup, event) {
  const items = [...popup.querySelectorAll("[role=menuitem], [role=option]")].filter((item) => !item.disabled);
  const at = items.indexOf(document.activeElement);
  const next = {ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1}[event.key];
  if (next !== undefined) {
    event.preventDefault();
    items.at(next % items.length)?.focus();
  } else if (event.key.length === 1 && /\S/.test(event.key) && !event.ctrlKey) {
    const from = items.slice(at + 1).concat(items);
    from.find((item) => item.textContent.trim().toLowerCase().startsWith(event.key.toLowerCase()))?.focus();
  } else if (event.key === "Tab") {
    popup.hidePopover();
  }
  event.stopPropagation();
}

// Items: {text, icon, swatch, keys, isChosen, isOff, why, run} or null for a line between them.
export function openMenu(button, items, {role = "menu", label = ""} = {}) {
  const popup = make("div", {class: "popup menu", role, "aria-label": label, popover: "auto"});
  for (const item of items) {
    if (item === null) {
      popup.append(make("hr"));
      continue;
    }
    popup.append(make("button", {
      type: "button", role: role === "menu" ? "menuitem" : "option", class: "item", disabled: item.isOff ?? false, title: item.why ?? "",
      "aria-selected": role === "listbox" ? String(Boolean(item.isChosen)) : undefined,
      onclick: () => {
        popup.hidePopover();
        item.run();
      },
    }, item.swatch ?? (item.icon ? icon(item.icon) : null), make("span", {class: "text"}, item.text),
      item.isChosen ? icon("check") : null, item.keys ? make("kbd", {}, item.keys) : null));
  }
  popup.addEventListener("keydown", (event) => moveFocus(popup, event));
  button.setAttribute("aria-expanded", "true");
  closeWith(popup, button);
  openBeside(popup, button);
  (popup.querySelector("[aria-selected=true]") ?? popup.querySelector("button:not(:disabled)"))?.focus();
  return popup;
}

// A button that shows the choice made, and opens a list of {value, text, swatch}.
export class Choice {
  #options = [];
  #value = null;
  #changed;

  constructor(label, changed) {
    this.#changed = changed;
    this.text = make("span", {class: "text"});
    this.element = make("button", {
      type: "button", class: "choice", role: "combobox", "aria-haspopup": "listbox", "aria-expanded": "false", "aria-label": label,
      onclick: () => this.#open(),
      onkeydown: (event) => {
        if (!["ArrowDown", "ArrowUp"].includes(event.key)) return;
        event.preventDefault();
        this.#open();
      },
    }, this.text, icon("down"));
    this.label = label;
  }
  #open() {
    if (this.#options.length === 0) return;
    openMenu(this.element, this.#options.map((option) => ({
      ...option,
      swatch: option.swatch?.(),
      isChosen: this.#isChosen(option.value),
      run: () => this.#changed(option.value),
    })), {role: "listbox", label: this.label});
  }
  #isChosen(value) {
    return JSON.stringify(value) === JSON.stringify(this.#value);
  }
  show(options, value, fallback = "") {
    this.#options = options;
    this.#value = value;
    const chosen = options.find((option) => this.#isChosen(option.value));
    this.text.replaceChildren(...[chosen?.swatch?.(), chosen?.text ?? fallback].filter(Boolean));
    this.text.classList.toggle("faint", !chosen);
  }
}

// Shows a Choice in place of a <select>, which keeps the value: all lists look and work the same.
export function replaceSelect(select) {
  const label = select.getAttribute("aria-label") ?? document.querySelector(`label[for="${select.id}"]`)?.textContent.trim() ?? "";
  const choice = new Choice(label, (value) => {
    select.value = value;
    select.dispatchEvent(new Event("change"));
    show();
  });
  choice.element.id = newId("choice");
  const show = () => choice.show([...select.options].map((o) => ({value: o.value, text: o.text})), select.value);
  select.classList.add("replaced");
  select.tabIndex = -1;
  select.setAttribute("aria-hidden", "true");
  select.after(choice.element);
  choice.refresh = show;
  select.addEventListener("change", show);
  show();
  return choice;
}
