// Where the handles of a kind are: a dot for each length that it has, and for each of its points. Coordinates are those of
// the kind's own space.
//
// A handle is one of
//   {name, path, value, from, along}  a number, at from + value · along; `start` stands for a value that has no place
//   {name, path, value, basis}        a point, which moves along the vectors of the basis, or in the picture's plane
//   {name, path, value}               a number without a place, such as a blend radius
// where `path` has the name of the parameter and, for an item of it, its indices.

const x = [1, 0, 0], y = [0, 1, 0], z = [0, 0, 1], origin = [0, 0, 0];
const unitVectors = [x, y, z];
const times = (a, k) => a.map((c) => c * k);
const plus = (a, b) => a.map((c, i) => c + b[i]);
const normalised = (a) => times(a, 1 / Math.hypot(...a));
const middle = (a, b) => times(plus(a, b), 0.5);

// Each of these makes a function of the values and of the axes: `facing` is to the right in the picture, and `radial` as
// near to that as possible in the xy plane.
const length = (name, from, along) => (v, axes) => ({name, path: [name], value: v[name], from: from(v, axes), along: along(v, axes)});
const centre = () => origin;
const ball = (name = "radius", from = centre) => length(name, from, (_, axes) => axes.facing);
const rim = (name = "radius", height = () => 0) => length(name, (v) => [0, 0, height(v)], (_, axes) => axes.radial);
const tall = (name = "height", along = z) => length(name, centre, () => times(along, 0.5));
const edges = (name = "size") => unitVectors.map((axis, i) => (v) => ({name: `${name}, ${"xyz"[i]}`, path: [name, i], value: v[name]?.[i], from: origin, along: times(axis, 0.5)}));
const halfAxes = (name) => unitVectors.map((axis, i) => (v) => ({name: `${name}, ${"xyz"[i]}`, path: [name, i], value: v[name]?.[i], from: origin, along: axis}));
// A spacing of 0 means no copies. Its handle is where the next copy would be, as far away as those along other axes.
const spacings = (name) => unitVectors.map((axis, i) => (v) => ({
  name: `${name}, ${"xyz"[i]}`, path: [name, i], value: v[name]?.[i], from: origin, along: axis, start: v[name]?.[i] === 0 ? Math.max(...v[name]) : undefined,
}));
const point = (name) => (v) => ({name, path: [name], value: v[name]});
const measure = (name) => (v) => ({name, path: [name], value: v[name]});
const points = (name, basis) => (v) => (v[name] ?? []).slice(0, mostPoints).map((value, i) => ({name: `${name} ${i + 1}`, path: [name, i], value, basis}));
const alongNormal = (name) => length(name, centre, (v) => normalised(v.normal));
// Inwards from a corner of a box.
const corner = (name) => length(name, (v) => times(v.size, 0.5), () => [0, 0, -1]);
const mostPoints = 64;

const tube = [rim(), length("inner_radius", centre, (_, axes) => times(axes.radial, -1)), tall()];
const cell = [length("period", centre, () => x), measure("thickness")];

const ofFields = {
  sphere: [ball()], octahedron: [length("radius", centre, () => x)], tetrahedron: [length("radius", centre, () => normalised([1, 1, 1]))],
  dodecahedron: [ball()], icosahedron: [ball()],
  box: edges(), wedge: edges(), rounded_box: [...edges(), corner("radius")], box_frame: [...edges(), corner("thickness")],
  cylinder: [rim(), tall()], prism: [rim(), tall()], tube,
  rounded_cylinder: [rim(), tall(), length("edge", (v, axes) => plus(times(axes.radial, v.radius), [0, 0, v.height / 2]), () => [0, 0, -1])],
  capped_cone: [rim("radius_bottom", (v) => -v.height / 2), rim("radius_top", (v) => v.height / 2), tall()],
  capsule: [point("from"), point("to"), ball("radius", (v) => middle(v.from, v.to))],
  round_cone: [point("from"), point("to"), ball("radius_from", (v) => v.from), ball("radius_to", (v) => v.to)],
  torus: [rim("major"), length("minor", (v, axes) => times(axes.radial, v.major), () => z)],
  capped_torus: [length("major", centre, () => x), length("minor", (v) => [v.major, 0, 0], () => z)],
  link: [length("length", centre, () => times(y, 0.5)), length("major", centre, () => x), length("minor", (v) => [v.major, 0, 0], () => z)],
  plane: [alongNormal("offset")],
  slab: [alongNormal("offset"), length("thickness", (v) => times(normalised(v.normal), v.offset), (v) => times(normalised(v.normal), 0.5))],
  ellipsoid: halfAxes("radii"),
  spherical_cap: [ball(), length("cut", centre, () => z)],
  bowl: [ball(), length("cut", centre, () => z), length("thickness", (v) => [0, 0, -v.radius], () => [0, 0, -0.5])],
  pyramid: [length("base", (v) => [0, 0, -v.height / 2], () => times(x, 0.5)), tall()],
  gyroid: cell, schwarz_p: cell, schwarz_d: cell,
  polyline: [points("points"), ball("radius", (v) => v.points?.[0])],
  voronoi_cells: [length("size", centre, () => x), measure("gap"), measure("rounding")],
  height_map: [tall("size_x", x), tall("size_y", y), length("height", centre, () => z)],
  circle: [rim()],
  rectangle: [tall("width", x), tall("height", y), length("radius", (v) => [v.width / 2, v.height / 2, 0], () => [-1, 0, 0])],
  star: [length("radius", centre, () => x), length("inner_radius", centre, (v) => [Math.cos(Math.PI / v.points), Math.sin(Math.PI / v.points), 0])],
  helix: [length("radius", centre, () => x), length("pitch", centre, (v) => [0, 0, v.turns / 2]), length("wire_radius", (v) => [v.radius, 0, -v.pitch * v.turns / 2], () => x)],
  heightfield: [length("size", centre, () => x), length("amplitude", centre, () => z)],
  polygon: [points("points", [x, y])], bezier: [points("points", [x, y]), measure("thickness")],
  text: [length("size", centre, () => y)],
  formula: [points("bounds")], balls: [points("centres")], mesh: [measure("thickness")],
  smooth_union: [measure("radius")], smooth_intersection: [measure("radius")], smooth_difference: [measure("radius")],
  offset: [measure("distance")], shell: [measure("half_thickness")], displace: [measure("amplitude"), measure("scale")],
  blob: [points("points"), points("polyline")], extrude: [tall()], revolve: [length("offset", centre, () => x)],
};

const copies = {
  grid: halfAxes("spacing"), endless_grid: spacings("spacing"),
  instances: [points("positions")], fibonacci_disk: [rim()], fibonacci_sphere: [ball()], scatter: [measure("spacing")],
  bounding_volume: [measure("margin")], proxy: [measure("error"), measure("margin")], level_of_detail: [point("viewpoint")],
  distort: [measure("amplitude"), measure("scale")],
};

const ofObjects = {
  thin_shell: [measure("half_thickness")], layered: [measure("thickness")], smooth_layered: [measure("thickness"), measure("radius")],
  close_gaps: [measure("gap")], smooth_unite_shape: [measure("radius")], smooth_unite_shape_below: [measure("radius")],
  smooth_intersect_shape: [measure("radius")], smooth_subtract_shape: [measure("radius")], interface: [measure("half_thickness")],
  interfaces: [measure("half_thickness")], checker: [point("origin"), length("size", (v) => v.origin, () => x)],
  layers: [length("offset", centre, (v) => normalised(v.direction))],
  strata: [length("offset", centre, (v) => normalised(v.direction))],
  voronoi: [length("size", centre, () => x)], particles: [points("centres")], labels: [],
};

// A panel of light is a rectangle that faces its target; its sides are measured without a place.
const panel = [point("centre"), point("target"), measure("width"), measure("height")];
const ofLights = {
  rectangle: panel, portal: panel, sphere: [point("centre"), ball("radius", (v) => v.centre)],
  spheres: [points("centres"), ball("radius", (v) => v.centres?.[0])], point: [point("position")],
  spot: [point("position"), point("target")], ies: [point("position"), point("target")],
};

const ofMeshes = {
  floor: [length("height", centre, () => z)],
  backdrop: [length("height", centre, () => z), length("distance", (v) => [0, 0, v.height], () => y), measure("radius")],
  obj: [point("translate")], ply: [point("translate")], stl: [point("translate")], gltf: [point("translate")],
};

const ofCamera = [point("look_at"), point("focus_at"), point("position")];

const makersOf = ({type, kind}) => ({
  field: ofFields[kind] ?? copies[kind], object: ofObjects[kind] ?? copies[kind], light: ofLights[kind], mesh: ofMeshes[kind],
  camera: ofCamera,
})[type] ?? [];

const isFinite = (value) => [value].flat(2).every((c) => Number.isFinite(c));

// The handles of an entry. `values` are those of its parameters, with defaults.
export function handlesIn(entry, values, axes) {
  const made = makersOf(entry).flatMap((make) => {
    try {
      return make(values, axes);
    } catch {
      return []; // a value that is missing, or of another sort
    }
  });
  const isComplete = ({value, from, along}) => value !== null && value !== undefined && isFinite(value) && isFinite(from ?? 0) && isFinite(along ?? 0);
  return made.filter((handle) => isComplete(handle) && (!Array.isArray(handle.value) || [2, 3].includes(handle.value.length)));
}
