// Common ways to wrap the selection, under the names by which people look for them, and the contents of a new scene.

const plane = {plane: {offset: 0}};

// For objects and for fields: `in` has null in the place of what is wrapped.
export const wraps = {
  object: [
    {text: "Move", kind: "translate", in: {translate: {by: [0, 0, 0], of: null}}},
    {text: "Rotate", kind: "rotate", in: {rotate: {axis: [0, 0, 1], angle: 30, of: null}}},
    {text: "Scale", kind: "scale", in: {scale: {factor: 1.25, of: null}}},
    null,
    {text: "Coat with a layer", kind: "layered", in: {layered: {phase: "<phase>", thickness: 0.05, of: null}}},
    {text: "Cut by a plane", kind: "intersect_shape", in: {intersect_shape: {shape: plane, of: null}}},
    {text: "Cut a shape away", kind: "subtract_shape", in: {subtract_shape: {shape: {sphere: {radius: 0.5}}, of: null}}},
    {text: "Repeat in a ring", kind: "polar_array", in: {polar_array: {count: 6, of: null}}},
    {text: "Repeat in rows", kind: "grid"},
    null,
    {text: "Put over others", kind: "over", in: {over: [null]}},
    {text: "Put under others", kind: "under", in: {under: [null]}},
  ],
  field: [
    {text: "Move", kind: "translate", in: {translate: {by: [0, 0, 0], of: null}}},
    {text: "Rotate", kind: "rotate", in: {rotate: {axis: [0, 0, 1], angle: 30, of: null}}},
    {text: "Scale", kind: "scale", in: {scale: {factor: 1.25, of: null}}},
    null,
    {text: "Cut by a plane", kind: "intersection", in: {intersection: [null, plane]}},
    {text: "Cut by a plane, with a round edge", kind: "smooth_intersection", in: {smooth_intersection: {radius: 0.1, of: [null, {plane: {normal: [0, 0, -1], offset: 0.75}}]}}},
    {text: "Cut a shape away", kind: "difference", in: {difference: {from: null, subtract: [{sphere: {radius: 0.5}}]}}},
    {text: "Unite with others", kind: "union", in: {union: [null]}},
    {text: "Blend with others", kind: "smooth_union"},
    {text: "Hollow out", kind: "shell"},
    {text: "Grow or shrink", kind: "offset"},
    {text: "Roughen", kind: "displace"},
    {text: "Repeat in a ring", kind: "polar_array", in: {polar_array: {count: 6, of: null}}},
    {text: "Repeat in rows", kind: "grid"},
  ],
};

// What a scene needs before anything can be seen.
export const starter = {
  phases: {glass: {clear: {ior: 1.5}}},
  meshes: [{floor: {height: -1, material: {coated: {color: {wood: {axis: [1, 0.1, 0.02], pith: [0, 0, -4]}}, roughness: 0.25}}}}],
  lights: [{sky: {sun_elevation: 30, sun_azimuth: -50}}],
  camera: {position: [0, -6.5, 3.2], look_at: [0.1, 0, -0.15], fov: 25},
  render: {width: 640, height: 480, samples: 64, exposure: 0.8},
};

// Materials to choose from when a new one is made, each with the look of a small ball: its sort and its colour.
export const materials = [
  {name: "glass", text: "Glass", look: "clear", colour: "#dfeaea", value: {clear: {ior: 1.5}}},
  {name: "water", text: "Water", look: "clear", colour: "#bfe2f5", value: {clear: {ior: 1.33, color: [0.8, 0.93, 1], color_distance: 2}}},
  {name: "ice", text: "Ice", look: "clear", colour: "#e6f3fa", value: {clear: {ior: 1.31}}},
  {name: "fog", text: "Fog", look: "matt", colour: "#e4e6e8", value: {clear: {ior: 1, scattering: [0.3, 0.3, 0.3], phase_function: {droplets: {diameter: 10}}}}},
  {name: "plastic", text: "Plastic", look: "shiny", colour: "#c93636", value: {coated: {color: [0.8, 0.1, 0.1], roughness: 0.2}}},
  {name: "matt", text: "Matt", look: "matt", colour: "#c8c3bc", value: {diffuse: {color: [0.6, 0.58, 0.55]}}},
  {name: "wood", text: "Wood", look: "shiny", colour: "#a26a3c", value: {coated: {color: {wood: {axis: [1, 0.1, 0.02], pith: [0, 0, -4]}}, roughness: 0.25}}},
  {name: "gold", text: "Gold", look: "shiny", colour: "#e0b04a", value: {conductor: {metal: "gold", roughness: 0.1}}},
];
