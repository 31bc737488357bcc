// Merges two changes of a text, each of which is seen as one range that has been replaced.

// {from, to, text}: what must be replaced in `before` to get `after`.
function changeBetween(before, after) {
  const least = Math.min(before.length, after.length);
  let from = 0, same = 0;
  while (from < least && before[from] === after[from]) ++from;
  while (same < least - from && before.at(-1 - same) === after.at(-1 - same)) ++same;
  return {from, to: before.length - same, text: after.slice(from, after.length - same)};
}

const applied = (text, {from, to, text: next}) => text.slice(0, from) + next + text.slice(to);

// {text, move}: the text with both changes, and where a position of `mine` is in it. null if the changes touch each other.
export function merged(base, mine, theirs) {
  const a = changeBetween(base, mine), b = changeBetween(base, theirs), growth = b.text.length - (b.to - b.from);
  if (a.to < b.from) return {text: applied(applied(base, b), a), move: (at) => at + (at > a.from + a.text.length + (b.from - a.to) ? growth : 0)};
  if (b.to < a.from) return {text: applied(applied(base, a), b), move: (at) => at + (at > b.from ? growth : 0)};
  return null;
}
