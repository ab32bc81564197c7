"""Circumstances of a result file in words, and a 3D scene, as written by `bvhbench report --scene`, packed for a page."""
import array
import pathlib
from typing import Any

from ..files import documents
from ..read import ranking_text, results
from ..read.cells import Cell
from ..words.tables import counted
from .cell_data import scene_name, state_of, who


def sentence_of(document: dict[str, Any]) -> str:
    run = document["run"]
    program, device = run["program"], run["device"]
    where = f", of {run['host']['cpu']}" if device["kind"] == "cpu" and run["host"]["cpu"] not in device["name"] else ""
    return (f"{device['name']}{where}, driver {device['driver']}, {device['opencl_c']}; commit {program['commit'][:10]}"
            f"{' with local changes' if program['dirty'] else ''}; {run['started_at']}")


def warnings_of(document: dict[str, Any]) -> list[str]:
    run = document["run"]
    program = run["program"]
    told = [(results.is_dirty(program), f"The program was one {results.changes_text(program)}."),
            (program["build_type"] != "Release", f"The program was a {program['build_type']} build: its times are not those of a release."),
            ("finished_at" not in run, "The run has no end: it was stopped, or goes on. What is missing was not measured."),
            (run["device"]["kind"] == "cpu", "Kernels ran on a processor: times say nothing about a GPU.")]
    return [sentence for is_so, sentence in told if is_so] + ranking_text.warnings([Cell(raw) for raw in document["cells"] if "outside" in raw])


def packed(kind: str, values: list) -> bytes:
    """Returns little-endian 32-bit numbers; `kind` is 'f' or 'I'."""
    return array.array(kind, values).tobytes()


def view_of(path: pathlib.Path) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Returns the facts of a scene, and its arrays by name. Raises results.Refused if the file is not a scene."""
    view = results.parsed(path)
    try:
        documents.require(view["cell"], documents.CELL, "cell")
        documents.require(view["run"], documents.RUN, "run")
        arrays = {"points": packed("f", view["points"])}
        arrays |= {name: packed("I", view[name]) for name in ("faces", "pairs", "contacts")}
        arrays["boxes"] = packed("f", [side for level in view["levels"] for side in level["boxes"]])
        return facts_of_view(view, Cell(view["cell"])), arrays
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise results.Refused(f"{path}: no scene of a report: {error}") from error


def facts_of_view(view: dict[str, Any], cell: Cell) -> dict[str, Any]:
    run, check, frame = view["run"], cell.check, f", frame {cell.frame}" if cell.frame else ""
    pairs, contacts = (len(view[name]) // 2 for name in ("pairs", "contacts"))
    why = f": {check['detail']}" if check.get("detail") else ""
    said = (f" with {check.get('against', '')}{why}. {counted(pairs, 'pair')} of triangles have boxes that overlap, "
            f"{contacts:,} intersect; neighbours that share a vertex are left out. Built and queried on "
            f"{run['device']['name']}, commit {run['program']['commit'][:10]}{' with local changes' if run['program']['dirty'] else ''}.")
    return {"scene": scene_name(cell), "title": f"{scene_name(cell)}{frame}: {counted(len(view['faces']) // 3, 'triangle')}, {who(cell)}",
            "state": state_of(cell), "said": said,
            "levels": [{"count": len(level["boxes"]) // 6, "leaves": level["leaves"]} for level in view["levels"]]}
