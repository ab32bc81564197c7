"""Prints a ranking of builders or pipelines, and what was left out of it."""
import re

from ..read import families, ranking_text, results
from ..read.cells import Cell, grouped
from ..read.ranking import Ranking, Row, chosen, ranked, was_beaten
from ..words import terminal
from ..words.tables import Table, counted, fixed, whole

EXPERIMENT = "best"
KIND = re.compile("(?<=^cannot win):.*|(?<=^left behind):.*")  # what differs from cell to cell in a reason
MOST_ROWS = 12
MOST_OF_SCENE = 4  # rows of each scene, if there are several
MAY_BE_UNKNOWN = ("SAH", "box tests", "pairs", "contacts")  # numbers that some rows lack
MAY_BE_BLANK = ("at least", "<", "<error", *MAY_BE_UNKNOWN)  # columns that are left out if no row has them
TAKE, UNKNOWN = "take", "-"
MILLI, MEGA = 1e-6, 1e-6


def rows_text(rows: list[Row], shown: list[Row], scenes: list[str], by_wall: bool) -> str:
    """Returns a line for each row that is shown, and what the marks and dashes mean. With several scenes each has a column with the ratio
    to its best."""
    take, is_tied = chosen(rows), sum(row.tied for row in rows) > 1
    titles = ["<pipeline" if rows[0].first.collider else "<builder", "<family", *(scenes or ["wall ms" if by_wall else "ms"]),
              "times the best", "at least", "<", "MB", "SAH", "box tests", "pairs", "contacts", "<error", "samples", "<verdict"]
    lines = []
    for row in shown:
        frames = "" if row.complete else f", {counted(len(row.cells), 'frame')} only"
        lines.append([ranking_text.label(row.first), ranking_text.family(row),
                      *([fixed(ratio) for ratio in row.by_scene] if scenes else [fixed(row.ns * MILLI, 3)]), fixed(row.ratio),
                      fixed(row.low / rows[0].high), TAKE if row is take else "=" * (row.tied and is_tied), fixed(row.bytes * MEGA, 1), fixed(row.amount("cost")),
                      *(whole(row.mean(f"{what}_count")) for what in ("box_tests", "pairs", "contacts")), row.wrong,
                      "–".join(str(count) for count in sorted({min(row.counts), max(row.counts)})),
                      next((cell.verdict for cell in row.cells if cell.verdict != "agrees"), "agrees") + frames])
    kept = [place for place, title in enumerate(titles) if title not in MAY_BE_BLANK or any(line[place] for line in lines)]
    table = Table(*(titles[place] for place in kept))
    for line in lines:
        table.row(*(line[place] or UNKNOWN * (titles[place] in MAY_BE_UNKNOWN) for place in kept))
    more = [f"and {len(rows) - len(shown)} more; `best --all` and `show --wide` print them"] * (len(rows) > len(shown))
    more += ["= as fast within noise: `at least`, where the row's interval of 95 % begins over where the best's ends, is 1 or less"] * is_tied
    more += [f"{TAKE}: of these, up to {ranking_text.number(rows[0].high / rows[0].ratio)} times the best, the least memory to two digits, "
             "then a family's plain builder, then the least time; forms as printed come last"] * (is_tied and take is not None)
    more += [f"{UNKNOWN}: a library does not count it, or there is no tree, or it was beaten in the race and not read back"
             ] * any(UNKNOWN in row for row in table.rows)
    return table.text() + "".join(f"{terminal.prose(line)}\n" for line in more)


def left_out(found: Ranking, all_: bool) -> str:
    """Returns what has no time, counted by the kind of its reason or, with `all_`, listed."""
    lines = []
    for why, cells in grouped(found.without, lambda cell: KIND.sub("", cell.reason)).items():
        lines.append(terminal.prose(f"{counted(len(cells), 'cell')} {cells[0].status}: {why}") + "\n")
        lines += [f"    {cell.label}{cell.reason.removeprefix(why)}\n" for cell in cells] if all_ else []
    beaten = sum(map(was_beaten, cells_of(found)))
    lines += [f"{counted(beaten, 'cell')} beaten before the end of the race\n"] if beaten else []
    lines += [f"{counted(len(found.unplaced), 'cell')} without a place: they {families.NO_FRAME_BEFORE}\n"] if found.unplaced else []
    return "".join(lines)


def cells_of(found: Ranking) -> list[Cell]:
    return [cell for rows in found.scenes.values() for row in rows for cell in row.cells]


def families_of(run: results.Run) -> str:
    """Returns the best of each family of each scene of the experiment families; empty without its cells."""
    found = ranked([cell for cell in run.all_cells if cell.experiment == families.EXPERIMENT and cell.caches == "hot"])
    return "".join(f"{scene}\n{rows_text(rows, ranking_text.best_of_families(rows), [], found.by_wall)}" for scene, rows in found.scenes.items())


def race(run: results.Run, all_: bool) -> str:
    """Returns what `best` printed of its file; empty for other files."""
    cells = run.all_cells
    if not cells or any(cell.experiment != EXPERIMENT for cell in cells):
        return ""
    return text(ranked(cells, ranking_text.objective_of([cell for cell in cells if cell.status == "measured"])), all_)


def text(found: Ranking, all_: bool = False) -> str:
    """Returns the tables of a ranking: each scene's and, of several scenes, one over all; what was left out, and the answer."""
    parts = [f"WRONG: {cell.label}: {cell.check.get('detail', 'no detail given')}\n" for cell in found.wrong]
    several = len(found.scenes) > 1
    for scene, rows in found.scenes.items():
        shown = rows if all_ else ranking_text.shown_of(rows, MOST_OF_SCENE if several else MOST_ROWS, chosen(rows))
        parts += [f"{scene}\n"] * several + [rows_text(rows, shown, [], found.by_wall)]
    if several and found.rows:
        parts += ["all scenes: the geometric mean of the ratios to each scene's best\n",
                  rows_text(found.rows, found.rows if all_ else ranking_text.shown_of(found.rows, MOST_ROWS, chosen(found.rows)), list(found.scenes), found.by_wall)]
    parts += [left_out(found, all_), f"{terminal.prose(ranking_text.sentence(found))}\n" if found.rows else ""]
    return "".join([*parts, ranking_text.warning_lines(cells_of(found))])
