// The parameters of what is selected. A chain of nodes with one child each, such as a filled and moved sphere, is shown as
// one.
import {plainText, summaryOf} from "./catalogue.js";
import {combiningFigure, isCombining} from "./combining.js";
import {arrange, make, refill} from "./dom.js";
import {icon, iconOf} from "./icons.js";
import {isPlacing, nameOf} from "./names.js";
import {ParameterRow, titleOf} from "./parameter_row.js";
import {joined} from "./pointer.js";
import {following} from "./relations.js";
import {shortMessage} from "./server.js";
import {chainOf, isNode, isSection, membersOf, pathTo, pointerOf} from "./structure.js";
import {lookOf, swatchOf} from "./swatch.js";

const mostAtOnce = 9; // parameters shown before the rest is folded

class Section {
  rows = [];

  constructor(look, entry, kind, inspector, isFirst) {
    this.look = look;
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
    refill(this.slots, JSON.stringify(slots.map((slot) => inspector.lookOfSlot(entry, slot))), () => slots.flatMap((slot) => inspector.slotRows(entry.key, slot)));
  }
}

export class Inspector {
  #elements;
  #scene;
  #selection;
  #sections = []; // of the last node that was shown
  other = make("div", {class: "other"});

  // `elements` are those of the panel: head, body. `act` has the actions that the buttons at the top offer, and rename.
  constructor(elements, {scene, selection, act, radius, failed}) {
    this.#elements = elements;
    this.#scene = scene;
    this.#selection = selection;
    this.act = act;
    this.catalogue = null;
    this.context = {
      radius,
      unit: () => scene.unit,
      phases: () => (scene.section("phases")?.children ?? []).map((entry) => entry.label),
      set: (entry, name, text, gesture, row, index) => this.#perform(row, {
        label: `Change ${titleOf(name).toLowerCase()} of ${nameOf(entry, this.catalogue).toLowerCase()}`,
        merge: gesture,
        operations: () => this.#withFollowers(entry, name, {set: index === undefined ? pointerOf(entry, name) : joined(pointerOf(entry, name), index), to: text}),
      }, this.#exchange(entry, name, text, row)),
      fill: (entry, slot) => act.addTo(entry, {...slot, pointer: joined(membersOf(entry), slot.name)}),
      reset: (entry, name, row) => this.#perform(row, {
        label: `Reset ${titleOf(name).toLowerCase()}`,
        operations: () => this.#withFollowers(entry, name, {remove: pointerOf(entry, name)}),
      }),
    };
    this.failed = failed;
    selection.addEventListener("change", () => this.show());
  }
  // An operation on a parameter, with those on the parameters that it excludes or requires. The entry is looked up again
  // because earlier steps of a gesture may have changed it.
  #withFollowers(entry, name, operation) {
    const now = this.#scene.entry(entry.key) ?? entry, {before, after} = following(this.catalogue.of(now), now, name, "set" in operation);
    return [...before, operation, ...after];
  }
  // If two parameters must be different phases, choosing the other one's phase exchanges them.
  #exchange(entry, name, text, row) {
    const specs = this.catalogue.of(entry)?.parameters ?? [], old = entry.parameters[name]?.text;
    const isPhase = (other) => specs.find((spec) => spec.name === other)?.control === "phase";
    const twin = row.spec.control === "phase" && old ? Object.keys(entry.parameters).find((other) => other !== name && isPhase(other) && entry.parameters[other].text === text) : null;
    return twin ? [{set: pointerOf(entry, twin), to: old}] : null;
  }
  async #perform(row, step, exchange = null) {
    try {
      await this.#scene.perform(step);
      row.fail("");
      return true;
    } catch (error) {
      if (exchange && !error.isOutdated) return this.#perform(row, {...step, operations: () => [...step.operations(), ...exchange]});
      const other = this.#scene.error;
      row.fail(other ? `First correct the error in the text${other.line ? ` on line ${other.line}` : ""}: ${other.message}` : shortMessage(error));
      this.failed(error);
      return false;
    }
  }
  // What was wrong may be right after a change by another page, or be about another part.
  forgetFailures() {
    for (const row of this.#sections.flatMap((section) => section.rows)) row.forgetFailure();
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
      this.#sections = [];
      this.#showOther(keys, entry);
      return;
    }
    const chain = isNode(entry) ? chainOf(entry).filter(isNode) : [entry];
    const looks = chain.map((e, i) => `${e.pointer} ${e.kind} ${i === 0} ${Object.keys(e.parameters ?? {}).length > mostAtOnce}`);
    if (looks.join("\n") !== this.#sections.map((section) => section.look).join("\n")) {
      const before = this.#sections, scroll = before[0]?.look === looks[0] ? body.scrollTop : 0;
      const had = body.contains(document.activeElement) ? document.activeElement : null;
      this.#sections = chain.map((e, i) => before.find(({look}) => look === looks[i]) ?? new Section(looks[i], e, this.catalogue.of(e), this, i === 0));
      // What is being typed elsewhere is not lost, but becomes part of the scene.
      if (had && !this.#sections.some((section) => section.element.contains(had))) had.blur();
      arrange(body, this.#sections.map((section) => section.element));
      body.scrollTop = scroll;
    }
    this.#sections.forEach((section, i) => section.show(chain[i], this, i === chain.length - 1));
    this.#showHead(head, entry);
  }
  get #selected() {
    return this.#selection.pointers.map((key) => this.#scene.entry(key)).filter(Boolean);
  }
  #showHead(head, entry) {
    const kind = this.catalogue.of(entry), crumbs = pathTo(entry).slice(0, -1).map((e) => ({key: e.pointer, text: nameOf(e, this.catalogue)}));
    const buttons = this.act.buttonsFor(entry).filter((button) => !button.isOff);
    const look = JSON.stringify([entry.key, entry.kind, entry.type, entry.label, nameOf(entry, this.catalogue), crumbs, buttons.map(({id}) => id)]);
    refill(head, look, () => this.#headOf(entry, kind, crumbs, buttons));
  }
  async #rename(key, input) {
    const entry = this.#scene.entry(key);
    if (await this.act.renameTo(entry, input.value.trim()) !== true) input.value = entry.label;
  }
  #headOf(entry, kind, crumbs, buttons) {
    const name = entry.label
      ? make("input", {
        type: "text", class: "line name", value: entry.label, spellcheck: false, "aria-label": "Name", "data-action": "name",
        onfocus: (event) => event.target.select(),
        onchange: (event) => this.#rename(entry.key, event.target),
      })
      : make("h2", {title: kind?.title ?? ""}, nameOf(entry, this.catalogue));
    const run = (id, button) => this.act.buttonsFor(this.#scene.entry(entry.key)).find((one) => one.id === id).run(button);
    const actions = buttons.map(({id, text, icon: image, keys}) => make("button", {
      type: "button", class: "icon-button", "aria-label": text, title: `${text}${keys ? ` (${keys})` : ""}`,
      "data-action": id, onclick: (event) => run(id, event.currentTarget),
    }, icon(image)));
    return [
      make("nav", {class: "crumbs", "aria-label": "Ancestors"}, crumbs.map(({key, text}) => make("button", {
        type: "button", onclick: () => this.select(key),
      }, text))),
      make("div", {class: "title"}, icon(iconOf(entry)), name),
      make("div", {class: "actions", role: "toolbar", "aria-label": "Actions"}, actions),
      this.#about(entry, kind),
      ...(isCombining(entry) ? [this.#combining(entry)] : [])];
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
      type: "button", class: "link", "aria-label": "More about this kind", onclick: (event) => {
        rest.hidden = !rest.hidden;
        event.currentTarget.textContent = rest.hidden ? "More" : "Less";
        event.currentTarget.setAttribute("aria-label", `${event.currentTarget.textContent} about this kind`);
      },
    }, "More"));
  }
  // The children in a slot, as buttons that select them, and one that adds another.
  lookOfSlot(entry, slot) {
    const inside = entry.children.filter((child) => child.slot === slot.name);
    return [entry.key, slot.name, slot.list, inside.map((child) => [child.pointer, child.kind, nameOf(child, this.catalogue), child.phases.slice(0, 3).map(lookOf)])];
  }
  slotRows(key, {name, list}) {
    const slotNow = () => this.#scene.entry(key).slots.find((slot) => slot.name === name);
    const inside = this.#scene.entry(key).children.filter((child) => child.slot === name);
    const items = inside.map((child) => make("button", {type: "button", class: "slot-item", onclick: () => this.select(child.pointer)},
      icon(iconOf(child)), make("span", {class: "name"}, nameOf(child, this.catalogue)),
      make("span", {class: "swatches"}, child.phases.slice(0, 3).map(swatchOf))));
    const add = list || inside.length === 0 ? [make("button", {
      type: "button", class: "slot-add", "data-action": `add to ${name}`, onclick: () => this.act.addTo(this.#scene.entry(key), slotNow()),
    }, icon("add"), "Add")] : [];
    return [make("div", {class: "slot", role: "group", "aria-label": titleOf(name)}, make("p", {class: "slot-name"}, titleOf(name)), ...items, ...add)];
  }
  // Several entries, a section, or nothing.
  #showOther(keys, entry) {
    const {head, body} = this.#elements, {other} = this;
    arrange(body, [other]);
    const title = (image, text) => refill(head, JSON.stringify([image, text]), () => [make("div", {class: "title"}, icon(image), make("h2", {}, text))]);
    if (keys.length > 1) {
      const buttons = this.act.buttonsForMany(this.#selected), press = (i, event) => this.act.buttonsForMany(this.#selected)[i].run(event);
      title("group", `${keys.length} selected`);
      refill(other, JSON.stringify(buttons.map(({text, isOff}) => [text, isOff])), () => buttons.map(({text, icon: image, keys: shortcut, isOff, why}, i) =>
        make("button", {type: "button", class: "wide-button", disabled: isOff ?? false, title: why ?? "", onclick: (event) => press(i, event)}, icon(image), text, shortcut ? make("kbd", {}, shortcut) : null)));
    } else if (entry) {
      title(iconOf(entry), nameOf(entry, this.catalogue));
      refill(other, entry.key, () => [make("button", {type: "button", class: "wide-button", onclick: () => this.act.addToSection(this.#scene.entry(entry.key))}, icon("add"), "Add")]);
    } else {
      refill(head, "", () => [make("h2", {}, "Nothing is selected")]);
      refill(other, "", () => [make("p", {class: "about"}, "Click something in the picture or in the outline to change it, or press Add.")]);
    }
  }
}
