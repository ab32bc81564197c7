"""Files of `bvhbench cluster`, of its --simulate, and of `bvhbench scale`: which a file is, and reading it."""
import lzma
import os
import pathlib
import statistics
from typing import Any

from ..files import documents
from ..files.json_files import Refused, parsed

ONE, SIMULATED, RUNS = "cluster-1", "cluster-simulation-1", "cluster-runs-1"  # formats, without their minor version
# Keys of a result, and of a file of `scale`.
RESULT, RUNS_KEYS = ("format", "run", "scene", "partition", "builder", "ranks"), ("format", "experiment", "command", "runs")
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


def format_of(document: dict[str, Any]) -> str:
    return document["format"].split(".")[0]


def read(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Reads a file that kind_of knows, and checks the keys of the results in it. Raises Refused."""
    document, kind = parsed(pathlib.Path(path)), kind_of(path)
    try:
        documents.require(document, RUNS_KEYS if kind == RUNS else RESULT)
        for result in [run["result"] for run in document["runs"] if "result" in run] if kind == RUNS else [document]:
            documents.require(result, RESULT, "result")
            documents.require(result["run"], documents.RUN, "run")
            require_even(result)
    except (LookupError, TypeError, ValueError) as error:
        raise Refused(f"{path}: not a file of `bvhbench cluster`: {error}") from error
    return document


def require_even(result: dict[str, Any]) -> None:
    """Raises ValueError unless all ranks have as many samples, and these the same stages."""
    each = [[[stage["stage"] for stage in sample["stages"]] for sample in rank.get("samples", [])]
            for rank in result.get("ranks", [])]
    if any(len(samples) != len(each[0]) for samples in each):
        raise ValueError("it has ranks with different numbers of samples")
    if any(stages != each[0][0] for samples in each for stages in samples):
        raise ValueError("it has samples with different stages")


def measured(document: dict[str, Any]) -> list[dict[str, Any]]:
    """Returns the results of measured cells of a file of `scale`, with their number of ranks, ascending."""
    runs = [run["result"] | {"count": run["ranks"]} for run in document["runs"] if run["status"] == "measured"]
    return sorted(runs, key=lambda run: run["count"])


def stage_times(run: dict[str, Any], clock: str = "host_ns") -> dict[str, list[float]]:
    """Returns the median time of each stage on each rank, in nanoseconds; empty if ranks shared a device."""
    times: dict[str, list[float]] = {}
    for rank in run["ranks"]:
        for k, stage in enumerate(rank["samples"][0]["stages"] if rank["samples"] else []):
            times.setdefault(stage["stage"], []).append(statistics.median(sample["stages"][k][clock] for sample in rank["samples"]))
    return times
