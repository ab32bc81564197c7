"""Files of `bvhbench cluster`, of its --simulate, and of `bvhbench scale`: which a file is, and reading it."""
import functools
import json
import lzma
import os
import pathlib
from typing import Any

from ..files import documents
from ..files import shape
from ..files.documents import FOLDER
from ..files.json_files import Refused, parsed

ONE, SIMULATED, RUNS = "cluster-1", "cluster-simulation-1", "cluster-runs-1"  # formats, without their minor version
USUAL_BOXES = 64  # that each rank tells the others, in files that do not say


def kind_of(path: str | os.PathLike[str]) -> str:
    """Returns ONE, SIMULATED or RUNS; empty for any other file. Reads the beginning alone, where such a file has its format."""
    file = pathlib.Path(path)
    if not file.is_file():  # what is no regular file, a pipe for one, can be read only once
        return ""
    try:
        with lzma.open(file) if file.suffix == ".xz" else file.open("rb") as beginning:
            text = beginning.read(100)
    except (OSError, EOFError, lzma.LZMAError):
        return ""
    return next((kind for kind in (ONE, SIMULATED, RUNS) if f'"{kind}.'.encode() in text), "")


@functools.cache
def check_of(kind: str) -> shape.Check:
    """Returns the check of a format by its schema."""
    schema = json.loads((FOLDER / "schema" / f"{kind}.schema.json").read_text(encoding="utf-8"))
    return shape.check_of(schema, schema)


def format_of(document: dict[str, Any]) -> str:
    return document["format"].split(".")[0]


def read(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Reads a file that kind_of knows, and checks it and the results in it. Raises Refused."""
    document = parsed(pathlib.Path(path))
    try:
        check_of(kind_of(path))(document)
        results = [run["result"] for run in document.get("runs", []) if "result" in run]
        for result in results:
            check_of(format_of(result))(result)
        for result in results or [document]:
            documents.check_of("run")(result["run"])
            check_even(result)
    except shape.Wrong as wrong:
        raise Refused(f"{path}: not a file of `bvhbench cluster`: {wrong}") from wrong
    return document


def check_even(result: dict[str, Any]) -> None:
    """Raises Wrong unless all ranks have as many samples, and these the same stages, which no schema can say."""
    each = [[[stage["stage"] for stage in sample["stages"]] for sample in rank.get("samples", [])]
            for rank in result.get("ranks", [])]
    if any(len(samples) != len(each[0]) for samples in each):
        raise shape.Wrong("has ranks with different numbers of samples")
    if any(stages != each[0][0] for samples in each for stages in samples):
        raise shape.Wrong("has samples with different stages")


def measured(document: dict[str, Any]) -> list[dict[str, Any]]:
    """Returns the results of measured cells of a file of `scale`, with their number of ranks, ascending."""
    runs = [run["result"] | {"count": run["ranks"]} for run in document["runs"] if run["status"] == "measured"]
    return sorted(runs, key=lambda run: run["count"])


def stage_times(run: dict[str, Any], clock: str = "host_ns") -> dict[str, list[float]]:
    """Returns the median time of each stage on each rank, in nanoseconds; empty if ranks shared a device."""
    times: dict[str, list[float]] = {}
    for rank in run["ranks"]:
        for k, stage in enumerate(rank["samples"][0]["stages"] if rank["samples"] else []):
            own = sorted(sample["stages"][k][clock] for sample in rank["samples"])
            times.setdefault(stage["stage"], []).append((own[(len(own) - 1) // 2] + own[len(own) // 2]) / 2)
    return times
