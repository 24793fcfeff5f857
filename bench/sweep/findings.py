"""What a sweep shows, light by light: which rows are best, and what less error costs."""
import math
from functools import cached_property, lru_cache
from typing import NamedTuple, Optional

TRUTHS = ("point", "disk")
COSTS = ("drawn", "kept")
DEFAULTS, TUTORIAL = "defaults", "tutorial"


class Choice(NamedTuple):
    """A row of one light that has both an error and a time."""
    index: int  # of the scene's rows
    name: str
    error: float  # share of wrong pixels (point), or mean error (disk)
    cost: float  # time of the light's passes over the defaults' time
    best: bool  # no other row has less error for no more time


class Halving(NamedTuple):
    """Cost of half the error for one light."""
    steps: list  # choices: the cheapest row, then each time the cheapest with at most half of that error
    factor: Optional[float]  # of the time per halving, over all steps
    defaults: Optional[Choice]
    half_of_defaults: Optional[Choice]  # the cheapest row with at most half the error of the defaults


class Missed(NamedTuple):
    """Why the defaults are above their bounds."""
    above: str  # in words
    beyond: float  # places on edges that are farther off than predicted
    sub_texel: float  # those at shadows or lights narrower than a texel
    reached: Optional[Choice]  # the cheapest row within the bounds


class Beside(NamedTuple):
    """Time of the defaults over the time of the light's first tutorial, which draws its map in every frame."""
    tutorial: Choice
    drawn: float  # the defaults draw their maps in every frame, too
    kept: Optional[float]  # the defaults keep their maps


def error_of(figures, truth):
    """An error of less than half a scored pixel counts as half a pixel. None: not measured."""
    if truth == "disk":
        return figures["disk_error"]
    if figures["wrong"] is None or figures["scored_px"] is None:
        return None
    return max(figures["wrong"], 0.5 / max(figures["scored_px"], 1.0))


def cost_of(figures, cost):
    ratio = figures["gpu_ratio" if cost == "drawn" else "kept_ratio"]
    return ratio if ratio is not None and ratio > 0.0 else None


def on_front(one, others, noise):
    """Whether no other row has less error for no more time. Times within `noise` are the same."""
    for other in others:
        if other.error < one.error and other.cost <= one.cost * (1.0 + noise):
            return False
        if other.error == one.error and other.cost < one.cost * (1.0 - noise):
            return False
    return True


class Scene:
    """One scene of report.json."""

    def __init__(self, data):
        self.data = data
        self.rows = data["rows"]
        self.choices = lru_cache(maxsize=None)(self._choices)

    @cached_property
    def lights(self):
        """Names of the lights that have rows, in the order of the first row."""
        return list(dict.fromkeys(light["light"] for row in self.rows for light in row["lights"]))

    def light(self, index, name):
        return next((light for light in self.rows[index]["lights"] if light["light"] == name), None)

    def figures(self, index, name):
        return self.light(index, name)["figures"]

    def _choices(self, light, truth, cost):
        """Rows of one light, the cheapest first. The defaults cost 1."""
        found = []
        for index, row in enumerate(self.rows):
            judged = self.light(index, light)
            if judged is None:
                continue
            error, time = error_of(judged["figures"], truth), cost_of(judged["figures"], cost)
            if error is None or time is None:
                continue
            # All others are measured against the defaults, so the time of their own row shows noise.
            time = 1.0 if row["row"] == DEFAULTS else time
            found.append(Choice(index, row["row"], error, time, False))
        found.sort(key=lambda choice: choice.cost)
        return [one._replace(best=on_front(one, found, self.data["cost_noise"])) for one in found]

    def factor(self, choice):
        return self.rows[choice.index]["factor"]

    def halving(self, light, truth, cost="drawn"):
        choices = self.choices(light, truth, cost)

        def cheapest(most_error):
            return next((c for c in choices if c.best and c.error <= most_error), None)
        steps = [one for one in [cheapest(math.inf)] if one]
        while steps and steps[-1].error > 0.0:
            after = cheapest(0.5 * steps[-1].error)
            if after is None:
                break
            steps.append(after)
        factor = None
        if len(steps) > 1:
            first, last = steps[0], steps[-1]
            halvings = math.log2(first.error / max(last.error, first.error * 1.0e-9))
            factor = (last.cost / first.cost) ** (1.0 / halvings)
        defaults = next((c for c in choices if c.name == DEFAULTS), None)
        return Halving(steps, factor, defaults, cheapest(0.5 * defaults.error) if defaults else None)

    def missed(self, light):
        """None: the defaults are within their bounds, or were not measured."""
        choices = self.choices(light, "point", "drawn")
        defaults = next((c for c in choices if c.name == DEFAULTS), None)
        above = self.light(defaults.index, light)["above"] if defaults else ""
        if not above:
            return None
        figures = self.figures(defaults.index, light)
        beyond = sum(figures[key] or 0.0 for key in ("sub_texel_caster", "truth_ambiguous", "unexplained"))
        reached = next((c for c in choices if not self.light(c.index, light)["above"]), None)
        return Missed(above, beyond, figures["sub_texel_caster"] or 0.0, reached)

    def tutorials(self, light):
        return [c for c in self.choices(light, "point", "drawn") if self.factor(c) == TUTORIAL]

    def beside_tutorial(self, light):
        """None: the light has no tutorial, or its defaults were not measured."""
        defaults = next((c for c in self.choices(light, "point", "drawn") if c.name == DEFAULTS), None)
        tutorial = min(self.tutorials(light), key=lambda c: c.index, default=None)
        if defaults is None or tutorial is None:
            return None
        kept_us = self.figures(defaults.index, light)["kept_us"]
        tutorial_us = self.figures(tutorial.index, light)["gpu_us"]
        kept = kept_us / tutorial_us if kept_us is not None and tutorial_us else None
        return Beside(tutorial, defaults.cost / tutorial.cost, kept)

    def bargains(self, light):
        """Pairs of each tutorial and the row with least error for no more time."""
        most = 1.0 + self.data["cost_noise"]
        choices = self.choices(light, "point", "drawn")
        return [(tutorial, min((c for c in choices if c.cost <= tutorial.cost * most), key=lambda c: c.error))
                for tutorial in self.tutorials(light)]

    def fronts(self, index, light):
        """"point drawn", ...: the fronts that a row of a light is on."""
        return [truth + " " + cost for truth in TRUTHS for cost in COSTS
                if any(c.index == index and c.best for c in self.choices(light, truth, cost))]

    def never_best(self):
        """Names of rows on no front of any light."""
        best = {}
        for light in self.lights:
            for truth in TRUTHS:
                for cost in COSTS:
                    for choice in self.choices(light, truth, cost):
                        best[choice.index] = best.get(choice.index, False) or choice.best
        return [self.rows[index]["row"] for index in sorted(best) if not best[index]]
