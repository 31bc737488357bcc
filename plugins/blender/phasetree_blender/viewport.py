"""The rendered viewport: a thread that renders what a viewport shows, and starts again when that changes."""

import math
import os
import tempfile
import threading

import numpy as np

from . import exr
from .command import Cancelled, RenderProcess
from .notes import Notes, TranslationError
from .translate.scene import complete, write_document

# Passes of increasing quality: the share of the resolution, and whether to stop after one sample per pixel.
PASSES = ((0.25, True), (1.0, False))
SECONDS_BETWEEN_PICTURES = 1


def camera_of_view(view_matrix, window_matrix):
    """The scene file's camera for the matrices of a viewport: from the world, and onto the region."""
    placed = view_matrix.inverted()
    position, forward, up, right = (placed.translation, -placed.col[2].xyz.normalized(), placed.col[1].xyz.normalized(),
                                    placed.col[0].xyz.normalized())  # fmt: skip
    scale_x, scale_y = window_matrix[0][0], window_matrix[1][1]
    if window_matrix[3][3] == 0:  # perspective
        lens = {"position": list(position), "look_at": list(position + forward), "up": list(up),
                "fov": math.degrees(2 * math.atan(1 / scale_y))}  # fmt: skip
        shift = [window_matrix[0][2] / scale_x * scale_y / 2, window_matrix[1][2] / 2]
        return {"tilt_shift": {**lens, "shift": shift}} if any(abs(s) > 1e-6 for s in shift) else {"thin_lens": lens}
    position = position - right * (window_matrix[0][3] / scale_x) - up * (window_matrix[1][3] / scale_y)
    # Parallel rays of a viewport also show what is behind its centre.
    position = position - forward * (1 / abs(window_matrix[2][2]) if window_matrix[2][2] else 0)
    seen = {"position": list(position), "look_at": list(position + forward), "up": list(up)}
    return {"orthographic": {**seen, "height": 2 / scale_y}}


class Viewport:
    """Renders in a thread until close(). `redraw` is called, in that thread, when `picture` or `status` changes."""

    def __init__(self, command, redraw):
        self._command, self._redraw = command, redraw
        self._changed = threading.Condition()
        self._translation = self._view = self._document = None
        self._version, self._is_closed = 0, False
        self.picture, self.status = None, ""
        self._folder = tempfile.TemporaryDirectory(prefix="phasetree_", ignore_cleanup_errors=True)
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def path(self):
        """Where the scene file of the next translation belongs, in a folder of its own."""
        return os.path.join(tempfile.mkdtemp(dir=self._folder.name), "scene.json")

    def show(self, translation=None, view=None):
        """Starts again with another scene or another view: (camera, width, height)."""
        with self._changed:
            if translation is not None:
                if self._translation is not None and self._translation.digest == translation.digest:
                    return  # something changed that phasetree ignores, such as the selection
                self._translation, self._document = translation, None
            if view is not None:
                self._view = view
            self._version += 1
            self._changed.notify_all()

    def close(self):
        with self._changed:
            self._is_closed = True
            self._version += 1
            self._changed.notify_all()
        self._thread.join(10)
        self._folder.cleanup()

    def _tell(self, status):
        self.status = status
        self._redraw()

    def _run(self):
        done = 0
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._version != done and (self._is_closed or (self._translation and self._view)))
                if self._is_closed:
                    return
                done, translation, document, view = self._version, self._translation, self._document, self._view
            try:
                if document is None:
                    self._tell("preparing the scene")
                    document = complete(translation, self._command, Notes(), lambda: self._version != done).document
                    with self._changed:
                        if self._translation is translation:
                            self._document = document
                self._render(document, translation.path, view, done)
            except Cancelled:
                pass
            except (TranslationError, OSError, ValueError) as error:
                self._tell(str(error))

    def _render(self, document, path, view, version):
        """Renders until another version is to be shown."""
        camera, width, height = view
        folder = os.path.dirname(path)
        for share, is_first in PASSES:
            settings = {**document["render"], "width": max(1, int(width * share)), "height": max(1, int(height * share))}
            write_document({**document, "camera": camera, "render": settings}, path)
            options = ["--cells", os.path.join(folder, "cells"), "--build-quality", "low", *(["--spp", "1"] if is_first else [])]
            process = RenderProcess(self._command, path, folder, options, 0 if is_first else SECONDS_BETWEEN_PICTURES)
            try:
                while not process.wait(0.05):
                    if self._version != version:
                        raise Cancelled
                    preview = process.preview()
                    if preview:
                        self._take(preview, f"{process.stage} {process.share:.0%}")
                process.finish()
            finally:
                process.stop()
            self._take(process.picture, "" if not is_first else "rendering")

    def _take(self, file, status):
        channels = exr.read(file)
        rows = [channels[c] for c in "RGB"] + [np.ones_like(channels["R"])]
        self.picture = np.ascontiguousarray(np.stack(rows, axis=-1)[::-1], dtype=np.float32)
        self._tell(status)
