from plots.evidence.quotes import Document, File, frame_ms
from plots.read.rank_files import stage_times

STRONG = {"cluster-strong": "torus:67108864", "cluster-strong-buddha": "Happy Buddha, refined to 17,000,000",
          "cluster-strong-hairball": "hairball:8000000", "cluster-strong-small": "torus:2880000"}


def scaling(doc: Document) -> None:
    runs = {name: File(f"h200/{name}").results() for name in (*STRONG, "cluster-weak")}
    times = {name: [frame_ms(run) for run in those] for name, those in runs.items()}
    doc.table("scaling", "< scene | pairs on four | one | two | four | faster", [
        *([scene, runs[name][2]["pairs_count"], *times[name], times[name][0] / times[name][2]]
          for name, scene in STRONG.items()),
        ["torus, weak", runs["cluster-weak"][2]["pairs_count"], *(weak := times["cluster-weak"]),
         weak[0] / weak[2]]])
    stages = "build", "select", "exchange", "self", "halo"
    rows = []
    for name, scene in STRONG.items():
        device, host = (stage_times(runs[name][2], clock) for clock in ("device_ns", "host_ns"))
        busiest = max(map(sum, zip(*device.values(), strict=True)))
        rows.append([scene, times[name][2], busiest * 1e-6, *(1e-6 * max((host if one == "exchange" else device)[one]) for one in stages)])
    doc.table("stages", f"< scene | frame | busiest device | {' | '.join(f'`{stage}`' for stage in stages)}", rows)


def tables(doc: Document) -> None:
    files = {"660,000,000": File("h200/cluster-largest").results(),
             "1,000,000,000": File("h200/cluster-billion").results(), "2,147,483,648": File("h200/cluster-most").results()}
    doc.table("largest", "triangles | H200 | frame, ms | pairs | device, GB | predicted | host, GB | moving, s", (
        [triangles, len(run["ranks"]), frame_ms(run), run["pairs_count"],
         *(1e-9 * max(rank[key] for rank in run["ranks"]) for key in ("device_peak_bytes", "predicted_device_bytes", "host_peak_bytes")),
         1e-9 * run["partition_ns"]] for triangles, (run,) in files.items()))
    doc.table("cubes", "< scene | boxes a rank | 1 rank | 2 ranks | pairs of 2 ranks", (
        [f"{scene}-cube", boxes, *map(frame_ms, both), both[1]["pairs_count"]]
        for scene in ("filled", "hollow") for size, boxes in {"": 50000, "-large": 9300000}.items()
        for both in [[File(f"h200/cluster-{scene}{size}-{ranks}").results()[0] for ranks in (1, 2)]]))


def quotes(doc: Document) -> None:
    scaling(doc)
    tables(doc)
