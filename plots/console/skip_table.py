"""Prints what each rule that skips work saves: frames with the rule beside the same frames without it."""
from collections.abc import Iterable

from ..read import results, savings
from ..read.cells import grouped
from ..read.savings import Saving
from ..words.tables import Table, duration, span
from . import spread

EXPERIMENT = "skips"
TITLES = ("<scene", "frame", "<rule", "triangles left out", *savings.AMOUNTS[1:], "with", "without", "times", "<pairs", "<pipeline")


def text(run: results.Run) -> str:
    """Returns a row for each frame and rule; empty if no cell is without a rule."""
    return table_of(savings.of_frames(run.all_cells))


def of_scenes(run: results.Run) -> str:
    """Returns a row for each scene, pipeline and rule of the experiment skips, its frames together, and a line for each scene with
    the rules that had nothing to skip there."""
    found = savings.of_scenes(cell for cell in run.all_cells if cell.experiment == EXPERIMENT)
    idle = [rules for rules in grouped(found, lambda one: (one.first.scene, one.rule)).values()
            if not any(one.skips_something for one in rules)]
    left_out = {id(one) for rules in idle for one in rules}
    return table_of([one for one in found if id(one) not in left_out]) + nothing(idle) + by_rule(found)


def table_of(found: Iterable[Saving]) -> str:
    table = Table(*TITLES)
    for one in found:
        table.row(*row_of(one))
    return f"skips:\n{table.text()}" if table.rows else ""


def row_of(one: Saving) -> list[str]:
    frames = sorted({cell.frame for cell, _ in one.frames})
    numbers = str(frames[0]) if len(frames) == 1 else f"{frames[0]}–{frames[-1]}"
    row = [one.first.scene_facts["name"], numbers, one.rule + (", forced" if one.is_forced else ""),
           *(f"{one.avoided(amount):,}" for amount in savings.AMOUNTS)]
    if one.skips_something:
        on, off = one.ns()
        row += [duration(on), duration(off), f"{spread.ratio(off, on):.2f}"]
    else:
        row += ["", "", "nothing to skip"]  # its times would be noise
    return [*row, "the same" if one.is_same else "NOT the same", one.pipeline]


def by_rule(found: list[Saving]) -> str:
    """Returns a row for each rule and scene, with the range over the pipelines in which it skipped something."""
    table = Table("<rule", "<scene", "pipelines", "<work", "avoided", "times")
    shown = [one for one in found if one.skips_something]
    for (rule, scene, work, is_forced), those in sorted(
            grouped(shown, lambda one: (one.rule, one.first.scene, one.work, one.is_forced)).items(), key=lambda group: savings.order(group[0][0])):
        table.row(rule + (", forced" if is_forced else ""), scene, str(len(those)), work, span([100 * one.share(work) for one in those], 0) + " %",
                  span([savings.times(one) for one in those], 2))
    return f"by rule:\n{table.text()}" if table.rows else ""


def nothing(idle: Iterable[list[Saving]]) -> str:
    """Returns a line for each scene, with the rules that had nothing to skip there."""
    scenes = grouped(idle, lambda rules: rules[0].first.scene)
    return "".join(f"nothing to skip on {scene}: {', '.join(rules[0].rule for rules in those)}\n"
                   for scene, those in scenes.items())
