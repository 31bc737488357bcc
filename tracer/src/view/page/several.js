// Operations on several entries at once, and on reusable shapes. As in edits.js, each function returns
// {label, operations, select}, or null where it makes no sense.
import {mapTo} from "./affine.js";
import {combinerOf, grouped, withPhases} from "./edits.js";
import {keysAt, parsed, textAt, written} from "./json_text.js";
import {joined} from "./pointer.js";
import {indexOf, isInList, isNode, listLength, listOf} from "./structure.js";

const inOneList = (entries) => entries.length > 1 && entries.every((entry) => isNode(entry) && isInList(entry) && listOf(entry) === listOf(entries[0]));
const inOrder = (entries) => [...entries].sort((a, b) => indexOf(a) - indexOf(b));

// Puts entries of one list together, and a node around them.
export function wrappedTogether(entries, value, title) {
  const group = inOneList(entries) ? grouped(entries) : null;
  return group && {...group, label: `${title}, ${entries.length} parts`, operations: [...group.operations, {wrap: group.select[0], in: written(value)}]};
}

// Makes one shape with a name of entries of one list.
export function shapeOfSeveral(scene, entries, name) {
  if (!inOneList(entries)) return null;
  const sorted = inOrder(entries), texts = sorted.map((entry) => textAt(scene.text, entry.pointer));
  const value = `{${JSON.stringify(combinerOf(sorted[0].type))}: [${texts.join(", ")}]}`, pointer = joined("/shapes", name);
  const insert = textAt(scene.text, "/shapes") === null ? {set: "/shapes", to: `{${JSON.stringify(name)}: ${value}}`} : {insert: pointer, value};
  const removals = sorted.slice(1).reverse().map((entry) => ({remove: entry.pointer}));
  return {label: `Make ${name} reusable`, operations: [insert, ...removals, {set: sorted[0].pointer, to: JSON.stringify(name)}], select: [pointer]};
}

// The reusable shapes, as kinds that can be added.
export function shapeKinds(scene) {
  const inside = scene.section("shapes")?.children ?? [];
  return inside.filter((entry) => entry.label).map((entry) => ({
    kind: "reference", title: entry.label, type: entry.type, chapter: "reusable-shapes", help: "A reusable shape of this scene.", picture: null, parameters: [], slots: [],
    template: JSON.stringify(entry.label),
  }));
}

// Replaces a reference by a copy of what it refers to.
export function ownCopy(scene, entry) {
  const text = entry.kind === "reference" ? textAt(scene.text, entry.target) : null;
  return text && {label: `Make a copy of ${entry.label}`, operations: [{set: entry.pointer, to: text}], select: [entry.pointer]};
}

// Moves an entry below or above all others of a selection: in "over", earlier objects replace later ones, and in "under",
// later ones earlier ones.
export function stacked(entries, active, isBelow) {
  const kind = active?.parent?.kind;
  if (!active || !["over", "under"].includes(kind) || !inOneList(entries)) return null;
  const others = entries.filter((entry) => entry !== active).map(indexOf), list = listOf(active), from = indexOf(active);
  const isLast = isBelow === (kind === "over"), to = isLast ? Math.max(...others) : Math.min(...others);
  if (isLast ? from > to : from < to) return null;
  // The place is one after the entry has been taken out.
  const target = isLast && to === listLength(active) - 1 ? `${list}/-` : `${list}/${to}`;
  return {label: isBelow ? "Put under" : "Put over", operations: [{move: active.pointer, to: target}], select: [`${list}/${to}`]};
}

const placings = ["translate", "rotate", "scale", "stretch", "affine"];
const listIn = (members) => (Array.isArray(members) ? members : members.of ?? []);

// The hollow of a vessel, as a field: what was cut out of it. null if nothing was.
export function hollowOf(value, shapes) {
  if (typeof value === "string") return value in shapes ? hollowOf(shapes[value], shapes) : null;
  const [[kind, members]] = Object.entries(value ?? {none: null});
  if (placings.includes(kind)) {
    const inner = hollowOf(members.of, shapes);
    return inner && {[kind]: {...members, of: inner}};
  }
  switch (kind) {
    case "difference": case "smooth_difference": {
      const {subtract, radius} = members, cut = subtract.length === 1 ? subtract[0] : {union: subtract};
      // Into the rounded edge, where the vessel replaces it.
      return radius ? {offset: {distance: radius / 4, of: cut}} : cut;
    }
    case "subtract_shape": case "smooth_subtract_shape": return members.shape;
    case "shell": return members.of;
    case "bowl": return {sphere: {radius: members.radius}};
    case "tube": return {cylinder: {radius: (members.radius + members.inner_radius) / 2, height: members.height}};
    case "set": case "intersect_shape": case "displace": return hollowOf(members.of, shapes);
    case "over": case "under": case "union": case "intersection": case "smooth_union": case "smooth_intersection":
      return listIn(members).map((item) => hollowOf(item, shapes)).find((found) => found !== null) ?? null;
    default: return null;
  }
}

// The half-space below a height of the scene, in the space around an entry.
function belowLevel(entry, level) {
  const {m, t} = mapTo(entry, false), normal = m[2], size = Math.hypot(...normal), offset = (level - t[2]) / size;
  const isUpright = Math.abs(normal[0]) < 1e-6 * size && Math.abs(normal[1]) < 1e-6 * size && normal[2] > 0;
  return {plane: isUpright ? {offset: Number(offset.toPrecision(4))} : {normal: normal.map((x) => Number((x / size).toPrecision(6))), offset}};
}

// Fills a vessel with a phase up to a height of the scene. The content of a thin shell is cut there instead.
export function filledTo(scene, entry, level, phase) {
  const plane = belowLevel(entry, level), shell = entry.kind === "thin_shell" ? entry : null;
  if (shell) {
    const inside = parsed(textAt(scene.text, joined(shell.members, "inside")) ?? "null");
    return inside && {label: `Fill up to ${level.toPrecision(3)}`, select: [entry.pointer],
      operations: [{wrap: entry.pointer, in: written({intersect_shape: {shape: plane, of: null, phases: inside}})}]};
  }
  const shapes = Object.fromEntries(keysAt(scene.text, "/shapes").map((name) => [name, parsed(textAt(scene.text, joined("/shapes", name)))]));
  const hollow = entry.type === "object" ? hollowOf(parsed(textAt(scene.text, entry.pointer)), shapes) : null;
  if (!hollow) return null;
  const content = withPhases({intersect_shape: {shape: plane, of: {set: {phase: "<phase>", of: hollow}}}}, [phase]);
  const [operations, pointer] = isInList(entry) && entry.parent.kind === "over"
    ? [[{insert: `${listOf(entry)}/${indexOf(entry) + 1 < listLength(entry) ? indexOf(entry) + 1 : "-"}`, value: written(content)}], `${listOf(entry)}/${indexOf(entry) + 1}`]
    : [[{wrap: entry.pointer, in: written({over: [null]})}, {insert: `${entry.pointer}/over/-`, value: written(content)}], `${entry.pointer}/over/1`];
  return {label: `Fill up to ${level.toPrecision(3)}`, operations, select: [pointer]};
}
