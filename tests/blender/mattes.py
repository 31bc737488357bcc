"""Cryptomatte of objects, materials and phases, by Blender's own node."""

import unittest

import bpy
import numpy as np
from phasetree_blender import exr
from support import BlenderTest, add_box, dress, principled


class Mattes(BlenderTest):
    def setUp(self):
        super().setUp()
        bpy.data.objects.remove(bpy.data.objects["Cube"])
        self.layer = self.scene.view_layers[0]
        camera = self.scene.camera
        camera.data.type, camera.data.ortho_scale = "ORTHO", 8
        camera.location, camera.rotation_euler = (0, 0, 10), (0, 0, 0)
        self.oak = principled("Oak")
        self.glass = principled("Glass", 1, IOR=1.5, Roughness=0.0, Base_Color=(1.0, 1.0, 1.0))
        for number, material in enumerate((self.oak, self.oak, self.glass, self.glass)):
            add_box(f"Box {number}", (2 * number - 3.75, -1, 0), (2 * number - 2.25, 1, 1), material)

    def mattes(self, layer, *names):
        """The coverage of each name in each of the four columns of the picture."""
        self.scene.use_nodes = True
        tree, found = self.scene.node_tree, []
        for name in names:
            tree.nodes.clear()
            node, output = tree.nodes.new("CompositorNodeCryptomatteV2"), tree.nodes.new("CompositorNodeComposite")
            node.scene = self.scene
            tree.links.new(tree.nodes.new("CompositorNodeRLayers").outputs["Image"], node.inputs["Image"])
            node.layer_name, node.matte_id = f"ViewLayer.{layer}", name
            tree.links.new(node.outputs["Matte"], output.inputs["Image"])
            self.scene.render.image_settings.file_format = "OPEN_EXR"
            self.scene.render.filepath = str(self.folder / "matte.exr")
            bpy.ops.render.render(write_still=True)
            matte = exr.read(self.scene.render.filepath)["R"]
            found.append([round(float(matte[18, 6 + 12 * column]), 2) for column in range(4)])
        self.scene.use_nodes = False
        return found

    def test_objects_of_one_material_are_told_apart(self):
        plain = self.combined()
        self.layer.use_pass_cryptomatte_object = self.layer.use_pass_cryptomatte_material = True
        self.assertLess(np.abs(self.combined() - plain).mean(), 0.02 * plain.mean())  # the picture stays
        self.assertEqual(self.notes(), "")
        self.assertEqual(
            self.mattes("CryptoObject", "Box 0", "Box 1", "Box 2", "Box 3", "Box"),
            [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0]],
        )
        self.assertEqual(self.mattes("CryptoMaterial", "Oak", "Glass"), [[1, 1, 0, 0], [0, 0, 1, 1]])

    def test_phases_are_clear_materials(self):
        self.layer.use_pass_cryptomatte_asset = True
        self.assertEqual(self.mattes("CryptoAsset", "Glass", "Oak"), [[0, 0, 1, 1], [0, 0, 0, 0]])

    def test_trees_moving_groups_and_mixes_have_their_names(self):
        path = self.folder / "ball.json"
        path.write_text('{"version": 1, "phases": {"gold": {"diffuse": {"color": [0.5, 0.4, 0.1]}}},'
                        '"tree": {"set": {"phase": "gold", "of": {"sphere": {"radius": 0.7}}}}}')  # fmt: skip
        tree = bpy.data.objects["Box 1"]
        tree.phasetree.source, tree.phasetree.file = "FILE", str(path)
        mixed = bpy.data.materials.new("Rust")
        mixed.use_nodes = True
        nodes, links = mixed.node_tree.nodes, mixed.node_tree.links
        both, metal = nodes.new("ShaderNodeMixShader"), nodes.new("ShaderNodeBsdfPrincipled")
        metal.inputs["Metallic"].default_value = 1
        links.new(nodes["Principled BSDF"].outputs[0], both.inputs[1])
        links.new(metal.outputs[0], both.inputs[2])
        links.new(both.outputs[0], nodes["Material Output"].inputs["Surface"])
        dress(bpy.data.objects["Box 0"], mixed)
        moving = bpy.data.objects["Box 2"]
        for frame, z in ((1, 0.0), (11, 1.0)):
            moving.location.z = z
            moving.keyframe_insert("location", frame=frame)
        self.scene.frame_set(6)
        self.scene.render.use_motion_blur = True
        self.layer.use_pass_cryptomatte_object = self.layer.use_pass_cryptomatte_material = True
        self.layer.use_pass_cryptomatte_asset = True
        self.assertEqual(self.mattes("CryptoObject", "Box 0", "Box 1", "Box 2"), [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]])
        self.assertEqual(self.mattes("CryptoMaterial", "Rust", "Box 1.gold", "Glass"), [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1]])
        self.assertEqual(self.mattes("CryptoAsset", "Box 1.gold", "Glass"), [[0, 1, 0, 0], [0, 0, 1, 1]])


if __name__ == "__main__":
    unittest.main()
