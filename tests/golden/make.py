#!/usr/bin/env python3
"""Write the golden result files beside this script: every builder, five scenes, sweeps over sizes, and whole frames.

The numbers are invented, by a formula that has the right order of magnitude; they are no measurements.

Usage: tests/golden/make.py
"""
import json
import pathlib
import random

SCENES = {"bunny": 144046, "erato": 412669, "dragon": 871306, "buddha": 1087474, "hairball": 2880000}
# Name to (microseconds before anything is built, nanoseconds a triangle).
BUILDERS = {
    "perfect": (14, 0.031), "apetrei": (16, 0.24), "apetrei-fused": (11, 0.11), "karras": (22, 0.18),
    "oibvh-single": (9, 0.033), "oibvh-multi": (13.5, 0.0235), "oibvh-reference": (20, 9.0),
    "embree-low": (300, 14.0), "embree-medium": (400, 90.0),
}
ON_HOST = ("oibvh-reference", "embree-low", "embree-medium")
RUN = {
    "id": "20200101T000000Z-golden-0000", "started_at": "2020-01-01T00:00:00Z",
    "finished_at": "2020-01-01T00:01:00Z", "command": ["bvhbench", "reproduce", "table1"],
    "program": {"version": "0.1.0", "commit": "0" * 40, "dirty": False, "build_type": "Release",
                "compiler": "GNU 12.2.0", "arch": "x86-64-v3", "kernels": "embedded"},
    "host": {"name": "golden", "cpu": "Invented CPU", "threads": 16, "os": "Debian GNU/Linux 12"},
    "device": {"name": "Invented GPU", "platform": "Invented OpenCL", "driver": "1.0",
               "opencl": "OpenCL 3.0", "opencl_c": "OpenCL C 1.2", "kind": "gpu", "compute_units": 64,
               "global_memory_bytes": 8 << 30, "max_allocation_bytes": 2 << 30, "local_memory_bytes": 49152,
               "max_group_size": 1024, "timer_resolution_ns": 1000},
    "libraries": {"assimp": "5.2.5"}, "copy_rate_bytes_per_s": 2.4e12,
    "copy_rate_buffer_bytes": 1 << 28, "compile_ns": 250000000,
}


def nodes(builder: str, triangles: int) -> int:
    complete = 1 << (triangles - 1).bit_length()
    if builder == "perfect":
        return 2 * complete - 1
    virtual = complete - triangles if builder.startswith("oibvh") else 0
    return 2 * triangles - 1 + virtual.bit_count()


def sample(order: int, builder: str, triangles: int, noise: random.Random) -> dict:
    start_us, slope_ns = BUILDERS[builder]
    time = int((start_us * 1000 + slope_ns * triangles) * (1 + 0.4 * noise.random() ** 2))
    if builder in ON_HOST:
        return {"order": order, "stages": [{"stage": "hierarchy", "wall_ns": time}]}
    return {"order": order, "stages": [{
        "stage": "hierarchy", "launches": 3 if builder == "oibvh-multi" else 1, "busy_ns": int(0.9 * time),
        "span_ns": time, "moved_bytes": 24 * triangles + 24 * (nodes(builder, triangles) - triangles)}]}


def whole_sample(order: int, builder: str, triangles: int, noise: random.Random) -> dict:
    """From triangles to tree: the stages before the hierarchy are the same whoever asks."""
    before = []
    for stage, start_us, slope_ns in (("bounds", 8, 0.02), ("codes", 4, 0.01), ("sort", 60, 0.08)):
        time = int((start_us * 1000 + slope_ns * triangles) * (1 + 0.2 * noise.random() ** 2))
        before.append({"stage": stage, "launches": 1, "busy_ns": int(0.9 * time), "span_ns": time,
                       "moved_bytes": 36 * triangles})
    return {"order": order, "stages": before + sample(order, builder, triangles, noise)["stages"]}


def cell(experiment: str, scene: dict, builder: str, noise: random.Random) -> dict:
    triangles = scene["triangles"]
    known = {"experiment": experiment, "scene": scene, "builder": {"name": builder, "options": {}}}
    if builder == "oibvh-reference" and triangles > 2_000_000:
        return {**known, "status": "skipped", "reason": "slower than the time allowed a cell"}
    count = nodes(builder, triangles)
    return {**known, "status": "measured", "warm_up": 2,
            "samples": [sample(order, builder, triangles, noise) for order in range(5)],
            "counters": {"nodes_count": count, "tree_bytes": 24 * count},
            "check": {"verdict": "agrees", "against": "contract"}}


def write(name: str, cells: list[dict], minor: int = 3, more: dict | None = None, stress: list[dict] | None = None) -> None:
    def lines(entries: list[dict]) -> str:
        return ",\n".join(json.dumps(entry) for entry in entries)

    found = f',\n"stress": [\n{lines(stress)}\n]' if stress else ""
    text = f'{{"format": "1.{minor}",\n"run": {json.dumps(RUN | (more or {}))},\n"cells": [\n{lines(cells)}\n]{found}}}\n'
    (pathlib.Path(__file__).parent / name).write_text(text, encoding="utf-8")


def main() -> None:
    noise = random.Random(1)
    scenes = []
    for name, triangles in SCENES.items():
        scene = {"name": name, "triangles": triangles, "objects": 1, "frame": 0}
        if name in ("erato", "hairball"):
            scene |= {"name": f"torus:{triangles}", "stand_in_for": name}
        scenes.append(scene)
    write("table1.json", [cell("table1", scene, builder, noise) for scene in scenes for builder in BUILDERS])
    sizes = [1 << power for power in range(10, 24, 2)] + [1 << 23]
    sweep = [{"name": f"torus:{size}", "triangles": size, "objects": 1, "frame": 0} for size in sizes]
    write("fig8.json", [cell("fig8", scene, builder, noise) for scene in sweep
                        for builder in BUILDERS if not builder.startswith("embree")])
    write_quality()
    write_frames()
    write_stress()
    noise = random.Random(3)
    scaling = [cell("scaling", scene, builder, noise) for scene in sweep
               for builder in ("perfect", "oibvh-single", "oibvh-multi", "apetrei-fused")]
    for entry in scaling:
        triangles, builder = entry["scene"]["triangles"], entry["builder"]["name"]
        entry["samples"] = [whole_sample(order, builder, triangles, noise) for order in range(5)]
    write("scaling.json", scaling)
    write_roofline(sweep[::2])
    write_accuracy()
    write_swept()


def write_roofline(scenes: list[dict]) -> None:
    """Builds and frames over the same scenes. Of a query more bytes are declared than of a stage that builds."""
    noise = random.Random(5)
    cells = [cell("roofline", scene, builder, noise) for scene in scenes
             for builder in ("perfect", "oibvh-single", "oibvh-multi", "apetrei-fused")]
    for entry in cells:
        triangles, builder = entry["scene"]["triangles"], entry["builder"]["name"]
        entry["samples"] = [whole_sample(order, builder, triangles, noise) for order in range(5)]
    cells += [frame_cell("roofline", scene["name"], 0, pipeline, noise) for scene in scenes
              for pipeline in ("leaf", "group", "bvtt", "grid")]
    write("roofline.json", cells, 5, {"launch_cost_ns": 3800.0, "tuning": {"from": "none", "values": {}}})


def accuracy_cell(axis: str, name: str, method: str, counters: dict, stages: list[dict], **more: object) -> dict:
    facts = {"axis": axis, "method": method} | ({"seed": 1} if axis == "narrow" else {})
    return {"experiment": "accuracy", "scene": {"name": name, "triangles": 100000}, "builder": {"name": "none"},
            "accuracy": facts, "operation": "accuracy", "status": "measured", "warm_up": 1,
            "samples": [{"order": order, "stages": stages} for order in range(3)], "counters": counters,
            "check": {"verdict": "counted", "against": "an oracle"}} | more


def on_device(stage: str, span: float) -> dict:
    return {"stage": stage, "launches": 1, "busy_ns": int(0.9 * span), "span_ns": int(span), "moved_bytes": 1000}


def write_accuracy() -> None:
    """A few inputs of each axis; the exact method is slow where it is needed, and never wrong."""
    noise = random.Random(7)
    right = {"check": {"verdict": "agrees", "against": "an oracle"}}
    cells = []
    for name, share in (("generic", 0.0), ("same_place", 0.2), ("scaled_1e-16", 0.6)):
        for method, ns, part in (("filter-f64+exact", 20 if share < 0.1 else 300, 0), ("guigue-f64", 50, 0.5),
                                 ("guigue-f32", 45, 0.9), ("moller-f32", 40, 1)):
            counters = {"pairs_count": 50000, "meeting_count": 20000, "missed_count": int(20000 * share * part),
                        "false_count": int(100 * share * part), "narrow_float_count": 50000,
                        "narrow_double_count": 0, "narrow_exact_count": 0}
            cells.append(accuracy_cell("narrow", name, method, counters,
                                       [on_device("narrow", 50000 * ns * noise.uniform(0.9, 1.1))],
                                       **(right if part == 0 else {})))
    for name in ("torus:100000", "hairball:100000"):
        for method, ns, error in (("f32", 3, 3e-6), ("f32-pairwise", 3.2, 1e-7), ("f32-compensated", 6, 5e-8),
                                  ("f64", 3.1, 1e-14), ("f64-pairwise", 3.3, 0.0), ("f64-compensated", 6.2, 1e-16)):
            counters = {"nodes_count": 200006, "sah_cost": 150.5, "relative_error": error}
            cells.append(accuracy_cell("sums", name, method, counters,
                                       [{"stage": "sum", "wall_ns": int(200006 * ns)}]))
    for method in (f"{curve}{bits}{axis}" for axis in ("", "-axis") for curve in ("morton", "hilbert") for bits in (30, 48, 63)):
        cost = noise.uniform(100, 150)
        counters = {"sah_cost": cost, "box_tests_count": int(40000 * cost), "duplicates_count": 500, "longest_run_count": 2,
                    "pairs_count": 600000, "missed_count": 0, "false_count": 0}
        stages = [on_device("codes", 1e5), on_device("sort", noise.uniform(1e6, 3e6)), on_device("broad", 5e7)]
        cells.append(accuracy_cell("codes", "torus:100000", method, counters, stages, **right))
    for sizes, more in (("0", 0), ("1e3", 100), ("1e6", 900000)):
        for method in ("f32", "f32-recentred"):
            false = more if method == "f32" else 0
            counters = {"right_pairs_count": 100000, "pairs_count": 100000 + false, "missed_count": 0, "false_count": false}
            cells.append(accuracy_cell("input", f"torus:20000 at {sizes}", method, counters,
                                       [on_device("broad", 1e7 + 20 * false)]))
    for name, pairs in (("torus:100000", 40000), ("hairball:100000", 400000)):
        for method, node_bytes, ms, share in (("f32", 24, 6.5, 0), ("f64", 48, 9, 0), ("f16", 12, 3.8, 0.4),
                                              ("u16", 12, 3.5, 0.1), ("u8", 6, 8, 15), ("u8-node-local", 8, 11, 0)):
            counters = {"right_pairs_count": pairs, "pairs_count": int(pairs * (1 + share)), "missed_count": 0,
                        "false_count": int(pairs * share), "node_bytes": node_bytes}
            cells.append(accuracy_cell("boxes", name, method, counters, [on_device("broad", 1e6 * ms)],
                                       **({} if share else right)))
    for entry in swept_cells("accuracy", ("group", "grid"), noise):
        entry |= {"operation": "accuracy", "accuracy": {"axis": "swept", "method": entry["collider"]["name"]}}
        cells.append(entry)
    cells.append(accuracy_cell("narrow", "generic", "guigue-f64", {}, []))
    without_numbers(cells[-1], "skipped", "guigue-f64 needs doubles, which the device has not")
    write("accuracy.json", cells, 7)


def swept_cells(experiment: str, pipelines: tuple[str, ...], noise: random.Random) -> list[dict]:
    """Both queries of a step of two scenes, one with a ground truth; of edges there are three times as many pairs."""
    cells = []
    for name in ("unc_cloth_ball", "cloth-funnel:18484"):
        for pairs, among, times in (("vertex-face", "between", 10), ("edge-edge", "within", 30)):
            for pipeline in pipelines:
                entry = frame_cell(experiment, name, 0, pipeline, noise)
                triangles = entry["scene"]["triangles"]
                entry["collider"]["options"] |= {"pairs_of": among, "narrow": "none"}
                entry["swept"] = {"pairs": pairs, "to_frame": 1, "primitives": 3 * triangles // 2}
                entry["counters"] = {"pairs_count": times * triangles, "missed_count": 0, "false_count": 0}
                entry["check"] = {"verdict": "agrees", "against": "brute", "pairs_hash": f"{times * triangles:016x}"}
                for sample in entry["samples"]:
                    sample["stages"] = [stage for stage in sample["stages"] if stage["stage"] != "narrow"]
                if name == "unc_cloth_ball":
                    entry["scene"].pop("stand_in_for", None)
                    entry["counters"] |= {"ground_truth_pairs": triangles // 5, "ground_truth_missed": 0}
                cells.append(entry)
    return cells


def write_swept() -> None:
    """One pipeline has edges only."""
    cells = swept_cells("swept", ("group", "leaf", "grid", "embree", "bvtt"), random.Random(8))
    cells = [entry for entry in cells
             if (entry["collider"]["name"], entry["swept"]["pairs"]) != ("bvtt", "vertex-face")]
    write("swept.json", cells, 7)


def valued(experiment: str, scene: dict, builder: str, order: str, cost: float, noise: random.Random) -> dict:
    entry = cell(experiment, scene, builder, noise)
    entry["builder"]["options"] = {"order": order}
    triangles = scene["triangles"]
    level = (triangles - 1).bit_length()
    around = [] if builder.startswith("oibvh") else [triangles // 3]
    last = triangles - sum(around)
    entry["counters"] |= {"sah_cost": cost, "depth_max": level + len(around)}
    entry |= {"left_out": {"epo": "not asked for: --epo"}, "leaves_by_depth": [0] * level + around + [last]}
    return entry


def write_quality() -> None:
    """Costs as if each mesh had 20 times the logarithm of its triangles, and paired neighbours 2.5 times that."""
    noise = random.Random(2)
    scenes = [{"name": "happy_buddha_1087716", "triangles": 1087716},
              {"name": "hairball:2880000", "triangles": 2880000, "stand_in_for": "hairball"},
              {"name": "dragon_202520", "triangles": 202520}, {"name": "bunny_69451", "triangles": 69451}]
    times = {"apetrei-fused": 1.0, "oibvh-multi": 2.5}
    base = {scene["name"]: round(4 * scene["triangles"].bit_length(), 2) for scene in scenes}
    write("table4.json", [valued("table4", scene, builder, "morton30-axis", base[scene["name"]] * factor, noise)
                          for scene in scenes for builder, factor in times.items()])
    moved = [{"name": f"outlier:{model}:0:{far}", "triangles": triangles,
              "outlier": {"of": model, "triangle": 0, "diameters": far}}
             for model, triangles in (("dragon_202520", 202520), ("torus:150000", 150000))
             for far in (0, 1, 2, 4, 8, 10)]
    write("fig13.json", [valued("fig13", scene, builder, "morton30-axis",
                                scene["triangles"] / 3000 * factor / (1 + scene["outlier"]["diameters"] / 4)
                                * (1 + (factor - 1) * scene["outlier"]["diameters"] / (scene["triangles"] / 20000)),
                                noise)
                         for scene in moved for builder, factor in times.items()])
    orders = {"morton30": 1.0, "morton63": 0.99, "hilbert30": 0.7, "hilbert63": 0.71}
    write("quality.json", [valued("quality", scene, builder, order, base[scene["name"]] * factor * share, noise)
                           for scene in scenes for builder, factor in times.items()
                           for order, share in orders.items()])


# Of whole frames: a collider's and a builder's name, their options that are not the usual ones, nanoseconds a triangle
# of the broad phase.
ALONG_A_CURVE = {"order": "hilbert30", "leaves": "sorted"}
PIPELINES = {
    "bvtt": ("bvtt", {"jump": 2}, "oibvh-multi", {}, 2.7), "leaf": ("leaf", {}, "oibvh-multi", {}, 10.5),
    "group": ("group", {}, "oibvh-multi", ALONG_A_CURVE, 18.0), "other tree": ("leaf", {}, "apetrei-fused", {}, 9.0),
    "front": ("front", {}, "oibvh-multi", {}, 4.0), "all work": ("leaf", {"no_skip": "near"}, "oibvh-multi", {}, 12.0),
    "grid": ("grid", {}, "none", {}, 3.1), "embree": ("embree", {}, "none", {}, 45.0),
    "fcl": ("fcl", {}, "none", {}, 900.0), "fcl-refit": ("fcl-refit", {}, "none", {}, 870.0),
}
LIBRARIES = ("embree", "fcl", "fcl-refit")
SEQUENCES = {
    "unc_cloth_ball": {"triangles": 92230, "vertices": 46598, "objects": 2, "stand_in_for": "cloth-ball"},
    "n-body": {"triangles": 146480, "vertices": 73960, "objects": 305},
    "cloth-funnel:18484": {"triangles": 18484, "vertices": 9500, "objects": 4, "stand_in_for": "funnel"},
    "cloth-layers:127000": {"triangles": 127000, "vertices": 64000, "objects": 4, "stand_in_for": "andy"},
    "bridson": {"triangles": 18000, "vertices": 9200, "objects": 2},
    "cloth_ball_sim": {"triangles": 93210, "vertices": 47038, "objects": 2},
}


def frame_stages(pipeline: str, triangles: int, exact: bool, first: bool, noise: random.Random) -> list[dict]:
    """Of one sample: on the device one after the other with 4 microseconds between, or on the host."""
    collider, _, builder, options, broad_ns = PIPELINES[pipeline]
    refits = collider in ("front", "fcl-refit") and not first
    times = [("bounds", 16, 0.04), ("codes", 6, 0.01), ("sort", 100, 0.2)]
    times += [] if builder == "none" else [("gather", 6, 0.02)] * ("leaves" in options) + [("hierarchy", 9, 0.05)]
    if collider in LIBRARIES:
        times = [("refit", 0, 80.0) if refits else ("hierarchy", 0, 60.0 if collider == "embree" else 770.0)]
    elif refits:
        times = [("bounds", 16, 0.04), ("refit", 12, 0.05)]
    times.append(("broad", 40, broad_ns * (0.3 if refits else 1)))
    times += [("copy", 20, 0.4)] * (collider == "embree") + [("narrow", 20, 0.6)] * (exact and "fcl" not in collider)
    stages, start = [], 0
    for stage, start_us, slope_ns in times:
        time = int((start_us * 1000 + slope_ns * triangles) * (1 + 0.2 * noise.random() ** 2))
        if collider in LIBRARIES and stage != "narrow":
            stages.append({"stage": stage, "wall_ns": time})
            continue
        stages.append({"stage": stage, "launches": 2, "busy_ns": int(0.9 * time), "start_ns": start, "span_ns": time,
                       "moved_bytes": 36 * triangles})
        start += time + 4000
    return stages


def frame_cell(experiment: str, name: str, frame: int, pipeline: str, noise: random.Random) -> dict:
    collider, collider_options, builder, options, _ = PIPELINES[pipeline]
    triangles = SEQUENCES[name]["triangles"] if name in SEQUENCES else int(name.split(":")[1])
    scene = {"name": name, "objects": 1, "triangles": triangles, **SEQUENCES.get(name, {}), "frame": frame,
             "source": "generated", "content_hash": f"{triangles + frame:016x}"}
    boxes_only = experiment == "pairs"
    asked = {"pairs_of": "between" if name == "n-body" else "all", "adjacent": "keep" if boxes_only else "drop",
             "narrow": "none" if boxes_only or "fcl" in collider else "exact", "jump": 0, "start_level": 0,
             "group_size": 0, "no_skip": ""}
    known = {"experiment": experiment, "scene": scene,
             "builder": {"name": builder, "options": {"order": "morton30", "group_size": 0, "items": 0, "leaves": "mesh"}
                         | options},
             "collider": {"name": collider, "options": asked | collider_options}, "operation": "collide"}
    pairs, contacts = 8 * triangles + 1000 * frame, triangles // 2
    counters = {"box_tests_count": 9 * pairs, "memory_bytes": 170 * triangles, "pairs_count": pairs}
    check = {"verdict": "agrees", "against": "brute, CGAL", "pairs_hash": f"{pairs:016x}"}
    if not boxes_only:
        counters["contacts_count"] = contacts
        check["contacts_hash"] = f"{contacts:016x}"
    if collider in ("bvtt", "front"):
        counters |= {"bvtt_peak_count": pairs + triangles // (2 if collider == "bvtt" else 1),
                     "memory_bytes": 470 * triangles}
    samples = [{"order": order, "stages": frame_stages(pipeline, triangles, not boxes_only, frame == 0, noise)}
               for order in range(1 if boxes_only else 2)]
    return {**known, "status": "measured", "warm_up": 1, "samples": samples, "counters": counters, "check": check}


def without_numbers(cell: dict, status: str, reason: str) -> None:
    for key in ("samples", "counters", "check", "warm_up"):
        del cell[key]
    cell |= {"status": status, "reason": reason}


def write_frames() -> None:
    noise = random.Random(4)

    def cells(experiment: str, scenes: dict[str, int], pipelines: tuple[str, ...]) -> list[dict]:
        return [frame_cell(experiment, scene, frame, pipeline, noise)
                for scene, frames in scenes.items() for frame in range(frames) for pipeline in pipelines]

    table2 = cells("table2", {"unc_cloth_ball": 2, "n-body": 1, "cloth-funnel:18484": 1},
                   ("bvtt", "leaf", "group", "front", "other tree"))
    without_numbers(table2[8], "failed", "the device has too little memory")  # of two frames the second
    without_numbers(table2[-1], "skipped", "slower than the time allowed a cell")
    table2[1]["check"] = {"verdict": "not_checked"}
    write("table2.json", table2, 4)
    write("table3.json", cells("table3", {"cloth-layers:127000": 1, "bridson": 1}, ("bvtt", "leaf", "group", "grid")), 4)
    write("rebuild.json", cells("rebuild", {"cloth_ball_sim": 2}, ("bvtt", "group", "front")), 4)
    write("pairs.json", cells("pairs", {f"torus:{size}": 1 for size in (20000, 144046, 1087474, 2880000, 69451)},
                              ("leaf", "group", "bvtt")), 4)
    write("libraries.json", cells("libraries", {"unc_cloth_ball": 1},
                                  ("group", "leaf", "all work", "embree", "fcl", "fcl-refit")), 4)


def write_stress() -> None:
    """What stress finds: systems that are right, one that refuses, and libraries that miss, add and crash."""
    def finding(verdict: str = "holds", missed: int = 0, false: int = 0) -> dict:
        detail = {"detail": f"{missed} missed, {false} false"} if verdict != "holds" else {}
        return {"verdict": verdict, "checked": 1000, "wrong": missed + false, "missed": missed, **detail}

    scenes = [("translate", "1e6"), ("scale", "1e20"), ("coincident", "a sphere twice"), ("not-finite", "one NaN")]
    systems = [("oibvh-multi", "builder", "", {"leaves": finding(), "boxes": finding()}),
               ("leaf over karras", "collider", "", {"pairs": finding(), "moved": finding()}),
               ("bvtt over oibvh-multi, groups", "collider", "", {"pairs": finding(), "room": finding()}),
               ("embree", "collider", "Embree", {"ends": finding("refused")}),
               ("rtcCollide", "library", "Embree", {"pairs": finding("broken", 3139)}),
               ("FCL OBBRSS float", "library", "FCL", {"contacts": finding("broken", 12, 1345)}),
               ("FCL AABB double", "library", "FCL", {"ends": {**finding("broken"), "detail": "it crashed (signal 11)"}})]
    cells = [{"family": family, "scene": scene, "triangles": 20000, "system": system, "kind": kind,
              **({"library": library} if library else {}), "findings": findings}
             for family, scene in scenes for system, kind, library, findings in systems
             if family != "not-finite" or kind == "library"]
    write("stress.json", [], 6, {"libraries": {"Embree": "3.13.5", "FCL": "0.7.0"}}, cells)


if __name__ == "__main__":
    main()
