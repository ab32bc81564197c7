#!/usr/bin/env python3
"""One page of result files that anybody can open: tables, charts, raw samples, scenes in three dimensions. No network.

    plots/report.py FILE... -o report.html

`bvhbench report` calls it and makes what --view names. Exits 0; 1 if an answer in the files was wrong, which the page shows; 2
for wrong usage; 3 if a file or library is missing or a file is no result.
"""
import argparse
import os
import pathlib
import sys
from collections import Counter
from typing import Any

import all as all_figures
import figure
import json_files
import output
import report_builders
import report_cells
import report_facts
import report_findings
import report_looks
import report_page
import report_skips
import report_stress
import report_tables
import results
import style
from cells import Cell
from report_tables import TO_SAMPLES


LEADS_ON = "A time stands beside its verdict, and leads to its raw samples; so does a mark of a chart."
IN_BRIEF = "A time stands beside its verdict; the result files have the raw samples."
OF_A_FILE = ("cells", "bars", "looks", "tables", "findings")  # what the overview does not need of a file's data


def file_data(path: pathlib.Path, document: dict[str, Any], all_cells: list[Cell]) -> dict[str, Any]:
    run, reader = document["run"], results.Run(path, document)
    cells = [report_cells.cell_data(cell, reader.copy_rate_of(cell)) for cell in all_cells]
    report_cells.mark_fronts(cells)
    stress = document.get("stress", [])
    by_library = Counter((cell["library"], cell["state"]) for cell in cells) + report_stress.states_of(stress)
    findings = report_findings.findings_of(all_cells) + ([report_stress.finding_of(stress)] if stress else [])
    return {"name": text_of(json_files.name_of(path)), "path": text_of(path.name), "cells": cells,
            "bars": report_cells.bars_of(cells), "looks": report_looks.looks_of(cells),
            "tables": report_skips.tables_of(all_cells) + report_builders.tables_of(reader) + report_tables.tables_of(cells)
            + report_stress.tables_of(stress), "states": tallied(by_library),
            "findings": findings, "star": report_cells.STAR,
            "experiments": list(dict.fromkeys(cell["experiment"] for cell in cells)) or ["stress"],
            "device": run["device"]["name"], "driver": run["device"]["driver"], "machine": run["host"]["name"],
            "processor": run["host"]["cpu"], "commit": run["program"]["commit"][:10], "started": run["started_at"],
            "options": " ".join(run["command"][1:])}


def tallied(by_library: Counter[tuple[str | None, str]]) -> dict[str, dict[str, Any]]:
    """Returns the number of cells, or of findings of stress, in each state, and how many of them are each library's."""
    states: dict[str, dict[str, Any]] = {}
    for (library, state), count in by_library.items():
        here = states.setdefault(state, {"count": 0, "libraries": {}})
        here["count"] += count
        if library:
            here["libraries"][library] = count
    return states


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
    blobs, sections, is_wrong, summary, found = [], [], False, [], []
    for number, (path, title) in enumerate(zip(files, titles_of(files), strict=True)):
        document = results.document_of(path)
        cells = [Cell(cell) for cell in document["cells"]]
        try:
            data = file_data(path, document, cells) | {"title": title}
            shown, pictures = in_brief(path, data) if is_brief else (data, [])
            blobs.append(report_page.json_blob(f"file-{number}", shown))
        except (ArithmeticError, ValueError) as error:
            raise results.Refused(f"{path}: no page can be made of its numbers: {error}") from error
        is_wrong |= "differs" in data["states"]
        summary.append({key: value for key, value in data.items() if key not in OF_A_FILE}
                       | {"count": len(data["cells"]) or len(document.get("stress", []))})
        found.append((title, data["findings"]))
        sections.append(report_page.section(number, title, report_facts.sentence_of(document),
                                            report_facts.warnings_of(document), report_facts.facts_of(document), data["findings"]))
        if is_brief:
            blobs.append(report_page.json_blob(f"pictures-{number}", pictures))
        else:
            blobs.append(report_page.json_blob(f"samples-{number}", [report_cells.samples_data(cell) for cell in cells]))
    scenes = []
    for number, path in enumerate(views):
        facts, arrays = report_facts.view_of(path)
        is_wrong |= facts["state"] == "differs"
        scenes.append(facts)
        blobs += [report_page.blob(f"view-{number}-{name}", content) for name, content in arrays.items()]
    best = report_findings.best_table(found)
    head = {"files": summary, "views": scenes, "stages": report_looks.stage_looks(), "dark": report_looks.IN_THE_DARK,
            "best": unlinked(best) if best and is_brief else best}
    title = "bvhbench report" + (f": {', '.join(titles_of(files)[:4])}" if files else "")
    title += f" and {len(files) - 4} more" if len(files) > 4 else ""
    blobs.insert(0, report_page.json_blob("head", head))
    libraries = report_page.libraries(charts=not is_brief, scenes=bool(scenes))
    said = report_page.devices([file["device"] for file in summary]) + report_page.findings(found)
    return report_page.page(title, said, IN_BRIEF if is_brief else LEADS_ON, sections, blobs + libraries), is_wrong


def write(files: list[pathlib.Path], views: list[pathlib.Path], out: pathlib.Path, force: bool, is_brief: bool) -> int:
    """Writes the page and returns the exit code: 1 if an answer was wrong. Raises output.WrongUsage or results.Refused."""
    output.check(out, [*files, *views], force, output.is_page)
    text, is_wrong = make(files, views, is_brief)
    content = text.encode("utf-8")
    if output.write(out, content):
        print(f"written: {out}, {len(content) / 1e6:.1f} MB")
    return 1 if is_wrong else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path, metavar="FILE", help="result files")
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("report.html"), help="the page")
    parser.add_argument("--force", action="store_true", help="replace a file that is no page")
    parser.add_argument("--view", action="append", default=[], type=pathlib.Path, help="a scene, as `bvhbench view` writes it")
    parser.add_argument("--brief", action="store_true", help="figures in place of charts, and no samples")
    arguments = parser.parse_args()

    return output.to_an_end(lambda: write(arguments.files, arguments.view, arguments.out, arguments.force, arguments.brief),
                            "bvhbench: ")


if __name__ == "__main__":
    sys.exit(main())
