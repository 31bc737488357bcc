// Whether something on the page is pressed at this moment. Panels change only while nothing is: if an update of the scene
// replaced a button between the press and the release, the browser would not report a click.

// What is dragged, or scrolled by dragging, follows the scene: only the moment before the first movement is a press.
const dragged = ".number, #handles, .plot, .ramp-bar, .ramp-stop, .time-key, canvas, input[type=range]";
const pixelsToDrag = 3;
const pauseOfTap = 350; // milliseconds within which a browser reports the click of a finger
const pauseOfClick = 30; // … of a mouse

let press = null;   // {id, x, y, isDrag}, or {key}
let waiting = [];   // what resolves when nothing is pressed
let timer = null;

function end() {
  clearTimeout(timer);
  press = timer = null;
  const resolve = waiting;
  waiting = [];
  for (const done of resolve) done();
}

const endSoon = (milliseconds) => {
  clearTimeout(timer);
  timer = setTimeout(end, milliseconds);
};

export const isPressed = () => press !== null;

// Resolves as soon as nothing is pressed.
export const whenReleased = () => (press === null ? Promise.resolve() : new Promise((done) => waiting.push(done)));

const isOfPress = (event) => press !== null && press.id === event.pointerId;

addEventListener("pointerdown", (event) => {
  clearTimeout(timer);
  press = {id: event.pointerId, x: event.clientX, y: event.clientY, isDrag: event.target.closest?.(dragged) !== null};
}, {capture: true});
addEventListener("pointermove", (event) => {
  if (!isOfPress(event)) return;
  const isReleased = event.pointerType === "mouse" && event.buttons === 0; // outside the window
  if (isReleased || (press.isDrag && Math.hypot(event.clientX - press.x, event.clientY - press.y) >= pixelsToDrag)) end();
}, {capture: true});
addEventListener("pointerup", (event) => {
  if (isOfPress(event)) endSoon(event.pointerType === "mouse" ? pauseOfClick : pauseOfTap);
}, {capture: true});
addEventListener("pointercancel", (event) => {
  if (isOfPress(event)) end();
}, {capture: true});
// The space bar clicks a button when it is released. The click follows before any timer.
addEventListener("click", () => {
  if (timer !== null) endSoon(0);
}, {capture: true});
addEventListener("keydown", (event) => {
  if (event.key === " " && press === null && event.target.matches?.("button, input[type=checkbox], summary")) press = {key: " "};
}, {capture: true});
addEventListener("keyup", (event) => {
  if (press?.key === event.key) endSoon(0);
}, {capture: true});
addEventListener("blur", () => {
  if (press !== null) end();
});

// Calls a function when Escape is pressed, before anything else on the page learns of it. Returns what stops this.
export function onEscape(run) {
  const listen = (event) => {
    if (event.key !== "Escape") return;
    event.preventDefault();
    event.stopImmediatePropagation();
    run(event);
  };
  addEventListener("keydown", listen, {capture: true});
  return () => removeEventListener("keydown", listen, {capture: true});
}
