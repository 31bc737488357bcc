// The scene file as the server has it: its text, its outline, and the steps that change it. Every page that shows the
// same scene follows it, so that all see the same.
import {isListAt, textAt} from "./json_text.js";
import {joined} from "./pointer.js";
import {whenReleased} from "./press.js";
import {Rejected, askDocument, pause, redo, save, sendStep, undo} from "./server.js";

const sections = ["tree", "objects", "shapes", "phases", "lights", "meshes", "camera", "render", "groups", "instances", "expect", ""];
const patience = 300; // milliseconds that a step waits for follow() before it asks for the document itself
const single = new Set(["tree", "camera", "render", ""]);

// Groups the entries into sections, one for each member of the scene. A member that is a single entry gets no section.
function grouped(entries) {
  const section = (name) => {
    const pointer = name === "" ? "" : `/${name}`;
    const inside = entries.filter((e) => e.pointer === pointer || (name !== "" && e.pointer.startsWith(`${pointer}/`)));
    if (single.has(name)) return inside;
    if (inside.length === 0 && !["phases", "lights", "meshes"].includes(name)) return [];
    return [{pointer, kind: `section:${name}`, isSection: true, children: inside}];
  };
  return sections.flatMap(section);
}

// The pointer of what holds an entry's parameters: {"sphere": {…}}, or the entry itself, such as the render settings.
function membersIn(text, entry) {
  const inner = joined(entry.pointer, entry.kind);
  return textAt(text, inner) === null ? entry.pointer : inner;
}

// Completes an entry. Its key is its pointer, with a prefix for sections, so that lists and their entries never mix.
function addTo(map, entry, parent, text) {
  entry.parent = parent;
  for (const list of ["children", "slots", "phases"]) entry[list] ??= [];
  entry.parameters ??= {};
  entry.uses = []; // references to it
  entry.name = entry.pointer.slice(1);
  entry.key = entry.isSection ? `section:${entry.name}` : entry.pointer || "scene";
  if (!entry.isSection) entry.members ??= membersIn(text, entry);
  for (const parameter of Object.values(entry.parameters)) parameter.text ??= textAt(text, parameter.pointer);
  if (entry.kind === "reference") entry.target ??= joined("/shapes", entry.label);
  for (const slot of entry.slots) slot.pointer ??= slot.list && isListAt(text, entry.members) ? entry.members : joined(entry.members, slot.name);
  map.set(entry.key, entry);
  for (const child of entry.children) addTo(map, child, entry, text);
  entry.phases = [...new Set([...entry.phases, ...entry.children.flatMap((child) => child.phases)])];
}

const operationsOf = ({operations}) => (typeof operations === "function" ? operations() : operations);

export class SceneDocument extends EventTarget {
  text = "";
  outline = [];
  version = 0;
  error = null;
  undo = null;
  redo = null;
  saved = true;
  file = "";
  isChangedHere = false; // whether the next change is made by this page, but not as a step
  #entries = new Map(); // by pointer
  #waiting = [];        // steps to send
  #isSending = false;
  #running = 0;         // requests that change the scene
  #isFollowed = false;
  #textVersion = 0;     // of the text and the outline that the page has
  #own = new Set();     // versions made by this page
  #others = 0;          // changes of the text by others
  #gesture = null;      // the last one that sent a step: {merge, and the text and #others before it}
  #wake = () => {};     // ends a pause of follow()

  entry(pointer) {
    return this.#entries.get(pointer) ?? null;
  }
  get entries() {
    return [...this.#entries.values()];
  }
  // The scene's unit of length, such as "cm"; empty if it declares none.
  get unit() {
    const text = textAt(this.text, "/unit");
    return text?.startsWith('"') ? JSON.parse(text) : "";
  }
  // The section of the outline for a member of the scene, such as "lights".
  section(name) {
    return this.entry(`section:${name}`);
  }
  get isBusy() {
    return this.#running > 0 || this.#waiting.length > 0;
  }
  async whenIdle() {
    while (this.isBusy) await pause(5);
  }
  async follow(lost) {
    let failures = 0;
    while (true) {
      try {
        const before = this.version;
        await this.#takeNext(this.#isFollowed ? askDocument(before, this.#textVersion) : askDocument(0, 0));
        // Nothing has happened for seconds, or too many pages wait.
        if (this.version === before) await Promise.race([pause(200), new Promise((done) => (this.#wake = done))]);
        failures = 0;
      } catch (error) {
        failures += 1;
        this.#isFollowed = false; // a server that was restarted counts from the beginning
        this.#textVersion = 0;
        if (failures > 1) lost(error);
        await pause(1000);
      }
    }
  }
  async #takeNext(answer) {
    const told = await answer;
    await whenReleased();
    this.#take(told);
  }
  #take(told) {
    if (told.version <= this.version && this.#isFollowed) return;
    const isFirst = !this.#isFollowed;
    this.#isFollowed = true;
    // A version may also be new because the text has been checked or saved.
    const hasNewText = "text" in told && told.text !== this.text; // the server leaves out a text that the page has
    const isOwn = this.isBusy || this.isChangedHere || this.#own.has(told.version) || !hasNewText;
    if (hasNewText) this.isChangedHere = false;
    if (!isOwn) this.#others += 1;
    for (const member of ["version", "error", "undo", "redo", "saved", "file"]) this[member] = told[member];
    this.saveError = told.save_error ?? null;
    if ("text" in told) {
      this.text = told.text ?? ""; // too large to be edited
      this.isTooLarge = told.too_large ?? false;
      this.hasOutline = told.outline !== null;
    }
    this.#textVersion = told.text_version;
    if (told.outline) {
      this.outline = grouped(told.outline);
      this.#entries = new Map();
      for (const entry of this.outline) addTo(this.#entries, entry, null, this.text);
      for (const entry of this.entries) if (entry.kind === "reference") this.entry(entry.target)?.uses.push(entry);
    }
    this.dispatchEvent(new CustomEvent("change", {detail: {isFirst, isOwn}}));
  }
  // Sends a step and resolves when the page shows it. `base` is the version that it changes, if it is not the present one. A step that waits is replaced by a later one of the same gesture,
  // so that a fast mouse does not build up a queue; `merge` names the gesture. `operations` may be a function, which is
  // called when the step is sent.
  perform({label, operations, base = null, merge = null, strict = true}) {
    return new Promise((done, failed) => {
      const last = this.#waiting.at(-1);
      const step = {label, operations, base, merge, strict, done: [done], failed: [failed]};
      if (last && merge !== null && last.merge === merge) {
        step.done.push(...last.done);
        step.failed.push(...last.failed);
        this.#waiting.pop();
      }
      this.#waiting.push(step);
      this.#send();
    });
  }
  async #send() {
    if (this.#isSending) return;
    this.#isSending = true;
    while (this.#waiting.length > 0) {
      const {done, failed, ...step} = this.#waiting.shift();
      if (step.merge !== null && step.merge !== this.#gesture?.merge) this.#gesture = {merge: step.merge, text: this.text, others: this.#others};
      await this.#run(() => sendStep({...step, operations: operationsOf(step), base: step.base ?? this.version}), done, failed);
    }
    this.#isSending = false;
  }
  async #run(request, done, failed) {
    this.#running += 1;
    try {
      const version = await request();
      this.#own.add(version);
      await this.#reach(version);
      for (const tell of done) tell(version);
    } catch (error) {
      if (error instanceof Rejected && error.isOutdated) await this.#takeNext(askDocument(0, this.#textVersion).catch(() => this));
      for (const tell of failed) tell(error);
    } finally {
      this.#running -= 1;
    }
  }
  // Waits until the page shows this version, which follow() usually receives.
  async #reach(version) {
    this.#wake();
    const end = performance.now() + patience;
    while (this.version < version && performance.now() < end)
      await new Promise((done) => {
        this.addEventListener("change", done, {once: true});
        setTimeout(done, end - performance.now());
      });
    if (this.version < version) await this.#takeNext(askDocument(0, this.#textVersion));
  }
  // Takes back all steps of a gesture, so that the history has none of them.
  async takeBack(merge) {
    const dropped = this.#waiting.filter((step) => step.merge === merge);
    this.#waiting = this.#waiting.filter((step) => step.merge !== merge);
    for (const tell of dropped.flatMap((step) => step.done)) tell(this.version);
    await this.whenIdle();
    const before = this.#gesture;
    if (before?.merge !== merge || this.text === before.text) return;
    if (this.#others !== before.others) throw new Error("The scene was changed elsewhere meanwhile, so the drag stays. Undo takes it back.");
    // The server drops a step that ends where its gesture began.
    await this.perform({label: "Cancel", operations: [{text: before.text}], merge, strict: false});
  }
  goBack() {
    return new Promise((done, failed) => this.#run(undo, [done], [failed]));
  }
  save() {
    return new Promise((done, failed) => this.#run(save, [done], [failed]));
  }
  goForward() {
    return new Promise((done, failed) => this.#run(redo, [done], [failed]));
  }
}
