// The parameters of what is selected. A chain of nodes with one child each, such as a filled and moved sphere, is shown as
// one.
import {plainText, summaryOf} from "./catalogue.js";
import {combiningFigure, isCombining} from "./combining.js";
import {make} from "./dom.js";
import {icon, iconOf} from "./icons.js";
import {isPlacing, nameOf} from "./names.js";
import {ParameterRow, titleOf} from "./parameter_row.js";
import {joined} from "./pointer.js";
import {shortMessage} from "./server.js";
import {chainOf, isNode, isSection, membersOf, pathTo, pointerOf} from "./structure.js";
import {swatchOf} from "./swatch.js";

const mostAtOnce = 9; // parameters shown before the rest is folded

class Section {
  rows = [];

  constructor(entry, kind, inspector, isFirst) {
    this.pointer = entry.pointer;
    this.kind = entry.kind;
    const {catalogue, context} = inspector;
    const title = isPlacing(entry) ? nameOf(entry, catalogue) : kind?.title ?? nameOf(entry, catalogue);
    this.element = make("section", {class: "node", "aria-label": title});
    if (!isFirst) this.element.append(make("h3", {}, make("button", {
      type: "button", class: "node-title", title: "Select only this", onclick: () => inspector.select(entry.pointer),
    }, icon(iconOf(entry)), title)));
    this.#addRows(entry, kind, context);
    this.slots = make("div", {class: "slots"});
    this.element.append(this.slots);
  }
  #addRows(entry, kind, context) {
    const slotNames = new Set((kind?.slots ?? []).map((slot) => slot.name));
    const specs = (kind?.parameters ?? []).filter((spec) => !slotNames.has(spec.name) && spec.control !== "slot");
    const known = new Set(specs.map((spec) => spec.name));
    for (const name of Object.keys(entry.parameters ?? {}))
      if (!known.has(name) && !slotNames.has(name)) specs.push({name, control: "json", default: null, help: "", required: false});
    const isEager = (spec) => spec.required || entry.parameters?.[spec.name] !== undefined;
    const first = specs.length <= mostAtOnce ? specs : specs.filter(isEager), rest = specs.filter((spec) => !first.includes(spec));
    this.rows = [...first, ...rest].map((spec) => new ParameterRow(spec, context));
    this.element.append(...this.rows.slice(0, first.length).map((row) => row.element));
    if (rest.length > 0) this.element.append(make("details", {class: "rest"},
      make("summary", {}, icon("chevron"), `${rest.length} more, at their defaults`), ...this.rows.slice(first.length).map((row) => row.element)));
  }
  show(entry, inspector, isLast) {
    const filled = new Set(entry.children.map((child) => child.slot));
    for (const row of this.rows) {
      row.show(entry);
      row.element.hidden = filled.has(row.spec.name); // such as a colour that is a texture
    }
    const own = new Set((inspector.catalogue.of(entry)?.slots ?? []).map((slot) => slot.name));
    const slots = isLast ? entry.slots.filter((slot) => own.has(slot.name) || filled.has(slot.name)) : [];
    this.slots.replaceChildren(...slots.flatMap((slot) => inspector.slotRows(entry, slot)));
  }
}

export class Inspector {
  #elements;
  #scene;
  #selection;
  #sections = [];
  #signature = "";

  // `elements` are those of the panel: head, body. `act` has the actions that the buttons at the top offer, and rename.
  constructor(elements, {scene, selection, act, radius, failed}) {
    this.#elements = elements;
    this.#scene = scene;
    this.#selection = selection;
    this.act = act;
    this.catalogue = null;
    this.context = {
      radius,
      phases: () => (scene.section("phases")?.children ?? []).map((entry) => entry.label),
      set: (entry, name, text, gesture, row, index) => this.#perform(row, {
        label: `Change ${titleOf(name).toLowerCase()} of ${nameOf(entry, this.catalogue).toLowerCase()}`,
        merge: gesture,
        operations: [{set: index === undefined ? pointerOf(entry, name) : joined(pointerOf(entry, name), index), to: text}],
      }),
      fill: (entry, slot) => act.addTo(entry, {...slot, pointer: joined(membersOf(entry), slot.name)}),
      reset: (entry, name, row) => this.#perform(row, {
        label: `Reset ${titleOf(name).toLowerCase()}`,
        operations: [{remove: pointerOf(entry, name)}],
      }),
    };
    this.failed = failed;
    selection.addEventListener("change", () => this.show());
  }
  async #perform(row, step) {
    try {
      await this.#scene.perform(step);
      row.fail("");
    } catch (error) {
      row.fail(shortMessage(error));
      this.failed(error);
    }
  }
  use(catalogue) {
    this.catalogue = catalogue;
    this.show();
  }
  select(pointer) {
    this.#selection.set([pointer]);
  }
  show() {
    const {head, body} = this.#elements;
    if (!this.catalogue) return;
    const keys = this.#selection.pointers, entry = this.#scene.entry(this.#selection.active ?? "");
    if (!entry || keys.length > 1 || isSection(entry)) {
      this.#signature = "";
      this.#sections = [];
      this.#showOther(keys, entry);
      return;
    }
    const chain = isNode(entry) ? chainOf(entry).filter(isNode) : [entry];
    const signature = chain.map((e) => `${e.pointer} ${e.kind} ${Object.keys(e.parameters ?? {}).length > mostAtOnce}`).join("\n");
    if (signature !== this.#signature) {
      const isSame = this.#signature.split("\n")[0] === signature.split("\n")[0];
      this.#signature = signature;
      this.#sections = chain.map((e, i) => new Section(e, this.catalogue.of(e), this, i === 0));
      const scroll = isSame ? body.scrollTop : 0;
      body.replaceChildren(...this.#sections.map((section) => section.element));
      body.scrollTop = scroll;
    }
    this.#sections.forEach((section, i) => section.show(chain[i], this, i === chain.length - 1));
    this.#showHead(head, entry);
  }
  #showHead(head, entry) {
    const kind = this.catalogue.of(entry), focused = head.contains(document.activeElement) ? document.activeElement.dataset : null;
    const crumbs = pathTo(entry).slice(0, -1);
    const name = entry.label
      ? make("input", {
        type: "text", class: "line name", value: entry.label, spellcheck: false, "aria-label": "Name", "data-action": "name",
        onfocus: (event) => event.target.select(),
        onchange: (event) => this.act.renameTo(entry, event.target.value.trim()),
      })
      : make("h2", {title: kind?.title ?? ""}, nameOf(entry, this.catalogue));
    const buttons = this.act.buttonsFor(entry).filter((button) => !button.isOff).map(({id, text, icon: image, keys, run}) => make("button", {
      type: "button", class: "icon-button", "aria-label": text, title: `${text}${keys ? ` (${keys})` : ""}`,
      "data-action": id, onclick: (event) => run(event.currentTarget),
    }, icon(image)));
    head.replaceChildren(
      make("nav", {class: "crumbs", "aria-label": "Ancestors"}, crumbs.map((e) => make("button", {
        type: "button", onclick: () => this.select(e.pointer),
      }, nameOf(e, this.catalogue)))),
      make("div", {class: "title"}, icon(iconOf(entry)), name),
      make("div", {class: "actions", role: "toolbar", "aria-label": "Actions"}, buttons),
      this.#about(entry, kind),
      ...(isCombining(entry) ? [this.#combining(entry)] : []));
    if (focused) head.querySelector(focused.operator ? `[data-operator="${focused.operator}"]` : `[data-action="${focused.action}"]`)?.focus();
  }
  // Over and under differ only by which end of the list has precedence.
  #combining(entry) {
    const choices = ["over", "under"].includes(entry.kind) ? ["over", "under"] : [];
    return combiningFigure(entry.kind, choices, (kind) => kind === entry.kind || this.act.run({
      label: `Change ${entry.kind} to ${kind}`, operations: [{rename: joined(entry.pointer, entry.kind), to: kind}], select: [entry.pointer],
    }));
  }
  #about(entry, kind) {
    if (entry.kind === "reference") return make("p", {class: "about"}, "A reusable shape. Changing it changes every place where it is used. ",
      make("button", {type: "button", class: "link", onclick: () => this.select(entry.target)}, "Edit the shape"));
    if (!kind) return make("p", {class: "about"}, "");
    const more = plainText(kind.help ?? "").split(/\n\s*\n/).slice(1).join("\n\n");
    const summary = summaryOf(kind.help), [word] = kind.title.split(" ");
    // "Translates" says it already.
    const isSaid = summary.toLowerCase().startsWith(word.toLowerCase());
    const text = make("span", {}, isSaid ? summary : `${kind.title}. ${summary}`);
    if (more === "") return make("p", {class: "about"}, text);
    const rest = make("span", {hidden: true}, ` ${more}`);
    return make("p", {class: "about"}, text, rest, " ", make("button", {
      type: "button", class: "link", onclick: (event) => {
        rest.hidden = !rest.hidden;
        event.currentTarget.textContent = rest.hidden ? "More" : "Less";
      },
    }, "More"));
  }
  // The children in a slot, as buttons that select them, and one that adds another.
  slotRows(entry, slot) {
    const inside = entry.children.filter((child) => child.slot === slot.name);
    const items = inside.map((child) => make("button", {type: "button", class: "slot-item", onclick: () => this.select(child.pointer)},
      icon(iconOf(child)), make("span", {class: "name"}, nameOf(child, this.catalogue)),
      make("span", {class: "swatches"}, child.phases.slice(0, 3).map(swatchOf))));
    const add = slot.list || inside.length === 0 ? [make("button", {type: "button", class: "slot-add", onclick: () => this.act.addTo(entry, slot)}, icon("add"), "Add")] : [];
    return [make("div", {class: "slot", role: "group", "aria-label": titleOf(slot.name)}, make("p", {class: "slot-name"}, titleOf(slot.name)), ...items, ...add)];
  }
  #showOther(keys, entry) {
    const {head, body} = this.#elements;
    if (keys.length > 1) {
      const entries = keys.map((key) => this.#scene.entry(key)).filter(Boolean);
      head.replaceChildren(make("div", {class: "title"}, icon("group"), make("h2", {}, `${keys.length} selected`)));
      body.replaceChildren(...this.act.buttonsForMany(entries).map(({text, icon: image, keys: shortcut, run, isOff, why}) =>
        make("button", {type: "button", class: "wide-button", disabled: isOff ?? false, title: why ?? "", onclick: run}, icon(image), text, shortcut ? make("kbd", {}, shortcut) : null)));
      return;
    }
    if (entry) {
      head.replaceChildren(make("div", {class: "title"}, icon(iconOf(entry)), make("h2", {}, nameOf(entry, this.catalogue))));
      body.replaceChildren(make("button", {type: "button", class: "wide-button", onclick: () => this.act.addToSection(entry)}, icon("add"), "Add"));
      return;
    }
    head.replaceChildren(make("h2", {}, "Nothing is selected"));
    body.replaceChildren(make("p", {class: "about"}, "Click something in the picture or in the outline to change it, or press Add."));
  }
}
