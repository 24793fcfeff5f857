"""Findings, page and tables of made-up sweeps. usage: report_test.py FOLDER_OF_REPORT_PY [unittest's arguments]"""
import csv
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SCRIPTS))
import plots  # noqa: E402
import report  # noqa: E402
from findings import Scene  # noqa: E402

COLUMNS = {key: "meaning of " + key for key in (
    "bytes", "draws", "scored_px", "wrong", "acne", "leak", "edge_places", "edge_p99_px", "predicted_px",
    "sub_texel_caster", "truth_ambiguous", "other_bias", "unexplained", "disk_error", "gpu_us", "gpu_ratio", "kept_us", "kept_ratio")}


def made_up(*rows):
    """A scene with the light "sun". A row: (name, wrong, time over the defaults' time[, factor])."""
    made = []
    for name, wrong, cost, *factor in rows:
        figures = {**dict.fromkeys(COLUMNS), "scored_px": 1.0e6, "wrong": wrong, "gpu_ratio": cost}
        light = {"light": "sun", "kind": "directional", "state": "rendered", "reason": "none", "above": "",
                 "figures": figures}
        made.append({"row": name, "factor": factor[0] if factor else "filter", "settings": ["filter=" + name],
                     "error": None, "lights": [light]})
    return {"scene": "a scene", "device": "a device", "camera": "", "size_px": [320, 180], "rounds": 3,
            "gl_complaints": 0, "cost_noise": 0.05, "rows": made}


def figures(data, row):
    return data["rows"][row]["lights"][0]["figures"]


def some_sweep():
    data = made_up(("defaults", 0.02, 1.0, "defaults"), ("tutorial, 1024", 0.08, 0.9, "tutorial"), ("fine", 0.01, 1.5),
                   ("failed", 0.0, 0.0))
    data["rows"][3].update(lights=[], error='no "room", sorry')
    return data


def front(data):
    return [choice.name for choice in Scene(data).choices("sun", "point", "drawn") if choice.best]


def said(data):
    return report.sentence(Scene(data), "sun", "point")


def page(*scenes, folder=Path("nowhere"), most_bytes=report.MOST_PICTURE_BYTES):
    return report.page([Scene(data) for data in scenes], folder, COLUMNS, most_bytes)


def data_of(text):
    return json.loads(re.search(r'id="data">(.*?)</script>', text, re.S).group(1))


def refers_elsewhere(text):
    """Whether an attribute that a browser follows names a file or a host."""
    values = re.findall(r"""(?:src|href)\s*=\s*["']?([^"'\s>]*)""", text)
    return "@import" in text or any(re.search("[/.]", value) for value in values if not value.startswith("data:"))


class Findings(unittest.TestCase):
    def test_the_front_is_what_nothing_beats_the_cheapest_first(self):
        self.assertEqual(front(made_up(("defaults", 0.02, 1.0), ("fine", 0.005, 3.0), ("poor", 0.03, 2.0),
                                       ("cheap", 0.04, 0.5))), ["cheap", "defaults", "fine"])

    def test_times_within_the_noise_are_the_same(self):
        self.assertEqual(front(made_up(("a", 0.04, 1.0), ("b", 0.02, 1.04))), ["b"])
        self.assertEqual(front(made_up(("a", 0.04, 1.0), ("b", 0.02, 1.06))), ["a", "b"])
        self.assertEqual(front(made_up(("a", 0.02, 0.97), ("b", 0.02, 1.0))), ["a", "b"])
        self.assertEqual(front(made_up(("a", 0.02, 0.94), ("b", 0.02, 1.0))), ["a"])

    def test_the_defaults_cost_one_whatever_their_own_row_shows(self):
        data = made_up(("defaults", 0.02, 1.4), ("other", 0.03, 1.2))
        self.assertEqual(front(data), ["defaults"])
        self.assertEqual(Scene(data).choices("sun", "point", "drawn")[0].cost, 1.0)

    def test_where_each_halving_takes_twice_the_time_the_factor_is_two(self):
        data = made_up(("a", 0.08, 1.0), ("b", 0.04, 2.0), ("c", 0.02, 4.0), ("d", 0.01, 8.0), ("beaten", 0.05, 3.0))
        found = Scene(data).halving("sun", "point")
        self.assertEqual([step.name for step in found.steps], ["a", "b", "c", "d"])
        self.assertAlmostEqual(found.factor, 2.0, delta=1e-9)

    def test_a_step_that_gains_more_than_half_counts_for_as_many_halvings(self):
        found = Scene(made_up(("a", 0.08, 1.0), ("b", 0.01, 8.0))).halving("sun", "point")  # an eighth for eight times
        self.assertEqual(len(found.steps), 2)
        self.assertAlmostEqual(found.factor, 2.0, delta=1e-9)

    def test_from_the_defaults_it_is_the_cheapest_row_with_half_their_error(self):
        found = Scene(made_up(("defaults", 0.02, 1.0), ("half", 0.01, 1.5), ("finer", 0.001, 4.0),
                              ("cheap", 0.1, 0.5))).halving("sun", "point")
        self.assertEqual((found.half_of_defaults.name, found.half_of_defaults.cost), ("half", 1.5))

    def test_where_nothing_is_twice_as_good_there_is_no_factor(self):
        data = made_up(("defaults", 0.02, 1.0), ("fine", 0.015, 3.0))
        found = Scene(data).halving("sun", "point")
        self.assertEqual((len(found.steps), found.factor, found.half_of_defaults), (1, None, None))
        self.assertIn("no row has half the wrong pixels", said(data))
        self.assertIsNone(Scene(data).halving("no such light", "point").factor)

    def test_no_wrong_pixel_at_all_counts_as_half_of_one(self):
        scene = Scene(made_up(("a", 1.0e-6, 1.0), ("none", 0.0, 2.0)))
        self.assertEqual(scene.choices("sun", "point", "drawn")[-1].error, 0.5e-6)
        self.assertAlmostEqual(scene.halving("sun", "point").factor, 2.0, delta=1e-6)

    def test_rows_that_failed_or_have_no_times_are_no_choice(self):
        data = made_up(("a", 0.08, 1.0), ("failed", 0.04, 2.0), ("untimed", 0.02, 4.0))
        data["rows"][1].update(error="cannot", lights=[])
        figures(data, 2)["gpu_ratio"] = None
        self.assertEqual(front(data), ["a"])

    def test_defaults_above_their_bounds_say_why_and_which_row_is_within_them(self):
        data = made_up(("defaults", 0.0011, 1.0), ("fine", 0.0004, 3.0), ("finer", 0.0001, 5.0),
                       ("nearly", 0.0006, 1.5))
        self.assertNotIn("bounds", said(data))
        for row in (0, 3):
            data["rows"][row]["lights"][0]["above"] = "0.11 % wrong (0.05 %)"
        figures(data, 0).update(sub_texel_caster=40.0, truth_ambiguous=2.0, unexplained=0.0)
        self.assertIn("above their bounds: 0.11 % wrong (0.05 %). Of 42 places", said(data))
        self.assertIn("40 are at shadows or lights narrower than a texel.", said(data))
        self.assertIn("The cheapest row within the bounds is “fine” (0.04 %, 3 ×", said(data))
        data["rows"][1]["lights"] = data["rows"][2]["lights"] = []
        self.assertIn("No row of this sweep is within the bounds.", said(data))

    def test_defaults_stand_beside_the_first_tutorial_of_the_light(self):
        data = made_up(("defaults", 0.0001, 1.0), ("taps", 0.05, 0.625, "tutorial"), ("cheaper", 0.08, 0.5, "tutorial"))
        self.assertIn("With every map redrawn the defaults take 1.6 times the time of “taps” (5 %)", said(data))
        figures(data, 0)["kept_us"] = 30.0
        figures(data, 1).update(gpu_us=24.0, kept_us=20.0)
        self.assertEqual(Scene(data).beside_tutorial("sun").kept, 1.25, "the tutorial keeps nothing")
        self.assertIn("maps are kept, the defaults take 1.25 times the time of “taps” (5 %), which draws", said(data))
        data["rows"][1]["lights"] = data["rows"][2]["lights"] = []
        self.assertNotIn("the defaults take", said(data))

    def test_a_bargain_is_the_best_that_no_more_time_buys(self):
        data = made_up(("tutorial", 0.08, 1.0, "tutorial"), ("a", 0.04, 0.8), ("b", 0.02, 1.0), ("c", 0.01, 2.0))
        self.assertEqual([(t.name, best.name) for t, best in Scene(data).bargains("sun")], [("tutorial", "b")])

    def test_never_best_are_rows_on_no_front(self):
        self.assertEqual(Scene(made_up(("a", 0.08, 1.0), ("b", 0.1, 2.0), ("c", 0.01, 4.0))).never_best(), ["b"])


class Files(unittest.TestCase):
    def test_csv_has_a_line_per_row_and_light_and_one_for_a_row_that_failed(self):
        file = io.StringIO(newline="")
        report.write_csv(file, [Scene(some_sweep())], COLUMNS)
        file.seek(0)
        lines = list(csv.DictReader(file))
        self.assertEqual([line["row"] for line in lines], ["defaults", "tutorial, 1024", "fine", "failed"])
        self.assertEqual([line["wrong"] for line in lines], ["0.02", "0.08", "0.01", ""])
        self.assertEqual((lines[2]["fronts"], lines[3]["error"]), ("point drawn", 'no "room", sorry'))
        self.assertTrue(all(None not in line and None not in line.values() for line in lines), "cells without a head")

    def test_markdown_names_the_device_the_bound_and_each_halving(self):
        data = some_sweep()
        figures(data, 2).update(unexplained=2.0, edge_places=70.0)
        text = report.markdown(Scene(data))
        for part in ("Device: a device.", "| `fine` | 1 % | 1.5 | 1.5 |", "| sun | 1 | 70 | 0 | 0 | 0 | 2 | `fine` |",
                     "| tutorial, 1024 | sun | 8 | - |", "| sun | point | drawn | `tutorial, 1024` 8 % × 0.9<br>`"):
            self.assertIn(part, text)

    def test_the_page_opens_with_one_sentence_and_its_plots(self):
        text = page(some_sweep())
        body = re.sub(r"<(script|style).*?</\1>", "", text, flags=re.S).split("<body>")[1]
        lead, plot, fold = (body.index(part) for part in ('class="lead"', "<svg", "<details"))
        self.assertLess(lead, plot)
        self.assertLess(plot, fold)
        self.assertIn("Of each million pixels that the light “sun” reaches in the scene “a scene”, a tutorial&#x27;s shadow map "
                      "gets 80 000 wrong and Gnomon&#x27;s defaults 20 000, for 1.1 times the tutorial", body)
        self.assertLess(len(re.sub("<[^>]*>", "", body[:plot]).split()), 120, "words before the first plot")
        self.assertIn("One has less error than the defaults, and 1 less time; nothing has both.", body)
        self.assertEqual(body.count("<details"), body.count("</details>"))
        self.assertNotIn("<details open", body)
        self.assertIn('class="lead"', page(made_up(("defaults", 0.02, None))))

    def test_numbers_have_the_digits_that_count_and_no_exponent(self):
        for value, words in ((0.00341, "0.0034"), (4.81, "4.8"), (123.0, "120"), (99.9, "100"), (1.0e-7, "0.0000001"),
                             (0.0, "0"), (1.0e6, "1000000"), (9.96, "10")):
            self.assertEqual(report.plain(value), words)

    def test_a_few_wrong_pixels_are_counted(self):
        self.assertIn("The defaults have 0.0003 %: 3 of 1 000 000 pixels.", said(made_up(("defaults", 3.0e-6, 1.0))))
        self.assertIn("The defaults have 2 %.", said(made_up(("defaults", 0.02, 1.0))))

    def test_the_page_needs_nothing_from_elsewhere(self):
        text = page(some_sweep())
        self.assertFalse(refers_elsewhere(text))
        self.assertNotIn("{{", text)
        self.assertIn("with half of that is “fine” (1 %, 1.5 ×", text)
        for bad in ('<img src="https://a.b/c.png">', "<link href = 'style.css'>"):
            self.assertTrue(refers_elsewhere(text + bad), bad)
        self.assertFalse(refers_elsewhere('<img src="data:image/png;base64,a/b"> <a href=\'#top\'>'))

    def test_no_name_ends_the_script_or_adds_an_element(self):
        data = some_sweep()
        data["scene"] = "</script><img src=x onerror=alert(1)>{{DATA}}"
        data["rows"][2]["row"] = "</script><b>"
        text = page(data)
        self.assertNotIn("<img src=x", text)
        self.assertNotIn("</script><", text)
        self.assertEqual(data_of(text)["rows"][2]["row"], "</script><b>")

    def test_without_times_there_are_no_plots_and_the_page_stands(self):
        data = made_up(("defaults", 0.02, None))
        self.assertEqual(plots.front_plot(Scene(data), "sun", "point"), "")
        self.assertIn("</html>", page(data))
        self.assertIn("</html>", page())

    def test_plots_have_a_dot_per_row_and_stay_finite_for_extremes(self):
        for rows in ([("a", 0.02, 1.0)], [("a", 0.0, 1.0)], [("a", 1.0e-300, 1.0e-9), ("b", 1.0, 1.0e9)]):
            data = made_up(*rows)
            for row, (_, error, _) in enumerate(rows):
                figures(data, row)["disk_error"] = error
            for truth in ("point", "disk"):
                plot = plots.front_plot(Scene(data), "sun", truth)
                self.assertEqual(plot.count('class="dot"'), len(rows))
                self.assertNotRegex(plot, r"\b(nan|inf)\b")

    def test_pictures_of_rows_on_a_front_come_first_and_the_page_says_how_many_are_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            pictures = Path(folder, "scene_0", "pictures")
            pictures.mkdir(parents=True)
            names = ["%d_sun_%s" % (row, end) for row in range(3) for end in ("render.jpg", "shown.png", "error.png")]
            for name in names + ["sun_point.png"]:
                (pictures / name).write_bytes(b"foo")
            data = made_up(("defaults", 0.02, 1.0), ("beaten", 0.03, 1.0), ("fine", 0.01, 1.5))
            one = 3 * len("data:image/png;base64,Zm9v") + 1  # image/jpeg is one longer
            text = page(data, folder=Path(folder), most_bytes=2 * one)
            rows = data_of(text)["rows"]
            self.assertEqual(["pictures" in row for row in rows], [True, False, True])
            self.assertEqual(rows[0]["pictures"]["render"], "data:image/jpeg;base64,Zm9v")
            self.assertEqual(set(data_of(text)["truths"].values()), {"data:image/png;base64,Zm9v"})
            self.assertIn("Pictures of 1 rows were left out", text)
            self.assertNotIn("were left out to keep the page small.</p>", page(data, folder=Path(folder)))

    def test_only_what_stands_between_the_marks_of_a_page_is_replaced(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "page.md")
            for old in ("", "old\nolder\n"):
                file.write_text("before\n<!-- cost -->\n%s<!-- end of cost -->\nafter\n" % old, encoding="utf-8")
                report.replace_section(file, "cost", "new\n")
                self.assertEqual(file.read_text(encoding="utf-8"),
                                 "before\n<!-- cost -->\nnew\n<!-- end of cost -->\nafter\n")
            for bad in ("nothing\n", "<!-- cost -->\n", "<!-- end of cost -->\n<!-- cost -->\n"):
                file.write_text(bad, encoding="utf-8")
                self.assertRaises(ValueError, report.replace_section, file, "cost", "new\n")
                self.assertEqual(file.read_text(encoding="utf-8"), bad)

    def test_one_command_with_the_flags_of_the_bench_leaves_every_file(self):
        with tempfile.TemporaryDirectory() as folder:
            out, markdown = Path(folder, "out"), Path(folder, "page.md")
            out.mkdir()
            markdown.write_text("<!-- cost -->\n<!-- end of cost -->\n", encoding="utf-8")
            command = [sys.executable, str(SCRIPTS / "report.py"), "accuracy", "--sweep", "quick", "--rows", "^fit=",
                       "--out", str(out), "--markdown", str(markdown)]
            self.assertEqual(subprocess.run(command, stderr=subprocess.DEVNULL, check=False).returncode, 2, "no report")
            (out / "report.json").write_text(json.dumps({"columns": COLUMNS, "scenes": [some_sweep()] * 2}))
            done = subprocess.run(command, stdout=subprocess.PIPE, check=True)
            self.assertIn('FAILED failed: no "room", sorry', done.stdout.decode())
            self.assertEqual(sorted(os.listdir(out)), ["report.csv", "report.html", "report.json"])
            self.assertEqual(markdown.read_text(encoding="utf-8").count("### The bound"), 2)


if __name__ == "__main__":
    unittest.main(verbosity=1)
