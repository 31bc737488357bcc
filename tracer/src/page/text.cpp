#include "page/text.hpp"

namespace phasetree::tracer::page {

const char* const head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>)";

const char* const body = R"(</title>
<style>
html, body { margin: 0; height: 100%; overflow: hidden; background: #c8ccd0; font: 14px/1.5 system-ui, sans-serif; color: #222 }
canvas { width: 100%; height: 100%; display: block; touch-action: none; outline: none }
#panel { position: absolute; top: 12px; left: 12px; background: #fffd; border-radius: 6px; padding: 8px 12px; max-height: 85%; overflow: auto }
#title { cursor: pointer; font-weight: bold }
#panel label { display: block; white-space: nowrap }
#panel i { display: inline-block; width: 10px; height: 10px; border-radius: 5px; margin: 0 6px; border: 1px solid #8888 }
#message { position: absolute; inset: 0; display: flex; align-items: center; justify-content: center; padding: 2em; white-space: pre-wrap; pointer-events: none }
</style></head><body>
<canvas id="view" tabindex="0" aria-label="the object; drag to rotate it"></canvas>
<details id="panel" open><summary id="title"></summary><div id="phases"></div>
<label>Cut <select id="axis"><option value="">nothing</option><option value="0">across x</option><option value="1">across y</option><option value="2">across z</option></select>
<input type="checkbox" id="flip" title="flip the side" aria-label="flip the side that is cut away"></label>
<input type="range" id="place" min="0" max="1" step="0.002" value="0.5" style="width:100%" aria-label="position of the cut"></details>
<div id="message">Loading …</div>
<script>
"use strict";
)";

const char* const script = R"JS(
const opened = performance.now(), $ = id => document.getElementById(id), canvas = $("view");
const state = window.phasetree = {ready: false, error: null, compiled: 0, opened: 0, frame: 0, scale: 1, at_rest: 0, passes: 0, most_passes: 16};
function fail(text) { state.error = text; $("message").textContent = text; $("message").style.background = "#fffe"; }

async function bytes(text) {
  const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function open() {
  $("title").textContent = document.title;
  $("panel").open = innerWidth >= 600;  // On a phone it would cover the object.
  const gl = canvas.getContext("webgl2", {antialias: false, powerPreference: "high-performance"});
  if (!gl) return fail("This page needs WebGL 2, which this browser lacks or has turned off.");
  if (!window.DecompressionStream) return fail("This browser is too old for this page: it lacks DecompressionStream.");
  const text = new TextDecoder().decode(await bytes(data.shader)), numbers = new Float32Array((await bytes(data.numbers)).buffer);
  function program(fragment) {
    const p = gl.createProgram(), parts = [];
    for (const [kind, source] of [[gl.VERTEX_SHADER, "#version 300 es\nvoid main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }"], [gl.FRAGMENT_SHADER, fragment]]) {
      const s = gl.createShader(kind);
      gl.shaderSource(s, source);
      gl.compileShader(s);
      gl.attachShader(p, s);
      parts.push(s);
    }
    gl.linkProgram(p);
    return {p, parts};
  }
  const parallel = gl.getExtension("KHR_parallel_shader_compile");
  const main = program(text);
  const copy = program("#version 300 es\nprecision highp float;\nuniform sampler2D image;\nuniform vec2 image_size;\nuniform float weight;\nout vec4 result;\nvoid main() { result = vec4(texture(image, gl_FragCoord.xy / image_size).rgb, weight); }");
  if (parallel) while (!gl.getProgramParameter(main.p, parallel.COMPLETION_STATUS_KHR) && !gl.isContextLost()) await new Promise(r => setTimeout(r, 20));
  for (const {p, parts} of [main, copy])
    if (!gl.getProgramParameter(p, gl.LINK_STATUS))
      return fail("The shader of this object does not compile on this machine:\n\n" + (gl.getProgramInfoLog(p) || "") + parts.map(s => gl.getShaderInfoLog(s) || "").join("\n").slice(0, 2000));
  state.compiled = performance.now() - opened;
  canvas.addEventListener("webglcontextlost", () => fail("The graphics driver stopped drawing this page. Reload it to try again."));
  gl.bindVertexArray(gl.createVertexArray());
  function texture(unit, filter) {
    const t = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, t);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return t;
  }
  texture(0, gl.NEAREST);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 1024, numbers.length / 4096, 0, gl.RGBA, gl.FLOAT, numbers);
  // Low: drawn while the camera moves. Full: one pass at full size. Sum: the mean of the passes.
  const has_floats = gl.getExtension("EXT_color_buffer_float");
  const targets = [1, 2, 3].map(unit => ({unit, t: texture(unit, gl.LINEAR), f: gl.createFramebuffer(), w: 0, h: 0}));
  function sized(target, w, h, floats) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.f);
    gl.viewport(0, 0, w, h);
    if (target.w === w && target.h === h) return;
    gl.activeTexture(gl.TEXTURE0 + target.unit);
    gl.texImage2D(gl.TEXTURE_2D, 0, floats ? gl.RGBA16F : gl.RGBA8, w, h, 0, gl.RGBA, floats ? gl.HALF_FLOAT : gl.UNSIGNED_BYTE, null);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target.t, 0);
    target.w = w; target.h = h;
  }
  const uniform = (p, name) => gl.getUniformLocation(p, name);
  const v = {target: [...data.look_at], away: 1, turn: 0, tilt: 0}, hidden = new Set();
  function reset() {
    const d = data.position.map((x, i) => x - data.look_at[i]);
    v.target = [...data.look_at]; v.away = Math.hypot(...d);
    v.turn = Math.atan2(d[1], d[0]); v.tilt = Math.asin(d[2] / v.away);
  }
  reset();
  function set_uniforms(w, h, jitter) {
    const u = name => uniform(main.p, name), c = Math.cos(v.tilt), s = Math.sin(v.tilt), tan = Math.tan(data.fov * Math.PI / 360);
    const back = [c * Math.cos(v.turn), c * Math.sin(v.turn), s], right = [-Math.sin(v.turn), Math.cos(v.turn), 0];
    const up = [-s * Math.cos(v.turn), -s * Math.sin(v.turn), c];
    gl.useProgram(main.p);
    gl.uniform1i(u("phasetree_numbers"), 0);
    gl.uniform3fv(u("eye"), back.map((x, i) => v.target[i] + v.away * x));
    gl.uniform3fv(u("forward"), back.map(x => -x));
    gl.uniform3fv(u("right"), right.map(x => tan * x));
    gl.uniform3fv(u("up"), up.map(x => tan * x));
    const lamp = [-0.45 * back[0] * 0 - 0.4, -0.35, 0.8], size = Math.hypot(...lamp);
    gl.uniform3fv(u("lamp"), lamp.map(x => x / size));
    gl.uniform2f(u("image_size"), w, h);
    gl.uniform2fv(u("jitter"), jitter);
    gl.uniform1f(u("floor_height"), data.floor);
    gl.uniform1f(u("object_size"), 0.5 * Math.hypot(...data.high.map((x, i) => x - data.low[i])));
    gl.uniform3fv(u("object_centre"), data.high.map((x, i) => 0.5 * (x + data.low[i])));
    gl.uniform4fv(u("looks"), data.looks);
    const bits = [0, 0];
    for (const i of hidden) bits[i >> 5] |= 1 << (i & 31);
    gl.uniform2ui(u("page_hidden"), bits[0] >>> 0, bits[1] >>> 0);
    const cut = [0, 0, 0, 0], axis = $("axis").value;
    if (axis !== "") {
      const sign = $("flip").checked ? -1 : 1;
      cut[+axis] = sign;
      cut[3] = sign * (data.low[axis] + $("place").value * (data.high[axis] - data.low[axis]));
    }
    gl.uniform4fv(u("cut"), cut);
  }
  function show(target, w, h, weight, to) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, to);
    gl.viewport(0, 0, w, h);
    gl.useProgram(copy.p);
    gl.uniform1i(uniform(copy.p, "image"), target.unit);
    gl.uniform2f(uniform(copy.p, "image_size"), w, h);
    gl.uniform1f(uniform(copy.p, "weight"), weight);
    if (weight < 1) { gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA); }
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.BLEND);
  }
  // Draws rows of an image and returns how long that took, in milliseconds.
  const pixel = new Uint8Array(4);
  function draw(target, w, h, from, to, jitter) {
    const start = performance.now();
    sized(target, w, h, false);
    set_uniforms(w, h, jitter);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, from, w, to - from);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.SCISSOR_TEST);
    gl.readPixels(0, from, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return performance.now() - start;
  }
  const [low, full, sum] = targets, wanted = 40;  // milliseconds per frame
  // The first picture is small, so that it appears immediately even if a pixel takes long. While the view moves, a
  // picture has as many pixels as the time per frame allows. At rest, it is drawn repeatedly at twice the last scale,
  // and then in passes.
  const smallest = 0.02;
  let moved = performance.now(), is_dirty = true, row = 0, rows = 16, scale = smallest, rest = 0;
  const touch = () => { moved = performance.now(); is_dirty = true; row = rest = 0; state.passes = 0; };
  function frame() {
    requestAnimationFrame(frame);
    if (state.error) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const w = Math.max(1, Math.round(canvas.clientWidth * ratio)), h = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; touch(); }
    const scaled = s => [w, h].map(x => Math.min(x, Math.max(16, Math.round(x * s))));
    if (is_dirty) {
      const [lw, lh] = scaled(scale), took = draw(low, lw, lh, 0, lh, [0, 0]);
      state.frame = took;
      state.scale = state.at_rest = scale;
      // Limits the change of scale.
      scale = Math.min(1, Math.max(smallest, scale * Math.min(1.5, Math.max(0.5, Math.sqrt(wanted / Math.max(took, 1))))));
      show(low, w, h, 1, null);
      is_dirty = false;
      if (!state.ready) { state.ready = true; state.opened = performance.now() - opened; $("message").textContent = ""; }
      return;
    }
    if (performance.now() - moved < 150 || state.passes >= (has_floats ? state.most_passes : 1)) return;
    if (rest === 0) rest = Math.min(1, 2 * state.scale);
    // Draws in bands, so that the page stays responsive. Each pass at full size is shifted by a fraction of a pixel.
    const k = state.passes, jitter = k ? [(k * 0.7548776662) % 1 - 0.5, (k * 0.5698402910) % 1 - 0.5] : [0, 0];
    const [rw, rh] = scaled(rest), to = Math.min(rh, row + rows), took = draw(full, rw, rh, row, to, jitter);
    rows = Math.round(Math.min(h, Math.max(1, rows * Math.min(2, Math.max(0.5, wanted / Math.max(took, 1))))));
    row = to;
    if (row < rh) return;
    row = 0;
    state.at_rest = rest;
    if (rest < 1) {
      rows = Math.max(1, rows >> 1);
      rest = Math.min(1, 2 * rest);
      return show(full, w, h, 1, null);
    }
    state.passes = k + 1;
    if (!has_floats) return show(full, w, h, 1, null);
    sized(sum, w, h, true);
    show(full, w, h, 1 / (k + 1), sum.f);
    show(sum, w, h, 1, null);
  }

  const fingers = new Map();
  const limits = () => { v.tilt = Math.max(-1.5, Math.min(1.5, v.tilt)); touch(); };
  const slide = (dx, dy) => {
    const k = 2 * v.away * Math.tan(data.fov * Math.PI / 360) / canvas.clientHeight, s = Math.sin(v.tilt), c = Math.cos(v.tilt);
    const right = [-Math.sin(v.turn), Math.cos(v.turn), 0], up = [-s * Math.cos(v.turn), -s * Math.sin(v.turn), c];
    v.target = v.target.map((x, i) => x + k * (dy * up[i] - dx * right[i]));
    touch();
  };
  canvas.addEventListener("pointerdown", e => { canvas.setPointerCapture(e.pointerId); fingers.set(e.pointerId, e); canvas.focus(); });
  for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, e => fingers.delete(e.pointerId));
  canvas.addEventListener("pointermove", e => {
    const before = fingers.get(e.pointerId);
    if (!before) return;
    const dx = e.clientX - before.clientX, dy = e.clientY - before.clientY;
    if (fingers.size === 2) {
      const other = [...fingers.values()].find(f => f.pointerId !== e.pointerId);
      const span = f => Math.hypot(f.clientX - other.clientX, f.clientY - other.clientY);
      v.away *= span(before) / Math.max(span(e), 1);
      slide(dx / 2, dy / 2);
    } else if (e.shiftKey || e.buttons & 6) slide(dx, dy);
    else { v.turn -= 0.008 * dx; v.tilt += 0.008 * dy; limits(); }
    fingers.set(e.pointerId, e);
  });
  canvas.addEventListener("wheel", e => { e.preventDefault(); v.away *= Math.exp(0.001 * e.deltaY); touch(); }, {passive: false});
  canvas.addEventListener("contextmenu", e => e.preventDefault());
  canvas.addEventListener("keydown", e => {
    const step = {ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]}[e.key];
    if (step) { v.turn += step[0]; v.tilt += step[1]; limits(); }
    else if (e.key === "+" || e.key === "=") { v.away *= 0.9; touch(); }
    else if (e.key === "-") { v.away /= 0.9; touch(); }
    else if (e.key === "0" || e.key === "Home") { reset(); touch(); }
    else return;
    e.preventDefault();
  });
  data.names.forEach((name, i) => {
    if (i === 0) return;
    const label = document.createElement("label"), box = document.createElement("input"), dot = document.createElement("i");
    box.type = "checkbox"; box.checked = true;
    box.addEventListener("change", () => { box.checked ? hidden.delete(i) : hidden.add(i); touch(); });
    dot.style.background = data.colors[i];
    label.append(box, dot, name);
    $("phases").append(label);
  });
  for (const id of ["axis", "flip", "place"]) $(id).addEventListener("input", touch);
  state.view = v;
  state.touch = touch;
  requestAnimationFrame(frame);
}
open().catch(e => fail("This page cannot be opened: " + e.message));
</script></body></html>
)JS";

}  // namespace phasetree::tracer::page
