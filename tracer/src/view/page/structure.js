// Where entries of the outline stand, and what may stand there.
import {fits} from "./catalogue.js";
import {joined, lastKey, parentOf} from "./pointer.js";

export const isSection = (entry) => entry.isSection === true;
export const isNode = (entry) => entry.type === "field" || entry.type === "object";
export const membersOf = (entry) => entry.members;

// The pointer of a parameter: what is written without its name has the pointer of its parent.
export const pointerOf = (entry, name) => entry.parameters[name]?.pointer ?? joined(membersOf(entry), name);

// The slot of its parent in which an entry stands, or null.
export const slotOf = (entry) => entry.parent?.slots.find((slot) => slot.name === entry.slot) ?? null;

// Whether an entry is one of a list, in which it may be moved and from which it may be removed.
export const isInList = (entry) => /^\d+$/.test(lastKey(entry.pointer)) &&
  (slotOf(entry)?.list === true || Boolean(entry.parent && isSection(entry.parent)));

export const listOf = (entry) => parentOf(entry.pointer);
export const indexOf = (entry) => Number(lastKey(entry.pointer));
export const listLength = (entry) =>
  entry.parent.children.filter((child) => parentOf(child.pointer) === listOf(entry)).length;

// The type that may stand where an entry stands.
export function typeOfPlace(entry) {
  const slot = slotOf(entry);
  if (slot) return slot.type;
  if (entry.pointer === "/tree") return "object";
  if (entry.pointer.startsWith("/shapes/")) return "field object";
  return entry.type;
}

export const mayStandAt = (entry, type) => fits(typeOfPlace(entry), type);

// From an entry down to where it branches: a filled, moved sphere is one thing to a person.
export function chainOf(entry) {
  const chain = [entry];
  while (chain.at(-1).children?.length === 1 && chain.length < 6) chain.push(chain.at(-1).children[0]);
  return chain;
}

// The uppermost entry whose chain contains this one.
export function topOfChain(entry) {
  let top = entry;
  while (top.parent && !isSection(top.parent) && top.parent.children.length === 1) top = top.parent;
  return top;
}

// What a point belongs to, from the outside in, along the nodes that decide it: first one of the parts that the scene's tree
// puts together, and a reusable shape after the place where it is used.
export function partsAlong(entries) {
  const parts = new Set();
  for (const entry of entries) {
    const above = pathTo(entry), first = above.indexOf(topOfChain(entry));
    for (const one of above.slice(first)) parts.add(one);
    if (entry.children.length === 1 && entry.children[0].kind === "reference") parts.add(entry.children[0]);
  }
  const all = [...parts], [root] = all;
  if (!root || root.pointer.startsWith("/shapes/")) return all;
  const branch = all.findIndex((entry) => entry.children.length > 1);
  const isPutTogether = branch >= 0 && branch + 1 < all.length && isInList(all[branch + 1]) && all[branch + 1].parent === all[branch];
  return isPutTogether && root.parent === null ? all.slice(branch + 1) : all;
}

export function pathTo(entry) {
  const path = [];
  for (let at = entry; at && !isSection(at); at = at.parent) path.unshift(at);
  return path;
}
