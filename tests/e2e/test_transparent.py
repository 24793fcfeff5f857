"""Pictures without a background: --transparent, and shadow catchers of a file."""
from game import GameTest, Picture, SMALL, glb_parts, main, read_bytes, write_glb


def alphas(picture):
    return picture.rgba[3::4]


class Transparent(GameTest):
    def picture_of(self, name, *args):
        file = self.path(name + ".png")
        self.run_game("--size", SMALL, "--exposure", 6, "--screenshot", file, *args)
        return Picture(file)

    def scene_with(self, name, change, *args):
        """A scene of the generator with `change` applied to each node with a mesh. Returns its file."""
        document, binary = glb_parts(self.make_scene(name + "_source.glb", *args))
        for node in document["nodes"]:
            if "mesh" in node:
                change(node)
        file = self.path(name + ".glb")
        write_glb(file, document, binary)
        return file

    def test_without_the_flag_the_picture_is_opaque_and_with_it_surfaces_are_the_same(self):
        opaque, clear = self.picture_of("opaque"), self.picture_of("clear", "--transparent")
        self.assertEqual(set(alphas(opaque)), {255})
        self.assertEqual(set(alphas(clear)), {0, 255}, "the courtyard has surfaces and sky")
        for i in range(0, len(clear.rgba), 4):
            if clear.rgba[i + 3]:
                self.assertEqual(clear.rgba[i:i + 3], opaque.rgba[i:i + 3])
            else:
                self.assertEqual(clear.rgba[i:i + 3], b"\0\0\0")

    def test_catchers_are_black_with_the_shadows_as_alpha(self):
        def catch(node):
            node.setdefault("extras", {})["shadowCatcher"] = True

        def catch_without_casters(node):
            catch(node)
            node["extras"]["castShadow"] = False

        caught = self.picture_of("caught", "--transparent", "--scene", self.scene_with("caught", catch))
        self.assertEqual({caught.rgba[i + c] for i in range(0, len(caught.rgba), 4) for c in range(3)}, {0})
        dark = sum(alpha > 40 for alpha in alphas(caught))
        self.assertGreater(dark, len(caught.rgba) // 4 // 50, "the courtyard's shadows")
        self.assertGreater(sum(alpha == 0 for alpha in alphas(caught)), len(caught.rgba) // 4 // 20)
        none = self.picture_of("none", "--transparent", "--scene", self.scene_with("none", catch_without_casters))
        self.assertEqual(set(alphas(none)), {0}, "nothing casts")

    def test_samples_smooth_the_alpha_of_edges_and_stay_straight(self):
        many = self.picture_of("many", "--transparent", "--samples", 8)
        between = [i for i in range(0, len(many.rgba), 4) if 0 < many.rgba[i + 3] < 255]
        self.assertGreater(len(between), 50)
        bright = sum(max(many.rgba[i:i + 3]) > many.rgba[i + 3] for i in between)
        self.assertGreater(bright, 0, "PNG has colours that are not multiplied by alpha")

    def test_two_runs_are_equal(self):
        for name in ("a", "b"):
            self.picture_of(name, "--transparent")
        self.assertEqual(read_bytes(self.path("a.png")), read_bytes(self.path("b.png")))


if __name__ == "__main__":
    main()
