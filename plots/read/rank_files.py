"""Cells of several ranks, which `bvhbench cluster`, its --simulate and `bvhbench scale` measure."""
import statistics

from ..files import documents
from ..files.json_files import Json, Refused

OPERATION = "cluster"
ASKED, FOUND = ("ranks_count", "simulated", "partition", "boxes_count"), ("halo_share", "imbalance", "ranks")  # keys of each; of each that was measured


def is_of_ranks(document: Json) -> bool:
    """True if all cells of a result file are of several ranks."""
    return all(cell.get("operation") == OPERATION for cell in document["cells"]) and bool(document["cells"])


def cells_of(document: Json, origin: str) -> list[Json]:
    """Returns the cells of several ranks of a result file, each with what it says of its ranks among its other keys. Raises Refused."""
    found = []
    for place, cell in enumerate(document["cells"]):
        if cell.get("operation") != OPERATION:
            continue
        where = f"cells[{place}].cluster"
        try:
            is_measured = cell["status"] == "measured"
            documents.require(cell.get("cluster"), ASKED + FOUND * is_measured, where)
            require_even(cell["cluster"])
        except (LookupError, TypeError, ValueError) as error:
            raise Refused(f"{origin} is no result file: {error}") from error
        found.append(cell | cell["cluster"])
    return found


def require_even(cluster: Json) -> None:
    """Raises ValueError unless all ranks have as many samples, and these the same stages."""
    each = [[[stage["stage"] for stage in sample["stages"]] for sample in rank.get("samples", [])]
            for rank in cluster.get("ranks", [])]
    if any(len(samples) != len(each[0]) for samples in each):
        raise ValueError("it has ranks with different numbers of samples")
    if any(stages != each[0][0] for samples in each for stages in samples):
        raise ValueError("it has samples with different stages")


def measured(cells: list[Json]) -> list[Json]:
    """Returns the measured cells, by their number of ranks, ascending."""
    return sorted((cell for cell in cells if cell["status"] == "measured"), key=lambda cell: cell["ranks_count"])


def asked_of(cell: Json) -> Json:
    """Returns what was asked for, but for the scene."""
    builder, collider = (cell.get(part, {}) for part in ("builder", "collider"))
    options = collider.get("options", {})
    return {"ranks": cell["ranks_count"], "partition": cell["partition"], "builder": builder.get("name"),
            "order": builder.get("options", {}).get("order"), "collider": collider.get("name"), "adjacent": options.get("adjacent"),
            "narrow": options.get("narrow", "none"), "within": options.get("within", "none"), "boxes": cell["boxes_count"],
            "frames": len(cell.get("frames", [])), "devices": "shared" if cell.get("shares_devices") else "one a rank"}


def stage_times(cell: Json, clock: str = "host_ns") -> dict[str, list[float]]:
    """Returns the median time of each stage on each rank, in nanoseconds; empty if ranks shared a device."""
    times: dict[str, list[float]] = {}
    for rank in cell["ranks"]:
        for k, stage in enumerate(rank["samples"][0]["stages"] if rank["samples"] else []):
            times.setdefault(stage["stage"], []).append(statistics.median(sample["stages"][k][clock] for sample in rank["samples"]))
    return times
