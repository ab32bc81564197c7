"""Formats a comparison as text: cells whose time changed or may have changed, worst first, with their stages; one line for each
other change; and the number of cells of each verdict."""
from comparing.comparison import ComparedCell, Comparison
from comparing.intervals import Interval
from comparing.scenes import SceneChange
from comparing.times import FASTER, FEWEST_SAMPLES, SAME, SLOWER, UNSURE, TimeChange
from tables import Table, counted, duration

WORST_FIRST = (SLOWER, UNSURE, FASTER, SAME)


def text(comparison: Comparison, show_all: bool = False) -> str:
    lines = [f"not the same: {remark}\n" for remark in comparison.remarks]
    if comparison.rules.other_devices:
        lines.append("ratios are of the median ratio of their scene: only how cells relate counts\n")
    return "".join([*lines, times_table(comparison, show_all), *changes(comparison), summary(comparison)])


def times_table(comparison: Comparison, show_all: bool) -> str:
    shown = [cell for cell in comparison.cells
             if is_timed(cell) and (show_all or is_notable(cell.time, comparison.rules.threshold))]
    if not shown and not comparison.scenes:
        return ""
    table = Table("<cell", "A", "B", "B/A", "own", "between", "p", "n", "<")
    for cell in sorted(shown, key=lambda cell: (WORST_FIRST.index(cell.verdict), -cell.time.ratio.value)):
        table.row(*row_of(cell.first.label, cell.time), cell.verdict)
        for stage, change in cell.stages.items():
            table.row(*row_of(f"  {stage}", change))
    for scene in comparison.scenes:
        table.row(*scene_row(scene))
    return table.text()


def is_timed(cell: ComparedCell) -> bool:
    return cell.time.counts[0] > 0


def is_notable(change: TimeChange, threshold: float) -> bool:
    """True if the time changed, or if an unsure cell's median moved by more than the threshold."""
    within = 1 / (1 + threshold) < change.ratio.value < 1 + threshold
    return change.verdict in (FASTER, SLOWER) or (change.verdict == UNSURE and not within)


def row_of(name: str, change: TimeChange) -> list[str]:
    before, after = change.first.value, change.second.value
    return [name, duration(before), duration(after), f"{after / before:.3f}" if before > 0 else "", f"{change.ratio.value:.3f}",
            ends(change.ratio), f"{change.p:.0e}" if change.p < 0.001 else f"{change.p:.3f}",
            "/".join(str(count) for count in dict.fromkeys(change.counts))]


def scene_row(change: SceneChange) -> list[str]:
    name = f"{change.scene.scene_facts['name']}: {change.cells} {change.scene.operation} cells together"
    return [name, "", "", f"{change.ratio.value:.3f}", "", ends(change.ratio), "", "", change.verdict]


def ends(ratio: Interval) -> str:
    return f"{ratio.low:.3f} – {ratio.high:.3f}" if ratio.has_ends else "too few"


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
    few = sum(is_timed(cell) and min(cell.time.counts) < FEWEST_SAMPLES for cell in comparison.cells)
    regressions = comparison.regressions
    if builders := comparison.rules.builders:
        alone = len(comparison.only_first) + len(comparison.only_second)
        return (f"{counted(len(verdicts), 'cell')} of {builders[1]} against {builders[0]}: {counts} at "
                f"{100 * comparison.rules.threshold:.1f} %\n" + (f"not of both: {counted(alone, 'cell')}\n" if alone else ""))
    return (f"{counted(len(verdicts), 'cell')}: {counts} at {100 * comparison.rules.threshold:.1f} %"
            f"{f'; {few} have fewer than {FEWEST_SAMPLES} samples' if few else ''}\n"
            f"{regressions or 'no'} regression{'s' if regressions > 1 else ''}\n")
