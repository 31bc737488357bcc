"""The render engine: translates the scene, and renders it in a child process."""

import os
import tempfile
import traceback

import bpy
import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d

from . import cryptomatte, exr, last_report, preferences
from .command import Cancelled, RenderProcess, UnusableCheckpoint
from .notes import Kind, Notes, TranslationError
from .passes import passes_of
from .translate.scene import options_of, region_of, translate, write_scene
from .viewport import Viewport, camera_of_view


class PhasetreeRenderEngine(bpy.types.RenderEngine):
    bl_idname = "PHASETREE"
    bl_label = "phasetree"
    bl_use_preview = False
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False

    _meanings = {}  # of the scene that is rendered: for Cryptomatte
    # If set, a render writes this scene file instead of rendering. Export runs as a render because Blender evaluates objects
    # with render settings only during one.
    export_path = ""

    def update_render_passes(self, scene=None, renderlayer=None):
        for made in passes_of(renderlayer):
            self.register_pass(scene, renderlayer, made.name, len(made.channels), made.ids, made.kind)

    def render(self, depsgraph):
        notes, phases = Notes(), ""
        with tempfile.TemporaryDirectory(prefix="phasetree_", ignore_cleanup_errors=True) as folder:
            try:
                phases = self._render(depsgraph, folder, notes)
            except Cancelled:
                notes.information("the render was cancelled")
            except TranslationError as error:
                notes.error(str(error))
            except Exception as error:  # report bugs of this add-on instead of failing silently
                traceback.print_exc()
                notes.error(f"internal error of the add-on: {error!r}; the console has details")
        last_report.keep(depsgraph.scene.name, notes, phases)
        self._tell(notes)

    def _render(self, depsgraph, folder, notes):
        """Renders one view layer. Returns the report on its phases."""
        command, scene = preferences.found_command(), depsgraph.scene
        self.update_stats("", "translating the scene")
        path = self.export_path or os.path.join(folder, "scene.json")
        written = write_scene(depsgraph, path, command, notes, self.camera_override, self._is_cancelled, self._set_time)
        self._meanings = written.meanings
        if self.export_path:
            return written.report
        options = options_of(scene, depsgraph.view_layer)
        interval, kept = 0 if self.is_animation else scene.phasetree.update_interval, checkpoint_of(depsgraph)
        try:
            process = RenderProcess(command, path, folder, options, interval, kept)
            self._wait_for(process, depsgraph, notes)
        except UnusableCheckpoint:
            notes.information("the render started again, because the scene or its settings changed since the checkpoint")
            os.remove(kept)
            process = RenderProcess(command, path, folder, options, interval, kept)
            self._wait_for(process, depsgraph, notes)
        self._show(depsgraph, process.picture, is_last=True)
        return written.report

    def _wait_for(self, process, depsgraph, notes):
        """Shows what a process renders until it ends."""
        status = None
        try:
            while not process.wait(0.1):
                if self._is_cancelled():
                    raise Cancelled
                if status != (process.stage, process.share):
                    status = (process.stage, process.share)
                    self.update_stats("", f"{process.stage} {process.share:.0%}")
                    self.update_progress(process.share)
                preview = process.preview()
                if preview:
                    self._show(depsgraph, preview, is_last=False)
            for warning in process.finish():
                notes.approximate(warning)
        finally:
            process.stop()

    def _is_cancelled(self):
        return self.test_break()

    def _set_time(self, frame, subframe):
        self.frame_set(frame, subframe=subframe)

    def _show(self, depsgraph, file, is_last):
        """Hands the pixels of an EXR file to Blender."""
        channels, attributes = exr.read_with_attributes(file)
        made = {p.name: p for p in passes_of(depsgraph.view_layer)}
        x0, y0, x1, y1 = region_of(depsgraph.scene.render)
        size = channels["R"].shape
        if size != (y1 - y0, x1 - x0):
            raise TranslationError(f"phasetree rendered {size[1]} × {size[0]} pixels instead of {x1 - x0} × {y1 - y0}")
        result = self.begin_result(0, 0, x1 - x0, y1 - y0, layer=depsgraph.view_layer.name)
        mattes = {}
        for layer in cryptomatte.layers_of(depsgraph.view_layer):
            renamed, ids = cryptomatte.renamed(layer, channels, attributes, self._meanings)
            mattes.update(renamed)
            for name, value in cryptomatte.metadata(depsgraph.view_layer.name, layer, ids).items():
                self.get_result().stamp_data_add_field(name, value)
        channels.update(mattes)
        for render_pass in result.layers[0].passes:
            if render_pass.name in made:
                fill(render_pass, made[render_pass.name], channels)
        if is_last:
            self.end_result(result)
        else:
            self.update_result(result)
            self.end_result(result, cancel=True)

    # The rendered viewport. Blender makes an engine for each one, and deletes it when the viewport shows something else.
    _viewport = _view = _drawn = _texture = None

    def __del__(self):
        if self._viewport is not None:
            self._viewport.close()
        getattr(super(), "__del__", lambda: None)()  # which Blender 4.4 and later have

    def view_update(self, context, depsgraph):
        """The scene changed, or the viewport begins to show it."""
        notes = Notes()
        try:
            if self._viewport is None:
                self._viewport = Viewport(preferences.found_command(), self.tag_redraw)
            self._viewport.show(translation=translate(depsgraph, self._viewport.path(), preferences.found_command(), notes))
        except TranslationError as error:
            self.update_stats("", str(error))

    def view_draw(self, context, depsgraph):
        if self._viewport is None:
            return
        region, seen = context.region, context.region_data
        scale = depsgraph.scene.phasetree.viewport_scale / 100
        size = max(1, int(region.width * scale)), max(1, int(region.height * scale))
        view = (camera_of_view(seen.view_matrix, seen.window_matrix), *size)
        if view != self._view:
            self._view = view
            self._viewport.show(view=view)
        self.update_stats("", self._viewport.status)
        picture = self._viewport.picture
        if picture is None:
            return
        if picture is not self._drawn:
            height, width, _ = picture.shape
            pixels = gpu.types.Buffer("FLOAT", picture.size, picture.reshape(-1))
            self._texture, self._drawn = gpu.types.GPUTexture((width, height), format="RGBA32F", data=pixels), picture
        self.bind_display_space_shader(depsgraph.scene)
        draw_texture_2d(self._texture, (0, 0), region.width, region.height)
        self.unbind_display_space_shader()

    def _tell(self, notes):
        for note in notes:
            print(f"phasetree: {note}")
        errors = [str(note.text) for note in notes.of_kind(Kind.ERROR) if not note.subject]
        if errors:
            self.error_set(f"phasetree: {errors[0]}")
            # Without this, Blender would save a black picture. Scripts get an exception, and command lines an exit code.
            self.report({"ERROR"}, f"phasetree: {errors[0]}")
        losses = len(notes.of_kind(Kind.UNSUPPORTED)) + len(notes.of_kind(Kind.APPROXIMATE))
        if losses:
            self.report({"WARNING"}, f"phasetree: unsupported or approximated: {losses}; see Render properties > Report")


def checkpoint_of(depsgraph):
    """The file of a picture's checkpoint, in a folder that exists; empty if renders do not go on."""
    scene = depsgraph.scene
    if not scene.phasetree.keeps_checkpoints:
        return ""
    folder = bpy.path.abspath(scene.phasetree.checkpoint_folder)
    if scene.phasetree.checkpoint_folder.startswith("//") and not bpy.data.filepath:
        raise TranslationError("save the .blend file first, or choose a folder for checkpoints that does not begin with //")
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise TranslationError(f"cannot make the folder of checkpoints {folder}: {error.strerror}") from error
    blend = os.path.splitext(os.path.basename(bpy.data.filepath))[0] or "unsaved"
    name = f"{blend} {scene.name} {depsgraph.view_layer.name} {scene.frame_current:04}"
    return os.path.join(folder, bpy.path.clean_name(name) + ".checkpoint")


def fill(render_pass, made, channels):
    """Fills a pass, whose lowest row is the first."""
    absent = np.full_like(channels["R"], made.missing)
    rows = np.stack([channels.get(name, absent) for name in made.channels], axis=-1)[::-1]
    render_pass.rect.foreach_set(np.ascontiguousarray(rows, dtype=np.float32).reshape(-1, rows.shape[-1]))


def register():
    bpy.utils.register_class(PhasetreeRenderEngine)


def unregister():
    bpy.utils.unregister_class(PhasetreeRenderEngine)
