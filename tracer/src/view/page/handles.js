// Handles over the picture for the selection: arrows that move it along the axes, a disc that moves it in the plane of
// the picture, a ring that rotates it, squares that scale it, and dots for its points and lengths. A handle follows the
// pointer at once while it is dragged, and the picture follows when it is rendered. A click on one types its numbers.
import {inverseTransformVector, mapTo, transformPoint, transformVector, valueOf, writtenValueOf} from "./affine.js";
import {canProject, projected} from "./camera.js";
import {makeSvg, newId} from "./dom.js";
import {follow, followed, rounded, typeNumbers} from "./handle_drag.js";
import {handlesIn} from "./handle_places.js";
import {parsed, written} from "./json_text.js";
import {isKeyed, set} from "./keyframes.js";
import {titleOf} from "./parameter_row.js";
import {joined} from "./pointer.js";
import {chainOf, isNode, pointerOf} from "./structure.js";

const arrow = 64, square = 44, beside = 30, apart = 18; // pixels
const axes = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];
const diagonals = [[1, 1], [-1, 1], [-1, -1], [0, 1]].map(([x, y]) => [x / Math.hypot(x, y), y / Math.hypot(x, y)]);
const plus = (a, b) => a.map((x, i) => x + b[i]);
const times = (a, k) => a.map((x) => x * k);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => times(a, 1 / Math.max(1e-12, Math.hypot(...a)));
const hasHandles = (entry) => (isNode(entry) && entry.kind !== "reference") || ["light", "mesh", "camera"].includes(entry.type);
const inSpace = (p) => [...p, 0, 0].slice(0, 3);

export class Handles {
  #svg;
  #view;
  #scene;
  #entry = null;
  #drag = null;
  catalogue = null;

  // `view` has camera() and canvas; `failed(error)` is called when the server rejects a step.
  constructor(svg, {view, scene, failed}) {
    this.#svg = svg;
    this.#view = view;
    this.#scene = scene;
    this.failed = failed;
  }
  select(entry) {
    const before = this.#entry;
    this.#entry = entry && hasHandles(entry) ? entry : null;
    if (this.#drag?.isReleased && this.#entry?.key !== before?.key) this.#drag = null;
    this.show();
  }
  // Where a point is on the page, relative to the canvas, in pixels.
  #seen(p) {
    const {width, height} = this.#view.canvas.getBoundingClientRect();
    // A drag of the camera itself changes the view.
    const found = projected(this.#drag?.camera ?? this.#view.camera(), width / height, p);
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
    if (this.#drag?.isReleased) return; // until the scene has what the drag has changed
    if (this.#drag) this.#follow();
    else this.#svg.replaceChildren(...this.#handles().map((handle) => this.#drawn(handle)));
  }
  // A handle has: name, part (SVG), value, valueAt(by, event), operations(value), and where its label is; tipAt(value) is
  // where its end is for a value, and isWhole says that all of it moves with its end.
  #handles() {
    if (!isNode(this.#entry)) return this.#places([this.#entry]);
    const chain = chainOf(this.#entry).filter(isNode), mover = chain.find((entry) => entry.kind === "translate") ?? null;
    if (chain.at(-1).kind === "plane" && !mover) return this.#offset(chain.at(-1));
    // Dots are where their numbers are; the others make room for them.
    const dots = this.#places(chain), room = new Room(dots.map(({label}) => label));
    const arrows = this.#arrows(chain, mover, room), squares = this.#squares(chain, room);
    return [...this.#ring(chain, room), ...arrows, ...squares, ...dots];
  }
  #drawn(handle) {
    const {name, part, label, value} = handle;
    const text = makeSvg("text", {x: label.x + 12, y: label.y - 10, class: "reading"});
    const group = makeSvg("g", {class: `handle ${handle.look ?? ""}`, "data-handle": name}, part, text);
    const say = (now) => { text.textContent = `${titleOf(name)} ${[now].flat().map((c) => Number(c.toPrecision(5))).join(", ")}`; };
    say(value);
    group.addEventListener("pointerdown", (event) => this.#run(event, handle, say));
    return group;
  }
  // Follows the pointer.
  #run(event, handle, say) {
    const merge = newId("handle"), drawn = handle, grip = event.currentTarget;
    const drag = {grip, camera: this.#view.camera(), shift: null, isReleased: false};
    let sender = null, last = null, isCancelled = false;
    const aim = () => {
      if (!sender || !last || isCancelled) return;
      const value = handle.valueAt(...last);
      if (value === null) return;
      say(value);
      drag.shift = this.#moveTip(grip, drawn, handle.tipAt(value));
      sender.send(value);
    };
    // The number from which the drag starts is known once the steps of the drag before are in the scene.
    const begin = async () => {
      handle = await this.#present(handle);
      sender = this.#sender(handle, merge);
      aim();
    };
    const begun = begin();
    // Until the scene has what the drag has changed, the handle stays where it was released, with the others.
    const end = async () => {
      drag.isReleased = true;
      for (const part of this.#svg.children) {
        part.classList.remove("resting", "dragged");
        if (drawn.isWhole && part !== grip && drag.shift) shift(part, drag.shift);
      }
      await begun;
      await sender.whenDone();
      if (isCancelled) await this.#scene.takeBack(merge).catch((error) => this.failed(error));
      if (this.#drag !== drag) return;
      this.#drag = null;
      this.show();
    };
    const hasBegun = follow(event, {
      moved: (by, now) => {
        this.#follow();
        last = [by, now];
        aim();
      },
      cancelled: () => {
        isCancelled = true;
        sender?.stop();
        drag.shift = null;
        this.#moveTip(grip, drawn, beyond(drawn.label, shiftOf(grip), 1));
      },
      ended: () => {
        if (last) return end();
        this.#drag = null;
        this.show();
      },
      clicked: () => this.#type(handle, merge),
    });
    if (hasBegun) this.#drag = drag;
  }
  // Moves what is drawn of a handle so that its end is at a place. Returns by how much it has moved.
  #moveTip(grip, {label, part, isWhole}, tip) {
    if (!tip) return null;
    const shifted = shiftOf(grip), by = [tip.x - label.x - shifted[0], tip.y - label.y - shifted[1]], move = `translate(${by[0]} ${by[1]})`;
    grip.querySelector(".reading").setAttribute("transform", move);
    if (isWhole) {
      part.setAttribute("transform", move);
      return by;
    }
    const isEnd = (x, y) => Math.hypot(x - label.x, y - label.y) < 1e-3;
    const shapes = part.matches("circle, rect") ? [part] : [...part.children];
    for (const shape of shapes) {
      const at = (name) => Number(shape.getAttribute(name));
      if (shape.tagName === "line") {
        shape.dataset.end ??= String(isEnd(at("x2"), at("y2")));
        if (shape.dataset.end === "true") {
          shape.setAttribute("x2", label.x + by[0]);
          shape.setAttribute("y2", label.y + by[1]);
        }
      } else if ((shape.tagName === "circle" && isEnd(at("cx"), at("cy"))) || (shape.tagName === "rect" && isEnd(at("x") + at("width") / 2, at("y") + at("height") / 2))) {
        shape.setAttribute("transform", move);
      }
    }
    return by;
  }
  // A handle as it is after the steps that are on their way.
  async #present(handle) {
    if (!this.#scene.isBusy) return handle;
    await this.#scene.whenIdle();
    return this.#handles().find(({name}) => name === handle.name) ?? handle;
  }
  // A step is made only after the one before it has been accepted, because the first may wrap what the others change.
  // whenDone() resolves when nothing is left to send; stop() drops what has not been sent.
  #sender(handle, merge) {
    let next = null, sending = null;
    const sendAll = async () => {
      while (next !== null) {
        const {value, gesture} = next;
        next = null;
        await this.#scene.perform({label: handle.step, operations: handle.operations(value), merge: gesture}).catch((error) => this.failed(error));
      }
      sending = null;
    };
    return {
      send: (value, gesture = merge) => {
        next = {value, gesture};
        sending ??= sendAll();
      },
      whenDone: async () => { while (sending) await sending; },
      stop: () => { next = null; },
    };
  }
  #type(handle, merge) {
    const grip = [...this.#svg.children].find((part) => part.dataset.handle === handle.name) ?? this.#svg;
    let sender = this.#sender(handle, merge);
    const field = typeNumbers(grip, {title: titleOf(handle.name), value: handle.value, least: handle.least, unit: handle.unit, scale: Math.abs([handle.value].flat()[0]) || 1},
      (value, gesture) => sender.send(value, gesture ?? merge));
    this.#present(handle).then((now) => {
      if (now === handle) return;
      sender = this.#sender(now, merge);
      field.show(now.value);
    });
  }
  // While one is dragged, the others are hidden: where they belong is known again at the end.
  #follow() {
    for (const part of this.#svg.children) {
      part.classList.toggle("resting", part !== this.#drag.grip);
      part.classList.toggle("dragged", part === this.#drag.grip);
    }
  }
  // The step that sets a parameter, or an item of it, in its key at this time if it has keys.
  #setting(entry, [name, ...indices], value) {
    const old = writtenValueOf(entry, name), pointer = pointerOf(entry, name);
    if (indices.length > 0 && old !== null && !isKeyed(old)) return [{set: joined(pointer, ...indices), to: written(value)}];
    const whole = indices.length === 0 ? value : this.#valuesOf(entry)[name].map((item, i) => (i === indices[0] ? value : item));
    return [{set: pointer, to: written(set(old, whole))}];
  }
  // The values of an entry's parameters, with those that are left out.
  #valuesOf(entry) {
    const specs = this.catalogue?.of(entry)?.parameters ?? [], values = {};
    for (const spec of specs) values[spec.name] = spec.default === null || spec.default === undefined ? null : parsed(spec.default);
    for (const name of Object.keys(entry.parameters)) values[name] = valueOf(entry, name);
    return values;
  }
  // Sets a parameter of an entry, or wraps another entry in a node that has it.
  #placing({entry, around, kind, name, more = {}}) {
    let isWrapped = entry !== null;
    return (value) => {
      if (entry) return this.#setting(entry, [name], value);
      const pointer = joined(around.pointer, kind, name);
      if (isWrapped) return [{set: pointer, to: written(value)}];
      isWrapped = true;
      return [{wrap: around.pointer, in: written({[kind]: {...more, [name]: value, of: null}})}];
    };
  }
  // Where a wrapper goes in a chain: inside its `set` node and the transforms that already place it, as in files written
  // by hand.
  #inside(chain, kinds) {
    return chain.find((entry, i) => i === chain.length - 1 || !kinds.includes(entry.kind));
  }
  #arrows(chain, mover, room) {
    const around = mover ? null : this.#inside(chain, ["set"]), target = mover ?? around, from = mover ? valueOf(mover, "by") : [0, 0, 0];
    const origin = transformPoint(mapTo(target, Boolean(mover)), [0, 0, 0]), centre = this.#seen(origin), outer = mapTo(target, false);
    if (!centre || !Array.isArray(from)) return [];
    const common = {step: "Move", value: from, operations: this.#placing({entry: mover, around, kind: "translate", name: "by"})};
    const moved = (vector, event) => {
      const by = inverseTransformVector(outer, vector);
      return by && from.map((c, i) => (Math.abs(by[i]) < 1e-9 * Math.hypot(...by) ? c : rounded(c + by[i], centre.unit, event)));
    };
    // Where the end of an arrow is when the selection has moved. Without a node that moves it, the origin moves by the value.
    const moves = (direction, length) => (value) => this.#seen(plus(transformPoint(outer, value), times(direction, length * centre.unit)));
    room.take(centre);
    const parts = axes.map(([name, direction]) => {
      const endAt = (length) => this.#seen(plus(origin, times(direction, length * centre.unit)));
      const length = room.choose([1, 1.35, 1.7, 2.05].map((k) => k * arrow), endAt), tip = endAt(length);
      if (!tip || Math.hypot(tip.x - centre.x, tip.y - centre.y) < 8) return null;
      const valueAt = ([dx, dy], event) => {
        const by = followed((p) => this.#seen(p), plus(origin, times(direction, length * centre.unit)), [direction], {x: tip.x + dx, y: tip.y + dy});
        return by && moved(times(direction, by[0]), event);
      };
      return {...common, name: `move ${name}`, look: `axis ${name}`, label: tip, part: stem(centre, tip), valueAt, tipAt: moves(direction, length), isWhole: true};
    });
    const valueAt = ([dx, dy], event) => moved(plus(times(centre.axes.right, dx * centre.unit), times(centre.axes.up, -dy * centre.unit)), event);
    return [...parts.filter(Boolean), {...common, name: "move", look: "plane", label: centre, part: circle(centre, 9), valueAt, tipAt: moves([0, 0, 0], 0), isWhole: true}];
  }
  // A plane moves along its normal.
  #offset(plane) {
    const {normal, offset} = {normal: valueOf(plane, "normal", [0, 0, 1]), offset: valueOf(plane, "offset", 0)}, size = Math.hypot(...normal);
    if (!(size > 0) || typeof offset !== "number") return [];
    const map = mapTo(plane), along = transformVector(map, times(normal, 1 / size)), origin = transformPoint(map, times(normal, offset / size)), centre = this.#seen(origin);
    const end = centre && plus(origin, times(unit(along), arrow * centre.unit)), tip = centre && this.#seen(end);
    if (!tip || Math.hypot(tip.x - centre.x, tip.y - centre.y) < 8) return [];
    const valueAt = ([dx, dy], event) => {
      const by = followed((p) => this.#seen(p), end, [along], {x: tip.x + dx, y: tip.y + dy});
      return by && rounded(offset + by[0], centre.unit, event);
    };
    return [{name: "offset", look: "axis offset", step: "Move the plane", label: tip, part: stem(centre, tip), value: offset, valueAt, isWhole: true,
      tipAt: (value) => this.#seen(plus(end, times(along, value - offset))),
      operations: (value) => this.#setting(plane, ["offset"], value)}];
  }
  // A ring around the axis of the first rotation, or around the vertical axis, with a dot that turns it.
  #ring(chain, room) {
    const entry = chain.find((one) => one.kind === "rotate") ?? null, around = entry ? null : this.#inside(chain, ["set", "translate"]);
    const angle = entry ? valueOf(entry, "angle") : 0, axis = entry ? valueOf(entry, "axis", [0, 0, 1]) : [0, 0, 1];
    if (typeof angle !== "number" || !Array.isArray(axis) || !(Math.hypot(...axis) > 0)) return [];
    const map = mapTo(entry ?? around, false), centre = this.#seen(transformPoint(map, [0, 0, 0]));
    if (!centre) return [];
    const along = unit(axis), [least] = [0, 1, 2].sort((i, j) => Math.abs(along[i]) - Math.abs(along[j]));
    const a = unit(cross(along, [0, 1, 2].map((i) => (i === least ? 1 : 0)))), b = cross(along, a);
    const size = 1.35 * arrow * centre.unit / Math.max(1e-9, Math.hypot(...transformVector(map, a)));
    const point = (degrees) => {
      const c = Math.cos(degrees * Math.PI / 180), s = Math.sin(degrees * Math.PI / 180);
      return this.#seen(transformPoint(map, plus(times(a, size * c), times(b, size * s))));
    };
    // The dot of what is not rotated yet may be anywhere.
    const shown = entry ? angle : room.choose([-50, -20, -80, 130, 160, 100], point), places = Array.from({length: 49}, (_, i) => point(7.5 * i)), knob = point(shown), next = point(shown + 7.5);
    if (!knob || !next || places.some((place) => !place)) return [];
    const path = makeSvg("path", {d: `M${places.map(({x, y}) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}`});
    // Where the ring is seen from below, it turns the other way round.
    const sense = Math.sign((knob.x - centre.x) * (next.y - centre.y) - (knob.y - centre.y) * (next.x - centre.x)) || 1;
    const valueAt = ([dx, dy], event) => {
      const from = Math.atan2(knob.y - centre.y, knob.x - centre.x), to = Math.atan2(knob.y + dy - centre.y, knob.x + dx - centre.x);
      const turn = ((to - from) * sense * 180 / Math.PI + 540) % 360 - 180, grid = event.ctrlKey || event.metaKey ? 15 : event.shiftKey ? 0.1 : 1;
      return Number((Math.round((angle + turn) / grid) * grid).toPrecision(6));
    };
    return [{name: "rotate", look: entry ? "ring" : "ring faint", step: "Rotate", label: knob, part: makeSvg("g", {}, path, circle(knob, 6)), value: angle, unit: "degrees",
      valueAt, tipAt: (value) => point(shown + value - angle), operations: this.#placing({entry, around, kind: "rotate", name: "angle", more: {axis: [0, 0, 1]}})}];
  }
  // Squares that scale along the axes of the selection, and one for all axes.
  #squares(chain, room) {
    const placing = ["set", "translate", "rotate"], around = this.#inside(chain, placing);
    const [scale, stretch] = ["scale", "stretch"].map((kind) => chain.find((entry) => entry.kind === kind) ?? null);
    const map = mapTo(stretch ?? around, false), centre = this.#seen(transformPoint(mapTo(scale ?? stretch ?? around, false), [0, 0, 0]));
    if (!centre) return [];
    const factors = stretch ? valueOf(stretch, "factors") : [1, 1, 1], factor = scale ? valueOf(scale, "factor") : 1;
    const grown = (value, [dx, dy], along, event) => rounded(value * Math.max(0.02, 1 + (dx * along[0] + dy * along[1]) / square), value / square, event);
    const parts = axes.map(([name, axis], i) => {
      // Opposite to the arrows and to what has a length along the axis.
      const direction = times(unit(transformVector(map, axis)), -1), endAt = (length) => this.#seen(plus(transformPoint(map, [0, 0, 0]), times(direction, length * centre.unit)));
      const tip = endAt(room.choose([1, 1.5, 2, 2.5].map((k) => k * square), endAt));
      const size = tip ? Math.hypot(tip.x - centre.x, tip.y - centre.y) : 0;
      if (size < 8 || !Array.isArray(factors)) return null;
      const along = [(tip.x - centre.x) / size, (tip.y - centre.y) / size];
      return {name: `scale ${name}`, look: `square ${name}`, step: "Stretch", label: tip, part: makeSvg("g", {}, line(centre, tip, "thin"), box(tip)), value: factors, least: 1e-4,
        tipAt: (value) => beyond(tip, along, square * (value[i] / factors[i] - 1)),
        valueAt: (by, event) => factors.map((old, j) => (i === j ? grown(old, by, along, event) : old)),
        operations: this.#placing({entry: stretch, around, kind: "stretch", name: "factors"})};
    });
    const cornerAt = (k) => ({x: centre.x + k * arrow, y: centre.y - k * arrow}), corner = cornerAt(room.choose([0.8, 1.1, 1.4, 1.7], cornerAt));
    const all = {name: "scale", look: "square all", step: "Scale", label: corner, part: makeSvg("g", {}, line(centre, corner, "thin"), box(corner)), value: factor, least: 1e-4,
      tipAt: (value) => beyond(corner, [0.7071, -0.7071], 1.13 * arrow * (value / factor - 1)),
      valueAt: (by, event) => grown(factor, times(by, square / (1.13 * arrow)), [0.7071, -0.7071], event),
      operations: this.#placing({entry: scale, around: stretch ?? around, kind: "scale", name: "factor"})};
    return [...parts.filter(Boolean), ...(typeof factor === "number" ? [all] : [])];
  }
  // Dots for what the kinds of a chain have: points, lengths, and numbers without a place.
  #places(chain) {
    let measures = 0;
    return chain.flatMap((entry) => {
      const map = mapTo(entry, false), values = this.#valuesOf(entry), specs = this.catalogue?.of(entry)?.parameters ?? [];
      const middles = isNode(entry) ? [] : [values.centre, values.look_at, values.position].filter(Array.isArray);
      const centre = [...middles, [0, 0, 0]].map((p) => this.#seen(transformPoint(map, p))).find((seen) => seen !== null);
      if (!centre || !inverseTransformVector(map, [1, 0, 0])) return [];
      const facing = unit(inverseTransformVector(map, centre.axes.right)), flat = [facing[0], facing[1], 0];
      const found = handlesIn(entry, values, {facing, radial: Math.hypot(...flat) > 1e-3 ? unit(flat) : [1, 0, 0]});
      return found.map((place) => {
        const {low, high, low_open: isOpen} = specs.find((spec) => spec.name === place.path[0]) ?? {};
        const limited = (value, grain) => Math.min(high ?? Infinity, Math.max(isOpen ? low + rounded(grain, grain) : low ?? -Infinity, value));
        const handle = place.from ? this.#length(map, place, limited) : Array.isArray(place.value) ? this.#point(map, place) : this.#measure(map, place, limited, centre, measures++);
        return handle && {...handle, name: place.name, look: `${handle.look ?? ""} dot`, value: place.value, least: low ?? undefined,
          step: `Change ${place.name}`, operations: (value) => this.#setting(entry, place.path, value)};
      }).filter(Boolean);
    });
  }
  #length(map, {value: present, start, from, along}, limited) {
    const value = start ?? present;
    const end = transformPoint(map, plus(from, times(along, value))), vector = transformVector(map, along), tip = this.#seen(end), root = this.#seen(transformPoint(map, from));
    if (!tip || !root || !followed((p) => this.#seen(p), end, [vector], tip)) return null;
    const grain = tip.unit / Math.max(1e-9, Math.hypot(...vector));
    const valueAt = ([dx, dy], event) => {
      const by = followed((p) => this.#seen(p), end, [vector], {x: tip.x + dx, y: tip.y + dy});
      return by && limited(rounded(value + by[0], grain, event), grain);
    };
    const tipAt = (now) => this.#seen(transformPoint(map, plus(from, times(along, now))));
    return {label: tip, part: makeSvg("g", {}, line(root, tip, "thin"), circle(tip, 6)), valueAt, tipAt};
  }
  #point(map, {value, basis}) {
    const p = transformPoint(map, inSpace(value)), tip = this.#seen(p);
    if (!tip) return null;
    const vectors = basis?.map((vector) => transformVector(map, vector)) ?? [tip.axes.right, tip.axes.up];
    const valueAt = ([dx, dy], event) => {
      const by = followed((q) => this.#seen(q), p, vectors, {x: tip.x + dx, y: tip.y + dy});
      const change = by && (basis ? by : inverseTransformVector(map, vectors.reduce((sum, v, i) => plus(sum, times(v, by[i])), [0, 0, 0])));
      return change && value.map((c, i) => (Math.abs(change[i]) < 1e-9 * tip.unit ? c : rounded(c + change[i], tip.unit, event)));
    };
    return {label: tip, part: circle(tip, 6), valueAt, tipAt: (now) => this.#seen(transformPoint(map, inSpace(now)))};
  }
  // Beside the middle, from a dot that marks 0.
  #measure(map, {value}, limited, centre, i) {
    const grain = centre.unit / Math.max(1e-9, Math.hypot(...transformVector(map, [1, 0, 0]))), along = diagonals[i % diagonals.length];
    const place = (pixels) => ({x: centre.x + along[0] * pixels, y: centre.y + along[1] * pixels});
    const tipAt = (now) => place(beside + Math.max(-beside, Math.min(4 * arrow, now / grain))), tip = tipAt(value);
    const valueAt = ([dx, dy], event) => limited(rounded(value + (dx * along[0] + dy * along[1]) * grain, grain, event), grain);
    return {look: "measure", label: tip, part: makeSvg("g", {}, line(place(beside), tip, "thin"), circle(place(beside), 2.5), circle(tip, 6)), valueAt, tipAt};
  }
}

// Chooses places for handles that are at least some pixels apart.
class Room {
  #taken;

  constructor(taken) {
    this.#taken = taken;
  }
  take(place) {
    this.#taken.push(place);
  }
  // The first of some values whose place is free, or else the first.
  choose(values, placeAt) {
    const isFree = (place) => place && this.#taken.every(({x, y}) => Math.hypot(place.x - x, place.y - y) >= apart);
    const value = values.find((one) => isFree(placeAt(one))) ?? values[0], place = placeAt(value);
    if (place) this.take(place);
    return value;
  }
}

// How far a handle was moved with another one that was dragged.
const shiftOf = (part) => JSON.parse(part.dataset.shift ?? "[0, 0]");
function shift(part, [dx, dy]) {
  const [x, y] = shiftOf(part);
  part.dataset.shift = JSON.stringify([x + dx, y + dy]);
  part.setAttribute("transform", `translate(${x + dx} ${y + dy})`);
}

const beyond = ({x, y}, along, pixels) => ({x: x + along[0] * pixels, y: y + along[1] * pixels});
const line = (a, b, look = "") => makeSvg("line", {x1: a.x, y1: a.y, x2: b.x, y2: b.y, class: look});
const circle = ({x, y}, r) => makeSvg("circle", {cx: x, cy: y, r});
const box = ({x, y}) => makeSvg("rect", {x: x - 5, y: y - 5, width: 10, height: 10});
const stem = (from, to) => makeSvg("g", {}, line(from, to, "grip"), line(from, to), circle(to, 6));
