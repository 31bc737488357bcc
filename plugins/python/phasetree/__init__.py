"""Multiphase signed distance fields: objects of several materials, traced from phase to phase.

    import phasetree as pt

    glass, water = pt.phase("glass", pt.clear(ior=1.5)), pt.phase("water", pt.clear(ior=1.33))
    bottle = pt.sphere(1).smooth(0.4) | pt.capsule((0, 0, 0), (0, 0, 1.5), 0.3)
    filled = bottle.thin_shell(glass, water, half_thickness=0.03)
    filled = filled.intersect_shape(pt.plane(offset=0.2), phases=water)
    print(filled.label([(0, 0, 0), (0, 0, 1)]))

Fields (sphere, box, union …) are signed distances; objects of several phases are made of them. There is one function
for each kind of node and material; textures, lights, meshes and cameras have modules of their own. All are generated
from the lists of nodes and scene parts that the reader of scene files uses. A formula in x, y, z = pt.coordinates() can
also be used as a field:
glass(pt.sqrt(x**2 + y**2) - 1).
"""

from phasetree import _formula, _parts, _phasetree, _trees
from phasetree._errors import Error, Interrupted, SceneError
from phasetree._formula import Expression, coordinates
from phasetree._parts import cameras, lights, materials, meshes, numbers, phase_functions, textures
from phasetree._phases import Phase, phase, vacuum
from phasetree._placed import Instances, instances_of
from phasetree._scene import Image, Scene, load
from phasetree._solve import Solution, solve
from phasetree._trees import Closest, Crossings, Field, Hits, Measures, NextCrossings, Object, PhaseMesh, Proof
from phasetree._view import View, view

__version__ = _phasetree.version
# The version and a hash of the sources, as in the first line of `phasetree --version`.
build_id = _phasetree.build_id

# The functions that are made from the lists: of nodes, of materials, of the image, and the usual camera.
nodes = dict(_trees.functions)
globals().update(nodes)
globals().update(vars(materials))
globals().update(_formula.functions)
image = _parts.image
normal_map = _parts.normal_map
voxels = _parts.voxels
camera = cameras.thin_lens

__all__ = [
    "Closest", "Crossings", "Error", "Expression", "Field", "Hits", "Image", "Instances", "Interrupted", "Measures", "NextCrossings", "Object", "Phase", "PhaseMesh", "Proof", "Scene", "SceneError", "Solution", "View",
    "build_id", "camera", "cameras", "coordinates", "image", "instances_of", "lights", "load", "materials", "meshes", "normal_map", "numbers", "phase", "phase_functions", "solve", "textures", "vacuum", "view", "voxels",
]  # fmt: skip
# Not among them are those that Python has under the same name.
__all__ += [name for name in _formula.functions if name not in ("abs", "max", "min")]
__all__ += [name for name in (*nodes, *vars(materials)) if name not in ("set",) and not name.startswith("_")]
