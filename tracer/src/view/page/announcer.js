// Short messages at the bottom of the window, also read by screen readers.
import {make} from "./dom.js";
import {icon} from "./icons.js";

export class Announcer {
  #place;

  constructor(place) {
    this.#place = place;
  }
  say(text, {isWrong = false, button = null} = {}) {
    const toast = make("div", {class: isWrong ? "toast wrong" : "toast"}, isWrong ? icon("warning") : null, make("span", {}, text));
    const close = () => toast.remove();
    if (button) toast.append(make("button", {type: "button", onclick: () => {
      close();
      button.run();
    }}, button.text));
    toast.append(make("button", {type: "button", class: "icon-button small", "aria-label": "Close", onclick: close}, icon("close")));
    for (const old of [...this.#place.children].slice(0, -1)) old.remove();
    this.#place.append(toast);
    setTimeout(close, isWrong ? 9000 : 3500);
  }
}
