"""The last frame against ray-traced truth, headless: --truth, beside the bench's own figures; and presets."""
import json
import os
import subprocess
import sys
import unittest

from game import LONG, GameTest, Picture, SMALL, TIMEOUT_S, glb_parts, main, write_glb

AT = ("--size", SMALL, "--frames", "2", "--time", "3")
# What both count, as well as scored, ambiguous and differently covered pixels. Each traces the truth by its own tree and
# its own test.
ERRORS = ("wrong_px", "false_shadow_px", "false_light_px", "uncovered_px", "acne_px", "leak_px")

# Share of pixels at which picture and ray may see different surfaces.
SILHOUETTES = 0.0005
# Of the one colour in the legend: a square as high as a line.
LEGEND_PX = 13 * 13


def pure(picture, channel):
    """Pixels in which one channel is far above both others."""
    rgb = zip(picture.rgba[0::4], picture.rgba[1::4], picture.rgba[2::4])
    return sum(1 for p in rgb if 2 * p[channel] > 3 * max(p[:channel] + p[channel + 1:]) + 80)


class Truth(GameTest):
    bench = None

    # What judged() found, by its arguments: several tests compare with the same frame.
    known = {}

    def judged(self, *args):
        """(figures by light, picture with the errors over it)"""
        if args not in self.known:
            self.known[args] = self.judge(*args)
        return self.known[args]

    def judge(self, *args):
        file = self.path("truth_%d.png" % len(os.listdir(self.folder)))
        stats = self.stats_of(*AT, "--truth", file, *args)
        lights = {light["name"]: light for light in stats["truth"]["lights"]}
        shadowed = [light["name"] for light in stats["frames"][-1]["lights"]]
        self.assertEqual(list(lights), shadowed)
        return lights, Picture(file)

    def bench_figures(self, *args):
        file = self.path("bench.json")
        subprocess.run([self.bench, "accuracy", "--size", SMALL, "--time", "3", "--repeat", "0", "--json", file] +
                       list(args), check=True, stdout=subprocess.DEVNULL, timeout=TIMEOUT_S)
        with open(file, encoding="utf-8") as text:
            return {light["name"]: light for light in json.load(text)["lights"]}

    def test_the_figures_are_those_of_the_bench(self):
        for settings in ((), ("--set", "filter=hard", "--set", "resolution=512")):
            mine, _ = self.judged(*settings)
            theirs = self.bench_figures(*settings)
            self.assertEqual(sorted(mine), sorted(theirs))
            for name, light in mine.items():
                self.assertGreater(light["scored_px"], 1000, name)
                # The bench leaves out where the picture shows another surface than the ray meets; the game cannot tell.
                other = theirs[name]["other_surface_px"]
                self.assertLess(other, SILHOUETTES * light["scored_px"], name)
                self.assertEqual(light["scored_px"], theirs[name]["scored_px"] + other, name)
                self.assertEqual(light["ambiguous_px"], theirs[name]["ambiguous_px"] - other, name)
                self.assertEqual(light["coverage_mismatch_px"], theirs[name]["coverage_mismatch_px"], name)
                more = {key: light[key] - theirs[name][key] for key in ERRORS}
                for key, pixels in more.items():
                    self.assertTrue(0 <= pixels <= other, "%s of %s, %s: %d more" % (key, name, settings, pixels))
                self.assertEqual(more["wrong_px"], more["false_shadow_px"] + more["false_light_px"] + more["uncovered_px"])
                self.assertLessEqual(more["acne_px"], more["false_shadow_px"], name)
                self.assertLessEqual(more["leak_px"], more["false_light_px"], name)
                for key, value in light["edge"].items():
                    self.assertAlmostEqual(value, theirs[name]["edge"][key], 6, "%s of %s" % (key, name))

    def test_a_scene_without_casters_is_lit_as_it_should_be(self):
        file = self.make_scene("courtyard.glb")
        document, binary = glb_parts(file)
        for node in document["nodes"]:
            node.setdefault("extras", {})["castShadow"] = False
        write_glb(file, document, binary)
        figures, picture = self.judged("--scene", file)
        for name, light in figures.items():
            self.assertGreater(light["scored_px"], 1000, name)
            self.assertEqual(light["false_light_px"] + light["uncovered_px"], 0, name)
            # At a few pixels on silhouettes the picture shows a surface that faces away, and the ray meets another.
            self.assertLess(light["wrong_px"], SILHOUETTES * light["scored_px"], name)
            self.assertEqual(light["edge"]["places"], 0, name)
        self.assertLessEqual(pure(picture, 2), LEGEND_PX)
        plain, _ = self.judged()
        self.assertGreater(sum(light["wrong_px"] for light in plain.values()), 0)
        self.assertGreater(min(light["edge"]["places"] for light in plain.values()), 100)

    @unittest.skipUnless(LONG, "long runs only: gl_truth.MeanErrorGate judges such filters in each")
    def test_a_filter_that_reads_the_sources_size_is_judged_by_all_of_it(self):
        sized = ("--set", "source_radius_m=0.05", "--set", "sun_radius_deg=1", "--set", "resolution=1024")
        hard, _ = self.judged(*sized)
        taps, taps_picture = self.judged(*sized, "--set", "filter=pcss")
        rays, rays_picture = self.judged(*sized, "--set", "filter=exact_soft")
        bench = self.bench_figures(*sized, "--set", "filter=pcss")
        for name, light in taps.items():
            self.assertIn("wrong_px", hard[name], "a filter that takes a point is judged by the middle")
            self.assertNotIn("wrong_px", light)
            self.assertGreater(light["penumbra_px"], 100, name)
            self.assertLess(rays[name]["mean_error"], 0.5 * light["mean_error"], name)
            for key in ("mean_error", "penumbra_error", "umbra_leak"):
                theirs = bench[name]["soft"][key]
                self.assertAlmostEqual(light[key], theirs, delta=0.1 * theirs + 0.002, msg="%s of %s" % (key, name))
        self.assertGreater(pure(taps_picture, 2), pure(rays_picture, 2) + 100)

    def test_antialiased_edges_are_judged_by_the_lit_share_of_pixels_areas(self):
        plain, _ = self.judged()
        smooth, picture = self.judged("--set", "antialias=on")
        for name, light in smooth.items():
            self.assertEqual((plain[name]["judged_by"], light["judged_by"]), ("middle", "area"), name)
            self.assertGreater(light["penumbra_px"], 1000, name)
            self.assertLess(light["penumbra_error"], 0.1, "a half-lit pixel beside an edge is no error")
            self.assertLess(light["false_shadow_px"] + light["false_light_px"], 0.02 * light["penumbra_px"], name)
        shifted, shifted_picture = self.judged("--set", "antialias=on", "--set", "bias=5")
        self.assertGreater(pure(shifted_picture, 2), pure(picture, 2) + 1000)
        for name, light in shifted.items():
            self.assertGreater(light["penumbra_error"], 2.0 * smooth[name]["penumbra_error"], "the control")
        taps, _ = self.judged("--set", "antialias=on", "--set", "filter=hard")
        self.assertEqual({light["judged_by"] for light in taps.values()}, {"middle"}, "hard shows no areas")
        if not LONG:
            return
        for name, theirs in self.bench_figures("--set", "antialias=on").items():
            area = theirs["area"]
            self.assertTrue(area["shown"], name)
            crossed = area["crossed_px"] + area["partial_px"]
            error = (area["crossed_px"] * area["mean_error"] + area["partial_px"] * area["partial_error"]) / crossed
            self.assertAlmostEqual(smooth[name]["penumbra_px"], crossed, delta=0.03 * crossed, msg=name)
            self.assertAlmostEqual(smooth[name]["penumbra_error"], error, delta=0.05 * error, msg=name)

    def test_a_bias_that_is_wrong_shows_as_false_light_or_as_false_shadow(self):
        fair, fair_picture = self.judged()
        far, far_picture = self.judged("--set", "bias=5")
        none, none_picture = self.judged("--set", "filter=hard", "--set", "bias=0")
        for name in fair:
            self.assertGreater(far[name]["false_light_px"], 20 * fair[name]["wrong_px"] + 100, name)
            self.assertGreater(none[name]["false_shadow_px"], 20 * fair[name]["wrong_px"] + 100, name)
            self.assertGreater(none[name]["acne_px"], 100, name)
        self.assertGreater(pure(far_picture, 2), pure(fair_picture, 2) + 1000)
        self.assertGreater(pure(none_picture, 0), pure(fair_picture, 0) + 1000)

    def test_colours_behind_glass_are_judged_by_rays(self):
        panes = "--scene", "panes"
        by_maps, by_rays, coarse, none = (self.judged(*panes, *settings)[0]["spot"] for settings in (
            (), ("--set", "filter=exact"), ("--set", "resolution=64"), ("--set", "translucent_casters=off")))
        for light in by_maps, by_rays, coarse:
            self.assertGreater(light["tint"]["tinted_px"], 1000)
        self.assertLess(by_maps["tint"]["tinted_error"], 2.0 / 255.0)
        self.assertLess(by_rays["tint"]["tinted_error"], 0.5 * by_maps["tint"]["tinted_error"])
        self.assertGreater(coarse["tint"]["tinted_error"], 3.0 * by_maps["tint"]["tinted_error"])
        self.assertNotIn("tint", none)
        self.assertNotIn("tint", self.judged()[0]["sun"], "the courtyard has no glass")

    def test_one_lights_errors_can_be_shown_alone(self):
        wrong = ("--set", "bias=5")
        _, worst = self.judged(*wrong)
        pictures = [self.judged(*wrong, "--truth-light", name)[1] for name in ("sun", "lantern", "guard_lamp")]
        for picture in pictures:
            self.assertLess(pure(picture, 2), pure(worst, 2))
            self.assertGreater(pure(picture, 2), 100)
        self.assertNotEqual(pictures[0].rgba, pictures[1].rgba)

    def test_the_screenshot_stays_without_errors_and_stats_without_truth_have_none(self):
        for name, truth in (("with.png", ("--truth", self.path("t.png"))), ("without.png", ())):
            self.run_game(*AT, "--screenshot", self.path(name), *truth)
        self.assertEqual(Picture(self.path("with.png")).rgba, Picture(self.path("without.png")).rgba)
        self.assertNotIn("truth", self.stats_of(*AT))

    def test_what_cannot_be_is_one_clear_line(self):
        self.assert_refused("--headless", "--truth", self.path("no", "folder.png"), mentions="cannot write")
        self.assert_refused("--headless", "--truth", self.path("t.png"), "--truth-light", "moon", mentions="moon")
        self.assert_refused("--headless", "--truth-light", "sun", mentions="--truth-light")


class Presets(GameTest):
    def wrong_and_bytes(self, *args):
        stats = self.stats_of(*AT, "--truth", self.path("t.png"), *args)
        return (sum(light["wrong_px"] for light in stats["truth"]["lights"]),
                sum(light["bytes"] for light in stats["frames"][-1]["lights"]))

    def test_high_is_right_where_fast_is_not_and_default_is_what_nothing_says(self):
        fast, high = self.wrong_and_bytes("--preset", "fast"), self.wrong_and_bytes("--preset", "high")
        default = self.wrong_and_bytes("--preset", "default")
        self.assertEqual(default, self.wrong_and_bytes())
        self.assertLess(4 * high[0], default[0])
        self.assertLess(2 * default[0], fast[0])

    def test_a_setting_goes_before_the_preset_and_an_unknown_one_is_refused(self):
        changed = self.wrong_and_bytes("--set", "resolution=256", "--preset", "fast")
        self.assertLess(changed[1], self.wrong_and_bytes("--preset", "fast")[1] // 8)
        self.assert_refused("--headless", "--preset", "ultra", mentions="ultra")


if __name__ == "__main__":
    Truth.bench = os.path.abspath(sys.argv.pop(3))
    main()
