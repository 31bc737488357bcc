// A picture of what the operators between phases do where two objects overlap. It stands where one of them is chosen: in
// the palette, and in the inspector of an operator.
import {make, makeSvg} from "./dom.js";

const radius = 15, height = 22, left = 24, right = 40, middle = 32, coat = 5;

const disc = (x, look) => makeSvg("circle", {cx: x, cy: height, r: radius, class: look});
const coated = (x) => makeSvg("circle", {cx: x, cy: height, r: radius + coat, class: "coat"});
// The part of a disc on its side of the middle.
const half = (x, look) => {
  const edge = Math.sqrt(radius ** 2 - (middle - x) ** 2), isFirst = x < middle;
  return makeSvg("path", {d: `M${middle} ${height - edge} A${radius} ${radius} 0 1 ${isFirst ? 0 : 1} ${middle} ${height + edge} Z`, class: look});
};
const number = (x, text) => {
  const label = makeSvg("text", {x, y: height + 4});
  label.textContent = text;
  return label;
};

const operators = [
  {kind: "over", says: "1 stays whole, and 2 gives way.", parts: () => [disc(right, "second"), disc(left, "first")]},
  {kind: "under", says: "2 stays whole, and 1 gives way.", parts: () => [disc(left, "first"), disc(right, "second")]},
  {kind: "contact", says: "Both give way, and share a face.", parts: () => [half(left, "first"), half(right, "second")]},
  {kind: "layered", says: "A layer of another phase coats them.", parts: () => [coated(left), coated(right), disc(left, "first"), disc(right, "second")]},
];

export const isCombining = ({kind, type}) => type === "object" && operators.some((operator) => operator.kind === kind);

// `present` is the kind that is chosen already, or null. `choose(kind)` is called for one of `choices` that is pressed;
// the others are only explained.
export function combiningFigure(present, choices, choose) {
  const panels = operators.map(({kind, says, parts}) => {
    const content = [makeSvg("svg", {viewBox: "0 0 64 44", "aria-hidden": "true"}, ...parts(), number(left - 6, "1"), number(right + 6, "2")),
      make("b", {}, kind), make("span", {class: "faint"}, says)];
    if (!choices.includes(kind)) return make("div", {class: `operator${kind === present ? " present" : ""}`, "data-operator": kind}, ...content);
    return make("button", {type: "button", class: "operator", "data-operator": kind, "aria-pressed": present === null ? undefined : String(kind === present), onclick: () => choose(kind)}, ...content);
  });
  return make("figure", {class: "combining", "aria-label": "Where two objects overlap"}, make("figcaption", {class: "faint"}, "Where objects overlap, in the order of their list:"),
    make("div", {class: "operators"}, panels));
}
