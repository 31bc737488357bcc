"""The live view: a page, served on this machine, that shows a scene and its changes."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
import webbrowser
import weakref

import numpy as np

from phasetree import _parts, _phasetree
from phasetree._errors import Error
from phasetree._phases import Phase
from phasetree._scene import Scene, load
from phasetree._trees import Object

# A palette that colour-blind people can distinguish (Okabe and Ito, "Color Universal Design", 2008), as linear values.
_COLOURS = ("#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7")


def _with_materials(object):
    """The same object, with a plain diffuse material for each phase that has none."""
    phases = [
        p if p.material else Phase(p.name, _parts.materials.diffuse(_COLOURS[i % len(_COLOURS)]), p.density)
        for i, p in enumerate(object.phases[1:])
    ]
    return Object(object._handle, (object.phases[0], *phases))


def _as_scene(what):
    """Completes a scene or an object for the view, with a camera in front and a plain sky if they are missing."""
    if isinstance(what, Scene):
        if what.object is not None:
            what = what.with_(object=_with_materials(what.object))
        elif what.objects:
            what = what.with_(objects={n: (_with_materials(o), m) for n, (o, m) in what.objects.items()},
                              groups=what.groups, instances=what.instances)  # fmt: skip
    elif isinstance(what, Object):
        what = Scene(_with_materials(what))
    else:
        raise Error(f"the view shows an object of phases or a scene, not {what!r}")
    if what.camera is None and what.object is None:
        raise Error("a scene of several objects, or of meshes alone, needs a camera to be viewed")
    if what.camera is None:
        low, high = np.array(what.object.bounds, dtype=float)
        if not (np.all(np.isfinite(low)) and np.all(low < high)):
            raise Error("the object is unbounded, so the view cannot place a camera; pass a scene with a camera")
        middle, radius = (low + high) / 2, np.linalg.norm(high - low) / 2
        position = middle + 3.2 * radius * np.array([0.35, -0.87, 0.35])
        what = what.with_(camera=_parts.cameras.thin_lens(tuple(position), tuple(middle), fov=40))
    if not what.lights:
        sky = _parts.lights.gradient(zenith=(1, 1, 1), horizon=(0.75, 0.75, 0.75), ground=(0.25, 0.25, 0.25))
        what = what.with_(lights=sky)
    return what


class View:
    """A live view, served until close() is called or the program ends.

    url: the address of the page; anyone on this machine who knows it can see the page. file: the scene file, which the
    page edits.
    """

    def __init__(self, what, width=None, samples=None, threads=0, port=0):
        folder = tempfile.mkdtemp(prefix="phasetree-view-")
        try:
            self.file = os.path.join(folder, "scene.json")
            self.show(what)
            served = _phasetree.View(self.file, width, samples, threads, port)
        except BaseException:
            shutil.rmtree(folder)
            raise
        self.url = served.url
        # Runs when the view is garbage-collected or the program exits.
        self._end = weakref.finalize(self, View._ended, served, folder)

    @staticmethod
    def _ended(served, folder):
        served.close()
        shutil.rmtree(folder, ignore_errors=True)

    def show(self, what):
        """Shows another object or scene on the same page.

        The camera stays as the user turned it, unless the camera of the new scene differs from that of the last one.
        """
        _as_scene(what).save(self.file)

    def scene(self):
        """The scene with the changes made in the page, except those of the tab View.

        An object that was shown without a scene has a sky, a camera and plain colours; `scene().object` is the object.
        Raises SceneError if the text typed in the page has an error, and Error after close().
        """
        if not self._end.alive:
            raise Error("the view is closed, and its scene is gone; call scene() before close()")
        return load(self.file)

    def close(self):
        """Ends the view. The page then shows that it has lost the connection."""
        self._end()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __reduce__(self):
        raise TypeError(
            "a View can be neither copied nor pickled, because its page is served by this process; call pt.view where it "
            "is needed"
        )

    def _repr_html_(self):
        return f'<iframe src="{self.url}" width="100%" height="640" style="border: 0"></iframe><a href="{self.url}">{self.url}</a>'

    def __repr__(self):
        return f"<View at {self.url}>" if self._end.alive else "<View, closed>"


def view(what, *, width=None, samples=None, threads=0, port=0, open=None):
    """Shows an object or a scene in the browser, where it can be turned, cut and edited. Returns a View.

    An object without a scene is shown under a plain sky, and phases without a material get a plain colour. width: of
    the picture, in pixels. samples: final number per pixel. port: on 127.0.0.1; 0 for any free port. open: whether to
    open the page in the browser; by default True, except in notebooks, which embed the page. Raises
    pt.Error if it cannot be shown, and RuntimeError if the port is unavailable.
    """
    made = View(what, width, samples, threads, port)
    if "ipykernel" not in sys.modules if open is None else open:
        webbrowser.open(made.url)
    return made
