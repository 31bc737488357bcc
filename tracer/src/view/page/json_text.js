// Finds the text of values in a scene file: JSON with comments.
import {keysOf} from "./pointer.js";

const blank = /(?:[\s,:]|\/\/[^\n]*|\/\*[^]*?\*\/)*/y;
const scalar = /"(?:[^"\\]|\\.)*"|[^\s,:\]}{["/]+/y;

// The value that begins at a position: {start, end}, and its {members: [[key, value], …]} or {items}.
function valueAt(text, from) {
  const skip = (at) => {
    blank.lastIndex = at;
    blank.test(text);
    return blank.lastIndex;
  };
  const start = skip(from);
  if (text[start] === "{" || text[start] === "[") {
    const isObject = text[start] === "{", children = [];
    let at = skip(start + 1);
    while (at < text.length && text[at] !== "}" && text[at] !== "]") {
      let key = null;
      if (isObject) {
        const name = valueAt(text, at);
        key = JSON.parse(text.slice(name.start, name.end));
        at = name.end;
      }
      const child = valueAt(text, at);
      children.push(isObject ? [key, child] : child);
      at = skip(child.end);
    }
    return {start, end: at + 1, [isObject ? "members" : "items"]: children};
  }
  scalar.lastIndex = start;
  if (!scalar.test(text)) throw new SyntaxError("not JSON");
  return {start, end: scalar.lastIndex};
}

function childOf(value, key) {
  if (value?.members) return value.members.find(([name]) => name === key)?.[1];
  return value?.items?.[Number(key)];
}

// The tree of the last text, because many values of it are looked up.
let last = {text: null, root: null};

function valueOf(text, pointer) {
  if (text !== last.text) {
    try {
      last = {text, root: valueAt(text, 0)};
    } catch {
      last = {text, root: null};
    }
  }
  return keysOf(pointer).reduce(childOf, last.root) ?? null;
}

// The text of the value at a pointer, or null.
export function textAt(text, pointer) {
  const value = valueOf(text, pointer);
  return value && text.slice(value.start, value.end);
}

export const isListAt = (text, pointer) => Boolean(valueOf(text, pointer)?.items);

// The value of a text that may contain comments.
export function parsed(text) {
  const plain = text.replace(/"(?:[^"\\]|\\.)*"|\/\/[^\n]*|\/\*[^]*?\*\//g, (part) => (part[0] === '"' ? part : " "));
  return JSON.parse(plain);
}

// The keys of an object's members, or the indices of a list's items, at a pointer.
export function keysAt(text, pointer) {
  const value = valueOf(text, pointer);
  return value?.members ? value.members.map(([key]) => key) : (value?.items ?? []).map((_, i) => i);
}

const rounded = (x) => Number(x.toPrecision(6));

// Values as the scene files write them: one line, with blanks after commas and colons.
export function written(value) {
  if (typeof value === "number") return String(rounded(value));
  if (Array.isArray(value)) return `[${value.map(written).join(", ")}]`;
  if (value !== null && typeof value === "object")
    return `{${Object.entries(value).map(([key, member]) => `${JSON.stringify(key)}: ${written(member)}`).join(", ")}}`;
  return JSON.stringify(value);
}
