// What may be written at a place of the scene's text: the parameters of the kind around it, and the names of kinds.

const most = 12;

// The name of the object around a position: `"sphere": {` gives "sphere".
export function kindAround(text, at) {
  let depth = 0;
  for (let i = at - 1; i >= 0; --i) {
    if (text[i] === "}" || text[i] === "]") ++depth;
    else if ((text[i] === "{" || text[i] === "[") && depth > 0) --depth;
    else if (text[i] === "{") return /"([^"\\]*)"\s*:\s*$/.exec(text.slice(Math.max(0, i - 80), i))?.[1] ?? null;
  }
  return null;
}

// {typed, names}: the text typed since the opening quotation mark, and the names that complete it; null if the position is
// not in a key or a name.
export function completions(text, at, catalogue) {
  const typed = /[{,[:]\s*"(\w*)$/.exec(text.slice(Math.max(0, at - 120), at))?.[1];
  if (typed === undefined) return null;
  const around = kindAround(text, at - typed.length - 1), inside = catalogue.kinds.filter((kind) => kind.kind === around);
  const parameters = inside.flatMap((kind) => [...kind.parameters, ...kind.slots].map(({name}) => name));
  const names = [...new Set([...parameters, ...(inside.length > 0 && typed === "" ? [] : catalogue.kinds.map((kind) => kind.kind))])];
  return {typed, names: names.filter((name) => name.startsWith(typed) && name !== typed).slice(0, most)};
}
