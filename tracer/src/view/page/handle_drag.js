// How a handle follows the pointer, how its numbers are rounded, and how they are typed.
import {make, newId} from "./dom.js";
import {closeWith, openBeside} from "./menu.js";
import {NumberField, VectorField} from "./number_field.js";
import {onEscape} from "./press.js";

const plus = (a, b) => a.map((x, i) => x + b[i]);
const times = (a, k) => a.map((x) => x * k);
const pixelsToDrag = 3, pixelsOfGrid = 12;

// How far a point must move along one or two vectors to be seen at a target. `seen(p)` is where a point is in the
// picture. null if it cannot be moved there, as along a line that leads into the picture.
export function followed(seen, p, vectors, target) {
  let by = vectors.map(() => 0);
  const at = (amounts) => seen(vectors.reduce((sum, v, i) => plus(sum, times(v, amounts[i])), p));
  for (let step = 0; step < 6; ++step) {
    const now = at(by);
    if (!now) return null;
    const small = vectors.map((v) => now.unit / Math.max(1e-12, Math.hypot(...v)));
    const slopes = vectors.map((_, i) => {
      const moved = at(by.map((b, j) => (i === j ? b + small[i] : b)));
      return moved && [(moved.x - now.x) / small[i], (moved.y - now.y) / small[i]];
    });
    if (slopes.includes(null)) return null;
    const change = solved(slopes, [target.x - now.x, target.y - now.y], small);
    if (!change) return null;
    by = by.map((b, i) => b + change[i]);
    if (change.every((c, i) => Math.abs(c) < 1e-3 * small[i])) break;
  }
  return by.every(Number.isFinite) ? by : null;
}

// Least squares for one column, and the solution for two.
function solved([a, b], [x, y], small) {
  const seenSize = (column, i) => Math.hypot(...column) * small[i]; // in pixels, for one pixel across the line of sight
  if (seenSize(a, 0) < 0.08) return null;
  if (!b) return [(a[0] * x + a[1] * y) / (a[0] ** 2 + a[1] ** 2)];
  const area = a[0] * b[1] - a[1] * b[0];
  if (Math.abs(area) * small[0] * small[1] < 0.02) return null;
  return [(x * b[1] - y * b[0]) / area, (a[0] * y - a[1] * x) / area];
}

// Rounds to about a pixel; with Ctrl to a coarse grid of 1, 2 or 5, about a dozen pixels wide.
export function rounded(value, unit, event) {
  const power = 10 ** Math.floor(Math.log10(unit)), wanted = pixelsOfGrid * unit, coarse = 10 ** Math.floor(Math.log10(wanted));
  const grid = event?.ctrlKey || event?.metaKey ? coarse * [1, 2, 5, 10].find((k) => k * coarse >= wanted) : power;
  return Number((Math.round(value / grid) * grid).toPrecision(6));
}

// Follows the pointer from a press until it is released. `moved(by, event)` gets pixels; Shift moves ten times as finely.
// A press without a drag is a click. Escape ends the drag and calls `cancelled` before `ended`.
export function follow(press, {moved, ended, clicked, cancelled}) {
  if (press.button !== 0) return false;
  press.preventDefault();
  press.stopPropagation();
  const grip = press.currentTarget;
  let last = [press.clientX, press.clientY], by = [0, 0], isDragged = false;
  const move = (event) => {
    const k = event.shiftKey ? 0.1 : 1;
    by = [by[0] + k * (event.clientX - last[0]), by[1] + k * (event.clientY - last[1])];
    last = [event.clientX, event.clientY];
    isDragged ||= Math.hypot(...by) >= pixelsToDrag;
    if (isDragged) moved(by, event);
  };
  const end = (event) => {
    stopEscape();
    grip.removeEventListener("pointermove", move);
    grip.removeEventListener("pointerup", end);
    grip.removeEventListener("pointercancel", end);
    if (event.type === "keydown" && isDragged) cancelled();
    ended();
    if (!isDragged && event.type === "pointerup") clicked();
  };
  const stopEscape = onEscape(end);
  grip.setPointerCapture(press.pointerId);
  grip.addEventListener("pointermove", move);
  grip.addEventListener("pointerup", end);
  grip.addEventListener("pointercancel", end);
  return true;
}

// Numbers to type, beside a handle; returns their field. `changed(value, gesture)` gets a number, or several.
export function typeNumbers(grip, {title, value, least, unit, scale}, changed) {
  const options = {label: title, low: least, unit, scale};
  const field = Array.isArray(value) ? new VectorField({...options, names: ["x", "y", "z"].slice(0, value.length)}, changed) : new NumberField(options, changed);
  field.show(value);
  const popup = make("div", {class: "popup typed", role: "dialog", "aria-label": title, popover: "auto", id: newId("typed")}, make("p", {class: "faint"}, title), field.element);
  popup.addEventListener("keydown", (event) => {
    if (event.key === "Enter") setTimeout(() => popup.hidePopover());
  }, true);
  closeWith(popup, grip);
  openBeside(popup, grip);
  popup.querySelector("input").focus();
  return field;
}
