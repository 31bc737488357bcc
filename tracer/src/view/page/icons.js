// Icons as inline SVG: strokes of the text's colour on a grid of 16.
import {makeSvg} from "./dom.js";

const paths = {
  undo: "M6 3 3 6l3 3M3 6h6a4 4 0 0 1 0 8H6",
  redo: "M10 3l3 3-3 3M13 6H7a4 4 0 0 0 0 8h3",
  add: "M8 3v10M3 8h10",
  duplicate: "M5.5 5.5h7v7h-7zM3.5 10.5v-7h7",
  delete: "M3 4.5h10M6.5 4.5v-2h3v2M4.5 4.5l.6 9h5.8l.6-9M6.8 7v4M9.2 7v4",
  group: "M2.5 5v-2.5H5M11 2.5h2.5V5M13.5 11v2.5H11M5 13.5H2.5V11M5.5 5.5h5v5h-5z",
  wrap: "M8 5.2a2.8 2.8 0 1 1 0 5.6 2.8 2.8 0 0 1 0-5.6zM8 2a6 6 0 1 1 0 12A6 6 0 0 1 8 2z",
  unwrap: "M8 6a2 2 0 1 1 0 4 2 2 0 0 1 0-4zM8 2v1.5M8 12.5v1.5M2 8h1.5M12.5 8H14M3.8 3.8l1 1M11.2 11.2l1 1M3.8 12.2l1-1M11.2 4.8l1-1",
  replace: "M3 6h9l-2.5-2.5M13 10H4l2.5 2.5",
  text: "M5.5 4 2 8l3.5 4M10.5 4 14 8l-3.5 4",
  help: "M5.8 6a2.2 2.2 0 1 1 3.4 1.9C8.4 8.5 8 8.8 8 9.7M8 12v.4",
  search: "M7 2.5a4.5 4.5 0 1 1 0 9 4.5 4.5 0 0 1 0-9zM10.3 10.3 14 14",
  chevron: "M6 4l4 4-4 4",
  down: "M4 6l4 4 4-4",
  up: "M4 10l4-4 4 4",
  folder: "M1.5 3.5h4l1.5 2h7.5v7.5h-13z",
  eye: "M1.5 8C4 4 12 4 14.5 8 12 12 4 12 1.5 8zM8 6.2a1.8 1.8 0 1 1 0 3.6 1.8 1.8 0 0 1 0-3.6z",
  "eye-off": "M1.5 8C4 4 12 4 14.5 8 12 12 4 12 1.5 8zM3 13.5 13 2.5",
  scene: "M3 2.5h6.5L13 6v7.5H3zM9.5 2.5V6H13M5.5 11.5l2-3 1.5 2 1-1.2 1.5 2.2z",
  close: "M4 4l8 8M12 4l-8 8",
  check: "M3 8.5 6.5 12 13 4.5",
  reset: "M4 3v3.5h3.5M4.3 6.2A4.8 4.8 0 1 1 3.3 9.5",
  key: "M8 3.5 12.5 8 8 12.5 3.5 8z",
  play: "M5 3.5 12 8l-7 4.5z",
  more: "M3.5 7.4v1.2M2.9 8h1.2M8 7.4v1.2M7.4 8h1.2M12.5 7.4v1.2M11.9 8h1.2",
  warning: "M8 2.5 14 13.5H2zM8 6.5v3.5M8 11.9v.1",
  sphere: "M8 2.5a5.5 5.5 0 1 1 0 11 5.5 5.5 0 0 1 0-11zM2.5 8c2 1.8 9 1.8 11 0",
  box: "M8 2l5.5 3v6L8 14l-5.5-3V5zM2.5 5 8 8l5.5-3M8 8v6",
  cylinder: "M3.5 4.5c0-2.3 9-2.3 9 0v7c0 2.3-9 2.3-9 0zM3.5 4.5c0 2.3 9 2.3 9 0",
  plane: "M1.5 10.5 5 5.5h9.5L11 10.5z",
  shape: "M8 2.5l6 10.5H2z",
  outline: "M3 3h10v10H3z",
  combine: "M6 3a4 4 0 1 1 0 8 4 4 0 0 1 0-8zM10 5a4 4 0 1 1 0 8 4 4 0 0 1 0-8z",
  object: "M3 6.5C5 4.5 6.5 8 8 6.5s3-.5 5 0M3 3h10v10H3z",
  fill: "M8 2c2.8 3.5 4.2 5.3 4.2 7.5a4.2 4.2 0 0 1-8.4 0C3.8 7.3 5.2 5.5 8 2z",
  shell: "M3 3v5a5 5 0 0 0 10 0V3M5.5 3v5a2.5 2.5 0 0 0 5 0V3",
  cut: "M2 11.5 14 4.5M3 7.5a5 5 0 0 1 8-3M13 8.5a5 5 0 0 1-8 3",
  move: "M8 2v12M2 8h12M6.3 3.7 8 2l1.7 1.7M6.3 12.3 8 14l1.7-1.7M3.7 6.3 2 8l1.7 1.7M12.3 6.3 14 8l-1.7 1.7",
  rotate: "M12.5 5.5A5.2 5.2 0 1 0 13.2 9M12.8 2.5v3.2H9.6",
  scale: "M2.5 9.5h4v4h-4zM9 2.5h4.5V7M13.5 2.5 8 8",
  warp: "M3 13c0-5 5-2 5-5s5 0 5-5",
  repeat: "M2.5 2.5h4v4h-4zM9.5 2.5h4v4h-4zM2.5 9.5h4v4h-4zM9.5 9.5h4v4h-4z",
  light: "M8 5a3 3 0 1 1 0 6 3 3 0 0 1 0-6zM8 1.5v1.5M8 13v1.5M1.5 8H3M13 8h1.5M3.4 3.4l1 1M11.6 11.6l1 1M3.4 12.6l1-1M11.6 4.4l1-1",
  camera: "M2 5h2.5L6 3h4l1.5 2H14v8H2zM8 6.5a2.5 2.5 0 1 1 0 5 2.5 2.5 0 0 1 0-5z",
  material: "M8 2.5a5.5 5.5 0 1 1 0 11 5.5 5.5 0 0 1 0-11zM5 7a3.2 3.2 0 0 1 3-2.5",
  texture: "M2.5 2.5h11v11h-11zM2.5 8h11M8 2.5v11",
  mesh: "M8 2l6 11H2zM5 7.5h6L8 13z",
  settings: "M2 4.5h7M12 4.5h2M2 11.5h2M7 11.5h7M10.5 3v3M5.5 10v3",
  link: "M6.5 9.5l3-3M7 4.5 9 2.8a3 3 0 0 1 4.2 4.2L11.5 9M9 11.5l-2 1.7A3 3 0 0 1 2.8 9L4.5 7",
  statement: "M2.5 8.5l3 3 8-8",
  tree: "M8 2v3M8 5H4v3M8 5h4v3M2.5 8h3v3h-3zM10.5 8h3v3h-3z",
  shapes: "M5 2.5 8 7.5H2zM11.5 9a2.5 2.5 0 1 1 0 5 2.5 2.5 0 0 1 0-5zM2.5 9.5H7V14H2.5z",
  save: "M3 3h8l2 2v8H3zM5.5 3v3.5h5V3M5 13V9.5h6V13",
  grab: "M5 9V4.8a1 1 0 0 1 2 0V8M7 7.5V3.3a1 1 0 0 1 2 0v4.2M9 7.5V4a1 1 0 0 1 2 0v4M11 8V5.8a1 1 0 0 1 2 0v4.4a4 4 0 0 1-7.3 2.3L3.2 9.3a1 1 0 0 1 1.7-1.1L5 8.4",
  frame: "M2.5 5V2.5H5M11 2.5h2.5V5M13.5 11v2.5H11M5 13.5H2.5V11M8 6v4M6 8h4",
};

const ofChapter = {
  shapes: "shape", "operators on fields": "combine", operators: "combine", objects: "object", warps: "warp", transforms: "move",
  materials: "material", textures: "texture", lights: "light", meshes: "mesh", cameras: "camera", statements: "statement",
  "render settings": "settings", "placed objects": "object", settings: "settings",
};

const ofKind = {
  sphere: "sphere", balls: "sphere", ellipsoid: "sphere", bowl: "shell", box: "box", rounded_box: "box", box_frame: "box", cylinder: "cylinder",
  rounded_cylinder: "cylinder", tube: "cylinder", capped_cone: "cylinder", capsule: "cylinder", plane: "plane", slab: "plane",
  circle: "outline", rectangle: "outline", polygon: "outline", star: "outline", bezier: "outline", text: "text",
  set: "fill", thin_shell: "shell", shell: "shell", over: "combine", under: "combine", layered: "wrap", layered_sequence: "wrap",
  smooth_layered: "wrap", offset: "wrap", intersect_shape: "cut", subtract_shape: "cut", smooth_intersect_shape: "cut",
  smooth_subtract_shape: "cut", difference: "cut", smooth_difference: "cut", change: "replace", remove: "delete",
  translate: "move", rotate: "rotate", scale: "scale", stretch: "scale", affine: "move", instances: "repeat", polar_array: "repeat",
  grid: "repeat", endless_grid: "repeat", fibonacci_disk: "repeat", fibonacci_sphere: "repeat", scatter: "repeat", particles: "repeat",
  reference: "link", extrude: "box", revolve: "rotate", floor: "plane", backdrop: "plane",
  "section:tree": "tree", "section:shapes": "shapes", "section:phases": "material", "section:lights": "light", "section:meshes": "mesh",
  "section:camera": "camera", "section:render": "settings",
};

const ofType = {light: "light", mesh: "mesh", material: "material", camera: "camera", texture: "texture", statement: "statement", settings: "settings", render: "settings", scene: "settings", number_texture: "texture", phase_function: "material"};

export function icon(name) {
  return makeSvg("svg", {viewBox: "0 0 16 16", class: "icon", "aria-hidden": "true"}, makeSvg("path", {d: paths[name] ?? paths.object}));
}

export const iconOf = ({kind, chapter, type}) =>
  ofType[type] ?? ofKind[kind] ?? ofChapter[(chapter ?? "").toLowerCase().replaceAll("-", " ")] ?? "object";
