"""Prints cells of several ranks."""
from ..files.json_files import Json
from ..read import rank_files, results
from ..read.cells import grouped
from ..words.tables import Table, counted, duration, size, whole


def text(run: results.Run) -> str:
    """Returns the tables of a file of `cluster`, and of any other file a row for each cell of ranks; empty without such cells."""
    cells = rank_files.cells_of(run.document, str(run.path))
    if [(cell["experiment"], cell["status"]) for cell in cells] != [("cluster", "measured")]:
        return "".join(table(those) for those in grouped(cells, lambda cell: cell["experiment"]).values())
    return (simulated if cells[0]["simulated"] else one)(cells[0])


def one(cell: Json) -> str:
    """Returns the ranks, the stages, and lines that sum up."""
    asked = rank_files.asked_of(cell)
    head = (f"{cell['scene']['name']}: {counted(cell['scene']['triangles'], 'triangle')}, "
            "{collider} over {builder} along {order}, adjacent {adjacent}, narrow {narrow}, ".format_map(asked)
            + (f"within {asked['within']}, " if asked["within"] != "none" else "") + f"{counted(len(cell['ranks']), 'rank')}, {cell['partition']}\n")
    lines = [f"halo: {100 * cell['halo_share']:.1f} % of the triangles; imbalance: {cell['imbalance']:.3f} of the mean\n"]
    if "frame_ns" in cell:
        lines += [f"frame: {duration(cell['frame_ns'])} by the host's clock, median of "
                  f"{counted(len(cell['ranks'][0]['samples']), 'sample')}; partition, once: {duration(cell['partition_ns'])}\n"]
    else:
        lines += ["ranks shared a device: there are no times\n"]
    return head + ranks(cell) + stages(cell) + frames(cell) + "".join(lines) + verdict(cell)


def ranks(cell: Json) -> str:
    table = Table("rank", "<host", "triangles", "halo sent", "received", "bytes sent", "own pairs", "halo pairs", "contacts",
                  "device memory", "host memory")
    for number, rank in enumerate(cell["ranks"]):
        contacts = whole(rank.get("contacts_count")) if "contacts_count" in cell else ""
        table.row(str(number), rank["host"], whole(rank["triangles"]), whole(rank["halo_sent_count"]), whole(rank["halo_received_count"]),
                  size(rank["sent_bytes"]), whole(rank["own_pairs_count"]), whole(rank["halo_pairs_count"]), contacts,
                  size(rank["device_peak_bytes"]), size(rank["host_peak_bytes"]))
    return table.text()


def stages(cell: Json) -> str:
    """Returns the median of each stage by both clocks, two rows for each rank; empty if there are no times."""
    host, device = (rank_files.stage_times(cell, clock) for clock in ("host_ns", "device_ns"))
    if not host:
        return ""
    table = Table("rank", "<clock", *host)
    for number in range(len(cell["ranks"])):
        table.row(str(number), "host", *(duration(times[number]) for times in host.values()))
        table.row("", "device", *(duration(times[number]) if times[number] else "" for times in device.values()))
    return table.text()


def frames(cell: Json) -> str:
    """Returns a line on the frames of a scene that moves; empty for another one."""
    if not (those := cell.get("frames", [])):
        return ""
    return (f"{counted(len(those), 'frame')}; work of a rank at most {max(frame['work_imbalance'] for frame in those):.3f} of the mean; "
            f"rebalanced {counted(sum(frame['moved_count'] > 0 for frame in those), 'time')}, "
            f"{counted(sum(frame['moved_count'] for frame in those), 'triangle')} moved\n")


def verdict(cell: Json) -> str:
    check = cell["check"]
    against, detail = check.get("against", "nothing"), check.get("detail", "")
    said = {"agrees": f"agrees with {against}", "differs": f"DIFFERS from {against}: {detail}",
            "not_checked": f"not checked: {detail}"}[check["verdict"]]
    found = "".join(f", {cell[f'{what}_count']:,} {what}, set hash {cell[f'{what}_set_hash']}"
                    for what in ("pairs", "contacts") if f"{what}_count" in cell)
    return f"verdict: {said}{found}\n"


def simulated(cell: Json) -> str:
    def most(key: str) -> int:
        return max(rank[key] for rank in cell["ranks"])

    return (f"{cell['scene']['name']}: {counted(cell['scene']['triangles'], 'triangle')} on "
            f"{counted(len(cell['ranks']), 'rank')}, simulated: {cell['partition']}, {cell['builder']['name']} along "
            f"{rank_files.asked_of(cell)['order']}, {cell['boxes_count']} box{'es' * (cell['boxes_count'] > 1)} a rank\n"
            f"halo: {100 * cell['halo_share']:.1f} % of the triangles; imbalance: {cell['imbalance']:.3f} of the mean\n"
            f"a rank sends {counted(most('halo_sent_count'), 'triangle')} at most, to {counted(most('targets_count'), 'rank')} at most; "
            f"receives {counted(most('halo_received_count'), 'triangle')} at most, from {counted(most('sources_count'), 'rank')} at most\n"
            f"boxes of all other ranks, received by each: {size(cell['box_bytes'])}\n"
            f"a frame by the model: {duration(cell['model_ns'])}, of which the largest part takes {duration(cell['part_ns'])}\n")


def table(cells: list[Json]) -> str:
    """Returns a row for each measured cell of an experiment, and a line for each other one."""
    table = Table("<scene", "ranks", "<partition", "boxes", "frame", "times one rank", "halo", "largest part", "<verdict")
    runs = rank_files.measured(cells)
    first = next((run for run in runs if "frame_ns" in run), None)
    for run in runs:
        grows = run["scene"]["triangles"] / first["scene"]["triangles"] if first else 1  # weak: the scene of P ranks is larger
        has_time = first is not None and "frame_ns" in run
        table.row(run["scene"]["name"], str(run["ranks_count"]), run["partition"], str(run["boxes_count"]),
                  duration(run["frame_ns"]) if has_time else "", f"{grows * first['frame_ns'] / run['frame_ns']:.2f}" if has_time else "",
                  f"{100 * run['halo_share']:.1f} %", f"{run['imbalance']:.3f}",
                  "counted" if run["simulated"] else run["check"]["verdict"].replace("_", " "))
    failed = "".join(f"{cell['scene']['name']} on {counted(cell['ranks_count'], 'rank')}: {cell['reason']}\n" for cell in cells
                     if cell["status"] != "measured")
    return f"scale {cells[0]['experiment']}\n{table.text() if runs else ''}{failed}"
