// The outline of the selection over the picture. The server reports which pixels show it (POST selected), and their
// border is drawn here. The old outline is faint while the picture changes; then a new one is requested.
import {makeSvg} from "./dom.js";
import {isWithin} from "./pointer.js";
import {askSelected} from "./server.js";
import {isNode} from "./structure.js";

const rest = 120; // milliseconds from the last change to the request
const pauseAfterFailure = 1000, mostAttempts = 5;

// What to request. All surfaces of a phase that occurs only in one object belong to this object, even if another node
// determines them, as the inside of a glass does for the water in it.
export function partsOf(entries, all) {
  const pointers = [], phases = [];
  for (const entry of entries) {
    if (entry.type === "material" && /^\/phases\/[^/]*$/.test(entry.pointer)) phases.push(entry.label);
    else if (entry.kind === "reference") pointers.push(entry.target);
    else if (entry.type === "mesh") pointers.push(entry.pointer);
    else if (isNode(entry)) {
      pointers.push(entry.pointer);
      const isElsewhere = (phase) => all.some((other) => isNode(other) && other.phases.includes(phase) &&
        !isWithin(other.pointer, entry.pointer) && !isWithin(entry.pointer, other.pointer));
      if (entry.type === "object") phases.push(...entry.phases.filter((phase) => !isElsewhere(phase)));
    }
  }
  return {pointers: [...new Set(pointers)], phases: [...new Set(phases)]};
}

// The closed borders of the selected pixels, as lists of points. Each point is the middle of a pixel's side, so slanted
// borders have no stairs.
export function borders(isIn, width, height) {
  const at = (x, y) => x >= 0 && y >= 0 && x < width && y < height && isIn[y * width + x];
  // Directed sides by the corner where they begin. Selected pixels are on their right.
  const sides = new Map();
  const add = (x, y, dx, dy) => {
    const key = y * (width + 1) + x;
    if (!sides.has(key)) sides.set(key, []);
    sides.get(key).push([x, y, dx, dy]);
  };
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      if (!isIn[y * width + x]) continue;
      if (!at(x, y - 1)) add(x, y, 1, 0);
      if (!at(x + 1, y)) add(x + 1, y, 0, 1);
      if (!at(x, y + 1)) add(x + 1, y + 1, -1, 0);
      if (!at(x - 1, y)) add(x, y + 1, 0, -1);
    }
  const found = [];
  for (const list of sides.values())
    while (list.length > 0) {
      const points = [];
      for (let side = list.pop(); side;) {
        const [x, y, dx, dy] = side;
        points.push([x + dx / 2, y + dy / 2]);
        const next = sides.get((y + dy) * (width + 1) + x + dx);
        // Where two pixels touch at a corner, turn to the right, so that each keeps its own border.
        const i = next ? Math.max(0, next.findIndex((s) => s[2] === -dy && s[3] === dx)) : -1;
        side = next?.length ? next.splice(i, 1)[0] : null;
      }
      found.push(points);
    }
  return found;
}

function pathOf(points) {
  const isStraight = (i) => {
    const [a, b, c] = [points.at(i - 1), points[i], points[(i + 1) % points.length]];
    return Math.abs((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])) < 1e-9;
  };
  return `M${points.filter((_, i) => !isStraight(i)).map(([x, y]) => `${x} ${y}`).join("L")}Z`;
}

export class SelectionOutline {
  #svg;
  #status;
  #scene;
  #selection;
  #parts = "";
  #text = "";      // of the scene for the last request: the same pointer may lead to another part of another text
  #picture = null; // identifies what the last picture shows
  #timer = null;
  #asked = 0;
  #isAsking = false;
  #failures = 0; // in a row
  isOn = true;

  // `status` is an element whose text tells screen readers what is outlined; `nameOf(entry)` is a name for people.
  constructor(svg, {status, scene, selection, nameOf}) {
    this.#svg = svg;
    this.#status = status;
    this.#scene = scene;
    this.#selection = selection;
    this.nameOf = nameOf;
    for (const changing of [selection, scene]) changing.addEventListener("change", () => this.#later());
  }
  // Called with each state of the server that has a new picture.
  pictureChanged(state) {
    // The first picture after a change has another time.
    const picture = JSON.stringify([state.seconds_to_picture, state.camera, state.width, state.height]);
    if (picture === this.#picture) return;
    this.#picture = picture;
    this.#parts = "";
    this.#later();
  }
  toggle(isOn) {
    this.isOn = isOn;
    this.#parts = "";
    this.#later();
  }
  #later() {
    this.#svg.classList.add("old");
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#ask(), rest);
  }
  #entries() {
    return this.#selection.pointers.map((pointer) => this.#scene.entry(pointer)).filter((entry) => entry && !entry.isSection);
  }
  async #ask() {
    const entries = this.#entries(), parts = partsOf(entries, this.#scene.entries);
    const isNothing = !this.isOn || parts.pointers.length + parts.phases.length === 0;
    const text = isNothing ? "nothing" : JSON.stringify(parts);
    if (this.#picture === null) return;
    if (text === this.#parts && this.#text === this.#scene.text) {
      this.#svg.classList.toggle("old", this.#isAsking);
      return;
    }
    this.#parts = text;
    this.#text = this.#scene.text;
    const asked = ++this.#asked;
    this.#isAsking = !isNothing;
    if (isNothing) return this.#show(null, []);
    let mask = null;
    try {
      mask = await askSelected(parts);
      this.#failures = 0;
    } catch {
      // There is no picture yet, or finding the selection takes too long, as while the picture is rendered. The scene's
      // outline still marks it.
      this.#failures += 1;
    }
    if (asked !== this.#asked) return;
    this.#isAsking = false;
    if (mask === null && this.#failures < mostAttempts) {
      this.#parts = "";
      this.#timer = setTimeout(() => this.#ask(), pauseAfterFailure);
    }
    if (this.#parts === text || mask === null) this.#show(mask, entries);
  }
  #show(mask, entries) {
    this.#svg.classList.remove("old");
    const isIn = [];
    for (const [i, run] of (mask?.runs ?? []).entries()) for (let k = 0; k < run; ++k) isIn.push(i % 2 === 1);
    const path = mask ? borders(isIn, mask.width, mask.height).map(pathOf).join("") : "";
    if (mask) this.#svg.setAttribute("viewBox", `0 0 ${mask.width} ${mask.height}`);
    this.#svg.replaceChildren(...(path ? ["halo", "line"].map((name) => makeSvg("path", {class: name, d: path, "vector-effect": "non-scaling-stroke"})) : []));
    const names = entries.map(this.nameOf).join(", ");
    this.#status.textContent = !mask ? "" : path ? `${names}: outlined in the picture` : `${names}: not visible in the picture`;
  }
}
