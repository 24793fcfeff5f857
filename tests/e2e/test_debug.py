"""Debug views, headless: --debug."""
from depth_view import TITLE, Region, background, grey, nothing
from game import GameTest, Picture, main

WIDTH, HEIGHT = 640, 360


class Debug(GameTest):
    def view(self, request, *args):
        file = self.path(request.replace(":", "_") + ".png")
        self.run_game("--size", "%dx%d" % (WIDTH, HEIGHT), "--frames", 2, "--time", 3, "--debug", request, "--screenshot",
                      file, *args)
        return Picture(file)

    def test_a_lantern_is_unfolded_in_a_cross_of_six_faces(self):
        picture = self.view("depth:lantern")
        edge = min(WIDTH // 4, (HEIGHT - TITLE) // 3)
        left, top = (WIDTH - 4 * edge) // 2, TITLE + (HEIGHT - TITLE - 3 * edge) // 2
        cell = lambda column, row: Region(picture, left + column * edge + 1, top + row * edge + 1, edge - 2, edge - 2)
        for column, row in ((1, 0), (0, 1), (1, 1), (2, 1), (3, 1), (1, 2)):
            face = cell(column, row)
            self.assertGreater(face.share(lambda p: grey(p) or nothing(p)), 0.97, (column, row))
            self.assertGreater(face.shades(), 20 if row == 1 else 2, (column, row))
        for column, row in ((0, 0), (2, 0), (3, 0), (0, 2), (2, 2), (3, 2)):
            self.assertGreater(cell(column, row).share(background), 0.99, (column, row))
        # Above are the lantern's roof, close to the light, and the sky; below is the ground.
        self.assertGreater(cell(1, 0).share(nothing), 0.2)
        self.assertGreater(cell(1, 0).share(lambda p: p[0] < 5), 0.2)
        self.assertLess(cell(1, 2).share(nothing), 0.05)

    def test_a_spot_is_one_map_and_a_sun_several_and_one_can_be_chosen(self):
        edge = HEIGHT - TITLE
        spot = Region(self.view("depth:guard_lamp"), (WIDTH - edge) // 2, TITLE, edge, edge)
        self.assertGreater(spot.share(lambda p: grey(p) or nothing(p)), 0.99)
        self.assertGreater(spot.shades(), 30)
        sun, one = (self.view(view, "--set", "cascades=4") for view in ("depth:sun", "depth:sun:1"))
        alone = Region(one, (WIDTH - edge) // 2, TITLE, edge, edge)
        self.assertGreater(alone.shades(), 30)
        self.assertGreater(sun.mean_difference(one), 10.0)

    def test_a_suns_cascades_and_a_lanterns_faces_tint_what_they_serve(self):
        plain = self.path("plain.png")
        self.run_game("--size", "%dx%d" % (WIDTH, HEIGHT), "--frames", 2, "--time", 3, "--screenshot", plain)
        plain = Picture(plain)
        below_words = lambda picture: Region(picture, 0, 7 * TITLE, WIDTH, HEIGHT - 7 * TITLE)
        sun, lantern = self.view("cascades:sun"), self.view("cascades:lantern")
        for picture in (sun, lantern):
            changed = sum(a != b for a, b in zip(below_words(picture).pixels, below_words(plain).pixels))
            self.assertGreater(changed, 0.3 * len(below_words(plain).pixels))
        self.assertGreater(sun.mean_difference(lantern), 10.0)

    def test_every_view_changes_the_picture_and_no_two_are_alike(self):
        plain = self.path("plain.png")
        self.run_game("--size", "%dx%d" % (WIDTH, HEIGHT), "--frames", 2, "--time", 3, "--screenshot", plain)
        pictures = [Picture(plain)]
        for view in ("texels:guard_lamp", "bias:sun", "penumbra:sun", "frusta", "frusta:sun", "sets:lantern"):
            pictures.append(self.view(view))
            for other in pictures[:-1]:
                self.assertGreater(pictures[-1].mean_difference(other), 0.3, view)

    def test_shadows_fitted_to_another_camera_are_shown_from_this_one(self):
        # The camera above sees more of the ground than the maps for the one below serve.
        cascades = ("cascades:sun", "--set", "cascades=4", "--camera", "top")
        own = self.view(*cascades)
        other = self.view(*cascades, "--fit-camera", "main")
        same = self.view(*cascades, "--fit-camera", "top")
        self.assertGreater(own.mean_difference(other), 3.0)
        self.assertEqual(own.rgba, same.rgba)
        self.assertGreater(self.view("frusta:sun", "--camera", "top", "--fit-camera", "main").mean_difference(
            self.view("frusta:sun", "--camera", "top")), 0.3)

    def test_an_unknown_fit_camera_is_one_clear_line(self):
        self.assert_refused("--fit-camera", "nobody", mentions="--fit-camera: no camera 'nobody'")

    def test_a_light_without_a_map_says_so_and_the_run_goes_on(self):
        off = self.view("depth:sun", "--set", "enabled=off")
        self.assertGreater(Region(off, 0, TITLE, WIDTH, HEIGHT - TITLE).share(background), 0.99)
        words = sum(1 for i in range(0, 4 * WIDTH * TITLE, 4) if off.rgba[i] > 200)
        self.assertGreater(words, 100)


if __name__ == "__main__":
    main()
