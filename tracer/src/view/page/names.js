// Names that a person understands, for entries of the outline: "Water over glass" instead of a path.

const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
const parts = {
  translate: "Move", rotate: "Rotate", scale: "Scale", stretch: "Stretch", affine: "Transform",
};
export const isPlacing = (entry) => entry.kind in parts;
const sections = {
  tree: "Object", shapes: "Reusable shapes", phases: "Materials", lights: "Lights", meshes: "Surroundings", camera: "Camera",
  render: "Render settings", expect: "Statements", objects: "Objects", groups: "Groups", instances: "Instances",
};

const phasesIn = (entry, key) => {
  try {
    const value = JSON.parse(entry.parameters?.[key]?.text ?? "null");
    return value === null ? "" : [value].flat().join(" and ");
  } catch {
    return "";
  }
};

// A word for the content of an entry: its name, its phase, or its kind.
function brief(entry, catalogue) {
  if (entry.label) return entry.label;
  if (entry.kind === "reference") return entry.target?.split("/").at(-1) ?? "shape";
  const phases = entry.phases ?? [];
  if (phases.length > 0 && phases.length < 3) return phases.join(" and ");
  if (["translate", "rotate", "scale", "stretch"].includes(entry.kind) && entry.children?.length)
    return brief(entry.children[0], catalogue);
  return catalogue.titleOf(entry).toLowerCase();
}

const childrenIn = (entry, slot) => entry.children.filter((child) => child.slot === slot);

const sentences = {
  set: (e, c) => `${phasesIn(e, "phase")} ${childrenIn(e, "of").map((child) => shapeName(child, c)).join()}`,
  thin_shell: (e) => `${phasesIn(e, "shell")} filled with ${phasesIn(e, "inside")}`,
  over: (e, c) => listed(e, c, " over "),
  under: (e, c) => listed(e, c, " under "),
  intersect_shape: (e, c) => `keep ${phasesIn(e, "phases") || "all"} inside ${childrenIn(e, "shape").slice(0, 1).map((s) => brief(s, c)).join()}`,
  subtract_shape: (e, c) => `cut ${childrenIn(e, "shape").slice(0, 1).map((s) => brief(s, c)).join()} from ${phasesIn(e, "phases") || "all"}`,
  change: (e) => `${phasesIn(e, "from")} becomes ${phasesIn(e, "to")}`,
  remove: (e) => `remove ${phasesIn(e, "phases")}`,
  contact: (e, c) => `contact: ${listed(e, c, " and ")}`,
};

function listed(entry, catalogue, between) {
  const names = [...new Set((entry.children ?? []).map((child) => brief(child, catalogue)))];
  if (names.length < 2) return names[0] ?? catalogue.titleOf(entry);
  return `${names[0]}${between}${names.slice(1).join(", ")}`;
}

// A shape without its moves: "sphere" for a moved sphere.
function shapeName(entry, catalogue) {
  if (entry.label) return entry.label;
  if (entry.kind === "reference") return brief(entry, catalogue);
  if (["translate", "rotate", "scale"].includes(entry.kind) && entry.children?.length === 1) return shapeName(entry.children[0], catalogue);
  return catalogue.titleOf(entry).toLowerCase();
}

export function nameOf(entry, catalogue) {
  if (entry.isSection) return sections[entry.name] ?? capital(entry.name);
  if (entry.pointer === "") return "Scene";
  if (entry.pointer === "/camera" || entry.pointer === "/render") return sections[entry.name];
  if (entry.label) return entry.label;
  if (entry.kind === "reference") return brief(entry, catalogue);
  const sentence = sentences[entry.kind]?.(entry, catalogue).replace(/\s+/g, " ").trim();
  return capital(sentence || parts[entry.kind] || catalogue.titleOf(entry));
}

// What is worth knowing beside the name: the kind of something that has a name of its own, and what is moved.
export function remarkOf(entry, catalogue) {
  if (entry.kind === "reference") return "reused";
  if (entry.label) return catalogue.titleOf(entry).toLowerCase();
  if (parts[entry.kind] && entry.children.length > 0) return brief(entry.children[0], catalogue);
  return "";
}
