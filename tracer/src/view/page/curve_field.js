// A curve through points [x, y], such as a spectrum or a ramp of numbers: points are dragged in a plot, added by a click,
// removed by Delete, and typed below it.
import {make, makeSvg, newId} from "./dom.js";
import {icon} from "./icons.js";
import {NumberField} from "./number_field.js";

const width = 280, height = 112, edge = 8; // pixels
const shareOfStep = 0.01; // of the plot, for an arrow key

const precise = (x) => Number(x.toPrecision(5));

export class CurveField {
  #points = [];
  #chosen = 0;
  #range = null; // [x from, x to, y from, y to]
  #drag = null;
  #options;
  #changed;

  // `options` has label, x and y (names), and the limits of y: low and high. `changed(points, gesture, i)` gets the index
  // of the only point that has changed, or undefined.
  constructor(options, changed) {
    this.#options = options;
    this.#changed = changed;
    this.plot = makeSvg("svg", {viewBox: `0 0 ${width} ${height}`, class: "plot", role: "group", "aria-label": options.label});
    this.plot.addEventListener("pointerdown", (event) => this.#add(event));
    this.fields = ["x", "y"].map((axis, i) => new NumberField({label: `${options.label}, ${options[axis]}`, unit: options[`${axis}Unit`]}, (value, gesture) =>
      this.#move(this.#chosen, this.#points[this.#chosen].map((old, j) => (i === j ? value : old)), gesture)));
    this.remove = make("button", {type: "button", class: "icon-button small", "aria-label": "Remove the point", title: "Remove the point (Delete)", onclick: () => this.#delete(this.#chosen)}, icon("delete"));
    this.ends = make("p", {class: "faint ends", "aria-hidden": "true"});
    this.element = make("div", {class: "curve"}, this.plot, this.ends, make("div", {class: "point-fields"}, this.fields.map((field) => field.element), this.remove));
  }
  show(points) {
    this.#points = points;
    this.#chosen = Math.max(0, Math.min(this.#chosen, points.length - 1));
    if (!this.#drag) this.#range = rangeOf(points, this.#options);
    this.#draw();
  }
  #place([x, y]) {
    const [x0, x1, y0, y1] = this.#range;
    return {x: edge + (x - x0) / (x1 - x0) * (width - 2 * edge), y: height - edge - (y - y0) / (y1 - y0) * (height - 2 * edge)};
  }
  #valueAt(event) {
    const box = this.plot.getBoundingClientRect(), [x0, x1, y0, y1] = this.#range;
    const x = ((event.clientX - box.left) / box.width * width - edge) / (width - 2 * edge);
    const y = (height - edge - (event.clientY - box.top) / box.height * height) / (height - 2 * edge);
    return [x0 + x * (x1 - x0), y0 + y * (y1 - y0)];
  }
  #draw() {
    const focused = this.plot.contains(document.activeElement) && !this.#drag;
    const places = this.#points.map((point) => this.#place(point));
    const path = makeSvg("path", {d: places.length > 0 ? `M0 ${places[0].y}${places.map(({x, y}) => `L${x.toFixed(1)} ${y.toFixed(1)}`).join("")}L${width} ${places.at(-1).y}` : "M0 0"});
    const dots = places.map(({x, y}, i) => {
      const dot = makeSvg("circle", {cx: x, cy: y, r: 5, tabindex: i === this.#chosen ? 0 : -1, role: "button", class: i === this.#chosen ? "chosen" : "",
        "aria-label": `Point ${i + 1} of ${places.length}: ${this.#points[i].map(precise).join(", ")}`, "data-point": i});
      dot.addEventListener("pointerdown", (event) => this.#grab(event, i));
      dot.addEventListener("keydown", (event) => this.#press(event, i));
      return dot;
    });
    if (this.#drag) this.#redraw(path, dots);
    else this.plot.replaceChildren(path, ...dots);
    if (focused) dots[this.#chosen]?.focus();
    const point = this.#points[this.#chosen];
    this.fields.forEach((field, i) => field.show(point?.[i] ?? null));
    this.remove.disabled = this.#points.length <= 1;
    const [x0, x1, y0, y1] = this.#range.map(precise);
    this.ends.replaceChildren(make("span", {}, `${x0}`), make("span", {}, `${this.#options.y} ${y0} to ${y1}`), make("span", {}, `${x1}`));
  }
  // While a dot is dragged, it must stay the same element.
  #redraw(path, dots) {
    this.plot.querySelector("path").setAttribute("d", path.getAttribute("d"));
    [...this.plot.querySelectorAll("circle")].forEach((dot, i) => {
      for (const name of ["cx", "cy", "class"]) dot.setAttribute(name, dots[i].getAttribute(name));
    });
  }
  // Between its neighbours, because x increases.
  #limited(i, [x, y]) {
    const {low = -Infinity, high = Infinity} = this.#options, [x0, x1] = this.#range, gap = 1e-4 * (x1 - x0);
    const [before, after] = [this.#points[i - 1]?.[0] ?? -Infinity, this.#points[i + 1]?.[0] ?? Infinity];
    return [precise(Math.max(before + gap, Math.min(after - gap, x))), precise(Math.max(low ?? -Infinity, Math.min(high ?? Infinity, y)))];
  }
  #move(i, point, gesture) {
    const next = this.#limited(i, point);
    this.show(this.#points.map((old, j) => (i === j ? next : old)));
    this.#changed(this.#points, gesture, i);
  }
  #delete(i) {
    if (this.#points.length <= 1) return;
    this.show(this.#points.filter((_, j) => j !== i));
    this.#changed(this.#points, null);
  }
  #add(event) {
    if (event.button !== 0 || event.target.tagName === "circle") return;
    event.preventDefault();
    const [x, y] = this.#valueAt(event), after = this.#points.findIndex(([at]) => at > x), i = after < 0 ? this.#points.length : after;
    this.#points = this.#points.toSpliced(i, 0, [x, y]);
    this.#points = this.#points.toSpliced(i, 1, this.#limited(i, [x, y]));
    this.#chosen = i;
    this.#draw();
    this.#changed(this.#points, null);
    this.plot.querySelectorAll("circle")[i].focus();
  }
  #grab(event, i) {
    if (event.button !== 0) return;
    event.preventDefault();
    this.#chosen = i;
    this.#draw();
    const dot = this.plot.querySelectorAll("circle")[i], gesture = newId("curve"), [x0, x1, y0, y1] = this.#range;
    const from = this.#valueAt(event), base = this.#points[i];
    dot.focus();
    this.#drag = dot;
    const onGrid = (value, size) => precise(Math.round(value / (10 ** Math.floor(Math.log10(size)) / 1000)) * (10 ** Math.floor(Math.log10(size)) / 1000));
    const move = (now) => {
      const k = now.shiftKey ? 0.1 : 1, at = this.#valueAt(now);
      this.#move(i, [onGrid(base[0] + k * (at[0] - from[0]), x1 - x0), onGrid(base[1] + k * (at[1] - from[1]), y1 - y0)], gesture);
    };
    const end = () => {
      dot.removeEventListener("pointermove", move);
      this.#drag = null;
      this.show(this.#points);
    };
    dot.setPointerCapture(event.pointerId);
    dot.addEventListener("pointermove", move);
    dot.addEventListener("pointerup", end, {once: true});
    dot.addEventListener("pointercancel", end, {once: true});
  }
  #press(event, i) {
    const [x0, x1, y0, y1] = this.#range, k = shareOfStep * (event.shiftKey ? 0.1 : 1);
    const by = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    if (by) this.#move(i, [this.#points[i][0] + by[0] * k * (x1 - x0), this.#points[i][1] + by[1] * k * (y1 - y0)], "curve-keys");
    else if (event.key === "Delete" || event.key === "Backspace") this.#delete(i);
    else if (event.key === "PageDown" || event.key === "PageUp") {
      this.#chosen = Math.max(0, Math.min(this.#points.length - 1, i + (event.key === "PageDown" ? 1 : -1)));
      this.#draw();
      this.plot.querySelectorAll("circle")[this.#chosen].focus();
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

function rangeOf(points, {low, high}) {
  const [xs, ys] = [0, 1].map((i) => points.map((point) => point[i]));
  const [x0, x1] = points.length > 0 ? [Math.min(...xs), Math.max(...xs)] : [0, 1], pad = 0.06 * (x1 - x0) || 0.5;
  const bottom = Math.min(0, ...ys), top = Math.max(...ys, Number.isFinite(high) && high < 1e3 ? high : bottom);
  const isFlat = top - bottom < 1e-9;
  return [x0 - pad, x1 + pad, Number.isFinite(low) && low > -1e3 ? Math.min(low, bottom) : bottom, isFlat ? bottom + 1 : Number.isFinite(high) && high < 1e3 ? top : bottom + 1.1 * (top - bottom)];
}
