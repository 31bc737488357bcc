// Affine maps of the tree's transforms, from a node's own coordinates to the scene's: p ↦ m p + t.
import {parsed} from "./json_text.js";
import {nowOf} from "./keyframes.js";
import {isNode, pathTo} from "./structure.js";

export const identity = {m: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], t: [0, 0, 0]};

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const transformVector = ({m}, v) => m.map((row) => dot(row, v));
export const transformPoint = (map, p) => transformVector(map, p).map((x, i) => x + map.t[i]);
const columns = (m) => [0, 1, 2].map((j) => m.map((row) => row[j]));
const product = (a, b) => a.map((row) => columns(b).map((column) => dot(row, column)));
const compose = (outer, inner) => ({m: product(outer.m, inner.m), t: transformPoint(outer, inner.t)});

// The preimage of a vector under a map's linear part; null if that is singular.
export function inverseTransformVector({m}, v) {
  const [a, b, c] = columns(m);
  const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const volume = dot(a, cross(b, c));
  if (Math.abs(volume) < 1e-12) return null;
  return [dot(v, cross(b, c)), dot(v, cross(c, a)), dot(v, cross(a, b))].map((x) => x / volume);
}

function rotation([x, y, z], degrees) {
  const size = Math.hypot(x, y, z) || 1, [a, b, c] = [x / size, y / size, z / size];
  const angle = degrees * Math.PI / 180, cos = Math.cos(angle), sin = Math.sin(angle), k = 1 - cos;
  return [[cos + a * a * k, a * b * k - c * sin, a * c * k + b * sin], [b * a * k + c * sin, cos + b * b * k, b * c * k - a * sin],
    [c * a * k - b * sin, c * b * k + a * sin, cos + c * c * k]];
}

// A parameter of an entry as the file has it; what is too long to be shown is absent.
export function writtenValueOf(entry, name, fallback = null) {
  const text = entry.parameters[name]?.text ?? null;
  try {
    return text === null ? fallback : parsed(text);
  } catch {
    return fallback;
  }
}

// A parameter of an entry, at the time of the picture.
export const valueOf = (entry, name, fallback = null) => nowOf(writtenValueOf(entry, name, fallback));

// The map of one node, from its content to itself.
function ownMap(entry) {
  const diagonal = (x, y, z) => ({m: [[x, 0, 0], [0, y, 0], [0, 0, z]], t: [0, 0, 0]});
  switch (entry.kind) {
    case "translate": return {...identity, t: valueOf(entry, "by", [0, 0, 0])};
    case "rotate": return {m: rotation(valueOf(entry, "axis", [0, 0, 1]), valueOf(entry, "angle", 0)), t: [0, 0, 0]};
    case "scale": {
      const factor = valueOf(entry, "factor", 1);
      return diagonal(factor, factor, factor);
    }
    case "stretch": return diagonal(...valueOf(entry, "factors", [1, 1, 1]));
    // The section's y axis becomes the z axis.
    case "revolve": return {m: [[1, 0, 0], [0, 0, -1], [0, 1, 0]], t: [valueOf(entry, "offset", 0), 0, 0]};
    default: return identity;
  }
}

// The map from an entry's content to the scene. A reusable shape is mapped to its first use. `isInside`: include the
// entry's own map.
export function mapTo(entry, isInside = true, depth = 0) {
  const nodes = pathTo(entry).filter(isNode), [root] = nodes;
  const own = (isInside ? nodes : nodes.slice(0, -1)).map(ownMap).reduce(compose, identity);
  return root?.uses.length > 0 && depth < 16 ? compose(mapTo(root.uses[0], true, depth + 1), own) : own;
}
