"""Prints files of `bvhbench cluster` and `bvhbench scale`."""
import pathlib
from typing import Any

from ..read import rank_files, results
from ..words.tables import Table, counted, duration, size, whole
from . import run as run_page

Json = dict[str, Any]


def text(document: Json) -> str:
    return {rank_files.ONE: one, rank_files.SIMULATED: simulated, rank_files.RUNS: scale}[rank_files.format_of(document)](document)


def one(document: Json) -> str:
    """Returns the ranks, the stages, and lines that sum up."""
    builder, collider = document["builder"], document["collider"]
    narrow = collider.get("narrow", "none")
    head = (f"{document['scene']['name']}: {counted(document['scene']['triangles'], 'triangle')}, {collider['name']} over "
            f"{builder['name']} along {builder['order']}, adjacent {collider['adjacent']}, narrow {narrow}, "
            f"{counted(len(document['ranks']), 'rank')}, {document['partition']}\n")
    lines = [f"halo: {100 * document['halo_share']:.1f} % of the triangles; imbalance: {document['imbalance']:.3f} of the mean\n"]
    if "frame_ns" in document:
        lines += [f"frame: {duration(document['frame_ns'])} by the host's clock, median of "
                  f"{counted(len(document['ranks'][0]['samples']), 'sample')}; partition, once: {duration(document['partition_ns'])}\n"]
    else:
        lines += ["ranks shared a device: there are no times\n"]
    return (run_page.text(results.Run(pathlib.Path(), document)) + head + ranks(document) + stages(document) + frames(document)
            + "".join(lines) + verdict(document))


def ranks(document: Json) -> str:
    table = Table("rank", "<host", "triangles", "halo sent", "received", "bytes sent", "own pairs", "halo pairs", "contacts",
                  "device memory", "host memory")
    for number, rank in enumerate(document["ranks"]):
        contacts = whole(rank.get("contacts_count")) if "contacts_count" in document else ""
        table.row(str(number), rank["host"], whole(rank["triangles"]), whole(rank["halo_sent_count"]), whole(rank["halo_received_count"]),
                  size(rank["sent_bytes"]), whole(rank["own_pairs_count"]), whole(rank["halo_pairs_count"]), contacts,
                  size(rank["device_peak_bytes"]), size(rank["host_peak_bytes"]))
    return table.text()


def stages(document: Json) -> str:
    """Returns the median of each stage by both clocks, two rows for each rank; empty if there are no times."""
    host, device = (rank_files.stage_times(document, clock) for clock in ("host_ns", "device_ns"))
    if not host:
        return ""
    table = Table("rank", "<clock", *host)
    for number in range(len(document["ranks"])):
        table.row(str(number), "host", *(duration(times[number]) for times in host.values()))
        table.row("", "device", *(duration(times[number]) if times[number] else "" for times in device.values()))
    return table.text()


def frames(document: Json) -> str:
    """Returns a line on the frames of a scene that moves; empty for another one."""
    if not (those := document.get("frames", [])):
        return ""
    return (f"{counted(len(those), 'frame')}; work of a rank at most {max(frame['work_imbalance'] for frame in those):.3f} of the mean; "
            f"rebalanced {counted(sum(frame['moved_count'] > 0 for frame in those), 'time')}, "
            f"{counted(sum(frame['moved_count'] for frame in those), 'triangle')} moved\n")


def verdict(document: Json) -> str:
    check = document["check"]
    said = {"agrees": f"agrees with {check['against']}", "differs": f"DIFFERS from {check['against']}: {check['detail']}",
            "not_checked": f"not checked: {check['detail']}"}[check["verdict"]]
    found = "".join(f", {document[f'{what}_count']:,} {what}, set hash {document[f'{what}_set_hash']}"
                    for what in ("pairs", "contacts") if f"{what}_count" in document)
    return f"verdict: {said}{found}\n"


def simulated(document: Json) -> str:
    def most(key: str) -> int:
        return max(rank[key] for rank in document["ranks"])

    model = (f"a frame by the model: {duration(document['model_ns'])}, of which the largest part takes {duration(document['part_ns'])}\n"
             if "model_ns" in document else "")
    return (run_page.text(results.Run(pathlib.Path(), document))
            + f"{document['scene']['name']}: {counted(document['scene']['triangles'], 'triangle')} on "
            f"{counted(len(document['ranks']), 'rank')}, simulated: {document['partition']}, {document['builder']['name']} along "
            f"{document['builder']['order']}, {document['boxes_count']} box{'es' * (document['boxes_count'] > 1)} a rank\n"
            f"halo: {100 * document['halo_share']:.1f} % of the triangles; imbalance: {document['imbalance']:.3f} of the mean\n"
            f"a rank sends {counted(most('halo_sent_count'), 'triangle')} at most, to {counted(most('targets_count'), 'rank')} at most; "
            f"receives {counted(most('halo_received_count'), 'triangle')} at most, from {counted(most('sources_count'), 'rank')} at most\n"
            f"boxes of all other ranks, received by each: {size(document['box_bytes'])}\n{model}")


def scale(document: Json) -> str:
    """Returns a row for each cell."""
    table = Table("<scene", "ranks", "<partition", "boxes", "frame", "times one rank", "halo", "largest part", "<verdict")
    runs = rank_files.measured(document)
    first = next((run for run in runs if "frame_ns" in run), None)
    for run in runs:
        grows = run["scene"]["triangles"] / first["scene"]["triangles"] if first else 1  # weak: the scene of P ranks is larger
        table.row(run["scene"]["name"], str(run["count"]), run["partition"], str(run.get("boxes_count", rank_files.USUAL_BOXES)),
                  duration(run["frame_ns"]) if first else "", f"{grows * first['frame_ns'] / run['frame_ns']:.2f}" if first else "",
                  f"{100 * run['halo_share']:.1f} %", f"{run['imbalance']:.3f}", run.get("check", {}).get("verdict", "counted"))
    failed = "".join(f"{run['scene']} on {counted(run['ranks'], 'rank')}: {run['reason']}\n" for run in document["runs"]
                     if run["status"] != "measured")
    return f"scale {document['experiment']}\n{table.text()}{failed}"
