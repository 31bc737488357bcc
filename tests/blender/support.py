"""Small scenes for tests in Blender, and renders of them."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import bpy
import numpy as np
from phasetree_blender import exr, last_report

COMMAND = os.environ["PHASETREE_COMMAND"]


class BlenderTest(unittest.TestCase):
    """Begins each test with Blender's default scene, small, and with a folder."""

    def setUp(self):
        bpy.ops.wm.read_factory_settings()
        bpy.ops.preferences.addon_enable(module="phasetree_blender")
        self.scene = bpy.context.scene
        self.scene.render.engine = "PHASETREE"
        self.scene.render.resolution_x, self.scene.render.resolution_y = 48, 36
        self.scene.phasetree.samples, self.scene.phasetree.caustics = 4, False
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def notes(self):
        """The notes of the last render or check, as text."""
        report = last_report.of(self.scene.name)
        return "\n".join(map(str, report.notes))

    def check(self):
        """Checks the scene. Returns the notes and the report on its phases, as text."""
        try:
            bpy.ops.phasetree.check()
        except RuntimeError:  # an error is among the notes
            pass
        return self.notes(), last_report.of(self.scene.name).phases

    def render(self):
        """{"ViewLayer.Combined.R": pixels …} of a render, the top row first."""
        self.scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
        self.scene.render.image_settings.color_depth = "32"
        self.scene.render.image_settings.exr_codec = "ZIP"
        self.scene.render.filepath = str(self.folder / "render.exr")
        bpy.ops.render.render(write_still=True)
        return exr.read(self.scene.render.filepath)

    def combined(self):
        pixels = self.render()
        return np.stack([pixels[f"ViewLayer.Combined.{c}"] for c in "RGB"], axis=-1)

    def export(self):
        """The exported scene file: its path and its contents."""
        path = str(self.folder / "exported.json")
        bpy.ops.phasetree.export_scene(filepath=path)
        return path, json.loads(pathlib.Path(path).read_text())

    def run_command(self, *arguments, text=""):
        done = subprocess.run([COMMAND, *arguments], input=text, capture_output=True, text=True, check=False, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def labels(self, path, points):
        """The names of the phases at points."""
        lines = self.run_command("eval", path, text="".join(f"{x} {y} {z}\n" for x, y, z in points)).splitlines()
        return [line.split(",")[3] for line in lines[1:]]


def principled(name, transmission=0.0, **inputs):
    """A material with a Principled BSDF, whose inputs have their names in Blender 3.4."""
    from phasetree_blender.translate.sockets import socket

    made = bpy.data.materials.new(name)
    made.use_nodes = True
    node = made.node_tree.nodes["Principled BSDF"]
    for key, value in {"Transmission": transmission, **inputs}.items():
        found = socket(node, key.replace("_", " "))
        found.default_value = (*value, 1) if isinstance(value, tuple) else value
    return made


def shader(kind, **inputs):
    """A material with a shader of that kind."""
    made = bpy.data.materials.new(kind)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output, node = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new(kind)
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    for key, value in inputs.items():
        node.inputs[key].default_value = (*value, 1) if isinstance(value, tuple) else value
    return made


def dress(item, material):
    item.data.materials.clear()
    item.data.materials.append(material)
    return item


def add_box(name, low, high, material):
    """A closed box."""
    centre, size = [(a + b) / 2 for a, b in zip(low, high)], [b - a for a, b in zip(low, high)]
    bpy.ops.mesh.primitive_cube_add(size=1, location=centre)
    item = bpy.context.object
    item.name, item.scale = name, size
    return dress(item, material)
