// Builds elements. Members that begin with "on" are listeners, those that begin with "aria-" or "data-" are attributes,
// and the others are properties. Children are elements or text; null is left out.

const svg = "http://www.w3.org/2000/svg";

function set(element, name, value) {
  if (value === undefined || value === null) return;
  if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
  else if (name === "class") element.setAttribute("class", value);
  else if (/^(aria-|data-|role$|for$|list$)/.test(name) || element.namespaceURI === svg) element.setAttribute(name, value);
  else element[name] = value;
}

export function make(tag, members = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(members)) set(element, name, value);
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

export function makeSvg(tag, members = {}, ...children) {
  const element = document.createElementNS(svg, tag);
  for (const [name, value] of Object.entries(members)) set(element, name, value);
  element.append(...children);
  return element;
}

const looks = new WeakMap(); // of what refill() has filled
const focusable = "button, input, textarea, select, summary, [tabindex]";

// Fills an element, unless its look is the same as the last time: elements that stay keep the focus and what is typed. If
// they are replaced, the focus goes to the element with the same label, or at the same place.
export function refill(parent, look, built) {
  if (looks.get(parent) === look) return;
  looks.set(parent, look);
  const labelOf = (element) => element.dataset.action ?? element.getAttribute("aria-label") ?? element.textContent;
  const isText = parent.contains(document.activeElement) && isTyping(document.activeElement);
  if (isText) document.activeElement.blur(); // which takes over what has been typed
  const old = [...parent.querySelectorAll(focusable)], at = old.indexOf(document.activeElement), label = at < 0 ? null : labelOf(old[at]);
  parent.replaceChildren(...built());
  if (at < 0) return;
  const next = [...parent.querySelectorAll(focusable)];
  (next.find((element) => labelOf(element) === label) ?? next[Math.min(at, next.length - 1)])?.focus();
}

// Makes elements the children of a parent. Those that are its children already stay where they are if their order allows it,
// because an element that is moved loses the focus.
export function arrange(parent, elements) {
  for (const child of [...parent.children]) if (!elements.includes(child)) child.remove();
  elements.forEach((element, i) => {
    if (parent.children[i] !== element) parent.insertBefore(element, parent.children[i] ?? null);
  });
}

let lastId = 0;
export const newId = (prefix) => `${prefix}-${++lastId}`;

// Whether keys pressed here are typed text.
export const isTyping = (element) =>
  element instanceof HTMLTextAreaElement || element?.isContentEditable ||
  (element instanceof HTMLInputElement && !["checkbox", "range", "button"].includes(element.type));
