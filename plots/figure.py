"""What the command lines of all figures share: files in, pictures out, a sentence for what cannot be drawn."""
import argparse
import functools
import math
import pathlib
import textwrap
from collections.abc import Callable, Iterator

import matplotlib.pyplot as plt
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

import output
import results
import style

MISSING_SHOWN = 4
Draw = Callable[[results.Run], plt.Figure]
Figures = dict[str, Callable[[], plt.Figure]]  # by the name of the picture


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


def save_all(run: results.Run, figures: Figures, folder: pathlib.Path, inputs: list[pathlib.Path], force: bool) -> Iterator[pathlib.Path]:
    """Raises what style.save does, and results.Refused where a figure cannot be made of the file's numbers."""
    for name, draw in figures.items():
        try:
            yield from style.save(draw(), folder, name, inputs, force)
        except (ArithmeticError, LookupError, RuntimeError, TypeError, UserWarning, ValueError) as error:
            raise results.Refused(f"{run.path}: the figure {name} cannot be drawn of it: {output.described(error)}") from error


def add_output(parser: argparse.ArgumentParser, **folder: object) -> None:
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR", **folder)
    parser.add_argument("--force", action="store_true", help="replace files of the pictures' names that are no pictures")


def draw_from(description: str | None, figures_of: Callable[[results.Run], Figures]) -> int:
    """What a command line asks for: exits as output.to_an_end."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path, metavar="FILE", help="result files")
    add_output(parser, default=pathlib.Path("."), help="where the pictures go (default: here)")
    arguments = parser.parse_args()
    style.set_up()

    def draw_all() -> int:
        for path in arguments.files:
            run = results.load(path)
            for picture in save_all(run, figures_of(run), arguments.out, arguments.files, arguments.force):
                print(picture)
        return 0

    return output.to_an_end(draw_all)


def command_line(name: str, description: str | None, draw: Draw) -> int:
    """One picture per file, called after it."""
    return draw_from(description, lambda run: {style.stem(run.path, name): lambda: draw(run)})


def command_line_of_frames(figures: dict[str, Draw], description: str | None) -> int:
    """A picture for each of these experiments that a file has frames of."""
    def figures_of(run: results.Run) -> Figures:
        found = {style.stem(run.path, name): functools.partial(draw, run) for name, draw in figures.items() if run.all_frames(name)}
        if not found:
            raise results.Refused(f"{run.path}: no measured frame of {' or '.join(figures)}")
        return found

    return draw_from(description, figures_of)
