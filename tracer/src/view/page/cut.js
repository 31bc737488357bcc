// A plane that cuts the object open. Its direction is an axis or three numbers. Its position is set by a slider, by
// Ctrl-dragging the picture, or by keys.

const length = (v) => Math.hypot(...v);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

export class Cut {
  #elements;
  #changed;
  #place = {centre: [0, 0, 0], radius: 1};

  // `elements` are those of the section: direction, normal (three inputs), offset, status.
  constructor(elements, changed) {
    this.#elements = elements;
    this.#changed = changed;
    elements.direction.addEventListener("change", () => {
      const axis = elements.direction.value;
      if (axis !== "" && axis !== "free") this.#setNormal(axis.split(" ").map(Number));
      this.#request();
    });
    elements.offset.addEventListener("input", () => this.#request());
    elements.normal.forEach((input) => input.addEventListener("change", () => {
      elements.direction.value = "free";
      this.#request();
    }));
  }
  get isOn() {
    return this.#elements.direction.value !== "";
  }
  get normal() {
    return this.#elements.normal.map((input) => Number(input.value));
  }
  #setNormal(normal) {
    this.#elements.normal.forEach((input, i) => { input.value = normal[i]; });
  }
  #request() {
    const normal = this.normal;
    this.#say();
    if (this.isOn && !(length(normal) > 1e-6)) return;
    this.#changed({cut: this.isOn ? this.#plane(normal) : null});
  }
  // The slider is in units of the object's radius from its centre; the server's offset is from the scene's origin.
  #plane(normal) {
    const unit = normal.map((x) => x / length(normal));
    return {normal: unit, offset: dot(unit, this.#place.centre) + Number(this.#elements.offset.value) * this.#place.radius};
  }
  // Cuts away what lies in a direction.
  face(direction) {
    this.#elements.direction.value = "free";
    this.#setNormal(direction.map((x) => Number((x / length(direction)).toPrecision(4))));
    this.#request();
  }
  // Moves the plane along its normal, in scene units.
  move(by) {
    if (!this.isOn) return;
    const {offset} = this.#elements;
    offset.value = Number(offset.value) + by / this.#place.radius;
    this.#request();
  }
  #say() {
    const {offset, status} = this.#elements;
    const text = this.isOn ? `${Math.round(100 * Number(offset.value))} % of the radius from the centre` : "none";
    offset.setAttribute("aria-valuetext", text);
    status.value = text;
    offset.disabled = !this.isOn;
    this.#elements.normal.forEach((input) => { input.disabled = !this.isOn; });
  }
  show(state) {
    this.#place = {centre: state.centre, radius: state.radius};
    const {direction, offset, normal} = this.#elements;
    const used = [direction, offset, ...normal].includes(document.activeElement);
    if (!used) {
      if (state.cut === null) direction.value = "";
      else {
        const axis = [...direction.options].find((o) => o.value === state.cut.normal.join(" "));
        direction.value = axis ? axis.value : "free";
        this.#setNormal(state.cut.normal.map((x) => Number(x.toPrecision(4))));
        offset.value = (state.cut.offset - dot(state.cut.normal, state.centre)) / state.radius;
      }
    }
    this.#say();
  }
}
