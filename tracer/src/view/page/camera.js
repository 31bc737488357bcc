// Rotates, moves and zooms a camera. A camera is an object as in a scene file: the members of a thin lens, or
// {"orthographic": {members}}. Every function returns a new camera. z is up.

const add = (a, b) => a.map((x, i) => x + b[i]);
const sub = (a, b) => a.map((x, i) => x - b[i]);
const times = (a, k) => a.map((x) => x * k);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.sqrt(dot(a, a));
const unit = (a) => times(a, 1 / length(a));

const isOrthographic = (camera) => "orthographic" in camera;

export const membersOf = (camera) => camera.orthographic ?? camera;

const withMembers = (camera, members) =>
  isOrthographic(camera) ? {orthographic: {...camera.orthographic, ...members}} : {...camera, ...members};

// The directions right, up and forward in the picture.
function frame(members) {
  const forward = unit(sub(members.look_at, members.position));
  for (const up of [members.up ?? [0, 0, 1], [0, 1, 0], [1, 0, 0]]) {
    const right = cross(forward, up);
    if (length(right) > 1e-6 * length(up)) return {right: unit(right), up: cross(unit(right), forward), forward};
  }
  throw new Error("the camera's direction is zero");
}

// Rotates a vector around an axis of unit length (Rodrigues' formula).
function turnedAround(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(times(v, c), times(cross(axis, v), s)), times(axis, dot(axis, v) * (1 - c)));
}

// Rotates around a centre: by `right` around the vertical and by `up` around the picture's horizontal, in radians. The
// camera never looks straight up or down, where left and right would swap.
export function orbit(camera, centre, right, up) {
  const members = membersOf(camera);
  const vertical = unit(members.up ?? [0, 0, 1]);
  const {right: horizontal, forward} = frame(members);
  const elevation = Math.asin(Math.max(-1, Math.min(1, -dot(forward, vertical))));
  const most = 89 * Math.PI / 180;
  const turn = Math.max(-most, Math.min(most, elevation + up)) - elevation;
  const around = (p) =>
    add(centre, turnedAround(turnedAround(sub(p, centre), horizontal, -turn), vertical, right));
  return withMembers(camera, {position: around(members.position), look_at: around(members.look_at)});
}

// The height of the picture at a distance, in scene units.
function heightAt(camera, distance) {
  const members = membersOf(camera);
  return isOrthographic(camera) ? members.height : 2 * distance * Math.tan((members.fov ?? 40) * Math.PI / 360);
}

// Moves by fractions of the picture's height, so that points at the distance of the centre follow the pointer.
export function moved(camera, centre, right, up) {
  const members = membersOf(camera);
  const axes = frame(members);
  const distance = Math.max(dot(sub(centre, members.position), axes.forward), 1e-3 * length(sub(members.look_at, members.position)));
  const height = heightAt(camera, distance);
  const by = add(times(axes.right, -right * height), times(axes.up, -up * height));
  return withMembers(camera, {position: add(members.position, by), look_at: add(members.look_at, by)});
}

// How far a plane must move along its normal to follow the pointer, which moved by fractions of the picture's height. A
// plane that faces the camera moves by the pointer's upward motion.
export function planeShift(camera, centre, normal, right, up) {
  const members = membersOf(camera);
  const axes = frame(members);
  const height = heightAt(camera, length(sub(centre, members.position)));
  const along = unit(normal);
  const seen = [dot(along, axes.right), dot(along, axes.up)];
  const square = dot(seen, seen);
  return square < 0.05 ? up * height : height * dot(seen, [right, up]) / square;
}

// Moves towards the centre (factor below 1) or away from it. For a parallel view, changes the visible size instead.
export function zoomed(camera, centre, radius, factor) {
  const members = membersOf(camera);
  if (isOrthographic(camera)) return withMembers(camera, {height: members.height * factor});
  const {forward} = frame(members);
  const distance = Math.max(length(sub(centre, members.position)), 0.01 * radius);
  const by = times(forward, distance * (1 - factor));
  const position = add(members.position, by);
  // Keep the point being examined in front of the camera, and the focus where it is.
  const ahead = Math.max(dot(sub(members.look_at, position), forward), 0.01 * radius);
  const next = {position, look_at: add(position, times(forward, ahead))};
  if (members.focus_distance !== undefined)
    next.focus_distance = Math.max(members.focus_distance - distance * (1 - factor), 0.01 * radius);
  return withMembers(camera, next);
}

export const canProject = (camera) =>
  camera !== null && Array.isArray(membersOf(camera).position) && Array.isArray(membersOf(camera).look_at);

// Where a point of the scene is in the picture, as shares of its width and height from the upper left, how high the
// picture is at that depth in scene units, and the picture's directions; null behind the camera.
export function projected(camera, aspect, p) {
  const members = membersOf(camera), axes = frame(members), seen = sub(p, members.position);
  const depth = dot(seen, axes.forward);
  if (!isOrthographic(camera) && depth <= 1e-6) return null;
  const height = heightAt(camera, depth);
  return {x: 0.5 + dot(seen, axes.right) / (height * aspect), y: 0.5 - dot(seen, axes.up) / height, height, axes};
}

// The camera that looks at a ball from the same direction.
export function framed(camera, centre, radius) {
  const members = membersOf(camera), axes = frame(members);
  const distance = isOrthographic(camera) ? length(sub(members.look_at, members.position))
    : 1.6 * radius / Math.tan((members.fov ?? 40) * Math.PI / 360);
  const next = {position: sub(centre, times(axes.forward, distance)), look_at: centre};
  return withMembers(camera, isOrthographic(camera) ? {...next, height: 3.2 * radius} : next);
}
