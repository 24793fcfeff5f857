#!/usr/bin/env python3
"""Makes a sweep's page, tables and sentences from the report.json that `gnomon_bench accuracy --sweep` writes.

usage: report.py [--out FOLDER] [--markdown PAGE]
Takes the flags of that command and skips what it does not know. Writes report.html and report.csv into FOLDER, replaces
what stands between <!-- cost --> and <!-- end of cost --> in PAGE, and prints a summary. Exit status: 2 for bad input.
"""
import argparse
import base64
import csv
import json
import re
import sys
from html import escape
from pathlib import Path

from findings import COSTS, DEFAULTS, TRUTHS, TUTORIAL, Scene
from plots import front_plot

MOST_PICTURE_BYTES = 12_000_000  # as text in the page
TEMPLATE = Path(__file__).resolve().parent / "html"
MIME = {".jpg": "image/jpeg", ".png": "image/png"}
LIGHT_KEYS = ("light", "kind", "state", "reason")


def plain(value, digits=2):
    """A number with so many digits that count, and without an exponent: 0.0034, 4.8, 120."""
    rounded = float("%.*g" % (digits, value))
    return "%d" % rounded if abs(rounded) >= 10.0 ** (digits - 1) else ("%.10f" % rounded).rstrip("0").rstrip(".")


def grouped(value):
    """The same, with a space after thousands."""
    return "{:,}".format(int(plain(value))).replace(",", " ") if value >= 1000.0 else plain(value)


def percent(share):
    return plain(100.0 * share) + " %"


def named(choice):
    return "“%s” (%s, %.3g × the defaults' time)" % (choice.name, percent(choice.error), choice.cost)


# --- sentences --------------------------------------------------------------------------------------------------------

def lead_words(scenes):
    """What the page shows, in one sentence for a person who has never seen a shadow map's settings."""
    for scene in scenes:
        for light in scene.lights:
            found, beside = scene.halving(light, "point").defaults, scene.beside_tutorial(light)
            if found and beside:
                time = beside.drawn if beside.kept is None else beside.kept
                return ("Of each million pixels that the light “%s” reaches in the scene “%s”, a tutorial's shadow map gets %s "
                        "wrong and Gnomon's defaults %s, for %s times the tutorial's time." % (
                            light, scene.data["scene"], grouped(1.0e6 * beside.tutorial.error), grouped(1.0e6 * found.error),
                            plain(time)))
    return "Each dot is one way to draw shadows: how many pixels are wrong, and how long it takes."


def pixels_words(scene, light, choice):
    """The number of wrong pixels, where it is small enough to be counted."""
    scored = scene.figures(choice.index, light)["scored_px"] or 0.0
    count = choice.error * scored
    return ": %d of %s pixels" % (round(count), "{:,.0f}".format(scored).replace(",", " ")) if 0.6 < count < 1000.0 else ""


def missed_words(missed):
    text = " The defaults are above their bounds: %s." % missed.above
    if missed.sub_texel > 0.0:
        text += " Of %d places on edges that are farther off than predicted, " % missed.beyond
        text += "%d are at shadows or lights narrower than a texel." % missed.sub_texel
    if missed.reached is None:
        return text + " No row of this sweep is within the bounds."
    return text + " The cheapest row within the bounds is %s." % named(missed.reached)


def beside_words(beside):
    tutorial = "the time of “%s” (%s), which draws its map in every frame" % (beside.tutorial.name,
                                                                             percent(beside.tutorial.error))
    if beside.kept is None:
        return " With every map redrawn the defaults take %.3g times %s." % (beside.drawn, tutorial)
    return (" While nothing moves and maps are kept, the defaults take %.3g times %s. With every map redrawn they "
            "take %.3g times that time." % (beside.kept, tutorial, beside.drawn))


def sentence(scene, light, truth):
    found = scene.halving(light, truth)
    error = "wrong pixels" if truth == "point" else "error of soft shadows"
    if found.factor is None:
        text = "%s: no row has half the %s of the cheapest row." % (light, error)
    else:
        text = "%s: halving the %s takes %.3g times the time on average, from %s to %s." % (
            light, error, found.factor, named(found.steps[0]), named(found.steps[-1]))
    if found.defaults is None:
        return text
    counted = pixels_words(scene, light, found.defaults) if truth == "point" else ""
    text += " The defaults have %s%s." % (percent(found.defaults.error), counted)
    if found.half_of_defaults is None:
        text += " No row has half of that."
    else:
        text += " The cheapest row with half of that is %s." % named(found.half_of_defaults)
    if truth == "point":
        missed, beside = scene.missed(light), scene.beside_tutorial(light)
        text += (missed_words(missed) if missed else "") + (beside_words(beside) if beside else "")
    return text


def sentences(scene):
    return [sentence(scene, light, truth) for light in scene.lights for truth in TRUTHS
            if scene.choices(light, truth, "drawn")]


def halving_rows(scene, light, truth):
    """Name, error, time and time over the row above, from the cheapest row on; empty if nothing halves the error."""
    steps = scene.halving(light, truth).steps
    return [(c.name, percent(c.error), "%.3g" % c.cost, "%.3g" % (c.cost / steps[i - 1].cost) if i > 0 else "")
            for i, c in enumerate(steps)] if len(steps) > 1 else []


# --- summary, CSV, Markdown -------------------------------------------------------------------------------------------

def summary(scene):
    data = scene.data
    lines = ["scene   " + data["scene"], "device  " + data["device"], "picture %d x %d" % tuple(data["size_px"]),
             "rows    %d, timed in %d rounds" % (len(scene.rows), data["rounds"]), ""] + sentences(scene)
    lines += ["FAILED %s: %s" % (row["row"], row["error"]) for row in scene.rows if row["error"] is not None]
    if data["gl_complaints"] > 0:
        lines.append("OpenGL complained %d times." % data["gl_complaints"])
    return "\n".join(lines) + "\n"


def write_csv(file, scenes, columns):
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["scene", "device", "row", "factor", "settings", "error", *LIGHT_KEYS, "fronts", *columns])
    for scene in scenes:
        for index, row in enumerate(scene.rows):
            cells = [scene.data["scene"], scene.data["device"], row["row"], row["factor"], " ".join(row["settings"]),
                     row["error"] or ""]
            for light in row["lights"]:
                figures = [light["figures"][column] for column in columns]
                writer.writerow(cells + [light[key] for key in LIGHT_KEYS] +
                                ["; ".join(scene.fronts(index, light["light"]))] +
                                ["" if figure is None else "%.9g" % figure for figure in figures])
            if not row["lights"]:
                writer.writerow(cells + [""] * (len(LIGHT_KEYS) + 1 + len(columns)))


def markdown_table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "".join("|" + "|".join(cells if cells[0] == "---" else (" %s " % cell for cell in cells)) + "|\n"
                   for cells in lines) + "\n"


def landmarks(scene):
    """Table of the defaults and the tutorials' rows."""
    scales = {"wrong": 100.0, "acne": 100.0, "leak": 100.0, "edge_p99_px": 1.0, "predicted_px": 1.0, "bytes": 1.0e-6,
              "draws": 1.0, "gpu_us": 1.0e-3, "gpu_ratio": 1.0, "kept_us": 1.0e-3}
    rows = []
    for row in scene.rows:
        for light in row["lights"] if row["factor"] in (DEFAULTS, TUTORIAL) else []:
            figures = [(light["figures"][key], scale) for key, scale in scales.items()]
            rows.append([row["row"], light["light"]] +
                        ["-" if value is None else "%.3g" % (value * scale) for value, scale in figures])
    return markdown_table(["row", "light", "wrong %", "acne %", "leak %", "edge p99 px", "predicted px", "MB", "draws",
                           "ms", "× defaults", "kept, ms"], rows)


def front_rows(scene, light):
    """A row per truth and time with the rows of the front, the cheapest first."""
    rows = []
    for truth in TRUTHS:
        for cost in COSTS:
            best = [c for c in scene.choices(light, truth, cost) if c.best]
            if best:
                rows.append([light, truth, cost, "<br>".join(
                    "`%s` %s × %.3g" % (c.name, percent(c.error), c.cost) for c in best)])
    return rows


def bounds(scene):
    """Table of places that are farther off than predicted, over all rows of a light."""
    keys = ("edge_places", "sub_texel_caster", "truth_ambiguous", "other_bias", "unexplained")
    rows = []
    for name in scene.lights:
        judged = [(row["row"], light["figures"]) for row in scene.rows for light in row["lights"]
                  if light["light"] == name and light["figures"]["unexplained"] is not None]
        counts = [len(judged)] + [sum(figures[key] or 0.0 for _, figures in judged) for key in keys]
        unexplained = ", ".join("`%s`" % row for row, figures in judged if figures["unexplained"] > 0.0)
        rows.append([name] + ["%d" % count for count in counts] + [unexplained or "none"])
    return markdown_table(["light", "rows", "places", "farther off than predicted: sub_texel_caster", "truth_ambiguous",
                           "other_bias", "unexplained", "rows with unexplained ones"], rows)


def markdown(scene):
    data = scene.data
    text = "## %s\n\nDevice: %s. Picture: %d × %d. Rows: %d, rounds of times: %d.\n\n" % (
        data["scene"], data["device"], *data["size_px"], len(scene.rows), data["rounds"])
    text += "### What halving the error costs\n\n" + markdown_table(["light and error"], [[line] for line in sentences(scene)])
    for light in scene.lights:
        for truth in TRUTHS:
            rows = halving_rows(scene, light, truth)
            if rows:
                text += markdown_table([light if truth == "point" else light + ", soft", "error", "time, × defaults",
                                        "× time for half the error"], [["`%s`" % row[0], *row[1:]] for row in rows])
    text += "### The defaults beside what tutorials set up\n\n" + landmarks(scene)
    text += "### Rows that are best at some cost\n\n" + markdown_table(
        ["light", "truth about a", "maps", "row, error, × the defaults' time"],
        [row for light in scene.lights for row in front_rows(scene, light)])
    never = ", ".join("`%s`" % name for name in scene.never_best()) or "none"
    text += markdown_table(["never best, for any light, truth or time"], [[never]])
    return text + "### The bound\n\n%s" % bounds(scene)


def replace_section(page, name, text):
    """Replaces what stands between the lines <!-- NAME --> and <!-- end of NAME --> of a page."""
    parts = re.split("(<!-- %s -->\n|<!-- end of %s -->\n)" % (name, name), page.read_text(encoding="utf-8"))
    if len(parts) != 5 or parts[1].startswith("<!-- end"):
        raise ValueError("%s: the page has no marks of '%s'" % (page, name))
    page.write_text("".join([*parts[:2], text, *parts[3:]]), encoding="utf-8")


# --- page -------------------------------------------------------------------------------------------------------------

def data_uri(file):
    """A picture file as text for a page; empty if there is none."""
    if not file.is_file():
        return ""
    return "data:%s;base64,%s" % (MIME[file.suffix], base64.b64encode(file.read_bytes()).decode())


def halving_table(scene, light, truth):
    rows = halving_rows(scene, light, truth)
    if not rows:
        return ""
    head = '<tr><th class="words">%s, %s</th>' % (escape(light), "hard" if truth == "point" else "soft")
    head += "<th>error</th><th>time, × defaults</th><th>× time of the row above</th></tr>"
    lines = ['<tr><td class="words">%s</td><td>%s</td><td>%s</td><td>%s</td></tr>' % (escape(row[0]), *row[1:])
             for row in rows]
    return "\n".join(["<table>", head, *lines, "</table>\n"])


def bargain_words(light, tutorial, best):
    return "%s: “%s” has %s wrong pixels; for no more time “%s” has %s." % (
        light, tutorial.name, percent(tutorial.error), best.name, percent(best.error))


def halving_html(scene):
    data = scene.data
    factors = [(light, scene.halving(light, "point").factor) for light in scene.lights]
    headline = ", ".join("%s %.3g times" % found for found in factors if found[1] is not None)
    text = "<h3>%s, %d × %d, %s</h3>\n" % (escape(data["scene"]), *data["size_px"], escape(data["device"]))
    if headline:
        text += '<p class="headline">Time for half the wrong pixels, on average: %s.</p>\n' % escape(headline)
    text += "".join('<p class="sentence">%s</p>\n' % escape(line) for line in sentences(scene))
    tables = "".join(halving_table(scene, light, truth) for light in scene.lights for truth in TRUTHS)
    bargains = [bargain_words(light, tutorial, best) for light in scene.lights
                for tutorial, best in scene.bargains(light) if best.index != tutorial.index]
    return text + '<div class="plots">\n%s</div>\n' % tables + "".join("<p>%s</p>\n" % escape(b) for b in bargains)


def plot_words(scene, light, truth):
    """What to see in a plot."""
    source = "as a point" if truth == "point" else "with its size"
    choices = scene.choices(light, truth, "drawn")
    defaults = next((c for c in choices if c.name == DEFAULTS), None)
    text = "“%s” %s: %d ways to draw its shadows. " % (light, source, len(choices))
    if defaults is None:
        return text + "The line joins the best ones."
    less = sum(c.error < defaults.error for c in choices)
    return text + "%s less error than the defaults, and %s less time; %s." % (
        "One has" if less == 1 else "%d have" % less, sum(c.cost < 1.0 for c in choices),
        "nothing has both" if not any(c.error < defaults.error and c.cost < 1.0 for c in choices)
        else "%d have both" % sum(c.error < defaults.error and c.cost < 1.0 for c in choices))


def plots_html(scene, number):
    text = '<h3>%s</h3>\n<div class="plots">\n' % escape(scene.data["scene"])
    for light in scene.lights:
        for truth in TRUTHS:
            plot = front_plot(scene, light, truth)
            if plot:
                text += '<figure data-scene="%d" data-light="%s">' % (number, escape(light))
                text += "<figcaption>%s</figcaption>\n%s</figure>\n" % (escape(plot_words(scene, light, truth)), plot)
    return text + "</div>\n"


def page_rows(scenes, folder, columns):
    """Rows of the page's table, and of each row the picture files' common name, or None."""
    rows, stems = [], []
    for number, scene in enumerate(scenes):
        pictures = folder / ("scene_%d" % number) / "pictures"
        for index, row in enumerate(scene.rows):
            common = {"scene": scene.data["scene"], "scene_index": number, "index": index, "row": row["row"],
                      "factor": row["factor"], "settings": " ".join(row["settings"]), "error": row["error"]}
            for light in row["lights"]:
                figures, name = light["figures"], light["light"]
                truth = pictures / (name + ("_disk.png" if figures["wrong"] is None else "_point.png"))
                rows.append({**common, **{key: light[key] for key in LIGHT_KEYS},
                             "fronts": "; ".join(scene.fronts(index, name)), "truth": str(truth),
                             "figures": [figures[column] for column in columns]})
                stems.append(pictures / ("%d_%s" % (index, name)))
            if not row["lights"]:
                rows.append({**common, **dict.fromkeys(LIGHT_KEYS, ""), "fronts": "", "figures": [None] * len(columns)})
                stems.append(None)
    return rows, stems


def add_pictures(rows, stems, most_bytes):
    """Puts pictures into rows, those on a front first, and returns the number of rows without room."""
    used = left_out = 0
    for i in sorted(range(len(rows)), key=lambda i: not rows[i]["fronts"]):
        if stems[i] is None:
            continue
        files = {"render": "_render.jpg", "shown": "_shown.png", "error": "_error.png"}
        pictures = {key: data_uri(stems[i].with_name(stems[i].name + end)) for key, end in files.items()}
        size = sum(map(len, pictures.values()))
        if used + size > most_bytes:
            left_out += 1
        elif size > 0:
            used += size
            rows[i]["pictures"] = pictures
    return left_out


def page(scenes, folder, columns, most_bytes=MOST_PICTURE_BYTES):
    """One page that needs no other file: findings, plots, a table to sort and to search, and pictures of each row."""
    rows, stems = page_rows(scenes, folder, columns)
    left_out = add_pictures(rows, stems, most_bytes)
    truths = {row["truth"]: data_uri(Path(row["truth"])) for row in rows if "truth" in row}
    data = json.dumps({"columns": list(columns), "truths": truths, "rows": rows}, ensure_ascii=False)
    notes = ("Errors do not change from run to run. Times are of this device. Each row's time is divided by the "
             "defaults' time right before it. ")
    notes += "".join("%s: %d rows, %d rounds of times. " % (scene.data["scene"], len(scene.rows), scene.data["rounds"])
                     for scene in scenes)
    notes += "In a row's picture only lights of the row's kind cast shadows."
    if left_out > 0:
        notes += " Pictures of %d rows were left out to keep the page small." % left_out
    values = {"LEAD": escape(lead_words(scenes)),
              "HALVING": "".join(map(halving_html, scenes)),
              "PLOTS": "".join(plots_html(scene, i) for i, scene in enumerate(scenes)),
              "NOTES": escape(notes),
              "COLUMNS": "".join("<dt>%s</dt><dd>%s</dd>\n" % (escape(name), escape(meaning))
                                 for name, meaning in columns.items()),
              "DATA": data.replace("<", "\\u003c"),  # nothing in it may end the script element
              "STYLE": (TEMPLATE / "report.css").read_text(encoding="utf-8"),
              "SCRIPT": (TEMPLATE / "report.js").read_text(encoding="utf-8")}
    template = (TEMPLATE / "report.html").read_text(encoding="utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda found: values[found.group(1)], template)


def main(arguments):
    parser = argparse.ArgumentParser(usage="report.py [--out FOLDER] [--markdown PAGE]", allow_abbrev=False)
    parser.add_argument("--out", type=Path, default="gnomon_sweep", help="folder of report.json (%(default)s)")
    parser.add_argument("--markdown", type=Path, help="page whose text between <!-- cost --> and its end is replaced")
    options, _ = parser.parse_known_args(arguments)
    report = json.loads((options.out / "report.json").read_text(encoding="utf-8"))
    columns, scenes = report["columns"], [Scene(data) for data in report["scenes"]]
    (options.out / "report.html").write_text(page(scenes, options.out, columns), encoding="utf-8")
    with open(options.out / "report.csv", "w", encoding="utf-8", newline="") as file:
        write_csv(file, scenes, columns)
    if options.markdown:
        replace_section(options.markdown, "cost", "".join(map(markdown, scenes)))
    print("\n".join(map(summary, scenes)))
    print(options.out / "report.html")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except (OSError, ValueError, KeyError, TypeError) as wrong:
        print("report.py: %s: %s" % (type(wrong).__name__, wrong), file=sys.stderr)
        sys.exit(2)
