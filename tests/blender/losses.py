"""What is unsupported is reported, and what is broken gives a message."""

import math
import os
import unittest
from types import SimpleNamespace

import bpy
import numpy as np
from phasetree_blender.notes import Notes
from phasetree_blender.translate import materials
from support import BlenderTest, add_box, dress, principled, shader


class Losses(BlenderTest):
    def test_default_scene_loses_nothing(self):
        self.assertEqual(self.check()[0], "")

    def test_unsupported_things_are_listed(self):
        cube = bpy.data.objects["Cube"]
        material = principled("Skin", Subsurface=0.3, Sheen=0.2, Specular_Tint=0.5)
        tree = material.node_tree
        noise = tree.nodes.new("ShaderNodeTexNoise")
        tree.links.new(noise.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])
        tree.links.new(noise.outputs["Fac"], tree.nodes["Principled BSDF"].inputs["Roughness"])
        bump = tree.nodes.new("ShaderNodeBump")
        tree.links.new(bump.outputs["Normal"], tree.nodes["Principled BSDF"].inputs["Normal"])
        dress(cube, material)
        add_box("Veil", (2, 0, 0), (3, 1, 1), shader("ShaderNodeBsdfHair"))
        bpy.ops.object.volume_add()
        light = bpy.data.objects["Light"]
        light.data.specular_factor = 0
        cube.visible_shadow = False
        world = self.scene.world.node_tree
        world.links.new(world.nodes.new("ShaderNodeTexSky").outputs[0], world.nodes["Background"].inputs["Color"])
        notes, _ = self.check()
        for wanted in (
            'not supported: material "Skin": "Base Color" is linked to Noise Texture, which is ignored',
            'not supported: material "Skin": "Roughness" is linked to Noise Texture, which is ignored; the value 0.5 is used',
            'not supported: material "Skin": "Subsurface" is ignored',
            'approximate: material "Skin": "Sheen" uses a different model than Blender',
            'not supported: material "Skin": "Specular Tint" is ignored',
            'not supported: material "Skin": Bump at "Normal" is ignored',
            'not supported: material "ShaderNodeBsdfHair": the shader Hair BSDF',
            'not supported: object "Volume": volumes are left out',
            'not supported: object "Cube": it is visible to all rays, although ray visibility excludes shadow',
            'not supported: light "Light": "specular_factor" is ignored',
            'approximate: world "World": Sky Texture is rendered by another model of the atmosphere',
        ):
            self.assertIn(wanted, notes)
        self.assertEqual(len(notes.splitlines()), 11, notes)
        # A render reports the same.
        self.render()
        self.assertEqual(self.notes(), notes)

    def test_broken_scenes_give_messages(self):
        def message():
            with self.assertRaises(RuntimeError) as raised:
                bpy.ops.render.render()
            return str(raised.exception)

        camera = self.scene.camera
        camera.data.type = "PANO"
        self.assertIn("panorama is of the type fisheye equisolid; use Equirectangular or Fisheye Equidistant", message())
        camera.data.type = "PERSP"
        self.scene.camera = bpy.data.objects["Cube"]
        self.assertIn('the active camera "Cube" is not a camera', message())
        self.scene.camera = None
        self.assertIn("error: the scene has no camera; add one", self.check()[0])
        with self.assertRaisesRegex(RuntimeError, "no camera"):
            self.export()
        self.scene.camera = camera
        mesh = bpy.data.objects["Cube"].data
        mesh.vertices[0].co.x = math.nan
        self.assertIn("the scene has nothing to render: no visible object has faces", message())
        self.assertIn('error: object "Cube": has vertices whose coordinates are not finite; it is left out', self.notes())
        mesh.clear_geometry()
        self.assertIn("the scene has nothing to render", message())
        # And then it renders again.
        add_box("Box", (0, 0, 0), (1, 1, 1), None)
        self.render()
        self.assertEqual(self.notes(), "")

    def test_missing_images_are_reported(self):
        material = principled("Poster")
        tree = material.node_tree
        texture = tree.nodes.new("ShaderNodeTexImage")
        image = bpy.data.images.new("poster", 4, 4)
        image.source, image.filepath = "FILE", str(self.folder / "missing.png")
        texture.image = image
        bsdf = tree.nodes["Principled BSDF"]
        link = tree.links.new(texture.outputs["Color"], bsdf.inputs["Base Color"])
        dress(bpy.data.objects["Cube"], material)
        wanted = 'not supported: material "Poster": the image "poster" cannot be read and is ignored'
        self.assertEqual(self.check()[0], wanted)
        # Instead of a number, the input's own value is used.
        tree.links.remove(link)
        bsdf.inputs["Metallic"].default_value = 0.25
        own = self.combined()
        tree.links.new(texture.outputs["Color"], bsdf.inputs["Metallic"])
        self.assertAlmostEqual(float(self.combined().mean() / own.mean()), 1, delta=0.01)
        self.assertEqual(self.notes(), wanted)

    def test_layers_and_images_lose_nothing(self):
        material = principled("Brushed", Emission=(0.1, 0.2, 0.3), Anisotropic=0.5, Anisotropic_Rotation=0.25)
        tree = material.node_tree
        bsdf = tree.nodes["Principled BSDF"]
        texture, mapping = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeMapping")
        texture.image = bpy.data.images.new("steel", 4, 4)
        mapping.inputs["Rotation"].default_value = (0, 0, 1)
        tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
        tree.links.new(texture.outputs["Color"], bsdf.inputs["Base Color"])
        dress(bpy.data.objects["Cube"], material)
        self.assertIn("Mapping has no input; the UV map is used", self.check()[0])
        tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["UV"], mapping.inputs["Vector"])
        self.assertEqual(self.check()[0], "")
        tree.links.new(texture.outputs["Color"], bsdf.inputs["Metallic"])
        # The images of numbers lie on the mesh in one way, and a Mapping node keeps it in the plane.
        other = tree.nodes.new("ShaderNodeTexImage")
        other.image = texture.image
        tree.links.new(other.outputs["Color"], bsdf.inputs["Roughness"])
        notes = self.check()[0]
        self.assertIn('"Anisotropic" is ignored, because "Roughness" is an image', notes)
        self.assertIn('the image of "Metallic" is ignored, because its mapping differs from that of', notes)
        mapping.inputs["Rotation"].default_value = (1, 0, 0)
        self.assertIn("Mapping at Image Texture is ignored; it may only move, scale, and rotate about z", self.check()[0])

    def test_command_that_is_missing_or_fails_gives_one_message(self):
        preferences = bpy.context.preferences.addons["phasetree_blender"].preferences
        found, path = os.environ.pop("PHASETREE_COMMAND"), os.environ["PATH"]
        os.environ["PATH"] = str(self.folder)
        try:
            for command, wanted in (
                ("", "the command `phasetree`, which does the rendering, was not found. Build it with"),
                (str(self.folder / "nothing"), "nothing is not a program; correct the file in the add-on's preferences"),
                ("/bin/false", "phasetree ended without a message"),
            ):
                preferences.command = command
                with self.assertRaises(RuntimeError) as raised:
                    bpy.ops.render.render()
                self.assertIn(wanted, str(raised.exception))
                self.assertEqual(len(self.notes().splitlines()), 1)
        finally:
            os.environ["PHASETREE_COMMAND"], os.environ["PATH"], preferences.command = found, path, ""

    def test_crash_of_the_command_gives_a_message(self):
        """Blender survives whatever ends its child."""
        script = self.folder / "crashing"
        script.write_text(f'#!/bin/sh\n[ "$1" != render ] || kill -SEGV $$\nexec "{os.environ["PHASETREE_COMMAND"]}" "$@"\n')
        script.chmod(0o755)
        preferences = bpy.context.preferences.addons["phasetree_blender"].preferences
        preferences.command = str(script)
        try:
            with self.assertRaisesRegex(RuntimeError, "phasetree was ended by signal 11"):
                bpy.ops.render.render()
        finally:
            preferences.command = ""


class NewNames(unittest.TestCase):
    """The sockets of a Principled BSDF as Blender 4 names them. No Blender 4 is needed."""

    DEFAULTS = {"Base Color": (0.8, 0.8, 0.8, 1), "Metallic": 0.0, "Roughness": 0.5, "IOR": 1.5, "Alpha": 1.0,
                "Subsurface Weight": 0.0, "Specular IOR Level": 0.5, "Specular Tint": (1, 1, 1, 1), "Anisotropic": 0.0,
                "Transmission Weight": 0.0, "Coat Weight": 0.0, "Sheen Weight": 0.0, "Emission Color": (1, 1, 1, 1),
                "Emission Strength": 0.0, "Thin Film Thickness": 0.0, "Thin Film IOR": 1.33, "Normal": (0, 0, 0),
                "Coat Roughness": 0.03, "Coat IOR": 1.5, "Coat Tint": (1, 1, 1, 1), "Coat Normal": (0, 0, 0),
                "Sheen Roughness": 0.5, "Sheen Tint": (1, 1, 1, 1), "Anisotropic Rotation": 0.0,
                "Tangent": (0, 0, 0)}  # fmt: skip

    def surface(self, **values):
        """The surface of a node with these values, and the notes as text."""
        sockets = {**self.DEFAULTS, **{name.replace("_", " "): value for name, value in values.items()}}
        inputs = {name: SimpleNamespace(name=name, is_linked=False, links=(), default_value=v) for name, v in sockets.items()}
        notes = Notes()
        made = materials.principled(SimpleNamespace(inputs=inputs, name="Principled BSDF"), notes)
        return made, "\n".join(map(str, notes))

    def test_default_is_opaque_and_dark(self):
        surface, notes = self.surface()
        self.assertEqual((surface.is_clear, surface.emission, notes), (False, (0, 0, 0), ""))
        self.assertAlmostEqual(surface.ior, 1.5)

    def test_values(self):
        surface, notes = self.surface(Transmission_Weight=1.0, IOR=1.33, Roughness=0.1)
        self.assertEqual((surface.is_clear, surface.ior, surface.roughness, notes), (True, 1.33, 0.1, ""))
        self.assertEqual(self.surface(Emission_Strength=2.0)[0].emission, (2, 2, 2))
        # A level of 1 doubles the reflectance: 0.08 instead of 0.04.
        self.assertAlmostEqual(self.surface(Specular_IOR_Level=1.0)[0].ior, (1 + 0.08**0.5) / (1 - 0.08**0.5))
        _, notes = self.surface(Coat_Weight=1.0, Coat_IOR=1.6, Coat_Tint=(1, 0, 0, 1), Subsurface_Weight=0.5)
        for text in ('"Coat IOR" is ignored; 1.5 is used instead', '"Coat Tint" is ignored', '"Subsurface Weight" is ignored'):
            self.assertIn(f"not supported: {text}", notes)
        self.assertEqual(len(notes.splitlines()), 3, notes)

    def test_layers(self):
        film = {"iridescenceFactor": 1, "iridescenceIor": 1.33, "iridescenceThicknessMinimum": 300,
                "iridescenceThicknessMaximum": 300}  # fmt: skip
        surface, notes = self.surface(Coat_Weight=0.75, Coat_Roughness=0.25, Thin_Film_Thickness=300.0)
        self.assertEqual((notes, surface.extensions), ("", {
            "KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25},
            "KHR_materials_iridescence": film}))  # fmt: skip
        surface, notes = self.surface(Sheen_Weight=0.5, Sheen_Tint=(1, 0.5, 0, 1), Specular_Tint=(1, 0.25, 0, 1))
        self.assertEqual(notes, 'approximate: "Sheen Weight" uses a different model than Blender\n'
                         'approximate: "Specular Tint" also colours reflections at grazing angles')  # fmt: skip
        self.assertEqual(surface.extensions, {
            "KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.25, 0], "sheenRoughnessFactor": 0.5},
            "KHR_materials_specular": {"specularColorFactor": [1, 0.25, 0]}})  # fmt: skip
        # Clear materials have films only.
        surface, notes = self.surface(Transmission_Weight=1.0, Thin_Film_Thickness=300.0, Coat_Weight=1.0, Sheen_Weight=1.0,
                                      Anisotropic=1.0, Specular_Tint=(1, 0, 0, 1))  # fmt: skip
        self.assertEqual(surface.extensions, {"KHR_materials_iridescence": film})
        for name in ("Coat Weight", "Sheen Weight", "Anisotropic", "Specular Tint"):
            self.assertIn(f'not supported: "{name}" of a clear material is ignored', notes)


class Materials(BlenderTest):
    """Colours of surfaces in the middle of the picture, under a white sky."""

    def setUp(self):
        super().setUp()
        self.scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
        self.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 1
        bpy.data.objects["Light"].data.energy = 0
        bpy.data.objects.remove(bpy.data.objects["Cube"])
        camera = self.scene.camera
        camera.location, camera.rotation_euler = (0, 0, 5), (0, 0, 0)
        bpy.ops.mesh.primitive_plane_add(size=10)
        self.plane = bpy.context.object

    def test_images_by_uv_maps(self):
        """Each quarter of an image of four pixels is where its UV map has it, packed, generated or on disk."""
        image = bpy.data.images.new("quarters", 64, 64)
        pixels = np.ones((64, 64, 4), dtype=np.float32)
        colors = {(0, 0): (1, 0, 0), (0, 1): (0, 1, 0), (1, 0): (0, 0, 1), (1, 1): (1, 1, 0)}  # (row from below, column)
        for (row, column), color in colors.items():
            pixels[32 * row : 32 * row + 32, 32 * column : 32 * column + 32, :3] = color
        image.pixels.foreach_set(pixels.reshape(-1))
        image.update()
        material = shader("ShaderNodeBsdfDiffuse")
        tree = material.node_tree
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.image = image
        tree.links.new(texture.outputs["Color"], tree.nodes["Diffuse BSDF"].inputs["Color"])
        dress(self.plane, material)

        def check():
            picture = self.combined()
            for (row, column), color in colors.items():
                y, x = (22 if row == 0 else 4), (4 if column == 0 else 28)
                np.testing.assert_allclose(picture[y : y + 10, x : x + 16].mean(axis=(0, 1)), color, atol=0.03)
            self.assertEqual(self.notes(), "")

        check()
        image.filepath_raw, image.file_format = str(self.folder / "quarters.tif"), "TIFF"
        image.save()
        texture.image = bpy.data.images.load(image.filepath_raw)
        check()
        image.filepath_raw, image.file_format = str(self.folder / "quarters.png"), "PNG"
        image.save()
        texture.image = bpy.data.images.load(image.filepath_raw)
        texture.image.pack()
        os.remove(self.folder / "quarters.png")
        check()

    def test_alpha_lets_light_through(self):
        dress(self.plane, principled("Net", Base_Color=(0.0, 0.0, 0.0), Roughness=1.0, Specular=0.0, Alpha=0.25))
        self.assertAlmostEqual(float(self.combined().mean()), 0.75, delta=0.05)

    def test_materials_without_nodes_and_without_material(self):
        self.plane.data.materials.clear()
        self.assertAlmostEqual(float(self.combined().mean()), 0.8, delta=0.01)
        material = bpy.data.materials.new("Plain")
        material.diffuse_color, material.specular_intensity = (0.2, 0.4, 0.6, 1), 0
        self.plane.data.materials.append(material)
        np.testing.assert_allclose(self.combined().mean(axis=(0, 1)), (0.2, 0.4, 0.6), atol=0.01)


if __name__ == "__main__":
    unittest.main()
