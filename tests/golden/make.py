#!/usr/bin/env python3
"""Write the golden result files beside this script: every builder, five scenes, and sweeps over sizes.

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


def write(name: str, cells: list[dict]) -> None:
    lines = ",\n".join(json.dumps(entry) for entry in cells)
    text = f'{{"format": "1.3",\n"run": {json.dumps(RUN)},\n"cells": [\n{lines}\n]}}\n'
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
    noise = random.Random(3)
    scaling = [cell("scaling", scene, builder, noise) for scene in sweep
               for builder in ("perfect", "oibvh-single", "oibvh-multi", "apetrei-fused")]
    for entry in scaling:
        triangles, builder = entry["scene"]["triangles"], entry["builder"]["name"]
        entry["samples"] = [whole_sample(order, builder, triangles, noise) for order in range(5)]
    write("scaling.json", scaling)


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


if __name__ == "__main__":
    main()
