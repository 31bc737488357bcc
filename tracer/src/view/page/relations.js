// Parameters that exclude or require each other. When one is set or removed, the others follow in the same step, so that
// the scene stays valid: a measured medium removes a colour, and brings its scale.
import {joined} from "./pointer.js";
import {membersOf, pointerOf} from "./structure.js";

const none = {exclusive: [], requirements: [], one_of: [], initial: ""};

// What has to be removed and added, as {removed: names, added: {name: text}}, when a parameter is set (or removed, if
// `isSet` is false). `present` are the names of the parameters that are given.
export function followers(relations, present, name, isSet) {
  const {exclusive, requirements, one_of: oneOf, initial} = relations ?? none;
  const given = new Set(present), added = {};
  const add = (one, text) => {
    for (const list of exclusive) if (list.includes(one)) for (const other of list) given.delete(other);
    given.add(one);
    if (one !== name) added[one] = text;
  };
  if (isSet) add(name, null);
  else given.delete(name);
  const isNew = (one) => one in added || (isSet && one === name);
  const lacking = ({parameter, any_of: anyOf}) => given.has(parameter) && !anyOf.some((one) => given.has(one));
  const excludes = (a, b) => exclusive.some((list) => list.includes(a) && list.includes(b));
  for (let i = 0; i < requirements.length; ++i) {
    const next = requirements.find((one) => lacking(one) && (!isNew(one.parameter) || (one.initial !== "" && !excludes(one.any_of[0], name))));
    if (!next) break;
    if (isNew(next.parameter)) add(next.any_of[0], next.initial);
    else given.delete(next.parameter);
  }
  if (oneOf.length > 0 && !oneOf.some((one) => given.has(one))) add(oneOf[0], initial);
  return {removed: [...present].filter((one) => one !== name && !given.has(one)), added: Object.fromEntries(Object.entries(added).filter(([one]) => given.has(one)))};
}

// The operations for the followers of a parameter of an entry: what must be done before, and after, it is set or removed.
export function following(kind, entry, name, isSet) {
  // The mass density of a phase stands beside its material, which may have another density.
  const isOwn = (one) => pointerOf(entry, one) === joined(membersOf(entry), one);
  const present = new Set([...Object.keys(entry.parameters ?? {}).filter(isOwn), ...entry.children.map((child) => child.slot)]);
  const {removed, added} = followers(kind?.relations, present, name, isSet);
  return {before: removed.map((one) => ({remove: pointerOf(entry, one)})),
    after: Object.entries(added).map(([one, text]) => ({set: joined(membersOf(entry), one), to: text}))};
}
