// The selected entries of the outline, by their pointers. The last one is the active one, which the inspector shows.
import {parentOf} from "./pointer.js";

export class Selection extends EventTarget {
  #pointers = [];
  #next = null; // what an action of this page has made, to be selected when the outline shows it

  get pointers() {
    return this.#pointers;
  }
  get active() {
    return this.#pointers.at(-1) ?? null;
  }
  has(pointer) {
    return this.#pointers.includes(pointer);
  }
  // What a person selects while the result of a step is awaited stays selected.
  set(pointers) {
    this.#next = null;
    this.#show(pointers);
  }
  #show(pointers) {
    if (pointers.join("\n") === this.#pointers.join("\n")) return;
    this.#pointers = [...pointers];
    this.dispatchEvent(new Event("change"));
  }
  toggle(pointer) {
    this.set(this.has(pointer) ? this.#pointers.filter((p) => p !== pointer) : [...this.#pointers, pointer]);
  }
  // After the next change of the scene, selects these pointers.
  expect(pointers) {
    this.#next = pointers;
  }
  forget() {
    this.#next = null;
  }
  // Keeps entries that still exist. Any other is replaced by its nearest remaining ancestor.
  update(scene) {
    const wanted = this.#next?.some((p) => scene.entry(p)) ? this.#next : this.#pointers;
    if (wanted === this.#next) this.#next = null;
    const found = wanted.map((pointer) => {
      let at = pointer;
      while (at !== "" && !scene.entry(at)) at = parentOf(at);
      return at;
    });
    this.#show([...new Set(found)].filter((pointer) => pointer !== ""));
  }
}
