"""Formats a comparison as text: cells whose time changed or may have changed, worst first, with their stages; one line for each
other change; and the number of cells of each verdict."""
import math

from ..words.tables import Table, counted, duration
from .comparison import ComparedCell, Comparison
from .times import FASTER, FEWEST_SAMPLES, MOST_DRIFT, SAME, SLOWER, UNSURE, TimeChange

UNKNOWN = 1000  # an interval that reaches beyond this ratio tells nothing; so it is with two processes a side and many cells
WORST_FIRST = (SLOWER, UNSURE, FASTER, SAME)
# "finds": the smallest change that would be found in nine of ten comparisons; "n": samples, or processes x samples.
COLUMNS = "<cell", "A", "B", "B/A", "between", "finds", "n", "<"


def text(comparison: Comparison, show_all: bool = False) -> str:
    lines = [f"not the same: {remark}\n" for remark in comparison.remarks]
    if comparison.rules.other_devices:
        lines.append("ratios are of the median ratio of their scene: only how cells relate counts\n")
    if comparison.sides.why and any(map(is_timed, comparison.cells)):
        lines.append(f"times: {comparison.sides.why}; so only a factor beyond {MOST_DRIFT} is a change (docs/comparing.md)\n")
    lines += [f"warning: {warning}\n" for warning in comparison.sides.warnings]
    return "".join([*lines, times_table(comparison, show_all), *changes(comparison), summary(comparison)])


def times_table(comparison: Comparison, show_all: bool) -> str:
    shown = [cell for cell in comparison.cells
             if is_timed(cell) and (show_all or is_notable(cell.time, comparison.rules.threshold))]
    if not shown:
        return ""
    table = Table(*COLUMNS)
    for cell in sorted(shown, key=lambda cell: (WORST_FIRST.index(cell.verdict), -cell.time.ratio.value)):
        table.row(*row_of(cell.first.label, cell.time), cell.verdict)
        for stage, change in cell.stages.items():
            table.row(*row_of(f"  {stage}", change))
    return table.text()


def is_timed(cell: ComparedCell) -> bool:
    return bool(cell.time.counts[0])


def is_notable(change: TimeChange, threshold: float) -> bool:
    """True if the time changed, or if an unsure cell's median moved by more than the threshold."""
    within = 1 / (1 + threshold) < change.ratio.value < 1 + threshold
    return change.verdict in (FASTER, SLOWER) or (change.verdict == UNSURE and not within)


def row_of(name: str, change: TimeChange) -> list[str]:
    return [name, duration(change.first), duration(change.second), f"{change.ratio.value:.3f}",
            f"{change.ratio.low:.3f} – {change.ratio.high:.3f}" if change.ratio.high < UNKNOWN else "unknown",
            found(change.smallest), "/".join(dict.fromkeys(change.counts))]


def found(smallest: float) -> str:
    """Returns the smallest change that would be found: "12 %", or "x 2.1" from 100 % on."""
    if smallest > UNKNOWN:
        return "too few"
    return f"{100 * (smallest - 1):.0f} %" if smallest < 2 else f"x {smallest:.1f}"


def changes(comparison: Comparison) -> list[str]:
    fails = "" if comparison.rules.allow_missing else "REGRESSION "
    if comparison.rules.builders:  # cells of one builder alone are no change
        return [f"WRONG {cell.first.label}: {sentence}\n" for cell in comparison.cells for sentence in cell.regressions]
    return [*(f"REGRESSION {cell.first.label}: {sentence}\n" for cell in comparison.cells for sentence in cell.regressions),
            *(f"{fails}{cell.label}: not in B\n" for cell in comparison.only_first),
            *(f"changed {cell.first.label}: {sentence}\n" for cell in comparison.cells for sentence in cell.changes),
            *(f"new {cell.label}: only in B\n" for cell in comparison.only_second)]


def summary(comparison: Comparison) -> str:
    verdicts = [cell.verdict for cell in comparison.cells]
    counts = ", ".join(f"{verdicts.count(verdict)} {verdict}" for verdict in (SAME, FASTER, SLOWER, UNSURE))
    level = f"{counts} at {100 * comparison.rules.threshold:.1f} %"
    if builders := comparison.rules.builders:
        alone = len(comparison.only_first) + len(comparison.only_second)
        return (f"{counted(len(verdicts), 'cell')} of {builders[1]} against {builders[0]}: {level}\n"
                + (f"not of both: {counted(alone, 'cell')}\n" if alone else ""))
    few = sum(is_timed(cell) and not math.isfinite(cell.time.smallest) for cell in comparison.cells)
    regressions, unsure = comparison.regressions, verdicts.count(UNSURE)
    last = f"{regressions or 'no'} regression{'s' if regressions > 1 else ''}" + (f" found, {counted(unsure, 'cell')} unsure" if unsure else "")
    if not regressions and unsure == len(verdicts) > 0:
        last = f"unsure: of {counted(unsure, 'cell')} none has a verdict"
    return (f"{counted(len(verdicts), 'cell')}: {level}{f'; {few} have fewer than {FEWEST_SAMPLES} samples' if few else ''}\n"
            + (f"{counted(comparison.withheld, 'cell')} may have changed, or the warnings are why\n" if comparison.withheld else "")
            + f"{last}\n")
