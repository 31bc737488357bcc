"""Mix Shader and Add Shader of surfaces: what is exact, compared with Cycles or with one shader, and what is reported."""

import unittest

import bpy
import numpy as np
from support import BlenderTest, dress, principled


class Mixes(BlenderTest):
    def setUp(self):
        super().setUp()
        self.cube = bpy.data.objects["Cube"]
        bpy.data.objects.remove(bpy.data.objects["Light"])
        world = self.scene.world.node_tree.nodes["Background"].inputs
        world["Color"].default_value, world["Strength"].default_value = (1, 1, 1, 1), 0.5
        self.scene.phasetree.samples = 64

    def material(self, kind="ShaderNodeMixShader", amount=0.5, first=None, second=None):
        """A material that combines two shaders, each (kind, {input: value}) or None."""
        made = bpy.data.materials.new("Both")
        made.use_nodes = True
        tree = made.node_tree
        tree.nodes.clear()
        both = tree.nodes.new(kind)
        tree.links.new(both.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        inputs = both.inputs[-2:]
        for socket, part in zip(inputs, (first, second)):
            if part:
                node = tree.nodes.new(part[0])
                for key, value in part[1].items():
                    node.inputs[key].default_value = (*value, 1) if isinstance(value, tuple) else value
                tree.links.new(node.outputs[0], socket)
        if kind == "ShaderNodeMixShader":
            both.inputs[0].default_value = amount
        dress(self.cube, made)
        return made

    def mean(self, engine="PHASETREE"):
        """The mean colour of the cube's pixels."""
        self.scene.render.engine = engine
        self.scene.render.film_transparent = True
        if engine == "CYCLES":
            self.scene.cycles.samples, self.scene.cycles.use_denoising, self.scene.cycles.device = 64, False, "CPU"
        self.scene.view_layers[0].use_pass_z = False
        pixels = self.render()
        self.scene.render.engine = "PHASETREE"
        alpha = pixels["ViewLayer.Combined.A"]
        return np.array([pixels[f"ViewLayer.Combined.{c}"].mean() for c in "RGB"] + [alpha.mean()])

    def assert_like_cycles(self, tolerance, notes=""):
        own = self.mean()
        self.assertEqual(self.notes(), notes)
        cycles = self.mean("CYCLES")
        self.assertTrue(np.allclose(own, cycles, rtol=tolerance, atol=0.0005), (own, cycles))
        return own

    def test_matt_shaders_are_mixed_exactly(self):
        red, blue = ("ShaderNodeBsdfDiffuse", {"Color": (0.8, 0.1, 0.1)}), ("ShaderNodeBsdfDiffuse", {"Color": (0.0, 0.2, 0.9)})
        self.material(amount=0.25, first=red, second=blue)
        mixed = self.assert_like_cycles(0.01)
        self.material("ShaderNodeAddShader", first=("ShaderNodeBsdfDiffuse", {"Color": (0.6, 0.075, 0.075)}),
                      second=("ShaderNodeBsdfDiffuse", {"Color": (0.0, 0.05, 0.225)}))  # fmt: skip
        self.assertTrue(np.allclose(self.assert_like_cycles(0.01), mixed, rtol=0.003))

    def test_emission_is_mixed_and_added(self):
        matt, light = ("ShaderNodeBsdfDiffuse", {"Color": (0.5, 0.5, 0.5)}), ("ShaderNodeEmission", {"Color": (1.0, 0.5, 0.0)})
        self.material(amount=0.3, first=matt, second=light)
        self.assert_like_cycles(0.01)
        self.material("ShaderNodeAddShader", first=light, second=matt)
        self.assert_like_cycles(0.01)
        glossy = ("ShaderNodeBsdfPrincipled", {"Base Color": (0.3, 0.3, 0.8), "Roughness": 0.4})
        # What is added to a Principled BSDF is the same as its own emission.
        dress(self.cube, principled("Plain", Base_Color=(0.3, 0.3, 0.8), Roughness=0.4, Emission=(1.0, 0.5, 0.0)))
        plain = self.mean()
        self.material("ShaderNodeAddShader", first=glossy, second=light)
        self.assertTrue(np.array_equal(self.mean(), plain))

    def test_holes_are_alpha(self):
        hole, matt = ("ShaderNodeBsdfTransparent", {}), ("ShaderNodeBsdfDiffuse", {"Color": (0.8, 0.4, 0.2)})
        self.material(amount=0.25, first=hole, second=matt)
        self.assert_like_cycles(0.02)
        self.material(amount=0.25, first=matt, second=hole)
        self.assert_like_cycles(0.02)

    def test_metal_and_plastic_are_a_mix_of_the_scene_file(self):
        metal = ("ShaderNodeBsdfPrincipled", {"Base Color": (0.9, 0.6, 0.3), "Metallic": 1.0, "Roughness": 0.3})
        plastic = ("ShaderNodeBsdfPrincipled", {"Base Color": (0.1, 0.3, 0.2), "Roughness": 0.6})
        self.material(amount=0.7, first=metal, second=plastic)
        self.assert_like_cycles(0.03)
        mix = self.export()[1]["meshes"][-1]["gltf"]["material"]["mix"]
        self.assertAlmostEqual(mix["amount"], 0.7, places=6)
        self.assertAlmostEqual(mix["first"]["conductor"]["roughness"], 0.09, places=6)
        self.assertAlmostEqual(mix["second"]["principled"]["base_color"][1], 0.3, places=6)

    def test_image_at_the_factor_chooses_between_two(self):
        made = self.material(first=("ShaderNodeBsdfDiffuse", {"Color": (0.9, 0.0, 0.0)}),
                             second=("ShaderNodeBsdfPrincipled", {"Base Color": (0.5, 0.5, 0.9), "Metallic": 1.0, "Roughness": 0.1}))  # fmt: skip
        tree = made.node_tree
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.image = bpy.data.images.new("mask", 8, 8)
        texture.image.colorspace_settings.name = "Non-Color"
        values = np.ones((8, 8, 4), dtype=np.float32)
        values[:, :4, :3] = 0  # the left half of each face is the first shader
        texture.image.pixels.foreach_set(values.ravel())
        tree.links.new(texture.outputs["Color"], next(n for n in tree.nodes if n.bl_idname == "ShaderNodeMixShader").inputs[0])
        own = self.mean()
        self.assertNotIn("not supported", self.notes())
        cycles = self.mean("CYCLES")
        self.assertTrue(np.allclose(own, cycles, rtol=0.04, atol=0.0005), (own, cycles))

    def test_gloss_by_fresnel(self):
        made = self.material(first=("ShaderNodeBsdfDiffuse", {"Color": (0.5, 0.1, 0.1)}),
                             second=("ShaderNodeBsdfGlossy", {"Color": (1.0, 1.0, 1.0), "Roughness": 0.2}))  # fmt: skip
        tree = made.node_tree
        fresnel = tree.nodes.new("ShaderNodeFresnel")
        fresnel.inputs["IOR"].default_value = 1.5
        tree.links.new(fresnel.outputs[0], next(n for n in tree.nodes if n.bl_idname == "ShaderNodeMixShader").inputs[0])
        self.assertIn('approximate: material "Both": Mix Shader is rendered as a gloss of the index 1.5', self.check()[0])
        own, cycles = self.mean(), self.mean("CYCLES")
        self.assertTrue(np.allclose(own, cycles, rtol=0.06, atol=0.002), (own, cycles))

    def test_what_a_mix_cannot_express_is_reported(self):
        glass, matt = ("ShaderNodeBsdfGlass", {}), ("ShaderNodeBsdfDiffuse", {})
        light, hole = ("ShaderNodeEmission", {}), ("ShaderNodeBsdfTransparent", {})
        shiny = ("ShaderNodeBsdfPrincipled", {})
        clear = "a mix with a clear material at Mix Shader; only the"
        for kind, amount, first, second, wanted in (
            ("ShaderNodeMixShader", 0.4, glass, matt, f"{clear} first shader is rendered"),
            ("ShaderNodeMixShader", 0.6, glass, matt, f"{clear} second shader is rendered"),
            ("ShaderNodeMixShader", 0.6, glass, hole, "Transparent BSDF at Mix Shader is ignored beside a clear material"),
            ("ShaderNodeMixShader", 0.5, shiny, light, "emission within the mix at Mix Shader is ignored"),
            ("ShaderNodeMixShader", 0.0, hole, matt, "Mix Shader is wholly transparent; it is rendered as black"),
            ("ShaderNodeAddShader", 0.5, glass, matt, "of the sum at Add Shader, only the first shader is rendered"),
            ("ShaderNodeAddShader", 0.5, shiny, matt, "of the sum at Add Shader, only the first shader is rendered"),
            ("ShaderNodeAddShader", 0.5, hole, light, "Transparent BSDF at Add Shader is ignored"),
            ("ShaderNodeMixShader", 0.5, matt, ("ShaderNodeBsdfHair", {}), "the shader Hair BSDF"),
        ):
            self.material(kind, amount, first, second)
            self.assertIn(f'not supported: material "Both{self.suffix()}": {wanted}', self.check()[0])
        self.material("ShaderNodeAddShader", 0, ("ShaderNodeBsdfDiffuse", {"Color": (0.8,) * 3}), matt)
        self.assertIn("Add Shader reflects more light than arrives; its colour is clamped to 1", self.check()[0])

    def suffix(self):
        return self.cube.data.materials[0].name.removeprefix("Both")

    def test_unlinked_shaders_are_black(self):
        self.material(amount=0.25, second=("ShaderNodeBsdfDiffuse", {"Color": (0.8, 0.4, 0.2)}))
        self.assert_like_cycles(0.02)

    def test_light_path_counts_as_the_camera_sees(self):
        made = self.material(first=("ShaderNodeBsdfGlass", {}), second=("ShaderNodeBsdfTransparent", {}))
        tree = made.node_tree
        mix = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeMixShader")
        tree.links.new(tree.nodes.new("ShaderNodeLightPath").outputs["Is Shadow Ray"], mix.inputs[0])
        self.assertEqual(self.check()[0], 'approximate: material "Both": "Is Shadow Ray" at Mix Shader counts as 0 for all rays')
        self.assertEqual(list(self.export()[1]["phases"]), ["Both"])

    def test_mesh_with_a_mix_beside_other_materials(self):
        self.material(amount=0.5, first=("ShaderNodeBsdfPrincipled", {"Metallic": 1.0}), second=("ShaderNodeBsdfPrincipled", {}))
        self.cube.data.materials.append(principled("Plain"))
        for face in self.cube.data.polygons:
            face.material_index = face.index % 2
        scene = self.export()[1]
        self.assertEqual(["material" in mesh["gltf"] for mesh in scene["meshes"]], [False, True])
        self.run_command("check", "exported.json")
        self.assertGreater(self.mean()[0], 0)


if __name__ == "__main__":
    unittest.main()
