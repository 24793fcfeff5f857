"""Every flag of the command line, headless, on the built-in scene."""
import os

from game import GameTest, Field, Picture, SMALL, main

LIGHTS = {"sun": "directional", "lantern": "point", "guard_lamp": "spot"}
FRAME_KEYS = {"cpu_us", "gpu_us", "shadow", "lights"}
SHADOW_KEYS = {"cpu_us", "gpu_us", "views", "draws", "clears", "triangles", "bytes"}
LIGHT_KEYS = {"name", "kind", "state", "reason", "predicted_error_px", "views", "texels", "bytes", "draws", "cpu_us",
              "gpu_us"}
STATES = {"rendered", "reused", "degraded", "skipped"}


class Flags(GameTest):
    def test_screenshot_has_the_asked_size_and_is_not_flat(self):
        file = self.path("a.png")
        self.run_game("--frames", 3, "--size", "322x181", "--screenshot", file)
        picture = Picture(file)
        self.assertEqual((picture.width, picture.height), (322, 181))
        self.assertGreater(picture.shade_count(), 500)
        luma = sorted(picture.luma())
        dark, bright = luma[len(luma) // 20], luma[-len(luma) // 20]
        self.assertGreater(bright - dark, 40.0, "automatic exposure shows neither light nor shade")

    def test_default_size_and_one_frame(self):
        file = self.path("a.png")
        stats = self.stats_of("--screenshot", file)
        self.assertEqual(len(stats["frames"]), 1)
        picture = Picture(file)
        self.assertEqual((picture.width, picture.height), (1280, 720))

    def test_visibility_writes_one_field_per_light_with_values_in_range(self):
        folder = self.path("deep", "visibility")
        self.run_game("--size", SMALL, "--visibility", folder)
        self.assertEqual(sorted(os.listdir(folder)), sorted(name + ".pfm" for name in LIGHTS))
        for name in LIGHTS:
            field = Field(os.path.join(folder, name + ".pfm"))
            self.assertEqual((field.width, field.height), (320, 180))
            self.assertTrue(all(v == -1.0 or 0.0 <= v <= 1.0 for v in field.values), name)
            self.assertGreater(field.share(lambda v: v >= 0.999), 0.01, name + " lights nothing")
            self.assertGreater(field.share(lambda v: v == 0.0), 0.05, name + " shades nothing")
            self.assertGreater(field.share(lambda v: v >= 0.0), 0.5, name + " sees no surface")

    def test_stats_hold_the_promised_keys_for_every_frame_and_light(self):
        stats = self.stats_of("--frames", 3, "--size", SMALL)
        self.assertTrue(stats["device"])
        self.assertEqual(len(stats["frames"]), 3)
        for frame in stats["frames"]:
            self.assertLessEqual(FRAME_KEYS, set(frame))
            self.assertLessEqual(SHADOW_KEYS, set(frame["shadow"]))
            self.assertEqual({l["name"]: l["kind"] for l in frame["lights"]}, LIGHTS)
            self.assertGreater(frame["cpu_us"], 0)
            for light in frame["lights"]:
                self.assertLessEqual(LIGHT_KEYS, set(light))
                self.assertIn(light["state"], STATES)
                self.assertRegex(light["reason"], r"^[a-z_]+$")
                for key in ("views", "texels", "bytes", "draws", "predicted_error_px"):
                    self.assertGreaterEqual(light[key], 0)
            for key in ("draws", "bytes"):
                self.assertEqual(frame["shadow"][key], sum(l[key] for l in frame["lights"]), key)
        first = stats["frames"][0]
        self.assertTrue(all(l["state"] == "rendered" and l["draws"] > 0 for l in first["lights"]), first["lights"])
        self.assertEqual({l["name"]: l["views"] for l in first["lights"]}["lantern"], 6)
        self.assertEqual(first["shadow"]["views"], first["shadow"]["clears"])

    def test_programs_are_compiled_in_the_first_frame(self):
        first, second = (f["programs_compiled"] for f in self.stats_of("--size", SMALL, "--frames", 2)["frames"])
        self.assertGreater(first, 5)
        self.assertEqual(second, 0)

    def test_frames_end_at_the_asked_time(self):
        times = [f["time_s"] for f in self.stats_of("--frames", 3, "--time", 2.5, "--size", SMALL)["frames"]]
        self.assertEqual(len(times), 3)
        for got, wanted in zip(times, (2.5 - 2 / 60.0, 2.5 - 1 / 60.0, 2.5)):
            self.assertAlmostEqual(got, wanted, places=12)
        times = [f["time_s"] for f in self.stats_of("--frames", 2, "--size", SMALL)["frames"]]
        self.assertAlmostEqual(times[0], 0.0, places=12)
        self.assertAlmostEqual(times[1], 1 / 60.0, places=12)

    def test_time_moves_the_casters_and_nothing_else(self):
        for name, args in (("a", ("--time", 0)), ("b", ("--time", 0)), ("c", ("--time", 1.3))):
            self.run_game("--size", SMALL, "--exposure", 6, "--screenshot", self.path(name + ".png"), *args)
        a, b, c = (Picture(self.path(n + ".png")) for n in "abc")
        self.assertEqual(a.rgba, b.rgba)
        self.assertGreater(a.mean_difference(c), 0.5)

    def test_the_same_time_gives_the_same_picture_however_many_frames_led_to_it(self):
        for name, frames in (("one", 1), ("many", 4)):
            self.run_game("--size", SMALL, "--exposure", 6, "--time", 1, "--frames", frames, "--screenshot",
                          self.path(name + ".png"))
        one, many = Picture(self.path("one.png")), Picture(self.path("many.png"))
        self.assertLess(one.mean_difference(many), 0.25)

    def test_cameras_are_chosen_by_name_and_by_index(self):
        for name, camera in (("main", "main"), ("zero", "0"), ("low", "low"), ("top", "1")):
            self.run_game("--size", SMALL, "--camera", camera, "--screenshot", self.path(name + ".png"))
        self.run_game("--size", SMALL, "--screenshot", self.path("default.png"))
        pictures = {n: Picture(self.path(n + ".png")) for n in ("main", "zero", "low", "top", "default")}
        self.assertEqual(pictures["main"].rgba, pictures["zero"].rgba)
        self.assertEqual(pictures["main"].rgba, pictures["default"].rgba)
        self.assertGreater(pictures["main"].mean_difference(pictures["low"]), 5.0)
        self.assertGreater(pictures["main"].mean_difference(pictures["top"]), 5.0)

    def test_a_higher_exposure_value_is_darker(self):
        mean = {}
        for ev in (4, 6, 8, "auto"):
            file = self.path("%s.png" % ev)
            self.run_game("--size", SMALL, "--exposure", ev, "--screenshot", file)
            luma = Picture(file).luma()
            mean[ev] = sum(luma) / len(luma)
        self.assertGreater(mean[4], mean[6] + 5.0)
        self.assertGreater(mean[6], mean[8] + 5.0)
        self.assertTrue(30.0 < mean["auto"] < 200.0, mean)

    def test_list_names_every_key_and_filter(self):
        done = self.call("--list")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        text = done.stdout.decode()
        for word in ("enabled", "filter", "resolution", "max_error_px", "bias", "economy", "hard", "hardware_2x2",
                     "pcf_grid", "sharp_4x4", "automatic", "depth"):
            self.assertRegex(text, r"\b%s\b" % word)

    def test_help_is_no_error(self):
        done = self.call("--help")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        for flag in ("--scene", "--camera", "--size", "--headless", "--frames", "--time", "--exposure", "--stats",
                     "--screenshot", "--visibility", "--set", "--debug", "--fit-camera", "--list"):
            self.assertIn(flag, done.stdout.decode())


if __name__ == "__main__":
    main()
