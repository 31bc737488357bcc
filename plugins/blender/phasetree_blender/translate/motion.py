"""Motion while the shutter is open: places of objects, and the camera, at several times."""

import math
from dataclasses import dataclass, field

import numpy as np

from ..notes import Notes

EPSILON = 1e-6  # relative: smaller changes are none


@dataclass
class Motion:
    """What moves. Times are in seconds from that of the picture."""

    times: list = field(default_factory=list)
    places: list = field(default_factory=list)  # for each time {key of an instance: 4×4 array}
    cameras: list = field(default_factory=list)  # for each time the scene file's camera
    vertices: list = field(default_factory=list)  # for each time {key of an instance: digest of the evaluated mesh}

    def shutter(self):
        return [self.times[0], self.times[-1]]

    def of(self, instance):
        """The places of an instance at all times, or None if it stands still or is not always there."""
        if not self.times:
            return None
        key = key_of(instance)
        found = [places.get(key) for places in self.places]
        if any(place is None for place in found) or all(is_close(place, found[0]) for place in found):
            return None
        return found

    def deforms(self, instance):
        key = key_of(instance)
        return len({vertices[key] for vertices in self.vertices if key in vertices}) > 1

    def camera(self, still, notes):
        """The camera with keys, or the still one."""
        kinds = {(kind, tuple(parameters)) for camera in self.cameras for kind, parameters in camera.items()}
        if not self.times or all(camera == still for camera in self.cameras):
            return still
        if len(kinds) > 1:
            notes.unsupported("the camera stands still, because its kind changes while the shutter is open")
            return still
        ((kind, parameters),) = still.items()
        moving = {}
        for name, value in parameters.items():
            values = [camera[kind][name] for camera in self.cameras]
            is_still = isinstance(value, int) or all(is_close(np.array(v), np.array(values[0])) for v in values)
            moving[name] = value if is_still else {"keys": [[t, v] for t, v in zip(self.times, values)]}
        return {kind: moving}


def key_of(instance):
    """Identifies an instance at all times."""
    parent = instance.parent.original.as_pointer() if instance.is_instance and instance.parent else 0
    return instance.object.original.as_pointer(), parent, tuple(instance.persistent_id) if instance.is_instance else ()


def is_close(a, b):
    return np.abs(a - b).max() <= EPSILON * max(1.0, np.abs(b).max())


def may_deform(item):
    return item.type in ("MESH", "CURVE", "FONT", "SURFACE", "META") and (
        len(item.modifiers) > 0 or getattr(item.original.data, "shape_keys", None) is not None
    )


def moves(item):
    """Whether Blender blurs an object's motion. Cycles has the setting."""
    return getattr(getattr(item.original, "cycles", None), "use_motion_blur", True)


def shutter_of(scene):
    """The times in frames, from that of the picture, between which the shutter is open."""
    length = scene.render.motion_blur_shutter
    owner = scene.render if hasattr(scene.render, "motion_blur_position") else scene.phasetree  # Blender's from 4.2 on
    opens = {"START": 0.0, "CENTER": -length / 2, "END": -length}[owner.motion_blur_position]
    return opens, opens + length


def sampled(scene, evaluated, set_time, camera_at):
    """The motion of a scene. `evaluated()`: its dependency graph, which `set_time(frame, subframe)` moves in time;
    `camera_at(depsgraph, notes)`: the scene file's camera."""
    motion = Motion()
    opens, closes = shutter_of(scene)
    if not scene.render.use_motion_blur or closes <= opens:
        return motion
    now, per_second = scene.frame_current + scene.frame_subframe, scene.render.fps / scene.render.fps_base
    steps = max(scene.phasetree.motion_steps, 2)
    try:
        for step in range(steps):
            offset = opens + (closes - opens) * step / (steps - 1)
            frame = math.floor(now + offset)
            set_time(frame, now + offset - frame)
            depsgraph = evaluated()
            motion.times.append(offset / per_second)
            motion.cameras.append(camera_at(depsgraph, Notes()))
            places, vertices = {}, {}
            for instance in depsgraph.object_instances:
                if not instance.show_self or not moves(instance.object):
                    continue
                places[key_of(instance)] = np.array(instance.matrix_world, dtype=float)
                if may_deform(instance.object) and not instance.is_instance:
                    vertices[key_of(instance)] = digest_of(instance.object)
            motion.places.append(places)
            motion.vertices.append(vertices)
    finally:
        set_time(math.floor(now), now - math.floor(now))
    return motion


def digest_of(item):
    mesh = item.to_mesh()
    if mesh is None:
        return None
    points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    item.to_mesh_clear()
    return hash(np.round(points, 5).tobytes())
