// The page: shows the server's state in the elements, and sends the user's actions to the server.
import {followed, membersOf, moved, turned, zoomed} from "./camera.js";
import {Cut} from "./cut.js";
import {listen} from "./input.js";
import {Numbers} from "./numbers.js";
import {PhaseList} from "./phases.js";
import {draw, place} from "./picture.js";
import {showPoint} from "./point.js";
import {Changes, ask, askFile, askNumbers, follow, writeCamera, writeNumbers} from "./server.js";
import {Time} from "./time.js";

const element = (id) => document.getElementById(id);
const canvas = element("picture"), exposure = element("exposure");

let state = null, camera = null;
let grabbed = null; // the camera when two fingers touched
let refusal = ""; // the error of the last action on this page; the scene's own error is state.error
const changes = new Changes(() => refuse(""), (error) => refuse(error.message));

const phases = new PhaseList(element("phases"), (change) => changes.make(change));
const cut = new Cut({
  direction: element("cut-direction"),
  normal: [...document.querySelectorAll("[data-normal]")],
  offset: element("cut-offset"),
  said: element("cut-said"),
}, (change) => changes.make(change));

const time = new Time({
  section: element("time"),
  slider: element("time-slider"),
  said: element("time-said"),
  play: element("time-play"),
}, (change) => changes.make(change));

const numbers = new Numbers({
  filter: element("number-filter"),
  rows: element("number-rows"),
  said: element("numbers-said"),
}, (change) => changes.make(change));

function showText(id, text) {
  const place = element(id);
  if (place.textContent === text) return;
  place.textContent = text;
  place.hidden = text === "";
}

function showErrors() {
  const all = new Set([state?.error, refusal]);
  showText("error", [...all].filter(Boolean).join("\n\n"));
}

function refuse(text) {
  refusal = text;
  showErrors();
}

// Performs an action that the server may reject, after clearing the last error.
async function attempt(action) {
  try {
    await action();
    refuse("");
  } catch (error) {
    refuse(error.message);
  }
}

function statusOf(state) {
  const seconds = state.seconds_to_picture > 0 ? `; first picture after ${state.seconds_to_picture.toFixed(2)} s` : "";
  return `${state.doing}${seconds}`;
}

// Recreate the options only if they differ, so that an open list stays open.
function showLayers(state) {
  const select = element("layer");
  const known = [...select.options].slice(1).map((option) => option.value);
  if (known.join("\n") !== state.layers.join("\n"))
    select.replaceChildren(select.options[0], ...state.layers.map((layer) => new Option(layer.replaceAll("_", " "), layer)));
  if (select !== document.activeElement) select.value = state.layer;
}

function showExposure(stops) {
  exposure.value = stops;
  element("exposure-value").value = `${Number(stops).toFixed(1)} stops`;
}

function told(next, pixels) {
  state = next;
  element("scene").textContent = state.scene || "phasetree view";
  element("status").textContent = statusOf(state);
  showErrors();
  showText("warning", state.warning);
  if (pixels) draw(canvas, state, pixels);
  // Changes just made here are newer than the server's state.
  if (changes.arePending || state.version < changes.version) return;
  phases.show(state.phases);
  cut.show(state);
  time.show(state);
  showLayers(state);
  numbers.show(state, askNumbers).catch((error) => refuse(error.message));
  if (document.activeElement !== exposure) showExposure(state.exposure);
  if (state.camera) {
    camera = JSON.parse(state.camera);
    showCamera(state.camera);
  }
}

function showCamera(text) {
  const area = element("camera");
  const said = `"camera": ${text}`;
  if (area.value !== said) area.value = said;
}

function look(next) {
  camera = next;
  changes.make({camera});
}

const askAt = (x, y) => attempt(async () => {
  showPoint(element("point"), await ask(x, y), (name, pointer) => numbers.showNode(name, pointer));
});

// Downloads the file by script and shows errors here. With an ordinary link, the browser would save the error message
// as the file, or show nothing.
const save = (extension) => attempt(async () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await askFile(`picture.${extension}`));
  const name = (state?.scene ?? "picture").replace(/^.*\//, "").replace(/\.[^.]*$/, "");
  link.download = `${name}.${extension}`;
  link.click();
  // By then the browser has begun to read it.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
});

const act = {
  turn: (right, up) => camera && look(turned(camera, state.centre, right, up)),
  move: (right, up) => camera && look(moved(camera, state.centre, right, up)),
  zoom: (factor) => camera && look(zoomed(camera, state.centre, state.radius, factor)),
  // Each finger reports its motion separately, so the combined motion is computed from the start instead of summed up.
  grab: () => { grabbed = camera; },
  pinch: (factor, right, up) => grabbed && look(moved(zoomed(grabbed, state.centre, state.radius, factor), state.centre, right, up)),
  reset: () => changes.make({camera: null}),
  cut: (right, up) => camera && cut.isOn && cut.move(followed(camera, state.centre, cut.normal, right, up)),
  stepCut: (direction) => cut.move(0.02 * direction * state.radius),
  ask: (event) => askAt(...place(canvas, event)),
  askMiddle: () => askAt(canvas.width / 2, canvas.height / 2),
};

const {step} = listen(canvas, act);
for (const button of document.querySelectorAll("[data-turn]"))
  button.addEventListener("click", () => act.turn(...button.dataset.turn.split(" ").map((n) => step * Number(n))));
for (const button of document.querySelectorAll("[data-zoom]"))
  button.addEventListener("click", () => act.zoom(Number(button.dataset.zoom)));
element("layer").addEventListener("change", () => changes.make({layer: element("layer").value}));
element("reset").addEventListener("click", act.reset);
exposure.addEventListener("input", () => {
  showExposure(exposure.value);
  changes.make({exposure: Number(exposure.value)});
});
element("copy").addEventListener("click", async () => {
  try {
    await navigator.clipboard.writeText(element("camera").value);
  } catch {
    element("camera").select();
    document.execCommand("copy");
  }
  element("copied").textContent = "Copied.";
});
element("numbers-reset").addEventListener("click", () => numbers.reset());
element("numbers-write").addEventListener("click", () => attempt(async () => {
  await writeNumbers();
  element("numbers-said").textContent = "Written.";
}));
element("write").addEventListener("click", () => attempt(async () => {
  await writeCamera();
  element("copied").textContent = "Written.";
}));
element("save").addEventListener("click", () => save("png"));
element("save-exr").addEventListener("click", () => save("exr"));
element("cut-facing").addEventListener("click", () => {
  if (!camera) return;
  const {position, look_at} = membersOf(camera);
  cut.face(position.map((x, i) => x - look_at[i]));
});

follow(told, (error) => { element("status").textContent = error.message; });
