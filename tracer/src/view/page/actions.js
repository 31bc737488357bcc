// What a person can do with the scene, for the tool bar, menus and keys: each makes one step that can be undone.
import {askName} from "./dialog.js";
import {addedKind, addedPhase, addedTo, boxed, deleted, duplicated, firstBall, freeName, grouped, moved, namedShape, replaced, templateOf, unwrapped,
  withPhases, wrapped, wrapperOf} from "./edits.js";
import {fits} from "./catalogue.js";
import {iconOf} from "./icons.js";
import {keysAt} from "./json_text.js";
import {openMenu} from "./menu.js";
import {nameOf} from "./names.js";
import {choose} from "./palette.js";
import {joined} from "./pointer.js";
import {materials, wraps} from "./recipes.js";
import {following} from "./relations.js";
import {ballOf} from "./swatch.js";
import {askStarts, shortMessage} from "./server.js";
import {filledTo, ownCopy, shapeKinds, shapeOfSeveral, stacked, wrappedTogether} from "./several.js";
import {indexOf, isInList, isNode, isSection, listLength, listOf, mayStandAt} from "./structure.js";

const isSettings = (entry) => entry.type === "render" || entry.type === "scene";
const isFixed = (entry) => isSettings(entry) || entry.pointer === "/camera";
const ofSection = {lights: "light", meshes: "mesh", expect: "statement", phases: "material", tree: "object", shapes: "field"};

export class Actions {
  #scene;
  #selection;
  #announcer;
  #phase = null; // the phase used last
  catalogue = null;

  constructor({scene, selection, announcer, radius}) {
    this.#scene = scene;
    this.#selection = selection;
    this.#announcer = announcer;
    this.radius = radius;
    selection.addEventListener("change", () => {
      const phases = this.active?.phases ?? [];
      if (phases.length > 0) this.#phase = phases[0];
    });
  }
  get active() {
    return this.#scene.entry(this.#selection.active ?? "");
  }
  get selected() {
    return this.#selection.pointers.map((key) => this.#scene.entry(key)).filter((entry) => entry && !isSection(entry));
  }
  // The phases of the scene, in the order in which something new would use them: those without a use yet, then the one
  // selected last.
  get phases() {
    const names = keysAt(this.#scene.text, "/phases");
    if (names.length === 0) return ["glass"];
    const used = new Set(this.#scene.entries.filter(isNode).flatMap((entry) => entry.phases));
    const rank = (name) => (!used.has(name) ? 0 : name === this.#phase ? 1 : 2);
    return names.sort((a, b) => rank(a) - rank(b));
  }
  // Performs {label, operations, select}. If it is rejected, performs the step that `otherwise` makes of the error, or says
  // why.
  async run(step, {merge = null, strict = true, otherwise = () => null} = {}) {
    if (!step) return false;
    if (step.select) this.#selection.expect(step.select);
    try {
      await this.#scene.perform({label: step.label, operations: step.operations, merge, strict});
      return true;
    } catch (error) {
      this.#selection.forget();
      const other = otherwise(error);
      if (other) return this.run(other, {merge, strict});
      this.#announcer.say(shortMessage(error), {isWrong: true});
      return false;
    }
  }
  async #go(direction, label, done) {
    if (label === null) return this.#announcer.say(done === "Undone" ? "There is nothing to undo." : "There is nothing to redo.");
    try {
      await (direction === "back" ? this.#scene.goBack() : this.#scene.goForward());
      this.#announcer.say(`${done}: ${label}`);
    } catch (error) {
      this.#announcer.say(error.message, {isWrong: true});
    }
  }
  undo() {
    return this.#go("back", this.#scene.undo, "Undone");
  }
  redo() {
    return this.#go("forward", this.#scene.redo, "Redone");
  }
  startWithBall() {
    return this.run(firstBall(this.#scene, this.phases[0]));
  }
  // Lets the person choose a kind, and name its file if it has one.
  async #chosen(title, kinds) {
    const kind = await choose(title, kinds);
    if (!kind?.template.includes('"<file>"')) return kind;
    const name = await askName("Name of the file, from the scene's folder", "", "Use this file");
    return name && {...kind, template: kind.template.replaceAll('"<file>"', JSON.stringify(name))};
  }
  // Adds a kind beside what is selected. What fills all of space is added within a box.
  addKind(kind, active = this.active) {
    const step = (some) => addedKind(this.#scene, some, active, this.phases, this.radius());
    return this.run(step(kind), {otherwise: (error) => (isNode(kind) && /unbounded/.test(error.message) ? step(boxed(kind)) : null)});
  }
  // Replaces everything by a scene to start from; undo brings the old one back.
  async startWith(button) {
    try {
      const items = (await askStarts()).map(({name, summary, text}) => ({
        text: summary, icon: "scene", run: () => this.run({label: `Start with ${name}`, operations: [{text}], select: ["/tree"]}),
      }));
      openMenu(button, items, {label: "Replace everything by"});
    } catch (error) {
      this.#announcer.say(shortMessage(error), {isWrong: true});
    }
  }
  async add() {
    const kinds = this.catalogue.kinds.filter((kind) => kind.template && ["field", "object", "light", "mesh", "material", "camera", "statement"].includes(kind.type) && !kind.for_meshes_only);
    const kind = await this.#chosen("Add", [...shapeKinds(this.#scene), ...withoutTwins(kinds, this.active)]);
    if (kind) await this.addKind(kind);
  }
  // Adds in a slot of an entry.
  async addTo(entry, slot) {
    const kinds = this.catalogue.kinds.filter((kind) => kind.template && (fits(slot.type, kind.type) || (fits(slot.type, "object") && kind.type === "field" && kind.chapter === "shapes")));
    const shapes = shapeKinds(this.#scene).filter((kind) => fits(slot.type, kind.type));
    const kind = await this.#chosen(`Add to ${nameOf(entry, this.catalogue).toLowerCase()}`, [...shapes, ...withoutTwins(kinds, entry)]);
    if (!kind) return;
    const step = addedTo(this.#scene, entry, slot, kind, this.phases), {before, after} = following(this.catalogue.of(entry), entry, slot.name, true);
    await this.run({...step, operations: [...before, ...step.operations, ...after]});
  }
  async addToSection(section, button = document.querySelector(`[data-key="${section.key}"]`)) {
    if (section.name === "phases") return this.newMaterial(button);
    const kinds = this.catalogue.kinds.filter((kind) => kind.template && kind.type === (ofSection[section.name] ?? "object"));
    const kind = await this.#chosen(`Add to ${nameOf(section, this.catalogue).toLowerCase()}`, kinds);
    if (!kind) return;
    if (section.name !== "shapes") return this.addKind(kind, section);
    const pointer = joined("/shapes", freeName(kind.kind, keysAt(this.#scene.text, "/shapes")));
    return this.run({label: "Add a shape", operations: [{insert: pointer, value: JSON.stringify(templateOf(kind, this.phases))}], select: [pointer]});
  }
  newMaterial(button) {
    // Before there is an object, phases alone are no valid scene.
    const strict = this.#scene.entry("/tree") !== null;
    const add = (name, value) => this.run(addedPhase(this.#scene, freeName(name, keysAt(this.#scene.text, "/phases")), value), {strict});
    openMenu(button, [...materials.map((m) => ({text: m.text, swatch: ballOf(m), run: () => add(m.name, m.value)})), null,
      {text: "Other materials …", icon: "search", run: async () => {
        const kind = await this.#chosen("New material", this.catalogue.kinds.filter((k) => k.type === "material" && !k.for_meshes_only));
        if (kind) await add(kind.kind, templateOf(kind, this.phases));
      }}], {label: "New material"});
  }
  wrapMenu(button, entry = this.active) {
    if (!entry || !isNode(entry)) return this.#announcer.say("Select an object or a shape first.");
    const several = this.selected.length > 1 && this.selected.includes(entry) ? this.selected : null;
    const items = wraps[entry.type].map((wrap) => wrap && {
      text: wrap.text, icon: iconOf({kind: wrap.kind, type: entry.type}), run: () => (several ? this.wrapTogether(several, wrap) : this.wrap(entry, wrap.kind, wrap.in)),
    });
    const fill = entry.type === "object" && !several ? [{text: "Fill up to here", icon: "fill", run: () => this.fillTo(entry)}] : [];
    const other = several ? [] : [null, {text: "Something else …", icon: "search", run: () => this.wrapInAny(entry)}];
    openMenu(button, [...items, ...fill, ...other], {label: "Wrap the selection"});
  }
  wrap(entry, kindName, value = null) {
    const kind = this.catalogue.named(kindName, entry.type) ?? this.catalogue.named(kindName);
    const wrapper = value ? withPhases(value, this.#otherPhases(entry)) : wrapperOf(kind, entry.type, this.#otherPhases(entry), this.catalogue);
    return this.run(wrapped(entry, wrapper, kind?.title ?? kindName));
  }
  wrapTogether(entries, {kind: kindName, in: value, text}) {
    const [first] = entries, kind = this.catalogue.named(kindName, first.type) ?? this.catalogue.named(kindName);
    const wrapper = value ? withPhases(value, this.#otherPhases(first)) : wrapperOf(kind, first.type, this.#otherPhases(first), this.catalogue);
    const step = wrappedTogether(entries, wrapper, text);
    if (step) return this.run(step);
    this.#announcer.say("To wrap several parts at once, select parts of the same list.");
  }
  // Up to the height of the point that was clicked last.
  fillTo(entry = this.active) {
    const level = this.pointed?.[2];
    if (level === undefined) return this.#announcer.say("Click in the picture first: the level will be at that height.");
    const step = filledTo(this.#scene, entry, level, this.#otherPhases(entry)[0]);
    if (step) return this.run(step);
    this.#announcer.say("Nothing has been cut out of the selection, so there is nothing to fill.", {isWrong: true});
  }
  stack(entries, isBelow) {
    return this.run(stacked(entries, this.active, isBelow));
  }
  // A coat of the phase that is inside would not be seen.
  #otherPhases(entry) {
    const isInside = (name) => entry.phases.includes(name);
    return [...this.phases.filter((name) => !isInside(name)), ...this.phases.filter(isInside)];
  }
  async wrapInAny(entry) {
    const kinds = this.catalogue.kinds.filter((kind) => kind.template && isNode(kind) && mayStandAt(entry, kind.type) && this.catalogue.slotsFor(kind, entry.type).length > 0);
    const kind = await this.#chosen(`Wrap ${nameOf(entry, this.catalogue).toLowerCase()} in`, kinds);
    if (kind) await this.run(wrapped(entry, wrapperOf(kind, entry.type, this.#otherPhases(entry), this.catalogue), kind.title));
  }
  async replace(entry = this.active) {
    if (!entry || isSettings(entry)) return;
    const kinds = this.catalogue.kinds.filter((kind) => kind.template && kind.kind !== entry.kind && (isNode(entry) ? mayStandAt(entry, kind.type) : kind.type === entry.type));
    const shapes = isNode(entry) ? shapeKinds(this.#scene).filter((kind) => mayStandAt(entry, kind.type) && kind.title !== entry.label) : [];
    const kind = await this.#chosen(`Replace ${nameOf(entry, this.catalogue).toLowerCase()} with`, [...shapes, ...kinds]);
    const phases = [...entry.phases, ...this.phases.filter((name) => !entry.phases.includes(name))];
    if (kind) await this.run(replaced(entry, kind, phases, this.catalogue));
  }
  duplicate() {
    const entry = this.active;
    if (!entry || isSection(entry)) return;
    const step = duplicated(this.#scene, entry, Number((0.3 * this.radius()).toPrecision(2)));
    if (step) return this.run(step);
    this.#announcer.say("This cannot be duplicated: a scene can have only one.");
  }
  delete() {
    const entries = this.selected;
    if (entries.length === 0) return;
    // Without an object, the scene is not finished, but that is for the person to decide.
    const step = deleted(entries), isLast = step.operations.some((operation) => operation.remove === "/tree");
    return this.run(step, {strict: !isLast});
  }
  group() {
    const step = grouped(this.selected);
    if (step) return this.run(step);
    this.#announcer.say("To group parts, select several of the same list: hold Ctrl and click.");
  }
  unwrap(entry = this.active) {
    const step = entry && isNode(entry) ? unwrapped(entry) : null;
    if (step) return this.run(step);
    this.#announcer.say("The wrapper cannot be removed: nothing inside the selection could take its place.");
  }
  copyShape(entry = this.active) {
    return this.run(ownCopy(this.#scene, entry));
  }
  async makeShapeOf(entries) {
    const taken = keysAt(this.#scene.text, "/shapes"), name = await askName("Make a reusable shape", freeName(entries[0].type === "field" ? "shape" : "object", taken), "Make it reusable");
    if (name) await this.run(shapeOfSeveral(this.#scene, entries, freeName(name, taken)));
  }
  async makeShape(entry = this.active) {
    if (!entry || !isNode(entry) || entry.kind === "reference" || entry.pointer.startsWith("/shapes/") && !entry.parent?.parent) return;
    const name = await askName("Make a reusable shape", freeName(entry.type === "field" ? "shape" : "object", keysAt(this.#scene.text, "/shapes")), "Make it reusable");
    if (name) await this.run(namedShape(this.#scene, entry, freeName(name, keysAt(this.#scene.text, "/shapes"))));
  }
  async rename(entry = this.active) {
    if (entry?.kind === "reference") return;
    if (entry && !entry.label && isNode(entry)) return this.makeShape(entry); // only what is reusable has a name in the file
    if (!entry?.label) return this.#announcer.say("Only materials, objects and shapes have names.");
    const name = await askName("Rename", entry.label, "Rename");
    if (name) await this.renameTo(entry, name);
  }
  renameTo(entry, name) {
    if (name === "" || name === entry.label) return;
    const pointer = joined(entry.pointer.slice(0, entry.pointer.lastIndexOf("/")), name);
    return this.run({label: `Rename ${entry.label}`, operations: [{rename: entry.pointer, to: name, references: true}], select: [pointer]});
  }
  shift(by) {
    const entry = this.active;
    if (!entry || !isInList(entry)) return;
    const to = indexOf(entry) + by;
    if (to < 0 || to >= listLength(entry)) return;
    return this.run({label: "Move in the outline", operations: [{move: entry.pointer, to: `${listOf(entry)}/${to}`}], select: [`${listOf(entry)}/${to}`]});
  }
  drop(entry, to) {
    return this.run(moved(entry, to));
  }
  buttonsFor(entry) {
    const node = isNode(entry), fixed = ["camera", "render"].includes(entry.name);
    return [
      {id: "wrap", text: "Wrap: move, rotate, cut, coat …", icon: "wrap", keys: "W", isOff: !node, run: (button) => this.wrapMenu(button, entry)},
      {id: "replace", text: "Replace with another kind", icon: "replace", keys: "R", isOff: isSettings(entry), run: () => this.replace(entry)},
      {id: "duplicate", text: "Duplicate", icon: "duplicate", keys: "Ctrl+D", isOff: fixed, run: () => this.duplicate()},
      {id: "delete", text: "Delete", icon: "delete", keys: "Delete", isOff: fixed, run: () => this.delete()},
      {id: "more", text: "More actions", icon: "more", isOff: isSettings(entry), run: (button) => this.menu(entry, button)},
    ];
  }
  buttonsForMany(entries) {
    const step = grouped(entries), off = {isOff: !step, why: step ? "" : "Only parts of the same list can be grouped."}, {active} = this;
    const stack = (text, icon, isBelow) => ({text, icon, isOff: !stacked(entries, active, isBelow), why: "The part that was selected last changes its place in an over or under.", run: () => this.stack(entries, isBelow)});
    return [
      {text: "Group", icon: "group", keys: "Ctrl+G", ...off, run: () => this.group()},
      {text: "Wrap: move, cut, coat, repeat …", icon: "wrap", keys: "W", ...off, run: (event) => this.wrapMenu(event.currentTarget, active)},
      {text: "Make reusable …", icon: "link", ...off, run: () => this.makeShapeOf(entries)},
      ...(active?.type === "object" ? [stack("Put the last under the others", "down", true), stack("Put the last over the others", "up", false)] : []),
      {text: "Delete all", icon: "delete", keys: "Delete", run: () => this.delete()},
    ];
  }
  menu(entry, button) {
    if (isSection(entry)) return openMenu(button, [{text: "Add …", icon: "add", run: () => this.addToSection(entry, button)}], {label: "Actions"});
    const node = isNode(entry), fixed = isFixed(entry), listed = isInList(entry);
    return openMenu(button, [
      {text: "Wrap …", icon: "wrap", keys: "W", isOff: !node, run: () => this.wrapMenu(button, entry)},
      {text: "Replace …", icon: "replace", keys: "R", isOff: isSettings(entry), run: () => this.replace(entry)},
      {text: "Remove the wrapper", icon: "unwrap", keys: "Ctrl+Shift+G", isOff: !node || !unwrapped(entry), run: () => this.unwrap(entry)},
      {text: "Make reusable …", icon: "link", isOff: !node || entry.kind === "reference" || !entry.parent, run: () => this.makeShape(entry)},
      {text: "Make a copy of its own", icon: "duplicate", isOff: entry.kind !== "reference", run: () => this.copyShape(entry)},
      {text: entry.label ? "Rename …" : "Give it a name …", icon: "text", keys: "F2", isOff: entry.kind === "reference" || (!entry.label && (!node || !entry.parent)), run: () => this.rename(entry)},
      null,
      {text: "Move up", icon: "up", keys: "Alt+↑", isOff: !listed || indexOf(entry) === 0, run: () => this.shift(-1)},
      {text: "Move down", icon: "down", keys: "Alt+↓", isOff: !listed || indexOf(entry) + 1 >= listLength(entry), run: () => this.shift(1)},
      {text: "Group", icon: "group", keys: "Ctrl+G", isOff: !grouped(this.selected), run: () => this.group()},
      null,
      {text: "Duplicate", icon: "duplicate", keys: "Ctrl+D", isOff: fixed, run: () => this.duplicate()},
      {text: "Delete", icon: "delete", keys: "Delete", isOff: fixed, run: () => this.delete()},
    ], {label: "Actions"});
  }
}

// If a kind exists both for fields and for objects, offer only the one that matches the selection's type.
function withoutTwins(kinds, active) {
  const wanted = active?.type === "field" ? "field" : "object";
  return kinds.filter((kind) => !["field", "object"].includes(kind.type) || kind.type === wanted || !kinds.some((other) => other !== kind && other.kind === kind.kind && other.type === wanted));
}
