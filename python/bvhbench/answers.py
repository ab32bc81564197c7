"""Result files, and the program's answer for a mesh, as tables of pandas, which is imported when they are asked for."""
import os
import pathlib
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from ._core import Error, Unavailable
from .arrays import faces_of

if TYPE_CHECKING:
    import pandas

Path = str | os.PathLike[str]


def read(paths: Path | Iterable[Path], counters: bool = False) -> "pandas.DataFrame":
    """Returns one row for each stage of each sample of the result files of bvhbench, packed or not, wrong answers included. Columns
    option_NAME hold the builder's options, collider_NAME the collider's; `counters` adds a column for each counter. A cell without
    samples has one row without times. Raises Error if a file is not a result file."""
    from ._plots.files.json_files import Refused
    from ._plots.read import sample_rows

    try:
        return sample_rows.read(paths, counters)
    except Refused as refused:
        raise Error(str(refused)) from None


def best(points, faces, device: str | int = "", *, goal: str = "frame", **options) -> "pandas.DataFrame":
    """Runs `bvhbench best` on a mesh, as Tree takes it, and returns a row a builder and collider, best first: `ns` a frame, its `ratio` to
    the best, whether it is `tied` with it and whether it is the one to `take`, `bytes` of memory, and `sah`, the tree's surface area cost.
    attrs["sentence"] says which to take. `goal` is "frame", "query", "build" or "memory"; `options` are those of the command, such as
    adjacent="drop", narrow="exact" or max_samples=5.

    Takes a minute or so. Raises Unavailable if there is no program, and Error with its sentence if it fails."""
    import pandas

    from ._plots.read import ranking, ranking_text, results

    points = np.asarray(points)
    faces = faces_of(faces)
    with tempfile.TemporaryDirectory() as folder:
        mesh, answer = (pathlib.Path(folder) / name for name in ("mesh.ply", "best.json"))
        mesh.write_bytes(ply(points, faces))
        words = [f"--{key.replace('_', '-')}={value}" for key, value in options.items()]
        done = subprocess.run([program(), "best", mesh, "--out", answer, "--for", goal, *[f"--device={device}"] * (device != ""), *words], capture_output=True, text=True,
                              check=False)
        if not answer.exists():
            raise Error(done.stderr.strip().rpartition("\n")[2].removeprefix("bvhbench: "))
        found = ranking.ranked(results.everything(answer).all_cells, goal)
    take = ranking.chosen(found.rows)
    rows = [{"builder": row.first.builder, "order": dict(row.first.options).get("order"), "collider": row.first.collider, "ns": row.ns,
             "ratio": row.ratio, "tied": row.tied, "take": row is take, "bytes": row.bytes, "sah": row.amount("cost"),
             "right": all(cell.checked for cell in row.cells)} for row in found.rows]
    table = pandas.DataFrame(rows)
    table.attrs["sentence"] = ranking_text.sentence(found) if found.rows else ""
    return table


def program() -> pathlib.Path:
    """Returns the program of the checkout that the module was built in, or else the first in PATH."""
    from . import _plots

    of_checkout = pathlib.Path(_plots.__file__).resolve().parents[1] / "bvhbench"
    found = of_checkout if of_checkout.is_file() else shutil.which("bvhbench")
    if not found:
        raise Unavailable("there is no program bvhbench in PATH")
    return pathlib.Path(found)


def ply(points: np.ndarray, faces: np.ndarray) -> bytes:
    """Returns a mesh as a file of PLY."""
    kind = "double" if points.dtype == np.float64 else "float"
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}", *(f"property {kind} {axis}" for axis in "xyz"),
            f"element face {len(faces)}", "property list uchar uint vertex_indices", "end_header", ""]
    rows = np.empty(len(faces), [("count", "u1"), ("corners", "<u4", 3)])
    rows["count"], rows["corners"] = 3, faces
    return "\n".join(head).encode() + points.astype("<f8" if kind == "double" else "<f4").tobytes() + rows.tobytes()
