// Handles over the picture for the selection: arrows that move it along the axes, a disc that moves it in the plane of
// the picture, a ring that rotates it, and dots for end points and radii. The picture follows while they are dragged.
import {at, mapTo, turned, unturned, valueOf} from "./affine.js";
import {canProject, projected} from "./camera.js";
import {makeSvg, newId} from "./dom.js";
import {written} from "./json_text.js";
import {joined} from "./pointer.js";
import {chainOf, isNode, membersOf} from "./structure.js";

const arrow = 64; // pixels
const axes = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];
const plus = (a, b) => a.map((x, i) => x + b[i]);
const times = (a, k) => a.map((x) => x * k);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const precise = (v, step) => v.map((x) => Number((Math.round(x / step) * step).toPrecision(6)));

export class Handles {
  #svg;
  #view;
  #scene;
  #entry = null;
  #drag = null;

  // `view` has camera() and canvas; `failed(error)` is called when the server rejects a step.
  constructor(svg, {view, scene, failed}) {
    this.#svg = svg;
    this.#view = view;
    this.#scene = scene;
    this.failed = failed;
  }
  select(entry) {
    this.#entry = entry && isNode(entry) && entry.kind !== "reference" ? entry : null;
    this.show();
  }
  // Where a point is on the page, relative to the canvas, in pixels.
  #seen(p) {
    const {width, height} = this.#view.canvas.getBoundingClientRect();
    const found = projected(this.#view.camera(), width / height, p);
    return found && {x: found.x * width, y: found.y * height, unit: found.height / height, axes: found.axes};
  }
  show() {
    const camera = this.#view.camera(), box = this.#view.canvas.getBoundingClientRect();
    if (!this.#entry || !canProject(camera) || box.width === 0) {
      this.#svg.replaceChildren();
      return;
    }
    this.#svg.setAttribute("viewBox", `0 0 ${box.width} ${box.height}`);
    Object.assign(this.#svg.style, {width: `${box.width}px`, height: `${box.height}px`});
    const chain = chainOf(this.#entry), mover = chain.find((entry) => entry.kind === "translate") ?? null;
    const target = mover ?? this.#placeToWrap(chain);
    const isPlane = chain.at(-1).kind === "plane" && !mover;
    const parts = isPlane ? this.#offset(chain.at(-1)) : [...this.#points(chain), ...this.#radii(chain), ...this.#ring(chain), ...this.#arrows(target, mover)];
    if (!this.#drag) this.#svg.replaceChildren(...parts);
    else this.#follow();
  }
  // A filled field is moved inside its filling, as in files written by hand.
  #placeToWrap(chain) {
    return chain[0].kind === "set" && chain.length > 1 ? chain[1] : chain[0];
  }
  #arrows(target, mover) {
    if (mover && !Array.isArray(valueOf(mover, "by"))) return [];
    const origin = at(mapTo(target, Boolean(mover)), [0, 0, 0]), centre = this.#seen(origin);
    if (!centre) return [];
    const parts = axes.map(([name, direction]) => {
      const tip = this.#seen(plus(origin, times(direction, arrow * centre.unit)));
      if (!tip) return null;
      const long = Math.hypot(tip.x - centre.x, tip.y - centre.y);
      if (long < 8) return null;
      const group = this.#arrow(name, centre, tip);
      group.addEventListener("pointerdown", (event) => this.#begin(event, target, mover, (dx, dy) => {
        const along = [(tip.x - centre.x) / long, (tip.y - centre.y) / long];
        return times(direction, (dx * along[0] + dy * along[1]) / long * arrow * centre.unit);
      }, centre.unit));
      return group;
    });
    const disc = makeSvg("circle", {cx: centre.x, cy: centre.y, r: 9, class: "plane"});
    disc.addEventListener("pointerdown", (event) => this.#begin(event, target, mover,
      (dx, dy) => plus(times(centre.axes.right, dx * centre.unit), times(centre.axes.up, -dy * centre.unit)), centre.unit));
    return [...parts.filter(Boolean), disc];
  }
  // A plane moves along its normal.
  #offset(plane) {
    const normal = valueOf(plane, "normal", [0, 0, 1]), size = Math.hypot(...normal), offset = valueOf(plane, "offset", 0);
    if (!(size > 0) || typeof offset !== "number") return [];
    const map = mapTo(plane), direction = turned(map, times(normal, 1 / size)), stretch = Math.hypot(...direction);
    const centre = this.#seen(at(map, times(normal, offset / size)));
    const origin = at(map, times(normal, offset / size)), tip = centre && this.#seen(plus(origin, times(direction, arrow * centre.unit / stretch)));
    if (!tip) return [];
    const long = Math.hypot(tip.x - centre.x, tip.y - centre.y);
    if (long < 8) return [];
    const grip = this.#arrow("offset", centre, tip);
    grip.addEventListener("pointerdown", (event) => this.#run(event, "Move the plane", (dx, dy) => {
      const by = (dx * (tip.x - centre.x) + dy * (tip.y - centre.y)) / long ** 2 * arrow * centre.unit / stretch;
      return [{set: joined(membersOf(plane), "offset"), to: written(precise([offset + by], 10 ** Math.floor(Math.log10(centre.unit)))[0])}];
    }));
    return [grip];
  }
  #arrow(name, from, to) {
    const line = {x1: from.x, y1: from.y, x2: to.x, y2: to.y};
    return makeSvg("g", {class: `axis ${name}`}, makeSvg("line", {...line, class: "grip"}), makeSvg("line", line), makeSvg("circle", {cx: to.x, cy: to.y, r: 6}));
  }
  // Drags by a vector of the scene, which `vectorOf` finds from the pointer's motion.
  #begin(event, target, mover, vectorOf, unit) {
    const map = mapTo(target, false), from = mover ? valueOf(mover, "by") : [0, 0, 0];
    const step = 10 ** Math.floor(Math.log10(unit));
    let isWrapped = mover !== null;
    const pointer = mover ? joined(membersOf(mover), "by") : `${target.pointer}/translate/by`;
    this.#run(event, "Move", (dx, dy) => {
      const by = unturned(map, vectorOf(dx, dy));
      if (!by) return null;
      const value = written(precise(plus(from, by), step));
      if (isWrapped) return [{set: pointer, to: value}];
      isWrapped = true;
      return [{wrap: target.pointer, in: `{"translate": {"by": ${value}, "of": null}}`}];
    });
  }
  // Follows the pointer until it is released. A step is made only after the one before it has been accepted, because
  // the first may wrap what the others change.
  #run(event, label, operationsFor) {
    if (event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    const grip = event.currentTarget, from = [event.clientX, event.clientY], merge = newId("handle");
    let next = null, isBusy = false;
    const send = async () => {
      if (isBusy || !next) return;
      const operations = operationsFor(next[0], next[1]);
      next = null;
      if (!operations) return;
      isBusy = true;
      await this.#scene.perform({label, operations, merge}).catch((error) => this.failed(error));
      isBusy = false;
      send();
    };
    const move = (now) => {
      next = [now.clientX - from[0], now.clientY - from[1]];
      this.#drag.by = next;
      this.#follow();
      send();
    };
    const end = () => {
      grip.removeEventListener("pointermove", move);
      this.#drag = null;
      this.show();
    };
    this.#drag = {by: [0, 0], grip};
    grip.setPointerCapture(event.pointerId);
    grip.addEventListener("pointermove", move);
    grip.addEventListener("pointerup", end, {once: true});
    grip.addEventListener("pointercancel", end, {once: true});
  }
  // While one is dragged, the others are hidden: where they belong is known again at the end.
  #follow() {
    for (const part of this.#svg.children) part.classList.toggle("resting", part !== this.#drag.grip);
  }
  // A ring around the axis of the first rotation, with a dot that turns it.
  #ring(chain) {
    const entry = chain.find((one) => one.kind === "rotate"), angle = entry ? valueOf(entry, "angle") : null, axis = entry ? valueOf(entry, "axis", [0, 0, 1]) : null;
    if (typeof angle !== "number" || !Array.isArray(axis) || !(Math.hypot(...axis) > 0)) return [];
    const map = mapTo(entry, false), origin = at(map, [0, 0, 0]), centre = this.#seen(origin);
    if (!centre) return [];
    const along = times(axis, 1 / Math.hypot(...axis));
    const [least] = [0, 1, 2].sort((i, j) => Math.abs(along[i]) - Math.abs(along[j]));
    const first = cross(along, [0, 1, 2].map((i) => (i === least ? 1 : 0))), a = times(first, 1 / Math.hypot(...first)), b = cross(along, a);
    const size = 1.35 * arrow * centre.unit / Math.max(1e-9, Math.hypot(...turned(map, a)));
    const point = (degrees) => {
      const c = Math.cos(degrees * Math.PI / 180), s = Math.sin(degrees * Math.PI / 180);
      return this.#seen(at(map, plus(times(a, size * c), times(b, size * s))));
    };
    const places = Array.from({length: 49}, (_, i) => point(7.5 * i)), knob = point(angle);
    if (!knob || places.some((place) => !place)) return [];
    const path = makeSvg("path", {d: `M${places.map(({x, y}) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}`});
    const group = makeSvg("g", {class: "ring"}, path, makeSvg("circle", {cx: knob.x, cy: knob.y, r: 6}));
    // Where the ring is seen from below, it turns the other way round.
    const [p, q] = [point(angle), point(angle + 7.5)];
    const sense = Math.sign((p.x - centre.x) * (q.y - centre.y) - (p.y - centre.y) * (q.x - centre.x)) || 1;
    group.addEventListener("pointerdown", (event) => this.#run(event, "Rotate", (dx, dy) => {
      const from = Math.atan2(knob.y - centre.y, knob.x - centre.x), to = Math.atan2(knob.y + dy - centre.y, knob.x + dx - centre.x);
      const by = ((to - from) * sense * 180 / Math.PI + 540) % 360 - 180;
      return [{set: joined(membersOf(entry), "angle"), to: written(Math.round(angle + by))}];
    }));
    return [group];
  }
  // End points, such as those of a capsule.
  #points(chain) {
    const entry = chain.at(-1), map = mapTo(entry);
    const names = ["from", "to", "centre", "target", "position"].filter((name) => Array.isArray(valueOf(entry, name)) && entry.kind !== "rotate");
    return names.map((name) => {
      const value = valueOf(entry, name);
      if (value.length !== 3 || !value.every((x) => typeof x === "number")) return null;
      const seen = this.#seen(at(map, value));
      if (!seen) return null;
      const dot = makeSvg("circle", {cx: seen.x, cy: seen.y, r: 6, class: "dot"});
      dot.append(makeSvg("title"));
      dot.lastChild.textContent = name;
      dot.addEventListener("pointerdown", (event) => this.#run(event, `Move ${name}`, (dx, dy) => {
        const by = unturned(map, plus(times(seen.axes.right, dx * seen.unit), times(seen.axes.up, -dy * seen.unit)));
        return by && [{set: joined(membersOf(entry), name), to: written(precise(plus(value, by), 10 ** Math.floor(Math.log10(seen.unit))))}];
      }));
      return dot;
    }).filter(Boolean);
  }
  // A dot at the rim of what has a radius, in the direction to the right of the picture.
  #radii(chain) {
    const entry = chain.at(-1), radius = valueOf(entry, "radius");
    if (typeof radius !== "number" || !["sphere", "cylinder", "rounded_cylinder", "tube", "prism"].includes(entry.kind)) return [];
    const map = mapTo(entry), centre = this.#seen(at(map, [0, 0, 0]));
    if (!centre) return [];
    const scale = Math.hypot(...turned(map, [1, 0, 0])), rim = radius * scale / centre.unit;
    const dot = makeSvg("circle", {cx: centre.x + rim, cy: centre.y, r: 6, class: "dot"});
    dot.append(makeSvg("title"));
    dot.lastChild.textContent = "radius";
    dot.addEventListener("pointerdown", (event) => this.#run(event, "Change radius", (dx) => {
      const next = Math.max((rim + dx) * centre.unit / scale, centre.unit);
      return [{set: joined(membersOf(entry), "radius"), to: written(precise([next], 10 ** Math.floor(Math.log10(centre.unit)))[0])}];
    }));
    return [dot];
  }
}
