"""Prints what each choice decides of a frame's time, and which measure of a tree predicts a query's (read/effects.py)."""
import itertools
from collections.abc import Iterable, Iterator, Sequence

import numpy

from ..read import effects, results
from ..read.cells import Cell
from ..words import terminal
from ..words.tables import Table, counted, fixed, percent, span

TITLES = tuple(title for part in ("frame", "query") for title in (part, "95 %", "scenes"))  # of ratios


def text(run: results.Run) -> str:
    """Returns the tables; of other experiments only which measure predicts a query's time, if trees were measured."""
    cells, measured = effects.frames_of(run.all_cells), effects.frames_of(run.all_cells, of_any=True)
    predicts = headed("rank correlation with the time of the stage broad, median and range of scenes", titles_of_ranks(measured),
                      rows_of_ranks(measured))
    if not cells:
        return predicts
    missing = [terminal.prose(f"{scene} does not count in shares: {counted(len(lacks), 'cell')} missing, as {', '.join(lacks[0])}") + "\n"
               for scene, lacks in effects.lacking(cells).items() if lacks]
    frame, query = (effects.shares(cells, of_query) for of_query in (False, True))
    return (headed("time over the reference's, all else equal; trees with one way to store leaves are held against sorted ones",
                   ("<choice", "<level", "<against", *TITLES, "pairs"), rows_of_ratios(cells))
            + headed("shares of the sum of squares of log times within scenes", ("<decided by", "frame", "query"),
                     ([name, percent(share), percent(query[name])] for name, share in frame.items())) + "".join(missing) + predicts)


def headed(heading: str, titles: Sequence[str], rows: Iterable[list[str]]) -> str:
    table = Table(*titles)
    for row in rows:
        table.row(*row)
    return f"{terminal.prose(heading)}:\n{table.text()}" if table.rows else ""


def rows_of_ratios(cells: list[Cell]) -> Iterator[list[str]]:
    """Yields a level's row: choice, level and reference; of frame and query the geometric mean of the ratios, its interval, and the
    range of scenes; the number of pairs of queries."""
    for one in effects.effects(cells):
        columns = [text for ratio in (one.frame, one.query) for text in (columns_of(ratio) if ratio else [""] * 3)]
        yield [one.choice, one.level, effects.CHOICES[one.choice], *columns, str(one.query.pairs)]


def columns_of(ratio: effects.Ratio) -> list[str]:
    return [fixed(ratio.mean), span(ratio.interval, 2, "-"), span(ratio.by_scene.values(), 2, "-")]


def titles_of_ranks(cells: list[Cell]) -> list[str]:
    return ["<measure", "<of", *dict.fromkeys(cell.collider or "" for cell in cells)]


def rows_of_ranks(cells: list[Cell]) -> Iterator[list[str]]:
    """Yields the row of a measure and a kind of trees: of each collider the median of the rank correlations over scenes, and their range."""
    for measure, kind in itertools.product(effects.MEASURES, effects.KINDS):
        if found := {collider: list(there.values()) for collider, there in effects.correlations(cells, measure, kind).items()}:
            yield [measure, kind, *(f"{numpy.median(found[collider]):.2f} ({span(found[collider], 2)})" if collider in found else ""
                                    for collider in titles_of_ranks(cells)[2:])]
