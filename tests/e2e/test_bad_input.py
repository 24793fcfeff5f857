"""Every bad input: one line on stderr, exit code 2."""
import json
import os
import unittest

from game import GameTest, Picture, glb_parts, main, read_bytes, write_glb


class BadInput(GameTest):
    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)
        return self.path(name)

    def test_flags(self):
        rows = [
            ["--nonsense"], ["extra"], ["--headless=maybe"], ["--frames"], ["--scene", ""], ["-x"],
            ["--size", "0x0"], ["--size", "16385x720"], ["--size", "720x99999999999999999999"], ["--size", "-1x5"],
            ["--size", "1280"], ["--size", "1280x"], ["--size", "x720"], ["--size", "1280x720x2"], ["--size", "1280 x720"],
            ["--size", "12.5x7"], ["--size", "0x10x10"], ["--size", ""],
            ["--frames", "0"], ["--frames", "-3"], ["--frames", "1.5"], ["--frames", "many"], ["--frames", "1e3"],
            ["--frames", "99999999999999999999999"], ["--frames", "3", "--frames", "4"],
            ["--time", "nan"], ["--time", "inf"], ["--time", "soon"], ["--time", "1s"], ["--time", "1e300"], ["--time", ""],
            ["--exposure", "bright"], ["--exposure", "nan"], ["--exposure", "1e9"], ["--exposure", "5 "],
            ["--camera", "nobody"], ["--camera", "3"], ["--camera", "-1"], ["--camera", "18446744073709551616"],
            ["--camera", "line\nbreak"],
            ["--debug", ""], ["--debug", "depth"], ["--debug", "depth:"], ["--debug", "depth:nobody"], ["--debug", "deep:sun"],
            ["--debug", "depth:sun:9"], ["--debug", "depth:sun:"], ["--debug", "depth:sun:0:0"],
        ]
        for row in rows:
            with self.subTest(row=row):
                self.assert_refused("--headless", *row)

    def test_settings(self):
        rows = ["", "=", "filter", "filter=", "filter=soft", "filter=hard ", "Filter=hard", "colour=red", "resolution=-1",
                "resolution=4096.5", "resolution=65537", "resolution=0x10", "resolution=1024px", "max_error_px=0",
                "max_error_px=-1", "max_error_px=nan", "max_error_px=inf", "max_error_px=1e-60", "bias=-0.1",
                "bias=nan", "bias=auto", "economy=yes", "economy=1", "enabled=true", "filter=hard=hard", "a\nb=c"]
        for row in rows:
            with self.subTest(row=row):
                text = self.assert_refused("--headless", "--set", row)
                self.assertIn("--set", text)
        self.assertIn("hardware_2x2", self.assert_refused("--headless", "--set", "filter=soft"))
        self.assert_refused("--headless", "--set", "filter=hard", "resolution=64")

    def test_a_good_setting_does_not_excuse_a_bad_one(self):
        self.assert_refused("--headless", "--set", "filter=hard", "--set", "filter=harder", mentions="harder")

    def test_scene_files(self):
        good = read_bytes(self.make_scene("good.glb"))
        document, binary = glb_parts(self.path("good.glb"))
        text = json.dumps(document).encode()
        rows = {
            "missing": self.path("missing.glb"),
            "a folder": self.folder,
            "empty": self.write("empty.glb", b""),
            "wrong magic": self.write("magic.glb", b"glTX" + good[4:]),
            "no glTF at all": self.write("text.gltf", b"hello"),
            "broken JSON": self.write("broken.gltf", text[:len(text) // 2]),
            "an array": self.write("array.gltf", b"[1, 2, 3]"),
            "deep JSON": self.write("deep.gltf", b"[" * 200000),
            "missing buffer": self.write("buffer.gltf", text),
        }
        for length in (3, 11, 12, 19, 40, len(text) // 2, len(good) // 2, len(good) - 1):
            rows["first %d bytes" % length] = self.write("cut%d.glb" % length, good[:length])
        for name, file in rows.items():
            with self.subTest(name=name):
                line = self.assert_refused("--headless", "--size", "64x64", "--scene", file)
                self.assertIn(os.path.basename(file), line)

    def test_scene_contents(self):
        self.make_scene("good.glb")

        def bad(name, change):
            document, binary = glb_parts(self.path("good.glb"))
            change(document)
            write_glb(self.path(name), document, binary)
            with self.subTest(name=name):
                self.assert_refused("--headless", "--size", "64x64", "--scene", self.path(name), mentions=name)

        bad("cycle.glb", lambda d: d["nodes"][0].update(children=[len(d["nodes"]) - 1]))
        bad("mesh_index.glb", lambda d: d["nodes"][-2].update(mesh=100000))
        bad("negative_index.glb", lambda d: d["nodes"][-2].update(mesh=-1))
        bad("view_range.glb", lambda d: d["bufferViews"][3].update(byteLength=2 ** 31))
        bad("accessor_range.glb", lambda d: d["accessors"][0].update(count=2 ** 30))
        bad("infinite.glb", lambda d: d["nodes"][-1].update(translation=[float("inf"), 0, 0]))
        bad("nan.glb", lambda d: d["nodes"][-1].update(translation=[float("nan"), 0, 0]))
        bad("light_index.glb", lambda d: d["nodes"][-2].update(extensions={"KHR_lights_punctual": {"light": 77}}))

    def test_what_is_merely_outside_the_letter_is_drawn_with_a_warning(self):
        """A cone without an edge, a range of 0, a camera behind itself, and bytes after the end."""
        self.make_scene("good.glb")
        document, binary = glb_parts(self.path("good.glb"))
        lights = document["extensions"]["KHR_lights_punctual"]["lights"]
        lights[0]["range"] = 0
        lights.append({"type": "spot", "spot": {"innerConeAngle": 0.4, "outerConeAngle": 0.4}})
        document.setdefault("cameras", []).append(
            {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": -1, "zfar": 9}})
        write_glb(self.path("odd.glb"), document, binary)
        with open(self.path("odd.glb"), "ab") as file:
            file.write(b"tail")
        done = self.run_game("--frames", 1, "--size", "64x64", "--scene", self.path("odd.glb"))
        lines = done.stderr.decode().splitlines()
        for rule in ("light.range", "light.cone", "camera.near", "glb.length"):
            named = [line for line in lines if "[%s]" % rule in line]
            self.assertEqual(len(named), 1, lines)
            self.assertIn("warning: " + self.path("odd.glb") + ": ", named[0])

    def test_names_of_lights_longer_than_names_of_files(self):
        self.make_scene("good.glb")
        document, binary = glb_parts(self.path("good.glb"))
        shown = [n for n in document["nodes"] if "KHR_lights_punctual" in n.get("extensions", {})]
        for node in shown:
            node["name"] = "x" * 300
        write_glb(self.path("long.glb"), document, binary)
        folder = self.path("out")
        self.run_game("--frames", 1, "--size", "64x64", "--scene", self.path("long.glb"), "--visibility", folder)
        names = sorted(name for name in os.listdir(folder))
        self.assertGreaterEqual(len(names), 2)
        self.assertEqual(names[0], "x" * 200 + ".1.pfm")
        self.assertIn("x" * 200 + ".pfm", names)

    def test_outputs_that_cannot_be_written_are_refused_before_the_work(self):
        plain = self.write("plain", b"x")
        for flag, target in (("--screenshot", self.path("no", "such", "a.png")), ("--stats", self.path("no", "s.json")),
                             ("--screenshot", self.folder), ("--stats", self.folder), ("--visibility", plain),
                             ("--visibility", os.path.join(plain, "below")), ("--stats", os.path.join(plain, "s.json"))):
            with self.subTest(flag=flag, target=target):
                # So many frames that only a refusal before the work can meet the time limit.
                self.assert_refused("--headless", "--frames", 1000000, flag, target)
        self.assertEqual(read_bytes(plain), b"x")

    @unittest.skipUnless(os.path.exists("/dev/full"), "this machine has no /dev/full")
    def test_a_full_disk_is_an_error_and_not_silence(self):
        for flag in ("--screenshot", "--stats"):
            with self.subTest(flag=flag):
                self.assert_refused("--headless", "--size", "64x64", flag, "/dev/full")

    def test_a_refused_run_leaves_no_output_behind(self):
        self.assert_refused("--headless", "--screenshot", self.path("a.png"), "--stats", self.path("no", "s.json"))
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_window_without_a_display(self):
        named = ("DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "XDG_RUNTIME_DIR", "XDG_SESSION_TYPE")
        bare = {k: v for k, v in os.environ.items() if k not in named}
        for more in ({}, {"XDG_RUNTIME_DIR": self.folder}, {"XDG_SESSION_TYPE": "wayland"}, {"DISPLAY": ":4095"}):
            with self.subTest(**more):
                self.assert_refused("--frames", 1, env=dict(bare, **more))

    def test_a_device_without_opengl_4_5(self):
        env = dict(os.environ, MESA_GL_VERSION_OVERRIDE="3.3", MESA_LOADER_DRIVER_OVERRIDE="", LIBGL_ALWAYS_SOFTWARE="1")
        text = self.assert_refused("--headless", "--size", "64x64", env=env, mentions="docs/reference/limits.md")
        self.assertIn("OpenGL 4.5", text)

    def test_a_device_with_opengl_4_5_and_no_extension_draws(self):
        absent = "-GL_ARB_shader_viewport_layer_array -GL_EXT_texture_filter_anisotropic -GL_ARB_texture_filter_anisotropic"
        env = dict(os.environ, MESA_GL_VERSION_OVERRIDE="4.5", MESA_EXTENSION_OVERRIDE=absent, LIBGL_ALWAYS_SOFTWARE="1")
        draws = []
        for each, name in ((dict(env, MESA_EXTENSION_OVERRIDE=""), "with"), (env, "without")):
            args = ("--size", "64x64", "--set", "cube_route=layered_vertex", "--stats", self.path(name + ".json"))
            done = self.call("--headless", "--screenshot", self.path(name + ".png"), *args, env=each)
            self.assertEqual(done.returncode, 0, done.stderr.decode(errors="replace"))
            with open(self.path(name + ".json"), encoding="utf-8") as text:
                draws.append({l["name"]: l["draws"] for l in json.load(text)["frames"][0]["lights"]})
        self.assertEqual(Picture(self.path("with.png")).rgba, Picture(self.path("without.png")).rgba)
        self.assertGreater(draws[1]["lantern"], draws[0]["lantern"], "control: the extension was there, and is absent")


if __name__ == "__main__":
    main()
