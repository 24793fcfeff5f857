"""Mist in the sample's lights: --mist."""
import json

from game import GameTest, Picture, SMALL, main, read_bytes


class Mist(GameTest):
    def shown(self, name, *args):
        self.run_game("--size", SMALL, "--exposure", 10, "--screenshot", self.path(name + ".png"), "--stats", self.path(name + ".json"), *args)
        return Picture(self.path(name + ".png"))

    def lights(self, name):
        with open(self.path(name + ".json"), encoding="utf-8") as file:
            return {light["name"]: light for light in json.load(file)["frames"][-1]["lights"]}

    def test_none_is_the_picture_without_the_flag(self):
        self.shown("plain")
        self.shown("none", "--mist", 0)
        self.assertEqual(read_bytes(self.path("plain.png")), read_bytes(self.path("none.png")))

    def test_more_of_it_hides_more(self):
        pictures = [self.shown("mist%d" % i, "--mist", share) for i, share in enumerate((0, 0.05, 0.5, 5))]

        def spread(picture):
            """The mean difference of pixels in a row."""
            reds = picture.rgba[0::4]
            return sum(abs(a - b) for a, b in zip(reds, reds[1:])) / len(reds)
        spreads = [spread(picture) for picture in pictures]
        for thinner, thicker in zip(pictures, pictures[1:]):
            self.assertNotEqual(thinner.rgba, thicker.rgba)
        self.assertLess(spreads[3], 0.5 * spreads[0], "in thick mist surfaces are gone")

    def test_every_light_with_a_map_keeps_it(self):
        self.shown("plain")
        self.shown("mist", "--mist", 0.05)
        plain, mist = self.lights("plain"), self.lights("mist")
        self.assertEqual(plain.keys(), mist.keys())
        for name, light in plain.items():
            if light["state"] == "rendered":
                self.assertEqual(mist[name]["state"], "rendered", name)

    def test_two_runs_are_equal(self):
        for name in ("a", "b"):
            self.shown(name, "--mist", 0.05, "--frames", 2)
        self.assertEqual(read_bytes(self.path("a.png")), read_bytes(self.path("b.png")))


if __name__ == "__main__":
    main()
