// Values that change with time, as scene files write them: {"keys": [[seconds, value], …], "between": "smooth"}. They are
// shown and changed at the time of the picture.

export const present = {seconds: 0, span: null}; // of the picture; the span from the first key of the scene to the last

export const isKeyed = (value) => Array.isArray(value?.keys) && value.keys.length > 0 && value.keys.every((key) => Array.isArray(key) && key.length === 2);

const near = (a, b) => Math.abs(a - b) < 1e-4 * Math.max(1, Math.abs(a));
export const keyNear = (keyed, seconds) => keyed.keys.findIndex(([at]) => near(at, seconds));

const mixed = (a, b, share) => {
  if (typeof a === "number" && typeof b === "number") return a + (b - a) * share;
  if (Array.isArray(a) && Array.isArray(b) && a.length === b.length) return a.map((x, i) => mixed(x, b[i], share));
  return a;
};

// The value at a time: that of the first key before it, and that of the last key after it.
export function valueAt({keys, between}, seconds) {
  const after = keys.findIndex(([at]) => at > seconds);
  if (after === 0) return keys[0][1];
  if (after < 0) return keys.at(-1)[1];
  const [from, a] = keys[after - 1], [to, b] = keys[after], share = (seconds - from) / (to - from);
  return mixed(a, b, between === "smooth" ? share * share * (3 - 2 * share) : share);
}

export const nowOf = (value) => (isKeyed(value) ? valueAt(value, present.seconds) : value);

const rounded = (seconds) => Number(seconds.toFixed(3));
const inOrder = (keyed, keys) => ({...keyed, keys: keys.sort(([a], [b]) => a - b)});

// With a value at a time, in a key that is there or in another one.
export function withKey(keyed, seconds, value) {
  const i = keyNear(keyed, seconds), key = [i < 0 ? rounded(seconds) : keyed.keys[i][0], value];
  return inOrder(keyed, [...keyed.keys.filter((_, j) => j !== i), key]);
}

// Two keys are the fewest. A constant gets one now, and one at the end of the scene's keys, or a second later.
export function firstKeys(value) {
  const at = rounded(present.seconds), [first, last] = present.span ?? [at, at + 1];
  const other = near(at, last) ? (near(at, first) ? at + 1 : first) : Math.max(last, at + 1e-3);
  return inOrder({}, [[at, value], [rounded(other), value]]);
}

// Without a key; a value with a single key left is constant.
export function withoutKey(keyed, i) {
  const keys = keyed.keys.filter((_, j) => j !== i);
  return keys.length < 2 ? keys[0][1] : {...keyed, keys};
}

// With a key at another time, at which no other key may be.
export function withMovedKey(keyed, i, seconds) {
  const at = rounded(seconds);
  if (keyed.keys.some(([other], j) => j !== i && rounded(other) === at)) return null;
  return inOrder(keyed, keyed.keys.map((key, j) => (j === i ? [at, key[1]] : key)));
}

// What a parameter becomes when it is set at the present time.
export const set = (old, value) => (isKeyed(old) ? withKey(old, present.seconds, value) : value);
