"""One page of result files that anybody can open: tables, charts, raw samples, scenes in three dimensions. No network."""
import os
import pathlib
from collections import Counter
from typing import Any

from ..draw import figure, style
from ..figures import catalog as all_figures
from ..files import json_files, output
from ..read import results
from ..read.cells import Cell
from . import cell_data, circumstances, experiment_tables, findings, html, plot_looks, stress_data, tables
from .tables import TO_SAMPLES

LEADS_ON = "A time stands beside its verdict, and leads to its raw samples; so does a mark of a chart."
IN_BRIEF = "A time stands beside its verdict; the result files have the raw samples."
STATES = ("agrees", "counted", "not_checked", "holds", "refused", "differs", "broken", "failed", "skipped")
BAD = STATES[STATES.index("differs"):]
RUNS = [("experiments", "text"), ("cells", "count"), ("wrong or missing", "text"),
        *((name, "text") for name in ("device", "driver", "commit", "options", "machine", "processor", "started"))]
DEVICE = 4  # the column of a row of runs_table


def file_data(path: pathlib.Path, document: dict[str, Any], all_cells: list[Cell]) -> dict[str, Any]:
    reader, stress = results.Run(path, document), document.get("stress", [])
    cells = [cell_data.cell_data(cell, reader.copy_rate_of(cell)) for cell in all_cells]
    cell_data.mark_fronts(cells)
    by_library = Counter((cell["library"], cell["state"]) for cell in cells)
    by_library.update((cell.get("library"), finding["verdict"]) for cell in stress for finding in cell["findings"].values())
    return {"cells": cells, "bars": cell_data.bars_of(cells), "looks": plot_looks.looks_of(cells), "star": cell_data.STAR,
            "tables": experiment_tables.skips(all_cells) + experiment_tables.builders(reader) + tables.tables_of(cells)
            + stress_data.tables_of(stress), "states": tallied(by_library)}


def tallied(by_library: Counter[tuple[str | None, str]]) -> list[dict[str, str]]:
    """Returns the number of cells, or of findings of stress, in each state, and how many of the bad ones are each library's."""
    tally = []
    for state in STATES:
        counts = Counter({library: count for (library, other), count in by_library.items() if other == state})
        theirs = [(library, count) for library, count in counts.most_common() if library and state in BAD]
        whose = "all" if not counts[None] else f"{counts.total() - counts[None]:,}"
        named = ", ".join(f"{library} {count:,}" for library, count in theirs)
        if counts.total():
            tally.append({"state": state, "count": f"{counts.total():,}", "of": f", {whose} of libraries: {named}" if named else ""})
    return tally


def run_row(title: str, document: dict[str, Any], states: list[dict[str, str]]) -> list[Any]:
    """Returns the file's row of runs_table."""
    run, cells = document["run"], document["cells"]
    bad = "; ".join(f"{one['count']} {one['state']}{one['of']}" for one in states if one["state"] in BAD)
    return [title, ", ".join(dict.fromkeys(cell["experiment"] for cell in cells)) or "stress", len(cells) or len(document.get("stress", [])),
            bad or None, run["device"]["name"], run["device"]["driver"], run["program"]["commit"][:10], " ".join(run["command"][1:]),
            run["host"]["name"], run["host"]["cpu"], run["started_at"]]


def runs_table(rows: list[list[Any]]) -> dict[str, Any]:
    links = {"links": [f"#file-{number}" for number, _ in enumerate(rows)]}
    return cell_data.table("What was run on what", [("file", "text", links), *RUNS], ("device", "experiments", "commit"), rows)


def text_of(name: str) -> str:
    """Returns a file's name as text, although it may contain any bytes."""
    return os.fsencode(name).decode("utf-8", "replace")


def titles_of(files: list[pathlib.Path]) -> list[str]:
    """Returns each file's name, preceded by its folder if another file has the same name."""
    names = [json_files.name_of(path) for path in files]
    return [text_of(name if names.count(name) == 1 else f"{path.resolve().parent.name}/{name}")
            for path, name in zip(files, names, strict=True)]


def unlinked(table: dict[str, Any]) -> dict[str, Any]:
    """Returns a table whose numbers do not lead to their samples."""
    def leads_on(key: str, value: Any) -> bool:
        return key == "cells" or (key == "links" and any(link and link.startswith("#cell=") for link in value or []))

    columns = [{key: value for key, value in column.items() if not leads_on(key, value)} for column in table["columns"]]
    return table | {"cells": None, "columns": columns, "note": table["note"].replace(TO_SAMPLES, "")}


def in_brief(path: pathlib.Path, data: dict[str, Any]) -> tuple[dict[str, Any], list[tuple[str, str]]]:
    """Returns a file's data for tables alone, and the figures in place of its charts."""
    style.set_up()
    run = results.load(path)
    kept = data | {"cells": [], "bars": [], "looks": {}, "tables": [unlinked(table) for table in data["tables"]]}
    return kept, figure.as_svg(run, all_figures.pictures_of(run))


def make(files: list[pathlib.Path], views: list[pathlib.Path], is_brief: bool) -> tuple[str, bool]:
    """Returns the page and whether an answer was wrong. Raises results.Refused."""
    blobs, sections, is_wrong, runs, found = [], [], False, [], []
    titles = titles_of(files)
    for number, (path, title) in enumerate(zip(files, titles, strict=True)):
        document = results.document_of(path)
        cells = [Cell(cell) for cell in document["cells"]]
        stress = document.get("stress", [])
        try:
            data = file_data(path, document, cells)
            answers = findings.findings_of(cells) + ([stress_data.finding_of(stress)] if stress else [])
            shown, pictures = in_brief(path, data) if is_brief else (data, [])
            blobs.append(html.json_blob(f"file-{number}", shown))
        except (ArithmeticError, ValueError) as error:
            raise results.Refused(f"{path}: no page can be made of its numbers: {error}") from error
        is_wrong |= any(one["state"] == "differs" for one in data["states"])
        runs.append(run_row(title, document, data["states"]))
        found.append((title, answers))
        sections.append(html.section(number, title, circumstances.sentence_of(document),
                                     circumstances.warnings_of(document), circumstances.facts_of(document), answers))
        if is_brief:
            blobs.append(html.json_blob(f"pictures-{number}", pictures))
        else:
            blobs.append(html.json_blob(f"samples-{number}", [cell_data.samples_data(cell) for cell in cells]))
    scenes = []
    for number, path in enumerate(views):
        facts, arrays = circumstances.view_of(path)
        is_wrong |= facts["state"] == "differs"
        scenes.append(facts)
        blobs += [html.blob(f"view-{number}-{name}", content) for name, content in arrays.items()]
    best = findings.best_table(found)
    overview = ([unlinked(best) if is_brief else best] if best else []) + ([runs_table(runs)] if runs else [])
    head = {"titles": titles, "tables": overview, "views": scenes, "stages": plot_looks.stage_looks(), "dark": plot_looks.IN_THE_DARK}
    title = "bvhbench report" + (f": {', '.join(titles[:4])}" if files else "")
    title += f" and {len(files) - 4} more" if len(files) > 4 else ""
    blobs.insert(0, html.json_blob("head", head))
    libraries = html.libraries(charts=not is_brief, scenes=bool(scenes))
    said = html.devices([row[DEVICE] for row in runs]) + html.findings(found)
    return html.page(title, said, IN_BRIEF if is_brief else LEADS_ON, sections, blobs + libraries), is_wrong


def write(files: list[pathlib.Path], views: list[pathlib.Path], out: pathlib.Path, is_brief: bool) -> int:
    """Writes the page and returns the exit code: 1 if an answer was wrong. Raises results.Refused."""
    text, is_wrong = make(files, views, is_brief)
    content = text.encode("utf-8")
    if output.write(out, content):
        print(f"written: {out}, {len(content) / 1e6:.1f} MB")
    return 1 if is_wrong else 0
