"""Renders: the pixels are the command's, and the camera, regions, passes and animations are Blender's."""

import collections
import json
import math
import struct
import unittest
import unittest.mock

import bpy
import numpy as np
from phasetree_blender import engine, exr
from support import BlenderTest, add_box, dress, principled, shader


def replace_materials(path, materials):
    """Replaces the materials of a .glb file."""
    content = path.read_bytes()
    (size,) = struct.unpack("<I", content[12:16])
    document = {**json.loads(content[20 : 20 + size]), "materials": materials}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = content[20 + size :]
    path.write_bytes(struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON") + text + rest)


class Pictures(BlenderTest):
    def of_command(self, *options):
        """The channels that the command renders of the exported scene."""
        path, _ = self.export()
        self.run_command("render", path, "-o", "command.exr", "--quiet", *options)
        return exr.read(self.folder / "command.exr")

    def assert_equal_pixels(self, blender, command, channels="RGB"):
        for channel in channels:
            np.testing.assert_array_equal(blender[f"ViewLayer.Combined.{channel}"], command[channel])

    def test_pixels_are_those_of_the_command(self):
        add_box("Ice", (0.5, -3, -1), (2.5, -1, 1), principled("Ice", 1, Roughness=0.0, IOR=1.31))
        finer = bpy.data.objects["Cube"].modifiers.new("Subdivision", "SUBSURF")
        finer.levels, finer.render_levels = 0, 2
        self.scene.phasetree.caustics = True
        rendered = self.render()
        self.assert_equal_pixels(rendered, self.of_command())
        self.assertTrue((rendered["ViewLayer.Combined.A"] == 1).all())
        self.assertGreater(rendered["ViewLayer.Combined.R"].std(), 0.01)

    def test_layers_are_those_of_the_same_gltf_file(self):
        """A coat, sheen and a grain along the UV map, each on a face of the cube, against extensions written by hand."""
        mesh = bpy.data.objects["Cube"].data
        rest = {"Base_Color": (0.5, 0.25, 0.125), "Roughness": 0.5}
        layered = [principled("Coat", Clearcoat=1.0, Clearcoat_Roughness=0.25, **rest),
                   principled("Sheen", Sheen=1.0, Sheen_Tint=0.0, **rest),
                   principled("Grain", Metallic=1.0, Anisotropic=0.5, Anisotropic_Rotation=0.125, **rest)]  # fmt: skip
        tree = layered[2].node_tree
        tangent = tree.nodes.new("ShaderNodeTangent")
        tangent.direction_type = "UV_MAP"
        tree.links.new(tangent.outputs[0], tree.nodes["Principled BSDF"].inputs["Tangent"])
        for material in layered:
            mesh.materials.append(material)
        mesh.materials.pop(index=0)
        for face in mesh.polygons:
            face.material_index = int(np.argmax(np.abs(face.normal)))
        rendered = self.render()
        self.assertIn("Sheen", self.notes())
        path, _ = self.export()
        # Tangents of the UV map are the reader's.
        self.assertNotIn(b'"TANGENT"', (self.folder / "exported.glb").read_bytes())
        base = {"baseColorFactor": [0.5, 0.25, 0.125, 1], "metallicFactor": 0, "roughnessFactor": 0.5}
        aspect = (1 - 0.9 * 0.5) ** 0.5
        along, across = 0.25 / aspect, 0.25 * aspect
        by_hand = [
            {"name": "Coat", "pbrMetallicRoughness": base, "extensions": {
                "KHR_materials_clearcoat": {"clearcoatFactor": 0.14, "clearcoatRoughnessFactor": 0.25}}},
            {"name": "Sheen", "pbrMetallicRoughness": base, "extensions": {
                "KHR_materials_sheen": {"sheenColorFactor": [0.16] * 3, "sheenRoughnessFactor": 0.3}}},
            {"name": "Grain", "pbrMetallicRoughness": {**base, "metallicFactor": 1, "roughnessFactor": across**0.5},
             "extensions": {"KHR_materials_anisotropy": {
                 "anisotropyStrength": ((along - across) / (1 - across)) ** 0.5, "anisotropyRotation": math.pi / 4}}},
        ]  # fmt: skip

        def picture(materials):
            replace_materials(self.folder / "exported.glb", materials)
            self.run_command("render", path, "-o", "command.exr", "--quiet", "--planes", "normal")
            return exr.read(self.folder / "command.exr")

        command = picture(by_hand)
        self.assert_equal_pixels(rendered, command)
        # Each face looks otherwise without its extension.
        changed = np.abs(picture([{**m, "extensions": {}} for m in by_hand])["R"] - command["R"])
        for axis, material in zip("XYZ", by_hand):
            self.assertGreater(changed[np.abs(command[f"normal.{axis}"]) > 0.9].max(), 1e-3, material["name"])

    def test_passes_regions_and_transparent_backgrounds(self):
        layer = bpy.context.view_layer
        layer.use_pass_z = layer.use_pass_normal = layer.phasetree.use_pass_albedo = True
        render = self.scene.render
        render.film_transparent = render.use_border = render.use_crop_to_border = True
        # Half of the picture at the top left, whose last pixels the default cube covers.
        render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0, 0.5, 0.5, 1
        rendered = self.render()
        command = self.of_command("--crop", "0,0,24,18", "--planes", "alpha,depth,normal,albedo")
        self.assert_equal_pixels(rendered, command, "RGBA")
        for channel in ("Depth.Z", "Normal.X", "Normal.Z", "Albedo.G"):
            theirs = channel[0].lower() + channel[1:]
            np.testing.assert_array_equal(rendered[f"ViewLayer.{channel}"], command[theirs])
        alpha, depth = rendered["ViewLayer.Combined.A"], rendered["ViewLayer.Depth.Z"]
        self.assertEqual((alpha[0, 0], alpha[-1, -1]), (0, 1))
        self.assertEqual(rendered["ViewLayer.Combined.R"][0, 0], 0)
        # The cube's nearest corner is 9.5 m from the default camera, along its axis.
        self.assertTrue(9 < depth[-1, -1] < 11, depth[-1, -1])
        self.assertEqual(depth[0, 0], np.float32(1e10))

    def test_region_without_cropping_keeps_its_position(self):
        whole = self.render()["ViewLayer.Combined.R"]
        render = self.scene.render
        render.use_border, render.use_crop_to_border = True, False
        render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.25, 0.5, 0.5, 0.75
        region = self.render()["ViewLayer.Combined.R"]
        self.assertEqual(region.shape, whole.shape)
        np.testing.assert_array_equal(region[9:18, 12:24], whole[9:18, 12:24])
        self.assertEqual(region[:9].max(), 0)

    def test_resolution_scale_and_seed(self):
        self.scene.render.resolution_percentage = 50
        first = self.combined()
        self.assertEqual(first.shape, (18, 24, 3))
        self.scene.phasetree.seed = 1
        self.assertFalse(np.array_equal(first, self.combined()))

    def test_unfinished_pictures_are_shown(self):
        """And the finished one is the same as without them. On a busy machine, few samples may end before the first look."""
        for samples in (500, 4000, 32000):
            wanted, shown = self.finished_and_shown(samples)
            if not np.array_equal(shown[0], wanted[..., 0]):
                break
        self.assertGreater(len(shown), 1)
        self.assertFalse(np.array_equal(shown[0], wanted[..., 0]))
        self.assertLess(abs(shown[-2].mean() / wanted[..., 0].mean() - 1), 0.5)

    def finished_and_shown(self, samples):
        """The picture, and the red channel of each that was shown."""
        self.scene.phasetree.samples, self.scene.phasetree.update_interval = samples, 0
        self.scene.render.threads_mode, self.scene.render.threads = "FIXED", 1
        wanted = self.combined()
        self.scene.phasetree.update_interval = 0.1
        shown = []
        show = engine.PhasetreeRenderEngine._show

        def noted(self, depsgraph, file, is_last):
            shown.append((is_last, exr.read(file)["R"]))
            show(self, depsgraph, file, is_last)

        with unittest.mock.patch.object(engine.PhasetreeRenderEngine, "_show", noted):
            got = self.combined()
        np.testing.assert_array_equal(got, wanted)
        self.assertEqual([is_last for is_last, _ in shown], [False] * (len(shown) - 1) + [True])
        return wanted, [red for _, red in shown]

    def test_two_frames_of_an_animation(self):
        cube = bpy.data.objects["Cube"]
        for frame, x in ((1, 0), (2, 3)):
            cube.location.x = x
            cube.keyframe_insert("location", frame=frame)
        self.scene.frame_start, self.scene.frame_end = 1, 2
        self.scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
        self.scene.render.image_settings.color_depth = "32"
        self.scene.render.filepath = str(self.folder / "frame_")
        bpy.ops.render.render(animation=True)
        frames = [exr.read(self.folder / f"frame_000{n}.exr") for n in (1, 2)]
        self.scene.frame_set(2)
        self.assert_equal_pixels(frames[1], self.of_command())
        self.assertFalse(np.array_equal(*(frame["ViewLayer.Combined.R"] for frame in frames)))

    def test_modifiers_instances_and_mirrored_objects(self):
        """A modifier, an instanced collection and a mirrored object look like their own triangles do."""
        cube = bpy.data.objects["Cube"]
        moved = cube.modifiers.new("Array", "ARRAY")
        moved.count, moved.use_relative_offset, moved.use_constant_offset = 2, False, True
        moved.constant_offset_displace = (0, 0, 2.5)
        collection = bpy.data.collections.new("Boxes")
        box = add_box("Box", (-3, 1, -1), (-2, 2, 0), shader("ShaderNodeBsdfDiffuse", Color=(0.8, 0.1, 0.1)))
        self.scene.collection.children.link(collection)
        for owner in list(box.users_collection):
            owner.objects.unlink(box)
        collection.objects.link(box)
        bpy.ops.object.collection_instance_add(collection="Boxes", location=(0, -3, 0))
        bpy.context.object.scale = (-1, 1, 1)
        instanced = self.combined()

        bpy.context.view_layer.objects.active = cube
        bpy.ops.object.modifier_apply(modifier="Array")
        bpy.data.objects.remove(bpy.context.scene.objects["Boxes"])
        add_box("Box", (2, -2, -1), (3, -1, 0), box.data.materials[0])
        separate = self.combined()
        self.assertLess(abs(instanced.mean() / separate.mean() - 1), 1e-3)
        self.assertGreater((np.abs(instanced - separate) < 1e-5).mean(), 0.99)

    def test_every_kind_of_object_is_rendered_once(self):
        """Curves, texts, surfaces and metaballs; instances by vertices, particles and geometry nodes."""
        made = {
            "Text": bpy.ops.object.text_add, "Curve": bpy.ops.curve.primitive_bezier_circle_add,
            "Ball": bpy.ops.object.metaball_add, "Surface": bpy.ops.surface.primitive_nurbs_surface_sphere_add,
            "Points": bpy.ops.mesh.primitive_plane_add, "Frame": bpy.ops.mesh.primitive_plane_add,
            "Field": bpy.ops.mesh.primitive_plane_add, "Nothing": bpy.ops.object.empty_add,
        }  # fmt: skip
        for name, add in made.items():
            add()
            bpy.context.object.name = name
        objects = bpy.data.objects
        objects["Curve"].data.bevel_depth = 0.1
        objects["Frame"].instance_type = "VERTS"
        bpy.ops.mesh.primitive_cube_add()
        bpy.context.object.name, bpy.context.object.parent = "Corner", objects["Frame"]
        objects["Field"].modifiers.new("Particles", "PARTICLE_SYSTEM")
        particles = objects["Field"].particle_systems[0].settings
        particles.type, particles.count, particles.render_type, particles.instance_object = "HAIR", 5, "OBJECT", objects["Cube"]
        tree = bpy.data.node_groups.new("Instances", "GeometryNodeTree")
        if hasattr(tree, "interface"):  # from Blender 4.0
            for way in ("INPUT", "OUTPUT"):
                tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
        else:
            tree.inputs.new("NodeSocketGeometry", "Geometry")
            tree.outputs.new("NodeSocketGeometry", "Geometry")
        start, end, copies, cube = (tree.nodes.new(kind) for kind in ("NodeGroupInput", "NodeGroupOutput",
                                                                     "GeometryNodeInstanceOnPoints", "GeometryNodeMeshCube"))  # fmt: skip
        tree.links.new(start.outputs[0], copies.inputs["Points"])
        tree.links.new(cube.outputs[0], copies.inputs["Instance"])
        tree.links.new(copies.outputs[0], end.inputs[0])
        objects["Points"].modifiers.new("Nodes", "NODES").node_group = tree
        self.export()
        content = (self.folder / "exported.glb").read_bytes()
        nodes = json.loads(content[20 : 20 + int.from_bytes(content[12:16], "little")])["nodes"]
        names = collections.Counter(node["name"] for node in nodes)
        self.assertEqual(dict(names), {"Cube": 1 + 5, "Text": 1, "Curve": 1, "Ball": 1, "Surface": 1, "Points": 4, "Frame": 1,
                                       "Corner": 4, "Field": 1})  # fmt: skip

    def test_view_layers(self):
        """Each view layer has its own objects."""
        second = self.scene.view_layers.new("Second")
        collection = bpy.data.objects["Cube"].users_collection[0]
        second.layer_collection.children[collection.name].exclude = True
        add_box("Other", (-1, -1, -1), (1, 1, 1), None)
        self.scene.collection.objects.link(bpy.context.object)
        collection.objects.unlink(bpy.context.object)
        rendered = self.render()
        np.testing.assert_array_less(rendered["Second.Combined.R"].mean(), rendered["ViewLayer.Combined.R"].mean())

    def test_cameras(self):
        """Each kind of camera sees a glowing square where Blender's own projection has it."""
        from bpy_extras.object_utils import world_to_camera_view
        from mathutils import Vector

        bpy.data.objects["Cube"].hide_render = True
        bpy.ops.mesh.primitive_plane_add(size=0.8, location=(0.4, -0.3, 0.6))
        dress(bpy.context.object, shader("ShaderNodeEmission", Strength=3.0))
        bpy.context.object.rotation_euler = (0.6, 0.4, 0)
        self.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
        camera, centre = self.scene.camera, Vector((0.4, -0.3, 0.6))

        def check():
            bpy.context.view_layer.update()
            place = world_to_camera_view(self.scene, camera, centre)
            picture = self.combined()[..., 0]
            height, width = picture.shape
            rows, columns = np.mgrid[0:height, 0:width] + 0.5
            self.assertGreater(picture.sum(), 10)
            seen = ((picture * columns).sum() / picture.sum() / width, 1 - (picture * rows).sum() / picture.sum() / height)
            np.testing.assert_allclose(seen, (place.x, place.y), atol=0.01)

        camera.data.shift_x, camera.data.shift_y = 0.1, -0.08
        check()
        self.scene.render.resolution_x, self.scene.render.resolution_y = 36, 48
        camera.data.sensor_fit, camera.data.sensor_height = "VERTICAL", 20
        check()
        camera.data.type, camera.data.ortho_scale, camera.data.sensor_fit = "ORTHO", 6, "AUTO"
        check()


if __name__ == "__main__":
    unittest.main()
