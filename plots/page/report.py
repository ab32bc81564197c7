"""One page of result files that anybody can open: tables, charts, raw samples, scenes in three dimensions. No network."""
import os
import pathlib
from collections import Counter
from typing import Any, NamedTuple

from ..files import output
from ..files.json_files import Json
from ..read import input_files, results
from ..read.cells import Cell
from . import cell_data, circumstances, experiment_tables, findings, html, plot_looks, stress_data, tables

LEADS_ON = "A time stands beside its verdict, and leads to its raw samples; so does a mark of a chart."
STATES = ("agrees", "counted", "not_checked", "holds", "refused", "differs", "broken", "failed", "skipped")
BAD = STATES[STATES.index("differs"):]
KEPT = ("format", "run", "merged_from")  # parts of a file that a section shows as they are
RUNS = [("experiments", "text"), ("cells", "count"), ("wrong or missing", "text"),
        *((name, "text") for name in ("device", "driver", "commit", "options", "machine", "processor", "started"))]


def file_data(path: pathlib.Path, document: Json, all_cells: list[Cell]) -> Json:
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
        whose = "all" if not counts[None] else f"{counts.total() - counts[None]:,}"
        named = ", ".join(f"{library} {count:,}" for library, count in counts.most_common() if library and state in BAD)
        if counts.total():
            tally.append({"state": state, "count": f"{counts.total():,}", "of": f", {whose} of libraries: {named}" if named else ""})
    return tally


def run_row(title: str, document: Json, states: list[dict[str, str]]) -> list[Any]:
    """Returns the file's row of runs_table."""
    run, cells = document["run"], document["cells"]
    bad = "; ".join(f"{one['count']} {one['state']}{one['of']}" for one in states if one["state"] in BAD)
    return [title, ", ".join(dict.fromkeys(cell["experiment"] for cell in cells)) or "stress", len(cells) or len(document.get("stress", [])),
            bad or None, run["device"]["name"], run["device"]["driver"], run["program"]["commit"][:10], " ".join(run["command"][1:]),
            run["host"]["name"], run["host"]["cpu"], run["started_at"]]


def runs_table(rows: list[list[Any]]) -> Json:
    links = {"links": [f"#file-{number}" for number, _ in enumerate(rows)]}
    return cell_data.table("What was run on what", [("file", "text", links), *RUNS], ("device", "experiments", "commit"), rows)


class Part(NamedTuple):
    """What a section of the page shows of a result file, or of the history of an experiment (history.py), which has no samples."""

    title: str
    document: Json  # whose circumstances are told
    data: Json  # what page.js draws
    answers: list[Json]  # of findings.py
    warnings: list[str]
    samples: list[cell_data.Data] = []

    @property
    def is_wrong(self) -> bool:
        return any(one["state"] == "differs" for one in self.data["states"])


def part_of(path: pathlib.Path, title: str) -> Part:
    document = results.document_of(path)
    cells, stress = [Cell(cell) for cell in document["cells"]], document.get("stress", [])
    try:
        answers = findings.findings_of(cells) + ([stress_data.finding_of(stress)] if stress else [])
        return Part(title, document, file_data(path, document, cells), answers, circumstances.warnings_of(document),
                    [cell_data.samples_data(cell) for cell in cells])
    except (ArithmeticError, ValueError) as error:
        raise results.Refused(f"{path}: no page can be made of its numbers: {error}") from error


def make(files: list[pathlib.Path], views: list[pathlib.Path]) -> tuple[str, bool]:
    """Returns the page and whether an answer was wrong. Raises results.Refused."""
    titles = [os.fsencode(title).decode("utf-8", "replace") for title in input_files.titles_of(files)]
    parts = [part_of(path, title) for path, title in zip(files, titles, strict=True)]
    scenes = [circumstances.view_of(path) for path in views]
    best = findings.best_table([(part.title, part.answers) for part in parts])
    runs = [runs_table([run_row(part.title, part.document, part.data["states"]) for part in parts])] if parts else []
    is_wrong = any(part.is_wrong for part in parts) or any(facts["state"] == "differs" for facts, _ in scenes)
    return page_of("report", LEADS_ON, parts, [best, *runs] if best else runs, scenes), is_wrong


def page_of(kind: str, note: str, parts: list[Part], overview: list[Json], scenes: list[tuple[Json, dict[str, bytes]]]) -> str:
    """Returns the page. Its first part has the tables of `overview` and the scenes, each as returned by circumstances.view_of."""
    titles = [part.title for part in parts]
    head = {"titles": titles, "tables": overview, "views": [facts for facts, _ in scenes], "stages": plot_looks.stage_looks(),
            "dark": plot_looks.IN_THE_DARK}
    blobs, sections = [html.json_blob("head", head)], []
    for number, part in enumerate(parts):
        kept = {key: part.document[key] for key in KEPT if key in part.document}
        if whose := {f"{cell['outside']['name']}: {Cell(cell).provenance}": None for cell in part.document["cells"] if "outside" in cell}:
            kept["from_outside"] = list(whose)
        blobs += [html.json_blob(f"file-{number}", part.data | {"run": kept}),
                  html.json_blob(f"samples-{number}", part.samples)]
        sections.append(html.section(number, part.title, circumstances.sentence_of(part.document), part.warnings, part.answers))
    blobs += [html.blob(f"view-{number}-{name}", content) for number, (_, arrays) in enumerate(scenes) for name, content in arrays.items()]
    devices = [part.document["run"]["device"]["name"] for part in parts]
    of = ", ".join(titles if len(titles) < 4 else [f"{len(titles)} results of {' and '.join(dict.fromkeys(devices))}"])
    said = html.findings(devices, [(part.title, part.answers) for part in parts])
    return html.page(f"bvhbench {kind}" + f": {of}" * bool(of), said, note, sections, blobs + html.libraries(bool(scenes)))


def write(text: str, is_wrong: bool, out: pathlib.Path) -> int:
    """Writes a page and returns the exit code: 1 if an answer was wrong. Raises results.Refused."""
    content = text.encode("utf-8")
    if output.write(out, content):
        print(f"written: {out}, {len(content) / 1e6:.1f} MB")
    return 1 if is_wrong else 0
