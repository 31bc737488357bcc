// The kinds of nodes, materials, lights and so on that a scene may contain, and where each may stand.

// Parameters that take a constant or a texture are edited with the control for constants.
const constants = {texture: "color", number_texture: "number"};

function withConstants(kind) {
  const isConstant = (slot) => !slot.list && slot.type in constants;
  const parameters = kind.slots.filter(isConstant).map(({name, type, help, required}) =>
    ({name, control: constants[type], default: null, help, required, instead: {type, list: false}}));
  return {...kind, parameters: [...parameters, ...kind.parameters], slots: kind.slots.filter((slot) => !isConstant(slot))};
}

export class Catalogue {
  #byKey = new Map();
  kinds;
  measuredColours; // {name, group, color}

  constructor({kinds, measured_colors: measuredColours}) {
    this.measuredColours = measuredColours ?? [];
    this.kinds = kinds.map(withConstants);
    for (const kind of this.kinds) {
      this.#byKey.set(`${kind.type} ${kind.kind}`, kind);
      if (!this.#byKey.has(kind.kind)) this.#byKey.set(kind.kind, kind);
    }
  }
  // The kind of an entry of the outline, or null: a reference or a section has none.
  of({kind, type}) {
    return this.#byKey.get(`${type} ${kind}`) ?? this.#byKey.get(kind) ?? null;
  }
  named(kind, type) {
    return this.#byKey.get(`${type} ${kind}`) ?? null;
  }
  titleOf(entry) {
    return this.of(entry)?.title ?? entry.kind.replaceAll("_", " ");
  }
  // The slots of a kind in which something of a type may stand.
  slotsFor(kind, type) {
    return (kind?.slots ?? []).filter((slot) => fits(slot.type, type));
  }
}

// Slots of some nodes take fields and objects alike.
export const fits = (slotType, type) => slotType === type || slotType.split(/[ |]+/).includes(type);

// The first paragraph of a help text, without its markup.
export const summaryOf = (help) => plainText((help ?? "").split(/\n\s*\n/)[0]);
export const plainText = (markdown) => markdown.replace(/\[([^\]]*)\]\([^)]*\)/g, "$1").replace(/[`*]/g, "");
