// The operations by which the scene's text is changed, for what a person does: add, wrap, replace, duplicate, delete,
// group. Each function returns {label, operations, select}: `select` are the pointers to select afterwards.
import {fits} from "./catalogue.js";
import {keysAt, parsed, textAt, written} from "./json_text.js";
import {joined, parentOf} from "./pointer.js";
import {starter} from "./recipes.js";
import {indexOf, isInList, isNode, isSection, listLength, listOf, mayStandAt, slotOf, typeOfPlace} from "./structure.js";

export const combinerOf = (type) => (type === "object" ? "over" : "union");

// A name that is not taken: "glass", "glass 2", …
export function freeName(wanted, taken) {
  let name = wanted;
  for (let i = 2; taken.includes(name); ++i) name = `${wanted} ${i}`;
  return name;
}

// Replaces the placeholders of phases in a value by the first two of a list of phases.
export function withPhases(value, [phase, other = phase]) {
  const filled = (part) => {
    if (part === "<phase>") return phase;
    if (part === "<other phase>") return other;
    if (Array.isArray(part)) return part.map(filled);
    if (part === null || typeof part !== "object") return part;
    return Object.fromEntries(Object.entries(part).map(([key, member]) => [key, filled(member)]));
  };
  return filled(value);
}

export const templateOf = (kind, phases) => withPhases(parsed(kind.template), phases);

// The template of a kind with null in the first slot that fits a type.
export function wrapperOf(kind, type, phases, catalogue) {
  const slot = catalogue.slotsFor(kind, type)[0];
  if (!slot) return null;
  const value = templateOf(kind, phases), members = value[kind.kind];
  if (Array.isArray(members)) return {[kind.kind]: [null]};
  return {[kind.kind]: {...members, [slot.name]: slot.list ? [null] : null}};
}

// Appends to a list of the scene, or begins it.
function appended(scene, name, value) {
  const hasList = textAt(scene.text, `/${name}`) !== null;
  const operation = hasList ? {insert: `/${name}/-`, value: written(value)} : {set: `/${name}`, to: written([value])};
  return {operation, pointer: `/${name}/${hasList ? keysAt(scene.text, `/${name}`).length : 0}`};
}

// Adds a member to an object of the scene, such as its phases.
function added(scene, name, key, value) {
  const hasObject = textAt(scene.text, `/${name}`) !== null;
  const pointer = joined("", name, key);
  return {operation: hasObject ? {insert: pointer, value: written(value)} : {set: `/${name}`, to: written({[key]: value})}, pointer};
}

// A ball on a table, for a scene that is empty.
export const firstBall = (scene, phase) => ({
  label: "Add a ball",
  operations: [...missingParts(scene), {set: "/tree", to: written({set: {phase, of: {sphere: {radius: 1}}}})}],
  select: ["/tree"],
});

export function addedPhase(scene, name, value) {
  const {operation, pointer} = added(scene, "phases", name, value);
  return {label: `Add the material ${name}`, operations: [operation], select: [pointer]};
}

// What the scene lacks before its object can be seen.
export function missingParts(scene) {
  return Object.entries(starter)
    .filter(([name]) => textAt(scene.text, `/${name}`) === null)
    .map(([name, value]) => ({set: `/${name}`, to: written(value)}));
}

// The place for a node of a type, near an active entry: {insert: pointer} or {wrap: entry}; null in an empty scene.
function placeFor(scene, active, type) {
  for (let at = active; at && !isSection(at); at = at.parent) {
    const slot = at.slots.find((s) => s.list && fits(s.type, type));
    if (at === active && slot) return {insert: `${slot.pointer}/-`, count: at.children.filter((child) => child.slot === slot.name).length};
    if (isInList(at) && isNode(at) && fits(typeOfPlace(at), type)) {
      const isLast = indexOf(at) + 1 >= listLength(at);
      return {insert: `${listOf(at)}/${isLast ? "-" : indexOf(at) + 1}`, count: indexOf(at) + 1};
    }
    const isRoot = !at.parent || isSection(at.parent) || at.parent.type !== at.type;
    if (isNode(at) && at.type === type && isRoot && mayStandAt(at, type)) return {wrap: at};
  }
  const root = scene.entry("/tree");
  return root && active !== root ? placeFor(scene, root, type) : null;
}

// A field that is added among objects is filled with a phase.
export function addedNode(scene, kind, active, phases) {
  const title = kind.title.toLowerCase(), isField = kind.type === "field";
  const inField = isField && active && !isSection(active) && active.type === "field";
  const type = inField ? "field" : "object";
  const value = isField && !inField ? {set: {phase: phases[0], of: templateOf(kind, phases)}} : templateOf(kind, phases);
  const label = `Add ${title}`;
  const place = placeFor(scene, active, type);
  if (!place) return {label, operations: [...missingParts(scene), {set: "/tree", to: written(value)}], select: ["/tree"]};
  if (place.wrap) {
    const {pointer} = place.wrap, combiner = combinerOf(type);
    return {label, operations: [{wrap: pointer, in: written({[combiner]: [null]})}, {insert: `${pointer}/${combiner}/0`, value: written(value)}],
      select: [`${pointer}/${combiner}/0`]};
  }
  return {label, operations: [{insert: place.insert, value: written(value)}], select: [`${parentOf(place.insert)}/${place.count}`]};
}

// Adds a kind in a slot of an entry.
export function addedTo(scene, entry, slot, kind, phases) {
  const value = slot.type === "object" && kind.type === "field" ? {set: {phase: phases[0], of: templateOf(kind, phases)}} : templateOf(kind, phases);
  const count = entry.children.filter((child) => child.slot === slot.name).length;
  const hasList = slot.list && textAt(scene.text, slot.pointer) !== null;
  const operation = hasList ? {insert: `${slot.pointer}/-`, value: written(value)}
    : {set: slot.pointer, to: written(slot.list ? [value] : value)};
  return {label: `Add ${kind.title.toLowerCase()}`, operations: [operation], select: [slot.list ? `${slot.pointer}/${count}` : slot.pointer]};
}

// A kind cut to a box of the usual size.
export function boxed(kind) {
  const box = '{"box": {"size": [1, 1, 1]}}';
  const template = kind.type === "field" ? `{"intersection": {"of": [${kind.template}, ${box}]}}`
    : `{"intersect_shape": {"shape": ${box}, "of": ${kind.template}}}`;
  return {...kind, template};
}

const lists = {light: "lights", mesh: "meshes", statement: "expect"};

const scaledBy = (value, k) => (Array.isArray(value) ? value.map((item) => scaledBy(item, k)) : typeof value === "number" ? Number((value * k).toPrecision(6)) : value);

// A light for a scene of a radius: as far away, as large and as bright there as the template is in a scene of radius 1.
function fittedLight(kind, value, radius) {
  const k = Number(radius.toPrecision(1)), isSmall = ["point", "spot", "ies"].includes(kind.kind), members = value[kind.kind];
  const factors = Object.fromEntries(kind.parameters.filter(({unit}) => unit === "m").map(({name}) => [name, k]));
  if (isSmall) factors.intensity = k * k; // others have a radiance, which distances do not change
  return {[kind.kind]: Object.fromEntries(Object.entries(members).map(([name, member]) => [name, scaledBy(member, factors[name] ?? 1)]))};
}

// Adds a kind of any type where it belongs. `radius` is that of the scene.
export function addedKind(scene, kind, active, phases, radius = 1) {
  if (kind.type === "field" || kind.type === "object") return addedNode(scene, kind, active, phases);
  const template = templateOf(kind, phases), label = `Add ${kind.title.toLowerCase()}`;
  const value = kind.type === "light" ? fittedLight(kind, template, radius) : template;
  if (kind.type === "material") return addedPhase(scene, freeName(kind.kind, keysAt(scene.text, "/phases")), value);
  if (kind.type === "camera") return {label, operations: [{set: "/camera", to: written(value)}], select: ["/camera"]};
  if (kind.type === "render") return {label, operations: [{set: "/render", to: written(value)}], select: ["/render"]};
  const {operation, pointer} = appended(scene, lists[kind.type], value);
  return {label, operations: [operation], select: [pointer]};
}

export const wrapped = (entry, value, title) =>
  ({label: `Wrap in ${title.toLowerCase()}`, operations: [{wrap: entry.pointer, in: written(value)}], select: [entry.pointer]});

// The pointer of the null in a wrapper.
function placeOfNull(value, at = "") {
  if (value === null) return at;
  if (typeof value !== "object") return null;
  for (const [key, member] of Object.entries(value)) {
    const found = placeOfNull(member, joined(at, key));
    if (found !== null) return found;
  }
  return null;
}

// Replaces an entry by one of another kind, which keeps the content if it takes it.
export function replaced(entry, kind, phases, catalogue) {
  const label = `Replace with ${kind.title.toLowerCase()}`, select = [entry.pointer];
  const child = entry.children.find((c) => isNode(c) && catalogue.slotsFor(kind, c.type).length > 0);
  if (!child) return {label, operations: [{set: entry.pointer, to: written(templateOf(kind, phases))}], select};
  const wrapper = wrapperOf(kind, child.type, phases, catalogue);
  const inner = entry.pointer + placeOfNull(wrapper);
  return {label, operations: [{wrap: entry.pointer, in: written(wrapper)},
    {unwrap: inner, keep: inner + child.pointer.slice(entry.pointer.length)}], select};
}

// The child that can stand where its parent stands.
const heirOf = (entry, without) => entry.children.find((child) => child !== without && mayStandAt(entry, child.type)) ?? null;

export function unwrapped(entry) {
  const heir = heirOf(entry, null);
  return heir && {label: "Remove the wrapper", operations: [{unwrap: entry.pointer, keep: heir.pointer}], select: [entry.pointer]};
}

// How to delete one entry. If its parent requires it, the parent is replaced by another child or deleted, too.
function deletion(entry) {
  const {parent} = entry;
  if (!parent) return {operation: {remove: entry.pointer}, select: []};
  if (isSection(parent)) return {operation: {remove: entry.pointer}, select: [parent.key]};
  const count = parent.children.filter((child) => child.slot === entry.slot).length;
  if (slotOf(entry)?.list && count > 1) return {operation: {remove: entry.pointer}, select: [parent.pointer]};
  const heir = isNode(entry) ? heirOf(parent, entry) : null;
  if (heir) return {operation: {unwrap: parent.pointer, keep: heir.pointer}, select: [parent.pointer]};
  if (!isNode(entry)) return {operation: {remove: entry.pointer}, select: [parent.pointer]};
  return deletion(parent);
}

// From the last to the first, so that no deletion moves another.
export function deleted(entries) {
  const order = (a, b) => b.pointer.localeCompare(a.pointer, undefined, {numeric: true});
  const outer = entries.filter((entry) => !entries.some((other) => other !== entry && entry.pointer.startsWith(`${other.pointer}/`)));
  const steps = [...outer].sort(order).map(deletion);
  return {label: outer.length === 1 ? "Delete" : `Delete ${outer.length}`, operations: steps.map((step) => step.operation), select: steps.at(-1).select};
}

// A copy of a value of the text, moved a little if it is a node.
function shifted(value, by) {
  const numbers = value?.translate?.by;
  if (Array.isArray(numbers) && numbers.every((x) => typeof x === "number"))
    return {translate: {...value.translate, by: numbers.map((x, i) => x + by[i])}};
  return {translate: {by, of: value}};
}
// For a `set` node, the translation is inserted below it, around the field, so that a later move finds and extends it.
const shiftedNode = (value, by) => (value?.set?.of ? {set: {...value.set, of: shifted(value.set.of, by)}} : shifted(value, by));

// A copy of a light or a mesh, at another place if it has one.
function shiftedPart(value, distance) {
  const isPoint = (item) => Array.isArray(item) && item.length === 3 && item.every((x) => typeof x === "number");
  const shift = (item) => (isPoint(item) ? [Number((item[0] + distance).toPrecision(6)), item[1], item[2]] : Array.isArray(item) ? item.map(shift) : item);
  const places = ["centre", "center", "centres", "centers", "position", "translate"];
  const [[kind, members]] = Object.entries(value);
  if (members === null || typeof members !== "object" || Array.isArray(members)) return value;
  return {[kind]: Object.fromEntries(Object.entries(members).map(([name, item]) => [name, places.includes(name) ? shift(item) : item]))};
}

export function duplicated(scene, entry, distance) {
  const label = "Duplicate", value = parsed(textAt(scene.text, entry.pointer));
  if (entry.parent && isSection(entry.parent) && !isInList(entry)) {
    const name = freeName(`${entry.label} copy`, keysAt(scene.text, `/${entry.parent.name}`)), pointer = joined("", entry.parent.name, name);
    return {label, operations: [{insert: pointer, value: written(value)}], select: [pointer]};
  }
  const copy = isNode(entry) ? shiftedNode(value, [distance, 0, 0]) : ["light", "mesh"].includes(entry.type) ? shiftedPart(value, distance) : value;
  if (isInList(entry)) {
    const next = indexOf(entry) + 1, pointer = `${listOf(entry)}/${next}`;
    return {label, operations: [{insert: next < listLength(entry) ? pointer : `${listOf(entry)}/-`, value: written(copy)}], select: [pointer]};
  }
  if (!isNode(entry)) return null;
  const combiner = combinerOf(entry.type);
  return {label, operations: [{wrap: entry.pointer, in: written({[combiner]: [null]})}, {insert: `${entry.pointer}/${combiner}/-`, value: written(copy)}],
    select: [`${entry.pointer}/${combiner}/1`]};
}

// Puts entries of one list together, where the first of them is.
export function grouped(entries) {
  const sorted = [...entries].sort((a, b) => indexOf(a) - indexOf(b)), [first, ...others] = sorted;
  if (!first || !sorted.every((entry) => isNode(entry) && isInList(entry) && listOf(entry) === listOf(first))) return null;
  const combiner = combinerOf(first.type), inside = `${first.pointer}/${combiner}`;
  // From the last to the first, each to the place after the first.
  const moves = others.reverse().map((entry, i) => ({move: entry.pointer, to: `${inside}/${i === 0 ? "-" : 1}`}));
  return {label: `Group ${sorted.length}`, select: [first.pointer], operations: [{wrap: first.pointer, in: written({[combiner]: [null]})}, ...moves]};
}

// Makes an entry a shape with a name, which can be used several times.
export function namedShape(scene, entry, name) {
  const {operation, pointer} = added(scene, "shapes", name, null);
  const text = textAt(scene.text, entry.pointer);
  const insert = operation.insert ? {insert: pointer, value: text} : {set: "/shapes", to: `{${JSON.stringify(name)}: ${text}}`};
  return {label: `Make ${name} reusable`, operations: [insert, {set: entry.pointer, to: JSON.stringify(name)}], select: [pointer]};
}

// Moves a list entry to just before the value at pointer `to`, or to the end ("/-"). `to` is given as it is before the move.
export function moved(entry, to) {
  const last = to.split("/").at(-1), list = parentOf(to), from = entry.pointer;
  const isLater = list === listOf(entry) && last !== "-" && Number(last) > indexOf(entry);
  const lands = isLater ? `${list}/${Number(last) - 1}` : to;
  // If the target list lies in a later item of the entry's own list, that item's index decreases by one when the entry
  // is removed.
  const outer = listOf(entry), inner = lands.startsWith(`${outer}/`) && list !== outer ? lands.slice(outer.length + 1).split("/") : null;
  if (inner && Number(inner[0]) > indexOf(entry)) inner[0] = String(Number(inner[0]) - 1);
  const target = inner ? `${outer}/${inner.join("/")}` : lands;
  return {label: "Move in the outline", operations: [{move: from, to: target}], select: [target]};
}
