// Mouse, touch and keyboard input on the picture. `act` has turn(right, up) in radians; move(right, up) and cut(right,
// up) in fractions of the picture's height; zoom(factor), stepCut(direction), ask(event), askMiddle() and reset(). For
// two fingers it has grab(), and pinch(factor, right, up) relative to the camera at the last grab.

const radiansAcross = Math.PI; // for a drag over the picture's height
const step = Math.PI / 24;     // per key press

export function listen(canvas, act) {
  const pointers = new Map(); // pressed pointers and their last positions
  let isClick = false;        // whether the gesture may still be a click: a single pointer that has not moved
  let grabbed = null;         // the state when the second finger touched

  const twoFingers = () => {
    const [a, b] = [...pointers.values()];
    return {
      x: (a.clientX + b.clientX) / 2,
      y: (a.clientY + b.clientY) / 2,
      spread: Math.max(1, Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY)),
    };
  };
  const grabIfTwo = () => {
    if (pointers.size !== 2) return;
    grabbed = twoFingers();
    act.grab();
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    canvas.focus();
    pointers.set(event.pointerId, event);
    isClick = pointers.size === 1;
    grabIfTwo();
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const height = canvas.getBoundingClientRect().height;
    const right = (event.clientX - last.clientX) / height, down = (event.clientY - last.clientY) / height;
    // Tolerate small movements during a click.
    if (isClick && Math.hypot(right, down) * height < 4) return;
    isClick = false;
    pointers.set(event.pointerId, event);
    if (pointers.size > 2) return;
    if (pointers.size === 2) {
      const now = twoFingers();
      act.pinch(grabbed.spread / now.spread, (now.x - grabbed.x) / height, (grabbed.y - now.y) / height);
    } else if (event.ctrlKey) {
      act.cut(right, -down);
    } else if (event.shiftKey || event.buttons & 2) {
      act.move(right, -down);
    } else {
      act.turn(-right * radiansAcross, down * radiansAcross);
    }
  });
  const release = (event) => {
    const asks = isClick && event.type === "pointerup" && event.button === 0;
    pointers.delete(event.pointerId);
    isClick = false;
    grabIfTwo();
    if (asks) act.ask(event);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    act.zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY / 400))));
  }, {passive: false});

  const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = arrows[event.key];
    if (arrow && event.shiftKey) act.move(0.1 * arrow[0], 0.1 * arrow[1]);
    else if (arrow) act.turn(step * arrow[0], step * arrow[1]);
    else if (event.key === "+" || event.key === "=") act.zoom(0.9);
    else if (event.key === "-") act.zoom(1 / 0.9);
    else if (event.key === "]") act.stepCut(1);
    else if (event.key === "[") act.stepCut(-1);
    else if (event.key === "0") act.reset();
    else if (event.key === "Enter") act.askMiddle();
    else return;
    event.preventDefault();
  });
  return {step};
}
