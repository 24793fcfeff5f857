"""What a scene file says, and what comes out: determinism, far worlds, casters, lights and cameras of files."""
import json
import os
import struct

from game import GameTest, Field, Picture, SMALL, glb_parts, main, read_bytes, without_times, write_glb


DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "shared", "data")


class Scenes(GameTest):
    def fields_of(self, *args):
        folder = self.path("fields%d" % len(os.listdir(self.folder)))
        self.run_game("--size", SMALL, "--visibility", folder, *args)
        return {name[:-4]: Field(os.path.join(folder, name)) for name in sorted(os.listdir(folder))}

    def test_two_runs_are_bit_identical(self):
        outputs = []
        for run in ("a", "b"):
            folder = self.path(run)
            os.mkdir(folder)
            self.run_game("--frames", 3, "--time", 1.5, "--size", SMALL, "--screenshot", os.path.join(folder, "p.png"),
                          "--visibility", folder, "--stats", os.path.join(folder, "s.json"))
            files = {f: read_bytes(os.path.join(folder, f)) for f in os.listdir(folder)}
            files["s.json"] = without_times(json.loads(files["s.json"]))
            outputs.append(files)
        self.assertEqual(sorted(outputs[0]), ["guard_lamp.pfm", "lantern.pfm", "p.png", "s.json", "sun.pfm"])
        for name in outputs[0]:
            self.assertEqual(outputs[0][name], outputs[1][name], name + " differs between two runs")

    def test_threads_of_the_software_device_change_no_bit(self):
        outputs = []
        for threads in ("0", "1", "3"):
            folder = self.path("threads" + threads)
            os.mkdir(folder)
            env = dict(os.environ, LP_NUM_THREADS=threads, LIBGL_ALWAYS_SOFTWARE="1")
            done = self.call("--headless", "--frames", 3, "--time", 1.5, "--size", SMALL, "--set", "splits=sampled",
                             "--screenshot", os.path.join(folder, "p.png"), "--visibility", folder, env=env)
            self.assertEqual(done.returncode, 0, done.stderr.decode(errors="replace"))
            outputs.append({name: read_bytes(os.path.join(folder, name)) for name in sorted(os.listdir(folder))})
        self.assertEqual(sorted(outputs[0]), ["guard_lamp.pfm", "lantern.pfm", "p.png", "sun.pfm"])
        for name in outputs[0]:
            for other in outputs[1:]:
                self.assertEqual(outputs[0][name], other[name], name)

    def test_the_generated_file_is_the_built_in_scene(self):
        scene = self.make_scene("courtyard.glb")
        self.run_game("--size", SMALL, "--screenshot", self.path("built_in.png"))
        self.run_game("--size", SMALL, "--screenshot", self.path("file.png"), "--scene", scene)
        self.assertEqual(read_bytes(self.path("built_in.png")), read_bytes(self.path("file.png")))

    def test_at_a_million_metres_nearly_every_pixel_sees_the_same_light(self):
        near = self.fields_of()
        far = self.fields_of("--scene", self.make_scene("far.glb", "--offset", "1e6,0,-1e6"))
        self.assertEqual(sorted(near), sorted(far))
        for name in near:
            pairs = zip(near[name].values, far[name].values)
            off = sum(1 for a, b in pairs if abs(a - b) > 0.5) / float(len(near[name].values))
            self.assertLess(off, 0.01, "%s: %.2f %% of the pixels differ" % (name, 100 * off))

    def test_without_casters_nothing_is_in_shadow_and_the_picture_differs(self):
        bare = self.make_scene("bare.glb", "--no-casters")
        lit, shaded = self.fields_of("--scene", bare), self.fields_of()
        for name in lit:
            self.assertEqual(set(lit[name].values) - {-1.0, 0.0, 1.0}, set(), name)
            self.assertGreater(lit[name].share(lambda v: v == 1.0), shaded[name].share(lambda v: v == 1.0) + 0.01, name)
        for name, args in (("with", ()), ("without", ("--scene", bare))):
            self.run_game("--size", SMALL, "--exposure", 6, "--screenshot", self.path(name + ".png"), *args)
        self.assertGreater(Picture(self.path("with.png")).mean_difference(Picture(self.path("without.png"))), 2.0)
        stats = self.stats_of("--size", SMALL, "--scene", bare)
        self.assertEqual((stats["frames"][0]["shadow"]["draws"], stats["frames"][0]["shadow"]["bytes"]), (0, 0))
        self.assertEqual({l["reason"] for l in stats["frames"][0]["lights"]}, {"no_caster"})

    def test_a_light_whose_extras_deny_the_shadow_has_no_field(self):
        document, binary = glb_parts(self.make_scene("a.glb"))
        for node in document["nodes"]:
            if node["name"] == "lantern":
                node["extras"] = {"shadow": False}
        write_glb(self.path("denied.glb"), document, binary)
        self.assertEqual(sorted(self.fields_of("--scene", self.path("denied.glb"))), ["guard_lamp", "sun"])

    def test_lights_are_named_by_node_then_light_then_index_and_stay_unique(self):
        document, binary = glb_parts(self.make_scene("a.glb"))
        lights = document["extensions"]["KHR_lights_punctual"]["lights"]
        carriers = [n for n in document["nodes"] if "KHR_lights_punctual" in n.get("extensions", {})]
        self.assertEqual([n["name"] for n in carriers], ["sun", "lantern", "guard_lamp"])
        carriers[0]["name"] = "a lamp/b"
        del carriers[1]["name"]
        lights[carriers[1]["extensions"]["KHR_lights_punctual"]["light"]]["name"] = "a lamp_b"
        del carriers[2]["name"]
        write_glb(self.path("named.glb"), document, binary)
        names = [l["name"] for l in self.stats_of("--size", "64x64", "--scene", self.path("named.glb"))["frames"][0]["lights"]]
        self.assertEqual(sorted(names), ["a_lamp_b", "a_lamp_b.1", "light2"])

    def test_a_scene_without_light_and_camera_gets_a_sun_and_a_view_of_all_of_it(self):
        scene = self.box_scene()
        file, folder = self.path("box.png"), self.path("box")
        stats = self.stats_of("--size", SMALL, "--scene", scene, "--screenshot", file, "--visibility", folder)
        self.assertEqual([(l["name"], l["kind"]) for l in stats["frames"][0]["lights"]], [("sun", "directional")])
        field = Field(os.path.join(folder, "sun.pfm"))
        self.assertGreater(field.share(lambda v: v == 1.0), 0.1)
        seen = field.share(lambda v: v >= 0.0)
        self.assertTrue(0.2 < seen < 0.95, "the box fills %.2f of the picture" % seen)
        edge = [field.values[y * 320 + x] for y in (0, 179) for x in range(320)]
        edge += [field.values[y * 320 + x] for y in range(180) for x in (0, 319)]
        self.assertEqual(set(edge), {-1.0}, "the framed box touches the rim of the picture")

    def test_a_textured_file_is_drawn_with_the_shadow_it_casts_upon_itself(self):
        scene = os.path.join(DATA, "khronos-sample-models", "Lantern", "glTF", "Lantern.gltf")
        if not os.path.exists(scene):
            self.skipTest("no khronos-sample-models/Lantern in the data folder")
        for name, extra in (("with", ()), ("without", ("--set", "enabled=off"))):
            self.run_game("--size", SMALL, "--exposure", 12, "--scene", scene, "--screenshot", self.path(name + ".png"), *extra)
        shaded, lit = Picture(self.path("with.png")), Picture(self.path("without.png"))
        self.assertEqual((shaded.width, shaded.height), (320, 180))
        self.assertGreater(shaded.shade_count(), 150, "a textured lantern has many shades")
        pairs = list(zip(shaded.luma(), lit.luma()))
        self.assertGreater(sum(1 for a, b in pairs if b > a + 8), 200, "the shadows darken nothing")
        self.assertEqual(sum(1 for a, b in pairs if a > b + 1), 0, "a shadow makes something brighter")
        field = self.fields_of("--scene", scene)["sun"]
        self.assertGreater(field.share(lambda v: v == 1.0), 0.02)
        unshadowed = self.fields_of("--scene", scene, "--set", "enabled=off")["sun"]
        self.assertGreater(field.share(lambda v: v == 0.0), unshadowed.share(lambda v: v == 0.0) + 0.002)

    def box_scene(self):
        corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        indices = [i for a, b, c, d in quads for i in (a, b, c, a, c, d)]
        binary = b"".join(struct.pack("<3f", *c) for c in corners) + struct.pack("<%dH" % len(indices), *indices)
        binary += b"\0" * (-len(binary) % 4)
        write_glb(self.path("box.glb"), {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-1, -1, -1],
                           "max": [1, 1, 1]},
                          {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96},
                            {"buffer": 0, "byteOffset": 96, "byteLength": 2 * len(indices)}],
            "buffers": [{"byteLength": len(binary)}]}, binary)
        return self.path("box.glb")


if __name__ == "__main__":
    main()
