// Nodes, meshes and lights that the picture leaves out while the file keeps them. The server stores their pointers.
import {isNode} from "./structure.js";

let pointers = new Set();

export const hiddenParts = {
  get pointers() {
    return [...pointers];
  },
  // Takes the pointers from the server's state, and returns whether they have changed.
  take(shown) {
    if (shown.join("\n") === this.pointers.join("\n")) return false;
    pointers = new Set(shown);
    return true;
  },
  canHide: (entry) => !entry.isSection && ((isNode(entry) && /^\/(tree|shapes)\b/.test(entry.pointer)) || (["light", "mesh"].includes(entry.type) && /^\/(lights|meshes)\/\d+$/.test(entry.pointer))),
  has: (entry) => pointers.has(entry.pointer),
  isInHidden(entry) {
    for (let at = entry; at; at = at.parent) if (!at.isSection && pointers.has(at.pointer)) return true;
    return false;
  },
  // The pointers after hiding some, or showing them again.
  with: (changed, isOff) => (isOff ? [...new Set([...pointers, ...changed])] : [...pointers].filter((pointer) => !changed.includes(pointer))),
};
