// The page: shows the server's state in the elements, and sends the user's actions to the server.
import {framed, membersOf, moved, orbit, planeShift, zoomed} from "./camera.js";
import {Cut} from "./cut.js";
import {listen} from "./input.js";
import {hiddenParts} from "./hidden_parts.js";
import {icon} from "./icons.js";
import {replaceSelect} from "./menu.js";
import {PhaseList} from "./phases.js";
import {draw, place} from "./picture.js";
import {showPoint} from "./point.js";
import {isPressed, whenReleased} from "./press.js";
import {Changes, ask, askFile, follow, writeCamera} from "./server.js";
import {fitPicture} from "./stage.js";
import {Studio} from "./studio.js";
import {setPhases} from "./swatch.js";
import {Tabs} from "./tabs.js";
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
  status: element("cut-said"),
}, (change) => changes.make(change));

const time = new Time({
  section: element("time"),
  slider: element("time-slider"),
  status: element("time-said"),
  play: element("time-play"),
}, (change) => changes.make(change));

for (const button of document.querySelectorAll("[data-icon]")) button.prepend(icon(button.dataset.icon));
const lists = {layer: replaceSelect(element("layer")), direction: replaceSelect(element("cut-direction"))};
const tabs = new Tabs(element("tabs"));
const studio = new Studio({
  canvas,
  tabs,
  camera: () => camera,
  radius: () => state?.radius ?? 1,
  lookAt: (centre) => camera && look(framed(camera, centre, 0.6 * state.radius)),
  hide: (phase, isHidden) => {
    const others = state.phases.filter(({name, hidden}) => hidden && name !== phase).map(({name}) => name);
    changes.make({hidden: isHidden ? [...others, phase] : others});
  },
  hideParts: (pointers, isHidden) => changes.make({hidden_parts: hiddenParts.with(pointers, isHidden)}),
  seek: (seconds) => {
    studio.showTime(seconds, state.times);
    changes.make({time: seconds});
  },
  togglePlay: () => element("time-play").click(),
  inspect: (event) => act.ask(event),
  changed: () => showErrors(),
  lost: (error) => { element("status").textContent = error.message; },
});
const fit = fitPicture(document.querySelector(".stage"), canvas, [element("handles"), element("selected-outline")], () => studio.handles.show());

function showText(id, text) {
  const place = element(id);
  if (place.textContent === text) return;
  place.textContent = text;
  place.hidden = text === "";
}

function showErrors() {
  // For an empty scene, the page already explains what to do, so do not show the error.
  const all = new Set([element("empty").hidden ? state?.error : "", refusal]);
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
  select.value = state.layer;
  lists.layer.refresh();
}

function showExposure(stops) {
  exposure.value = stops;
  element("exposure-value").value = `${Number(stops).toFixed(1)} stops`;
}

function showState(next, pixels) {
  state = next;
  element("scene").textContent = state.scene.replace(/^.*\//, "") || "phasetree view";
  element("scene").title = state.scene;
  element("status").textContent = statusOf(state);
  showErrors();
  showText("warning", state.warning);
  if (pixels) draw(canvas, state, pixels);
  if (pixels) fit();
  if (pixels) studio.selectionOutline.pictureChanged(state);
  if (isPressed()) whenReleased().then(() => state === next && showPanels());
  else showPanels();
}

function showPanels() {
  // Changes just made here are newer than the server's state.
  if (changes.arePending || state.version < changes.version) return;
  showPhases(state.phases);
  if (hiddenParts.take(state.hidden_parts)) studio.outliner.show();
  cut.show(state);
  lists.direction.refresh();
  time.show(state);
  studio.showTime(state.time, state.times);
  showLayers(state);
  if (document.activeElement !== exposure) showExposure(state.exposure);
  if (state.camera) {
    camera = JSON.parse(state.camera);
    showCamera(state.camera);
  }
}

// The swatches of the outline have the colours of the phases.
let seenPhases = "";
function showPhases(shown) {
  phases.show(shown);
  const text = JSON.stringify(shown.map(({name, kind, color, hidden}) => [name, kind, color, hidden]));
  if (text === seenPhases) return;
  seenPhases = text;
  setPhases(shown);
  studio.outliner.show();
  studio.inspector.show();
}

function showCamera(text) {
  const area = element("camera");
  const written = `"camera": ${text}`;
  if (area.value !== written) area.value = written;
  studio.handles.show();
}

function look(next) {
  camera = next;
  studio.handles.show();
  changes.make({camera});
}

// Asks what is at a point. If `selects`, selects it; otherwise opens the tab that describes the point.
const askAt = (x, y, selects) => attempt(async () => {
  const told = await ask(x, y);
  showPoint(element("point"), told, (pointer) => studio.selectNode(pointer));
  if (selects) studio.selectNodes(told.path, told.point);
  else tabs.show("point");
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
  turn: (right, up) => camera && look(orbit(camera, state.centre, right, up)),
  move: (right, up) => camera && look(moved(camera, state.centre, right, up)),
  zoom: (factor) => camera && look(zoomed(camera, state.centre, state.radius, factor)),
  // Each finger reports its motion separately, so the combined motion is computed from the start instead of summed up.
  grab: () => { grabbed = camera; },
  pinch: (factor, right, up) => grabbed && look(moved(zoomed(grabbed, state.centre, state.radius, factor), state.centre, right, up)),
  reset: () => changes.make({camera: null}),
  cut: (right, up) => camera && cut.isOn && cut.move(planeShift(camera, state.centre, cut.normal, right, up)),
  stepCut: (direction) => cut.move(0.02 * direction * state.radius),
  ask: (event) => askAt(...place(canvas, event), !event.altKey),
  askMiddle: () => askAt(canvas.width / 2, canvas.height / 2, false),
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
element("write").addEventListener("click", () => attempt(async () => {
  studio.scene.isChangedHere = true;
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

follow(showState, (error) => { element("status").textContent = error.message; });
window.studio = studio; // for the browser's console and for tests
studio.start().catch((error) => refuse(error.message));
