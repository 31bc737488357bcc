// Grabs a point of a surface in the picture and drags it. The server finds the numbers that move the point, and values
// of them for which the surface follows the pointer; the page sets these in the scene, in one step that can be undone.
import {newId} from "./dom.js";
import {GrabPanel} from "./grab_panel.js";
import {place} from "./picture.js";
import {onEscape} from "./press.js";
import {dragTo, grabAt, pause, shortMessage} from "./server.js";

const tolerated = 4;   // pixels that a click may move
const keyStep = 0.01;  // of the picture's height, for an arrow key

// The picture may still be that of the scene before the last change.
async function grabbedAt(x, y) {
  for (let attempts = 5; ; --attempts) {
    try {
      return await grabAt(x, y);
    } catch (error) {
      if (attempts === 0 || !error.message.includes("before the last change")) throw error;
      await pause(200);
    }
  }
}

class Cancelled extends Error {}

export class Grab {
  #canvas;
  #mark;
  #button;
  #scene;
  #announcer;
  #panel;
  #point = null;   // what is grabbed: the server's answer, and the gesture
  #press = null;   // the pointer that is down
  #target = null;  // where the point should be, in pixels of the picture
  #isBusy = false;

  // `inspect(event)` is what a click does while Alt is held.
  constructor({canvas, mark, panel, button, scene, announcer, inspect}) {
    this.#canvas = canvas;
    this.#mark = mark;
    this.#button = button;
    this.#scene = scene;
    this.#announcer = announcer;
    this.inspect = inspect;
    this.#panel = new GrabPanel(panel, {changed: () => this.#solve(), closed: () => this.release()});
    button.addEventListener("click", () => this.toggle());
    // Before the listeners that turn the camera.
    canvas.addEventListener("pointerdown", (event) => this.#down(event), {capture: true});
    canvas.addEventListener("keydown", (event) => this.#key(event), {capture: true});
    // What else changes the scene, such as undo, makes the point's numbers out of date.
    scene.addEventListener("change", () => {
      if (this.#point && !this.isBusy && scene.text !== this.#point.text) this.release();
    });
    new ResizeObserver(() => this.#showMark()).observe(canvas);
  }
  use(catalogue) {
    this.#panel.catalogue = catalogue;
  }
  get isOn() {
    return this.#button.getAttribute("aria-pressed") === "true";
  }
  get point() {
    return this.#point;
  }
  get isBusy() {
    return this.#isBusy || this.#press !== null;
  }
  // Without a file, there is nothing to change.
  get #isPossible() {
    return document.body.dataset.studio !== "off";
  }
  toggle() {
    if (!this.#isPossible) return;
    const isOn = !this.isOn;
    this.#button.setAttribute("aria-pressed", String(isOn));
    this.#canvas.classList.toggle("grabbing", isOn);
    if (isOn) this.#canvas.focus();
    else this.release();
    this.#announcer.say(isOn ? "Grab: drag a surface, or press Enter and use the arrows" : "Grab is off");
  }
  release() {
    this.#point = this.#target = null;
    this.#panel.hide();
    this.#showMark();
  }

  #down(event) {
    if (!this.#isPossible || !(this.isOn || event.altKey)) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    if (event.button !== 0 || this.#press) return;
    this.#canvas.focus();
    this.#canvas.setPointerCapture(event.pointerId);
    const press = {from: [event.clientX, event.clientY], isGrab: this.isOn, id: event.pointerId};
    this.#press = press;
    if (press.isGrab) this.#begin(place(this.#canvas, event));
    const move = (now) => {
      if (now.pointerId !== press.id) return;
      if (!press.isMoved && Math.hypot(now.clientX - press.from[0], now.clientY - press.from[1]) < tolerated) return;
      press.isMoved = true;
      if (!press.isGrab) {
        press.isGrab = true;
        this.#begin(place(this.#canvas, event));
      }
      this.#aim(place(this.#canvas, now));
    };
    const end = (now) => {
      if (now.pointerId !== press.id) return;
      stopEscape();
      for (const name of ["pointermove", "pointerup", "pointercancel"]) this.#canvas.removeEventListener(name, name === "pointermove" ? move : end);
      this.#press = null;
      if (!press.isGrab && now.type === "pointerup") this.inspect(now);
      else this.#finish();
    };
    const stopEscape = onEscape(() => {
      const merge = this.#point?.merge;
      end({pointerId: press.id, type: "keydown"});
      this.release();
      if (merge) this.#scene.takeBack(merge).catch((error) => this.#announcer.say(shortMessage(error), {isWrong: true}));
    });
    this.#canvas.addEventListener("pointermove", move);
    this.#canvas.addEventListener("pointerup", end);
    this.#canvas.addEventListener("pointercancel", end);
  }
  // While something is grabbed, the arrows drag it; otherwise Enter grabs what is in the middle.
  #key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (event.key === "Escape" && (this.#point || this.isOn)) {
      if (this.#point) this.release();
      else this.toggle();
    } else if (this.isOn && event.key === "Enter") {
      this.#begin([this.#canvas.width / 2, this.#canvas.height / 2]).then(() => this.#finish());
    } else if (this.isOn && this.#point && arrow) {
      const step = keyStep * this.#canvas.height * (event.shiftKey ? 0.1 : 1), [x, y] = this.#target ?? this.#point.at;
      this.#aim([x + step * arrow[0], y + step * arrow[1]]);
    } else {
      return;
    }
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  async #begin(at) {
    this.release();
    this.#isBusy = true;
    try {
      const told = await grabbedAt(...at);
      const pointers = told.influences.map((one) => one.pointer);
      const values = Object.fromEntries(told.influences.map((one) => [one.pointer, one.value]));
      this.#point = {...told, at, merge: newId("grab"), first: values, values, pointers, follows: true, text: this.#scene.text};
      this.#panel.show(this.#point, this.#scene);
      this.#mark.dataset.follows = "true";
    } catch (error) {
      this.#target = null;
      this.#announcer.say(`Nothing to drag here: ${shortMessage(error)}`, {isWrong: true});
    }
    this.#isBusy = false;
    this.#showMark();
    if (this.#target) this.#solve();
  }
  #aim([x, y]) {
    this.#target = [Math.max(0, Math.min(this.#canvas.width, x)), Math.max(0, Math.min(this.#canvas.height, y))];
    this.#solve();
  }
  // Finds values for the present target and sets them; again if the target or the choice has changed meanwhile.
  async #solve() {
    const point = this.#point;
    if (!point || !this.#target || this.#isBusy) {
      this.#isAgain = this.#isBusy;
      return;
    }
    this.#isBusy = true;
    this.#isAgain = false;
    const [x, y] = this.#target;
    try {
      const told = await dragTo({grab: point.grab, x, y, chosen: this.#panel.chosen});
      point.follows = told.follows;
      this.#mark.dataset.follows = String(told.follows);
      const changed = Object.entries(told.values).filter(([pointer, value]) => value !== point.values[pointer]);
      if (this.#point !== point) throw new Cancelled(); // by Escape
      point.values = told.values;
      this.#panel.showValues(point.values);
      this.#showMark();
      if (changed.length > 0) {
        const operations = changed.map(([pointer, value]) => ({set: pointer, to: String(value)}));
        await this.#scene.perform({label: `Drag ${point.inside === "vacuum" ? point.outside : point.inside}`, operations, merge: point.merge});
        point.text = this.#scene.text;
      }
    } catch (error) {
      if (!(error instanceof Cancelled)) this.#announcer.say(shortMessage(error), {isWrong: true});
    }
    this.#isBusy = false;
    if (this.#isAgain) this.#solve();
    else if (!this.#press) this.#finish();
  }
  #isAgain = false;

  // Says what has changed, for those who do not see the panel.
  #finish() {
    const point = this.#point;
    if (!point || this.isBusy) return;
    const changes = point.pointers.filter((pointer) => point.values[pointer] !== point.first[pointer]);
    const said = this.#panel.sentence(changes, point.values);
    if (!point.follows) this.#announcer.say("The surface cannot follow: choose other numbers, or a limit is reached", {isWrong: true});
    else this.#panel.say(said);
  }
  #showMark() {
    const at = this.#target ?? this.#point?.at;
    this.#mark.hidden = !at || !this.#point;
    if (this.#mark.hidden) return;
    const {offsetLeft, offsetTop, clientWidth, clientHeight, width, height} = this.#canvas;
    Object.assign(this.#mark.style, {left: `${offsetLeft + at[0] / width * clientWidth}px`, top: `${offsetTop + at[1] / height * clientHeight}px`});
  }
}
