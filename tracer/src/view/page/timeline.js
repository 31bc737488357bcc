// The timeline below the picture, for scenes that change with time: where the picture is in time, and the keys of the
// selection, which are dragged, typed and deleted. Without a selection that has keys, those of the whole scene.
import {writtenValueOf} from "./affine.js";
import {make, newId} from "./dom.js";
import {typeNumbers} from "./handle_drag.js";
import {icon} from "./icons.js";
import {written} from "./json_text.js";
import {isKeyed, keyNear, present, withoutKey} from "./keyframes.js";
import {nameOf} from "./names.js";
import {titleOf} from "./parameter_row.js";
import {joined} from "./pointer.js";
import {chainOf, isNode, isSection, pointerOf} from "./structure.js";

const mostTracks = 6, room = 0.15; // beyond the last key, as a share of the time between the first and the last

export class Timeline {
  #element;
  #scene;
  #act;
  #drag = null; // {range, key} while a key is dragged

  // `act` has entry(), the active one; catalogue(); seek(seconds); togglePlay(); and failed(error).
  constructor(element, scene, act) {
    this.#element = element;
    this.#scene = scene;
    this.#act = act;
    this.slider = make("input", {type: "range", "aria-label": "Time", oninput: () => act.seek(Number(this.slider.value))});
    this.status = make("output", {});
    this.play = make("button", {type: "button", class: "icon-button small", "aria-label": "Play", title: "Play", onclick: () => act.togglePlay()}, icon("play"));
    this.tracks = make("div", {class: "tracks"});
    element.append(make("div", {class: "track head"}, make("div", {class: "track-name"}, this.play, this.status), make("div", {class: "lane"}, this.slider)), this.tracks);
  }
  get #range() {
    const [first, last] = present.span;
    return this.#drag?.range ?? [first, last + room * (last - first)];
  }
  show() {
    this.#element.hidden = present.span === null;
    if (present.span === null) return;
    const [low, high] = this.#range;
    Object.assign(this.slider, {min: low, max: high, step: (high - low) / 1000});
    if (this.slider !== document.activeElement || !this.slider.matches(":active")) this.slider.value = present.seconds;
    this.status.value = `${present.seconds.toFixed(2)} s`;
    if (!this.#drag) this.#showTracks();
  }
  #keyed(entries) {
    return entries.flatMap((entry) => Object.keys(entry.parameters).filter((name) => entry.parameters[name].keyed).map((name) => ({entry, name, value: writtenValueOf(entry, name)})))
      .filter(({value}) => isKeyed(value));
  }
  #showTracks() {
    const active = this.#act.entry(), own = !active || isSection(active) ? [] : this.#keyed(isNode(active) ? chainOf(active) : [active]);
    const shown = own.length > 0 ? own : this.#keyed(this.#scene.entries.filter((entry) => !isSection(entry)));
    const focused = document.activeElement?.dataset?.keyOf;
    this.tracks.replaceChildren(...shown.slice(0, mostTracks).map((track) => this.#track(track)));
    if (shown.length > mostTracks) this.tracks.append(make("p", {class: "faint"}, `${shown.length - mostTracks} more; select something to see its keys.`));
    if (focused) this.tracks.querySelector(`[data-key-of="${CSS.escape(focused)}"]`)?.focus();
  }
  #track({entry, name, value}) {
    const title = titleOf(name), whole = nameOf(entry, this.#act.catalogue());
    const lane = make("div", {class: "lane"}, value.keys.map((_, i) => this.#key({entry, name, value}, i)));
    return make("div", {class: "track", role: "group", "aria-label": `Keys of ${title.toLowerCase()}, ${whole}`}, make("div", {class: "track-name", title: `${title}, ${whole}`}, title), lane);
  }
  #key(track, i) {
    const {value, name, entry} = track, [seconds] = value.keys[i], [low, high] = this.#range;
    const button = make("button", {
      type: "button", class: `time-key${keyNear(value, present.seconds) === i ? " now" : ""}`, title: `${seconds} s: drag to move, Delete removes, double-click types`,
      "aria-label": `Key ${i + 1} of ${value.keys.length}, at ${seconds} seconds`, "data-key-of": `${pointerOf(entry, name)} ${i}`,
      onpointerdown: (event) => this.#grab(event, track, i), ondblclick: (event) => this.#type(event.currentTarget, track, i), onkeydown: (event) => this.#press(event, track, i),
    }, icon("key"));
    button.style.left = `${100 * (seconds - low) / (high - low)}%`;
    return button;
  }
  // Only this number of the file changes, so a key stays between its neighbours.
  #move({entry, name, value}, i, seconds, gesture) {
    const gap = 0.001, least = value.keys[i - 1]?.[0] ?? -Infinity, most = value.keys[i + 1]?.[0] ?? Infinity;
    const at = Number(Math.max(least + gap, Math.min(most - gap, seconds)).toFixed(3));
    this.#perform({label: `Move a key of ${titleOf(name).toLowerCase()}`, merge: gesture, operations: [{set: joined(pointerOf(entry, name), "keys", i, 0), to: written(at)}]});
    return at;
  }
  #perform(step) {
    this.#scene.perform(step).catch((error) => this.#act.failed(error));
  }
  #grab(event, track, i) {
    if (event.button !== 0) return;
    event.preventDefault();
    const button = event.currentTarget, box = button.parentElement.getBoundingClientRect(), [low, high] = this.#range, gesture = newId("key");
    const base = track.value.keys[i][0];
    let isDragged = false;
    this.#drag = {range: [low, high]}; // from now on, the button stays
    button.focus();
    const move = (now) => {
      const by = (now.clientX - event.clientX) / box.width * (high - low), grid = now.shiftKey ? 0.001 : 10 ** Math.floor(Math.log10((high - low) / 50));
      if (!isDragged && Math.abs(now.clientX - event.clientX) < 3) return;
      isDragged = true;
      const at = this.#move(track, i, Math.round((base + by) / grid) * grid, gesture);
      button.style.left = `${100 * (at - low) / (high - low)}%`;
    };
    const end = () => {
      button.removeEventListener("pointermove", move);
      this.#drag = null;
      this.show();
      if (!isDragged) this.#act.seek(base);
    };
    button.setPointerCapture(event.pointerId);
    button.addEventListener("pointermove", move);
    button.addEventListener("pointerup", end, {once: true});
    button.addEventListener("pointercancel", end, {once: true});
  }
  #type(button, track, i) {
    typeNumbers(button, {title: "Time of the key", value: track.value.keys[i][0], unit: "s", scale: 1}, (seconds, gesture) => this.#move(track, i, seconds, gesture));
  }
  #press(event, track, i) {
    const {entry, name, value} = track, [low, high] = this.#range, by = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (by) this.#move(track, i, value.keys[i][0] + by * (event.shiftKey ? 0.001 : (high - low) / 100), "key-keys");
    else if (event.key === "Delete" || event.key === "Backspace") this.#perform({label: `Delete a key of ${titleOf(name).toLowerCase()}`, operations: [{set: pointerOf(entry, name), to: written(withoutKey(value, i))}]});
    else if (event.key === "Enter") this.#type(event.currentTarget, track, i);
    else if (event.key === " ") this.#act.seek(value.keys[i][0]);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
