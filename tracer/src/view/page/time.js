// The time at which the scene is shown, for scenes with keys: a slider from the first key to the last, and a play
// button. During playback, each time is requested when the picture of the previous one has arrived, so slow scenes skip
// times instead of lagging behind.

export class Time {
  #elements;
  #changed;
  #span = null;
  #begun = null; // during playback, the clock time in seconds at which the slider was at its minimum
  #lastPicture = 0; // number of the picture that was shown at the last request

  // `elements` are those of the section: section, slider, status, play.
  constructor(elements, changed) {
    this.#elements = elements;
    this.#changed = changed;
    elements.slider.addEventListener("input", () => {
      this.#stop();
      this.#request(Number(elements.slider.value));
    });
    elements.play.addEventListener("click", () => (this.#begun === null ? this.#start() : this.#stop()));
  }
  show(state) {
    const {section, slider} = this.#elements;
    section.hidden = state.times === null;
    if (state.times === null) return this.#stop();
    const [first, last] = this.#span = state.times;
    slider.min = first;
    slider.max = last;
    slider.step = (last - first) / 1000;
    if (slider !== document.activeElement && this.#begun === null) slider.value = state.time;
    this.#say(this.#begun === null ? state.time : Number(slider.value));
    const picture = state.picture?.number ?? 0;
    if (this.#begun !== null && picture > this.#lastPicture) this.#next(picture);
  }
  #request(seconds) {
    this.#say(seconds);
    this.#changed({time: seconds});
  }
  #say(seconds) {
    this.#elements.status.value = `${seconds.toFixed(2)} s`;
  }
  #start() {
    if (this.#span === null) return;
    const [first, last] = this.#span;
    const at = Number(this.#elements.slider.value);
    this.#begun = performance.now() / 1000 - (at < last ? at - first : 0);
    this.#elements.play.textContent = "Stop";
    this.#next(this.#lastPicture);
  }
  #stop() {
    this.#begun = null;
    this.#elements.play.textContent = "Play";
  }
  #next(picture) {
    const [first, last] = this.#span;
    const gone = performance.now() / 1000 - this.#begun;
    this.#lastPicture = picture;
    const at = Math.min(first + gone, last);
    this.#elements.slider.value = at;
    this.#request(at);
    if (at === last) this.#stop();
  }
}
