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

let lastId = 0;
export const newId = (prefix) => `${prefix}-${++lastId}`;

// Whether keys pressed here are typed text.
export const isTyping = (element) =>
  element instanceof HTMLTextAreaElement || element?.isContentEditable ||
  (element instanceof HTMLInputElement && !["checkbox", "range", "button"].includes(element.type));
