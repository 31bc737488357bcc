// Keys that work anywhere in the page, except where text is typed.
import {openDialog} from "./dialog.js";
import {isTyping, make} from "./dom.js";

const table = [
  ["Scene", [["Shift+A", "Add"], ["W", "Wrap the selection"], ["R", "Replace"], ["Ctrl+D", "Duplicate"], ["Delete", "Delete"], ["Ctrl+G", "Group"],
    ["Ctrl+Shift+G", "Remove the wrapper"], ["F2", "Rename"], ["Alt+↑ Alt+↓", "Move up or down in its list"], ["Ctrl+Z", "Undo"],
    ["Ctrl+Shift+Z", "Redo"], ["Ctrl+E", "Show the text"], ["F", "Look at the selection"], ["G", "Drag surfaces"],
    ["O", "Outline the selection in the picture"], ["H", "Hide or show the selection in the picture"], ["Alt+H", "Show everything"]]],
  ["Picture", [["Drag", "Rotate"], ["Shift+drag", "Move"], ["Scroll", "Zoom"], ["Click", "Select"], ["Alt+drag", "Drag the surface"], ["Alt+click", "Inspect the point"],
    ["Ctrl+drag", "Move the cut"], ["← ↑ → ↓", "Rotate; with Shift, move"], ["+ −", "Zoom"], ["[ ]", "Move the cut"], ["Enter", "Inspect the centre"],
    ["0", "Reset the camera"]]],
  ["Handles", [["Drag", "Change"], ["Shift", "Finer"], ["Ctrl", "Snap to round numbers, or to 15°"], ["Click", "Type the numbers"]]],
  ["Curves, ramps, keys", [["← → ↑ ↓", "Move the point; with Shift, finer"], ["Page Up, Page Down", "The next point"], ["Delete", "Remove it"], ["Enter", "Type the time of a key"],
    ["Space", "Go to the time of a key"]]],
  ["Outline", [["↑ ↓", "Select"], ["← →", "Collapse, expand"], ["Ctrl+click, Space", "Select several"], ["Shift+click", "Select a range"], ["Enter", "Edit"],
    ["Shift+F10", "Menu"]]],
  ["Numbers", [["Drag", "Change"], ["Shift, Ctrl", "Finer, coarser"], ["↑ ↓", "Step"], ["1/3, 2*0.4", "Typed: calculates"], ["Esc", "Cancel"]]],
];

// Whether what is in a field of the inspector is part of the scene: nothing has been typed since. Ctrl+Z then undoes a step
// of the scene; before, the browser undoes what has been typed.
const isCommitted = (element) => element instanceof HTMLInputElement && element.closest("#inspector") !== null && !element.dataset.typed;

// Fields with a control of their own, such as numbers, keep track of this themselves.
function watchTyping() {
  addEventListener("input", ({target}) => { if (target.matches?.("#inspector input.line")) target.dataset.typed = "yes"; });
  addEventListener("change", ({target}) => { if (target.matches?.("#inspector input.line")) delete target.dataset.typed; });
}

export function showKeys() {
  openDialog("Keys", "keys", () => make("div", {class: "key-tables"}, table.map(([title, rows]) => make("section", {}, make("h3", {}, title),
    make("dl", {}, rows.flatMap(([keys, text]) => [make("dt", {}, keys.split(", ").flatMap((key) => [make("kbd", {}, key), " "])), make("dd", {}, text)]))))));
}

export function listenForKeys(actions, {toggleText, frame, toggleGrab, toggleOutline, toggleHidden, showAll, wrapButton, whenReady}) {
  watchTyping();
  document.addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open], [popover]:popover-open")) return;
    const control = event.ctrlKey || event.metaKey, key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (control && key === "e") {
      event.preventDefault();
      return toggleText();
    }
    const isOfHistory = control && ["z", "y"].includes(key);
    if (isTyping(document.activeElement) && !(isOfHistory && isCommitted(document.activeElement))) return;
    const onPicture = document.activeElement?.id === "picture";
    const run = (() => {
      if (control && key === "z") return () => (event.shiftKey ? actions.redo() : actions.undo());
      if (control && key === "y") return () => actions.redo();
      if (control && key === "d") return () => actions.duplicate();
      if (control && key === "g") return () => (event.shiftKey ? actions.unwrap() : actions.group());
      if (control) return null;
      if (event.altKey && !onPicture && key === "ArrowUp") return () => actions.shift(-1);
      if (event.altKey && !onPicture && key === "ArrowDown") return () => actions.shift(1);
      if (event.altKey && key === "h") return showAll;
      if (event.altKey) return null;
      if (key === "Delete" || key === "Backspace") return () => actions.delete();
      if (key === "F2") return () => actions.rename();
      if (event.shiftKey && key === "a") return () => actions.add();
      if (event.shiftKey && key !== "?") return null;
      if (key === "w") return () => actions.wrapMenu(wrapButton);
      if (key === "r") return () => actions.replace();
      if (key === "f") return frame;
      if (key === "g") return toggleGrab;
      if (key === "o") return toggleOutline;
      if (key === "h") return toggleHidden;
      if (key === "?") return showKeys;
      return null;
    })();
    if (!run) return;
    event.preventDefault();
    whenReady(run);
  });
}
