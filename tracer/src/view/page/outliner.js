// The tree of what is in the scene: chosen by pointer or keyboard, filtered by words, and put in order by dragging.
import {fits} from "./catalogue.js";
import {arrange, make} from "./dom.js";
import {icon, iconOf} from "./icons.js";
import {nameOf, remarkOf} from "./names.js";
import {indexOf, isInList, isSection, listOf, slotOf, typeOfPlace} from "./structure.js";
import {isWithin, parentOf} from "./pointer.js";
import {isHidden, lookOf, swatchOf} from "./swatch.js";
import {hiddenParts} from "./hidden_parts.js";

const pixelsToDrag = 5;

const isPhase = (entry) => entry.type === "material" && /^\/phases\/[^/]*$/.test(entry.pointer);

export class Outliner {
  #scene;
  #selection;
  #catalogue = null;
  #elements;
  #act;
  #closed = new Set();   // pointers of entries whose children are hidden
  #shown = [];           // entries in the order of the rows
  #rows = new Map();     // by key
  #looks = new Map();    // for each key, a string that changes whenever the row must look different
  #anchor = null;

  // `elements` are those of the panel: tree, search. `act` has menu(entry, row, event), drop(entry, place), rename(entry),
  // add(section), hide(phase, isHidden) and openEdit().
  constructor(elements, {scene, selection, act}) {
    this.#elements = elements;
    this.#scene = scene;
    this.#selection = selection;
    this.#act = act;
    elements.search.addEventListener("input", () => this.show());
    elements.search.addEventListener("keydown", (event) => {
      if (event.key === "ArrowDown") this.#rows.get(this.#shown[0]?.key)?.focus();
      if (event.key === "Escape") {
        elements.search.value = "";
        this.show();
      }
    });
    elements.tree.addEventListener("keydown", (event) => this.#press(event));
    selection.addEventListener("change", () => this.#showSelection());
  }
  use(catalogue) {
    this.#catalogue = catalogue;
    this.show();
  }
  #isOpen(entry) {
    return this.#elements.search.value !== "" || !this.#closed.has(entry.key);
  }
  #matches(entry) {
    const words = this.#elements.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    if (words.length === 0) return true;
    const text = `${nameOf(entry, this.#catalogue)} ${entry.kind} ${this.#catalogue.titleOf(entry)} ${(entry.phases ?? []).join(" ")}`.toLowerCase();
    return words.every((word) => text.includes(word)) || (entry.children ?? []).some((child) => this.#matches(child));
  }
  #list(entries, level) {
    for (const entry of entries) {
      if (!this.#matches(entry)) continue;
      this.#shown.push(entry);
      entry.level = level;
      if (this.#isOpen(entry)) this.#list(entry.children ?? [], level + 1);
    }
  }
  show() {
    if (!this.#catalogue || !this.#scene.hasOutline) return;
    const {tree} = this.#elements, focused = document.activeElement?.closest?.("[data-key]")?.dataset.key, scroll = tree.scrollTop;
    const hadFocus = tree.contains(document.activeElement);
    this.#shown = [];
    this.#list(this.#scene.outline, 1);
    const before = [...this.#rows.values()];
    this.#rows = new Map(this.#shown.map((entry) => [entry.key, this.#rowOf(entry)]));
    const rows = [...this.#rows.values()], isSame = rows.length === before.length && rows.every((row, i) => row === before[i]);
    if (!isSame || rows.length === 0) {
      arrange(tree, rows);
      tree.scrollTop = scroll;
      if (rows.length === 0) tree.append(make("p", {class: "faint empty"}, "No matches."));
    }
    this.#markSelection();
    if (hadFocus && !isSame) (this.#rows.get(focused) ?? this.#rows.get(this.#selection.active) ?? [...this.#rows.values()][0])?.focus();
  }
  // The row of an entry. Reuses the existing row if its appearance is unchanged, which keeps dragging a number fast.
  #rowOf(entry) {
    const parts = {
      name: nameOf(entry, this.#catalogue), remark: remarkOf(entry, this.#catalogue), hasChildren: entry.children.length > 0, open: this.#isOpen(entry),
      phases: entry.type === "material" && entry.label ? [entry.label] : entry.phases.slice(0, 4),
    };
    const look = JSON.stringify([parts, entry.kind, entry.type, entry.level, parts.phases.map(lookOf), hiddenParts.has(entry), hiddenParts.isInHidden(entry)]), old = this.#rows.get(entry.key);
    if (old && this.#looks.get(entry.key) === look) return old;
    this.#looks.set(entry.key, look);
    return this.#row(entry, parts);
  }
  #row(entry, {name, remark, hasChildren, open, phases}) {
    const {key} = entry, now = () => this.#shown.find((one) => one.key === key);
    const row = make("div", {
      class: isSection(entry) ? "row section" : "row", role: "treeitem", tabIndex: -1, "aria-level": entry.level, "data-key": entry.key,
      "aria-expanded": hasChildren ? String(open) : undefined, "aria-selected": "false", title: this.#catalogue.titleOf(entry),
    }, make("span", {class: hasChildren ? "twist" : "twist none", "aria-hidden": "true", onclick: (event) => {
      event.stopPropagation();
      this.#toggle(now());
    }}, icon("chevron")), icon(iconOf(entry)), make("span", {class: "name"}, name), remark ? make("span", {class: "remark"}, remark) : null,
      isSection(entry) ? null : make("span", {class: "swatches"}, phases.map(swatchOf)));
    row.style.setProperty("--level", entry.level - 1);
    if (isSection(entry) && ["lights", "meshes", "phases"].includes(entry.name)) row.append(make("button", {
      type: "button", class: "icon-button small", "aria-label": `Add to ${name.toLowerCase()}`, title: `Add to ${name.toLowerCase()}`, tabIndex: -1,
      onclick: (event) => {
        event.stopPropagation();
        this.#act.add(now());
      },
    }, icon("add")));
    const beforeEye = row.querySelector(".swatches");
    if (isPhase(entry)) beforeEye.before(this.#eye(`${entry.label} in the picture`, isHidden(entry.label), (isOff) => this.#act.hide(entry.label, isOff)));
    if (hiddenParts.canHide(entry)) {
      beforeEye.before(this.#eye(name, hiddenParts.has(entry), (isOff) => this.#act.hideParts([now().pointer], isOff)));
      row.classList.toggle("is-hidden", hiddenParts.isInHidden(entry));
    }
    row.addEventListener("click", (event) => this.#choose(now(), event));
    row.addEventListener("dblclick", () => (entry.label && !isSection(entry) ? this.#act.rename(now()) : this.#toggle(now())));
    row.addEventListener("contextmenu", (event) => {
      event.preventDefault();
      if (!this.#selection.has(key)) this.#selection.set([key]);
      this.#act.menu(now(), row);
    });
    row.addEventListener("pointerdown", (event) => this.#grab(now(), row, event));
    return row;
  }
  // A button that hides something in the picture or shows it again.
  #eye(what, isOff, hide) {
    const text = `${isOff ? "Show" : "Hide"} ${what}`;
    return make("button", {
      type: "button", class: `icon-button small eye${isOff ? " off" : ""}`, "aria-label": text, "aria-pressed": String(isOff), title: text, tabIndex: -1,
      onclick: (event) => {
        event.stopPropagation();
        hide(!isOff);
      },
    }, icon(isOff ? "eye-off" : "eye"));
  }
  #toggle(entry, open = this.#closed.has(entry.key)) {
    if (open) this.#closed.delete(entry.key);
    else this.#closed.add(entry.key);
    this.show();
  }
  #choose(entry, event) {
    this.#rows.get(entry.key)?.focus();
    if (event.ctrlKey || event.metaKey) {
      this.#selection.toggle(entry.key);
    } else if (event.shiftKey && this.#anchor) {
      const keys = this.#shown.map((e) => e.key), a = keys.indexOf(this.#anchor), b = keys.indexOf(entry.key);
      const range = keys.slice(Math.min(a, b), Math.max(a, b) + 1);
      this.#selection.set([...range.filter((key) => key !== entry.key), entry.key]);
      return;
    } else {
      this.#selection.set([entry.key]);
    }
    this.#anchor = entry.key;
  }
  #showSelection() {
    this.#markSelection();
    this.#rows.get(this.#selection.active)?.scrollIntoView({block: "nearest"});
  }
  #markSelection() {
    const active = this.#selection.active;
    for (const [key, row] of this.#rows) {
      row.setAttribute("aria-selected", String(this.#selection.has(key)));
      row.classList.toggle("active", key === active);
      row.tabIndex = key === active ? 0 : -1;
    }
    if (!this.#rows.has(active) && this.#shown.length > 0) this.#rows.get(this.#shown[0].key).tabIndex = 0;
  }
  // Makes an entry's row visible.
  reveal(pointer) {
    let changed = false;
    for (let entry = this.#scene.entry(pointer)?.parent; entry; entry = entry.parent) changed = this.#closed.delete(entry.key) || changed;
    if (changed) this.show();
    else this.#rows.get(pointer)?.scrollIntoView({block: "nearest"});
  }
  #press(event) {
    const row = event.target.closest("[data-key]");
    if (!row || event.altKey) return;
    const at = this.#shown.findIndex((entry) => entry.key === row.dataset.key), entry = this.#shown[at];
    if (!entry) return;
    const go = (to) => {
      const next = this.#shown[Math.max(0, Math.min(this.#shown.length - 1, to))];
      this.#rows.get(next.key).focus();
      if (event.shiftKey) this.#selection.set([...this.#selection.pointers.filter((p) => p !== next.key), next.key]);
      else if (!event.ctrlKey) this.#selection.set([next.key]);
    };
    const hasChildren = (entry.children ?? []).length > 0, open = this.#isOpen(entry);
    if (event.key === "ArrowDown") go(at + 1);
    else if (event.key === "ArrowUp") go(at - 1);
    else if (event.key === "Home") go(0);
    else if (event.key === "End") go(this.#shown.length - 1);
    else if (event.key === "ArrowRight" && hasChildren && !open) this.#toggle(entry, true);
    else if (event.key === "ArrowRight") go(hasChildren ? at + 1 : at);
    else if (event.key === "ArrowLeft" && hasChildren && open) this.#toggle(entry, false);
    else if (event.key === "ArrowLeft" && entry.parent) go(this.#shown.indexOf(entry.parent));
    else if (event.key === " ") this.#selection.toggle(entry.key);
    else if (event.key === "Enter") this.#act.openEdit();
    else if (event.key === "F2" && entry.label) this.#act.rename(entry);
    else if (event.key === "ContextMenu" || (event.key === "F10" && event.shiftKey)) this.#act.menu(entry, row);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
  // Dragging a row by the mouse moves its entry into another list, or elsewhere in its own.
  #grab(entry, row, event) {
    if (event.button !== 0 || event.pointerType === "touch" || !isInList(entry)) return;
    const from = [event.clientX, event.clientY];
    let place = null, isDragged = false;
    const mark = make("div", {class: "drop-mark"});
    const move = (now) => {
      if (!isDragged && Math.hypot(now.clientX - from[0], now.clientY - from[1]) < pixelsToDrag) return;
      isDragged = true;
      row.classList.add("dragged");
      place = this.#placeAt(entry, now.clientX, now.clientY);
      mark.remove();
      if (place) this.#showPlace(place, mark);
    };
    const end = (now) => {
      document.removeEventListener("pointermove", move);
      document.removeEventListener("pointerup", end);
      document.removeEventListener("pointercancel", end);
      row.classList.remove("dragged");
      mark.remove();
      for (const other of this.#rows.values()) other.classList.remove("drop-into");
      if (isDragged && place && now.type === "pointerup") this.#act.drop(entry, place.pointer);
    };
    // Listen on the document, not on the row: a fast pointer may have left the row before its first event.
    document.addEventListener("pointermove", move);
    document.addEventListener("pointerup", end);
    document.addEventListener("pointercancel", end);
  }
  // Where an entry dropped at a position of the window would go: before or after a row, or into it.
  #placeAt(entry, x, y) {
    const row = document.elementFromPoint(x, y)?.closest?.("[data-key]");
    const target = row && this.#shown.find((e) => e.key === row.dataset.key);
    if (!target || target === entry || isWithin(target.pointer, entry.pointer)) return null;
    const box = row.getBoundingClientRect(), share = (y - box.top) / box.height;
    const slot = (target.slots ?? []).find((s) => s.list && fits(s.type, entry.type));
    const besides = isInList(target) && fits(typeOfPlace(target), entry.type) && (slotOf(target) !== null || listOf(target) === listOf(entry));
    if (slot && (!besides || (share > 0.25 && share < 0.75))) return {row, side: "into", pointer: `${slot.pointer}/-`};
    if (!besides) return null;
    if (share < 0.5) return {row, side: "before", pointer: target.pointer};
    const next = `${parentOf(target.pointer)}/${indexOf(target) + 1}`;
    return {row, side: "after", pointer: this.#scene.entry(next) ? next : `${listOf(target)}/-`};
  }
  #showPlace({row, side}, mark) {
    for (const other of this.#rows.values()) other.classList.toggle("drop-into", side === "into" && other === row);
    if (side === "before") row.before(mark);
    if (side === "after") row.after(mark);
  }
}
