"""Plots of a sweep as SVG: error against time of one light's rows, on logarithmic axes."""
import math
from html import escape

from findings import DEFAULTS, TUTORIAL

LEFT, TOP, WIDE, HIGH, RIGHT, BOTTOM = 64.0, 48.0, 470.0, 300.0, 16.0, 46.0
DOT, LARGE_DOT, LABEL_GAP = 3.0, 5.5, 8.0
MARGIN = 1.15  # around what is shown, as a factor
# Colours by what a row varies.
HUES = {DEFAULTS: "#000000", TUTORIAL: "#c0392b", "filter": "#1f6fb2", "resolution": "#2e8b57", "bias": "#b8860b",
        "cascades": "#8e44ad", "fit": "#d2691e", "format": "#008b8b"}
OTHER_HUE = "#555555"


def hue_of(factor):
    """Colour of the factor, or of what is crossed with the resolution."""
    return HUES.get(factor[len("resolution x "):] if factor.startswith("resolution x ") else factor, OTHER_HUE)


class LogScale:
    def __init__(self, values):
        self.low, self.high = min(values) / MARGIN, max(values) * MARGIN

    def share(self, value):
        return math.log(value / self.low) / math.log(self.high / self.low)

    def ticks(self):
        """1, 2 and 5 of each decade that is shown."""
        decades = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        all_ticks = [step * 10.0 ** decade for decade in decades for step in (1, 2, 5)]
        return [tick for tick in all_ticks if self.low <= tick <= self.high]


def text(x, y, words, style=""):
    return '<text x="%.2f" y="%.2f" %s>%s</text>' % (x, y, style, escape(words))


def line(x1, y1, x2, y2):
    return '<line x1="%.2f" y1="%.2f" x2="%.2f" y2="%.2f" stroke="#e4e4e4"/>' % (x1, y1, x2, y2)


def circle(x, y, radius, style):
    return '<circle cx="%.2f" cy="%.2f" r="%.2f" %s/>' % (x, y, radius, style)


def axes(x_scale, y_scale, place, truth):
    parts = []
    bottom = TOP + HIGH
    for tick in x_scale.ticks():
        x, _ = place(tick, y_scale.low)
        parts += [line(x, TOP, x, bottom), text(x, bottom + 16.0, "%.3g" % tick, 'text-anchor="middle"')]
    for tick in y_scale.ticks():
        _, y = place(x_scale.low, tick)
        parts += [line(LEFT, y, LEFT + WIDE, y),
                  text(LEFT - LABEL_GAP, y + 4.0, ("%.6f" % (100.0 * tick)).rstrip("0").rstrip(".") or "0", 'text-anchor="end"')]
    parts.append('<rect x="%.2f" y="%.2f" width="%.2f" height="%.2f" fill="none" stroke="#888"/>' %
                 (LEFT, TOP, WIDE, HIGH))
    parts.append(text(LEFT + 0.5 * WIDE, bottom + 38.0, "time of drawing and reading its maps, × the defaults' time "
                      "(logarithmic)", 'text-anchor="middle"'))
    parts.append(text(0.0, 0.0, "wrong pixels, % (logarithmic)" if truth == "point" else "mean error, % (logarithmic)",
                      'text-anchor="middle" transform="translate(14 %.2f) rotate(-90)"' % (TOP + 0.5 * HIGH)))
    return parts


def key(factors):
    """Each colour in use, once."""
    parts, x = [], LEFT
    used = {hue_of(factor) for factor in factors}
    for factor, colour in HUES.items():
        if colour in used:
            parts += [circle(x, TOP - 32.0, DOT, 'fill="%s"' % colour), text(x + LABEL_GAP, TOP - 28.0, factor)]
            x += 2.2 * LABEL_GAP + 6.2 * len(factor)
    return parts


def front_plot(scene, light, truth):
    """SVG with a dot per row and a line along the front; empty if no row has both error and time."""
    choices = scene.choices(light, truth, "drawn")
    if not choices:
        return ""
    x_scale = LogScale([c.cost for c in choices])
    y_scale = LogScale([max(c.error, 1.0e-9) for c in choices])

    def place(cost, error):
        return (LEFT + WIDE * x_scale.share(cost), TOP + HIGH * (1.0 - y_scale.share(max(error, 1.0e-9))))
    width, height = LEFT + WIDE + RIGHT, TOP + HIGH + BOTTOM
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" width="%g" height="%g" font-family="sans-serif" font-size="12">' %
             (width, height), "<title>%s</title>" % escape(light + ": error against time"),
             '<rect width="%g" height="%g" fill="#fff"/>' % (width, height)]
    parts += axes(x_scale, y_scale, place, truth)
    front = " ".join("%.2f,%.2f" % place(c.cost, c.error) for c in choices if c.best)
    parts.append('<polyline points="%s" fill="none" stroke="#333" stroke-width="1.5" stroke-opacity="0.6"/>' % front)
    for c in choices:
        factor = scene.factor(c)
        colour, landmark = hue_of(factor), factor in (DEFAULTS, TUTORIAL)
        x, y = place(c.cost, c.error)
        parts.append('<g class="dot" data-row="%d"><title>%s</title>' %
                     (c.index, escape("%s: %.3g %%, x %.4g" % (c.name, 100.0 * c.error, c.cost))))
        parts.append(circle(x, y, LARGE_DOT if landmark or c.best else DOT,
                            'fill="%s" fill-opacity="%s"' % (colour, "1" if c.best else "0.35")) + "</g>")
        if landmark:
            right = x > LEFT + 0.6 * WIDE  # the label goes to the side with room
            parts.append(text(x + (-LABEL_GAP if right else LABEL_GAP), y - LABEL_GAP, c.name,
                              'font-size="10" fill="%s" text-anchor="%s"' % (colour, "end" if right else "start")))
    return "\n".join(parts + key([scene.factor(c) for c in choices]) + ["</svg>\n"])
