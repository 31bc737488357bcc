// Dialogs of the page: a question with a text, and information.
import {make} from "./dom.js";
import {icon} from "./icons.js";

// Shows a dialog that closes on Escape and on a click beside it. `built` makes its content with a function that closes it.
export function openDialog(title, className, built) {
  const dialog = make("dialog", {class: `dialog ${className}`, "aria-label": title});
  const close = () => dialog.close();
  dialog.append(make("header", {}, make("h2", {}, title),
    make("button", {type: "button", class: "icon-button", "aria-label": "Close", title: "Close (Esc)", onclick: close}, icon("close"))));
  dialog.append(...[built(close)].flat());
  // A drag that begins inside, such as one that selects text, may end beside the dialog.
  let isBeside = false;
  dialog.addEventListener("pointerdown", (event) => { isBeside = event.target === dialog; });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog && isBeside) close();
  });
  dialog.addEventListener("close", () => dialog.remove());
  dialog.addEventListener("keydown", (event) => event.stopPropagation());
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}

// Asks for a name; null if there is none.
export function askName(title, proposed, done) {
  return new Promise((answer) => {
    let name = null;
    const input = make("input", {type: "text", class: "line", value: proposed, spellcheck: false, autocomplete: "off"});
    const dialog = openDialog(title, "small", (close) => make("form", {
      onsubmit: (event) => {
        event.preventDefault();
        name = input.value.trim() || null;
        close();
      },
    }, make("label", {}, "Name", input), make("div", {class: "buttons"},
      make("button", {type: "button", onclick: close}, "Cancel"), make("button", {type: "submit", class: "primary"}, done))));
    dialog.addEventListener("close", () => answer(name));
    input.select();
  });
}
