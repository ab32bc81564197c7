"""Prints a ranking of builders or pipelines, and what was left out of it."""
from ..read import families, ranking_text, results
from ..read.cells import Cell, grouped
from ..read.ranking import Ranking, Row, ranked
from ..words import terminal
from ..words.tables import Table, counted, fixed, whole

MOST_ROWS = 12
MOST_OF_SCENE = 4  # rows of each scene, if there are several
MAY_BE_BLANK = ("<", "SAH", "box tests", "<error")  # columns that are left out if no row has them
MILLI, MEGA = 1e-6, 1e-6


def milliseconds(by_wall: bool) -> str:
    return "wall ms" if by_wall else "ms"


def verdict(row: Row) -> str:
    return next((cell.verdict for cell in row.cells if cell.verdict != "agrees"), "agrees")


def rows_text(rows: list[Row], most: int | None, scenes: list[str], by_wall: bool) -> str:
    """Returns a line for each row; "=" marks what is no worse than the best within noise. With several scenes each has a column
    with the ratio to its best."""
    lines = []
    for row in rows[:most]:
        columns = [fixed(ratio) for ratio in row.by_scene] if scenes else [fixed(row.ns * MILLI, 3)]
        samples = {len(cell.samples) for cell in row.cells}
        frames = "" if row.complete else f", {counted(len(row.cells), 'frame')} only"
        mark = "=" if row.tied and row is not rows[0] else ""
        lines.append([ranking_text.label(row.first), *columns, fixed(row.ratio), mark, fixed(row.bytes * MEGA, 1), fixed(row.sah),
                      whole(row.mean("box_tests_count")), row.wrong,
                  "–".join(str(count) for count in sorted({min(samples), max(samples)})), verdict(row) + frames])
    titles = ["<pipeline" if rows[0].first.collider else "<builder", *(scenes or [milliseconds(by_wall)]), "times the best", "<", "MB",
              "SAH", "box tests", "<error", "samples", "<verdict"]
    shown = [place for place, title in enumerate(titles) if title not in MAY_BE_BLANK or any(line[place] for line in lines)]
    table = Table(*(titles[place] for place in shown))
    for line in lines:
        table.row(*(line[place] for place in shown))
    more = len(rows) - len(lines)
    return table.text() + (f"and {more} more; --all\n" if more > 0 else "")


def reason(cell: Cell) -> str:
    """Returns the kind of reason, so that cells can be counted by it."""
    return cell.reason.partition(":")[0] if cell.reason.startswith(("cannot win", "left behind")) else cell.reason


def left_out(found: Ranking, all_: bool) -> str:
    """Returns what has no time, counted by reason or, with `all_`, listed."""
    lines = []
    for why, cells in grouped(found.without, reason).items():
        lines.append(terminal.prose(f"{counted(len(cells), 'cell')} {cells[0].status}: {why}") + "\n")
        lines += [f"    {cell.label}{cell.reason.removeprefix(why)}\n" for cell in cells] if all_ else []
    beaten = sum(cell.raw.get("sampling", {}).get("stopped") == "beaten" for rows in found.scenes.values() for row in rows
                 for cell in row.cells)
    lines += [f"{counted(beaten, 'cell')} beaten before the end of the race\n"] if beaten else []
    lines += [f"{counted(len(found.unplaced), 'cell')} without a place: they {families.NO_FRAME_BEFORE}\n"] if found.unplaced else []
    return "".join(lines)


def by_family(found: Ranking) -> str:
    """Returns a table of the best of each family by scene, with its time and the ratio to the scene's best; empty for one family."""
    firsts = {scene: ranking_text.best_of_families(rows) for scene, rows in found.scenes.items()}
    if max(map(len, firsts.values()), default=0) < 2:
        return ""
    table = Table("<scene", "<family", "<its best", milliseconds(found.by_wall), "times the best", "<")
    for scene, rows in firsts.items():
        for row in rows:
            mark = "=" if row.tied and row is not rows[0] else ""
            table.row(scene, ranking_text.family(row), ranking_text.label(row.first), fixed(row.ns * MILLI, 3), fixed(row.ratio), mark,
                      among=scene)
    return f"the best of each family:\n{table.text()}"


def families_of(run: results.Run) -> str:
    """Returns the table by_family of a run's cells of the experiment families; empty without such cells."""
    return by_family(ranked([cell for cell in run.all_cells if cell.experiment == families.EXPERIMENT and cell.caches == "hot"]))


def text(found: Ranking, all_: bool = False) -> str:
    """Returns the tables of a ranking: each scene's and, of several scenes, one over all."""
    parts = [f"WRONG: {cell.label}: {cell.check.get('detail', 'no detail given')}\n" for cell in found.wrong]
    several = len(found.scenes) > 1
    for scene, rows in found.scenes.items():
        parts += [f"{scene}\n"] if several else []
        parts.append(rows_text(rows, None if all_ else MOST_OF_SCENE if several else MOST_ROWS, [], found.by_wall))
    if several and found.rows:
        parts += ["all scenes: the geometric mean of the ratios to each scene's best\n",
                  rows_text(found.rows, None if all_ else MOST_ROWS, list(found.scenes), found.by_wall)]
    parts += [by_family(found), left_out(found, all_)]
    parts += [f"{terminal.prose(ranking_text.sentence(found))}\n"] if found.rows else []
    parts.append(ranking_text.warning_lines([cell for rows in found.scenes.values() for row in rows for cell in row.cells]))
    return "".join(parts)
