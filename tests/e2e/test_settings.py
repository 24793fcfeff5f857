"""--set changes what it names, and only that."""
import os

from game import GameTest, Field, SMALL, main


class Settings(GameTest):
    def lights_of(self, *args, frame=-1):
        return {l["name"]: l for l in self.stats_of("--size", SMALL, *args)["frames"][frame]["lights"]}

    def fields_of(self, *args):
        folder = self.path("fields%d" % len(os.listdir(self.folder)))
        self.run_game("--size", SMALL, "--visibility", folder, *args)
        return {name[:-4]: Field(os.path.join(folder, name)) for name in os.listdir(folder)}

    def test_resolution_fixes_the_texels_of_every_map(self):
        small, large = (self.lights_of("--set", "resolution=%d" % n) for n in (128, 512))
        self.assertEqual(small["lantern"]["texels"], 6 * 128 * 128)
        self.assertEqual(large["lantern"]["texels"], 6 * 512 * 512)
        self.assertEqual(small["guard_lamp"]["texels"], 128 * 128)
        for name in small:
            self.assertEqual(large[name]["texels"], 16 * small[name]["texels"], name)
            self.assertGreater(large[name]["bytes"], small[name]["bytes"], name)
            self.assertGreater(small[name]["resolved_px"], large[name]["resolved_px"], name)
            self.assertGreater(small[name]["resolved_m"], large[name]["resolved_m"], name)
        small, large = (self.lights_of("--set", "filter=hard", "--set", "resolution=%d" % n) for n in (128, 512))
        for name in small:
            self.assertGreater(small[name]["predicted_error_px"], large[name]["predicted_error_px"], name)

    def test_a_hard_filter_knows_only_lit_and_dark(self):
        for name, field in self.fields_of("--set", "filter=hard", "--set", "cascade_blend=0").items():
            self.assertEqual(set(field.values) - {-1.0, 0.0, 1.0}, set(), name)

    def test_soft_filters_have_values_between(self):
        for kind in ("hardware_2x2", "pcf_grid"):
            fields = self.fields_of("--set", "filter=" + kind, "--set", "resolution=256")
            for name, field in fields.items():
                self.assertGreater(field.share(lambda v: 0.01 < v < 0.99), 0.001, "%s of %s" % (kind, name))

    def test_economy_off_draws_still_maps_again_and_changes_no_value(self):
        still = ("--frames", 4, "--scene", self.still_scene())
        on = self.stats_of("--size", SMALL, *still)["frames"]
        off = self.stats_of("--size", SMALL, "--set", "economy=off", *still)["frames"]
        self.assertGreater(on[0]["shadow"]["draws"], 0)
        self.assertEqual(on[0]["shadow"]["draws"], off[0]["shadow"]["draws"])
        self.assertEqual(on[-1]["shadow"]["draws"], 0)
        self.assertEqual({l["state"] for l in on[-1]["lights"]}, {"reused"})
        self.assertEqual(off[-1]["shadow"]["draws"], off[0]["shadow"]["draws"])
        kept = [light["kept"] for light in on[-1]["lights"]]
        self.assertEqual({k["reason"] for k in kept}, {"visibility_kept"})
        self.assertEqual({light["kept"] for light in off[-1]["lights"]}, {None})
        self.assertEqual(on[-1]["shadow"]["bytes"] - sum(k["bytes"] for k in kept), off[-1]["shadow"]["bytes"])
        with_economy = self.fields_of(*still)
        without = self.fields_of("--set", "economy=off", *still)
        for name, field in with_economy.items():
            self.assertEqual(field.values, without[name].values, name)

    def still_scene(self):
        from game import glb_parts, write_glb
        document, binary = glb_parts(self.make_scene("moving.glb"))
        for node in document["nodes"]:
            node.get("extras", {}).pop("motion", None)
        document.pop("animations")
        write_glb(self.path("still.glb"), document, binary)
        return self.path("still.glb")

    def test_enabled_off_lights_everything_that_faces_the_light(self):
        on, off = self.fields_of(), self.fields_of("--set", "enabled=off")
        for name in on:
            self.assertEqual(set(off[name].values) - {-1.0, 0.0, 1.0}, set(), name)
            self.assertGreater(off[name].share(lambda v: v == 1.0), on[name].share(lambda v: v == 1.0) + 0.01, name)
        lights = self.lights_of("--set", "enabled=off")
        for light in lights.values():
            self.assertEqual((light["state"], light["reason"], light["draws"], light["bytes"]),
                             ("skipped", "shadows_off", 0, 0))

    def test_a_finer_error_bound_never_asks_for_fewer_texels(self):
        fine, coarse = (self.lights_of("--set", "filter=triangles", "--set", "max_error_px=%s" % e)
                        for e in ("0.25", "16"))
        for name in fine:
            self.assertGreaterEqual(fine[name]["texels"], coarse[name]["texels"], name)

    def test_a_word_that_no_usual_map_keeps_is_kept_by_another_filter(self):
        for name, light in self.lights_of("--set", "max_error_px=0.25").items():
            self.assertEqual((light["filter"]["name"], light["filter"]["reason"]), ("exact", "map_too_coarse"), name)
            self.assertGreater(light["filter"]["usual_error_px"], 0.25, name)
            self.assertTrue(light["keeps_max_error"], name)
        for name, light in self.lights_of("--set", "max_error_px=1").items():
            self.assertEqual((light["filter"]["name"], light["keeps_max_error"]), ("triangles", True), name)
        for name, light in self.lights_of("--set", "narrowest_caster_px=0.05").items():
            self.assertEqual((light["filter"]["name"], light["filter"]["reason"]), ("exact", "map_too_coarse"), name)
            self.assertGreater(light["filter"]["usual_resolved_px"], 0.05, name)
            self.assertTrue(light["keeps_narrowest_caster"], name)
        for name, light in self.lights_of().items():
            self.assertEqual((light["filter"]["name"], light["filter"]["reason"]), ("triangles", "none"), name)

    def test_a_constant_bias_of_nothing_shows_acne_that_the_automatic_one_does_not(self):
        args = ("--set", "filter=hard", "--set", "resolution=256")
        automatic, constant = self.fields_of(*args), self.fields_of("--set", "bias=0", *args)
        lit = lambda field: field.share(lambda v: v == 1.0)
        self.assertGreater(lit(automatic["sun"]), lit(constant["sun"]) + 0.02)

    def test_every_key_reaches_every_light(self):
        plain = self.fields_of("--set", "filter=hard", "--set", "resolution=256")
        self.assertEqual(len(plain), 3)
        for change in ("filter=pcf_grid", "resolution=64", "bias=0", "enabled=off"):
            changed = self.fields_of("--set", "filter=hard", "--set", "resolution=256", "--set", change)
            self.assertEqual(sorted(plain), sorted(changed))
            for name, field in plain.items():
                off = sum(1 for a, b in zip(field.values, changed[name].values) if a != b) / float(len(field.values))
                self.assertGreater(off, 0.001, "%s changes nothing of %s" % (change, name))
        plain = self.lights_of("--set", "max_error_px=1")
        for light in self.lights_of("--set", "economy=off", "--frames", 3).values():
            self.assertNotEqual(light["state"], "reused", light["name"])
        self.assertEqual(len(plain), 3)

    def test_the_last_of_repeated_keys_counts(self):
        lights = self.lights_of("--set", "resolution=64", "--set", "filter=hard", "--set", "resolution=128")
        self.assertEqual(lights["guard_lamp"]["texels"], 128 * 128)


if __name__ == "__main__":
    main()
