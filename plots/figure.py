"""What the command lines of all figures share: files in, pictures out, a sentence for what cannot be drawn."""
from __future__ import annotations

import argparse
import math
import pathlib
import sys
import textwrap
from collections.abc import Callable

import matplotlib.pyplot as plt
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

import results
import style

MISSING_SHOWN = 4
Draw = Callable[[results.Run], plt.Figure]


def listed(names: list[str]) -> str:
    return ("; " if any("," in name for name in names) else ", ").join(names)


def notes(run: results.Run, experiment: str) -> list[str]:
    """What a reader must know of how cells were timed, were not checked, or are missing."""
    cells = [cell for cell in run.cells if cell.experiment == experiment and cell.operation in ("build", "collide")]
    lines = []
    on_host = sorted({cell.called for cell in cells if cell.on_host})
    if on_host:
        lines.append(f"On the host and its clock: {listed(on_host)} ({run.facts['host']['cpu']}).")
    unchecked = sorted({cell.called for cell in cells if not cell.checked})
    if unchecked:
        lines.append(f"Answers not checked: {listed(unchecked)}.")
    missing = run.left_out(experiment)
    if len(missing) > MISSING_SHOWN:
        missing[MISSING_SHOWN:] = [f"and {len(missing) - MISSING_SHOWN} more reasons for missing cells"]
    return lines + missing


def log_ticks(axis: Axis, low: float, high: float) -> None:
    """Plain numbers, at powers of ten; between them too where there are few."""
    steps = (1,) if high / low > 300 else (1, 2, 5)
    axis.set_major_locator(LogLocator(subs=steps, numticks=20))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.10g}"))
    axis.set_minor_formatter(NullFormatter())


def legend_above(figure: plt.Figure, handles: list, columns: int = 7) -> float:
    """A legend over all panels; answers the inches it takes."""
    figure.legend(handles=handles, loc="upper center", ncols=columns, columnspacing=1.2)
    return 0.1 + 0.16 * math.ceil(len(handles) / columns)


def footer(figure: plt.Figure, run: results.Run, experiment: str, extra: tuple[str, ...] = (),
           top_inches: float = 0) -> None:
    """The circumstances, remarks and missing cells in small type; the panels get the room that is left."""
    sentences = (run.circumstances(), *extra, *notes(run, experiment))
    lines = [piece for sentence in sentences for piece in textwrap.wrap(sentence, 130)]
    height = figure.get_figheight()
    bottom = (0.06 + 0.128 * len(lines)) / height
    figure.get_layout_engine().set(rect=(0, bottom, 1, 1 - bottom - top_inches / height))
    figure.text(0.01, 0.03 / height, "\n".join(lines), fontsize=style.SMALL, color="#444444", va="bottom",
                linespacing=1.25)


def draw_from(description: str | None, draw_all: Callable[[pathlib.Path, pathlib.Path], list[pathlib.Path]]) -> int:
    """What a command line asks for. Exits 1 with a sentence if a picture cannot be made."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path, metavar="FILE", help="result files")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."), metavar="DIR",
                        help="where the pictures go (default: here)")
    arguments = parser.parse_args()
    style.set_up()
    try:
        for path in arguments.files:
            for picture in draw_all(path, arguments.out):
                print(picture)
    except results.Refused as refusal:
        print(refusal, file=sys.stderr)
        return 1
    return 0


def command_line(name: str, description: str | None, draw: Draw) -> int:
    """One picture per file, called after it."""
    return draw_from(description, lambda path, folder: style.save(draw(results.load(path)), folder,
                                                                  style.stem(path, name)))


def command_line_of_frames(figures: dict[str, Draw], description: str | None) -> int:
    """A picture for each of these experiments that a file has frames of."""
    def draw_all(path: pathlib.Path, folder: pathlib.Path) -> list[pathlib.Path]:
        run = results.load(path)
        found = [name for name in figures if run.has_frames(name)]
        if not found:
            raise results.Refused(f"{path}: no measured frame of {' or '.join(figures)}")
        return [picture for name in found for picture in style.save(figures[name](run), folder, style.stem(path, name))]

    return draw_from(description, draw_all)
