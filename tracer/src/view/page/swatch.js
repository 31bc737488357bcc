// Small patches in the colours of phases. Those that light travels through are drawn as drops, with a light rim.
import {hexOf} from "./colour.js";
import {make} from "./dom.js";

let colours = new Map(); // by name of the phase: {hex, isClear, isHidden}

// `phases` are those of the state that the server sends.
export function setPhases(phases) {
  colours = new Map(phases.map((phase) => [phase.name, {
    hex: hexOf(phase.color ?? (phase.kind === "clear" ? [0.75, 0.87, 0.95] : [0.5, 0.5, 0.5])),
    isClear: phase.kind === "clear",
    isHidden: Boolean(phase.hidden),
  }]));
}

// Whether a phase is left out of the picture.
export const isHidden = (phase) => colours.get(phase)?.isHidden ?? false;

// A string that changes whenever the swatch must look different.
export const lookOf = (phase) => JSON.stringify([phase, colours.get(phase)]);

export function swatchOf(phase) {
  const colour = colours.get(phase) ?? {hex: "#808080", isClear: false};
  const swatch = make("span", {class: colour.isClear ? "swatch clear" : "swatch", title: phase, "aria-hidden": "true"});
  swatch.style.setProperty("--swatch", colour.hex);
  return swatch;
}

// A small ball that looks like a material of recipes.js.
export function ballOf({look, colour}) {
  const ball = make("span", {class: `ball ${look}`, "aria-hidden": "true"});
  ball.style.setProperty("--swatch", colour);
  return ball;
}
