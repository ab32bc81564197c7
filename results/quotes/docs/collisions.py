import statistics

from plots.console.claims import BVTT, FRESH, FROM_ROOT, RADIX
from plots.evidence.quotes import ONE_SET, Document, File, best, later_ms, ratios, us
from plots.read import families, results
from plots.read.cells import Cell, later
from plots.words import tables

BLOCK, GROUP, LEAF = (f"{name} over oibvh-multi (hilbert30, sorted leaves)" for name in ("block", "group", "leaf"))
CDK18 = "bvtt (jump 1) over perfect"
SAT = f"{BVTT}, contacts sat-f32"
FRONT, REFIT = "front over oibvh-multi", "group (always refit) over apetrei-fused"
TABLE2 = {"cloth-ball": "unc_cloth_ball, 15 between", "funnel": "unc_cloth_funnel, 15 between", "n-body": "unc_nbody, 15 between",
          "flamenco": "cloth-dress:49000"}
REAL = {f"{name}, real step": scene.partition(",")[0] for name, scene in TABLE2.items() if "between" in scene}
TABLE3 = {"andy": "cloth-layers:127000", "bridson": "cloth-ball:18000", "bridson-3": "cloth-layers:198000"}


def rows_of(file: File) -> dict[str, str]:
    """Returns the scenes of Table 2 by name: first those at their real step, which a file may lack."""
    there = {cell.scene for cell in file.cells}
    return {name: scene for name, scene in REAL.items() if scene in there} | TABLE2


def most_mb(frames: list[Cell]) -> float:
    return max(cell.counters["memory_bytes"] for cell in frames) * 1e-6


def printed(table: str, name: str) -> str:
    """Returns the milliseconds that the paper prints for the rival and its tree: "2.3, 1.9"."""
    return ", ".join(f"{row['frame_ms']:g}" for row in results.printed(table)["rows"] if row["scene"] == name)


def memory_and_spread(frames: list[Cell]) -> str:
    """Returns the megabytes and, in brackets, the standard deviation of the frames' milliseconds: "46.1 (0.03)"."""
    return f"{tables.three_digits(most_mb(frames))} ({statistics.pstdev(1e-6 * cell.median_ns() for cell in later(frames)):.2f})"


def printed_memory(name: str) -> str:
    """Returns the same as the paper prints it, of the rival and its tree: "145 (1.33), 85 (0.34)"."""
    return ", ".join(f"{row['memory_megabytes']:.3g} ({row['frame_stdev_ms']:.2f})" for row in results.printed("table2")["rows"]
                     if row["scene"] == name)


def wrong(file: File, scene: str) -> str:
    """Returns the contacts that the paper's narrow phase missed and invented, and those that it found: "0/3 of 1,155,367"."""
    missed, false, found = (sum(cell.counters[key] for cell in file.frames(scene, SAT))
                            for key in ("missed_count", "false_count", "contacts_count"))
    return f"{missed}/{false} of {found:,}"


def pairs(doc: Document) -> None:
    file, orders = File("h200/pairs"), ("kd", "hilbert30", "morton30")

    def soonest(there: list[Cell]) -> str:
        cell = min(there, key=lambda one: us(one, "ropes", "broad"))
        return f"{us(cell, 'ropes', 'broad'):.0f} `{cell.collider}`"

    rows = []
    for scene in ("torus:144046", "torus:2880000", "happy_buddha_1087716", "unc_cloth_ball"):
        there = [cell for cell in file.cells if cell.has_times and cell.scene == scene + ONE_SET and cell.builder != "none"]
        whole = file.cell(scene + ONE_SET, "block over oibvh-single (hilbert30, sorted leaves)")
        rows.append([scene, int(whole.counters["pairs_count"]),
                     *(soonest([cell for cell in there if dict(cell.options)["order"] == order]) for order in orders),
                     soonest([cell for cell in there if cell.collider in ("leaf", "group")]), us(whole)])
    doc.table("pairs", f"< scene | pairs | {' | '.join(f'over `{order}`' for order in orders)} | `leaf` or `group` | whole", rows)


def fronts_mb(file: File, scene: str) -> float:
    """Returns the megabytes of the front that takes the least time over a scene, over any tree."""
    return most_mb(min((file.frames(scene, asked) for asked in (FRONT, *RADIX)), key=later_ms))


def memory(file: File, asked: str) -> tuple[float, float]:
    """Returns how many times the megabytes of a pipeline the best front takes, the least and the most of the scenes of Table 2."""
    return ratios(*zip(*((fronts_mb(file, scene), most_mb(file.frames(scene, asked))) for scene in TABLE2.values()), strict=True))


def frames(doc: Document) -> None:
    file = File("h200/table2")
    doc.table("table2", "< scene | `block` | `bvtt` | root | CDK18 | `front` | best front | fresh front | refit | paper: front, its tree", (
        [name, *best([*(later_ms(file.frames(scene, asked)) for asked in (BLOCK, BVTT, FROM_ROOT, CDK18, FRONT)),
                      min(later_ms(file.frames(scene, asked)) for asked in RADIX),
                      *(later_ms(file.frames(scene, asked)) for asked in (FRESH, REFIT))]), printed("table2", name.partition(",")[0])]
        for name, scene in rows_of(file).items()))
    rows = []
    for name, scene in TABLE2.items():
        times = {asked: later_ms(file.frames(scene, asked)) for asked in (FRONT, *RADIX)}
        front = min(times, key=times.__getitem__)
        rows.append([name, scene.partition(",")[0], "`front`" if front == FRONT else "`front-leaf`",
                     *(memory_and_spread(file.frames(scene, asked)) for asked in (BLOCK, BVTT, front)), printed_memory(name),
                     1e3 * (later_ms(file.frames(scene, BVTT)) - later_ms(file.frames(scene, SAT))), wrong(file, scene)])
    doc.table("table2-more", "< scene | < measured | < best front | MB (ms): `block` | `bvtt` | front | paper: front, its tree | `sat-f32` saves, µs | missed/false",
              rows)
    file, columns = File("h200/table3"), (BLOCK, BVTT, FROM_ROOT, CDK18, LEAF, GROUP, "hierarchical grid")
    doc.table("table3", "< scene | < measured | `block` | `bvtt` | root | CDK18 | `leaf` | `group` | grid | paper: I-Cloth, its tree", (
        [name, scene, *best([later_ms(file.frames(scene, asked)) for asked in columns]), printed("table3", name)]
        for name, scene in TABLE3.items()))


def rebuild(doc: Document) -> None:
    h200, pocl, scene = File("h200/rebuild"), File("pocl-2-cores/rebuild"), "cloth_ball_sim"
    rows = {"`block`": BLOCK, "`leaf`": LEAF, "`group`": GROUP, "`bvtt`": BVTT, "root": FROM_ROOT, "`front`": FRONT,
            "`front`, `apetrei-fused`": RADIX[0], "`front-leaf`, `apetrei-fused`": RADIX[1], "fresh front": FRESH, "refit": REFIT}
    doc.table("rebuild", "< pipeline | H200, ms | PoCL, ms | memory, MB", (
        [label, *(later_ms(file.frames(scene, asked)) for file in (h200, pocl)), most_mb(h200.frames(scene, asked))]
        for label, asked in rows.items()))


def agreeing(machine: str) -> int:
    return sum(cell.verdict == "agrees" for cell in File(f"{machine}/agreement").cells)


def cards(doc: Document) -> None:
    """Compares the times of the device in both files of `families`."""
    both = [pair for pair in zip(File("h100/families").cells, File("h200/families").cells, strict=True)
            if all(cell.has_times and families.of_cell(cell) not in families.ON_HOST for cell in pair)]
    doc.says("each takes {} to {} of its time on the H200", *ratios(*([cell.median_ns() for cell in card] for card in zip(*both, strict=True))))


def worlds(doc: Document) -> None:
    """Writes the nanoseconds a world of a frame, by pipeline."""
    files, scenes = [File(f"{machine}/worlds") for machine in ("h200", "pocl-2-cores")], ("worlds:8192:60", "worlds:1024:5290")
    def each(file: File) -> dict[tuple[str, str], int]:
        """Returns nanoseconds by pipeline and scene."""
        return {(f"`{cell.collider}`" + f" over `{cell.builder}`" * (cell.builder != "none"), cell.scene.partition(",")[0]):
                round(cell.median_ns() / cell.scene_facts["objects"]) for cell in file.cells}

    found = [each(file) for file in files]
    doc.table("worlds", "< pipeline | H200: 8,192 of 60 | 1,024 of 5,290 | two cores: 8,192 of 60 | 1,024 of 5,290", (
        [pipeline, *(f"{those[pipeline, scene]:,}" for those in found for scene in scenes)] for pipeline in dict.fromkeys(key for key, _ in found[0])))


def features(doc: Document) -> None:
    cells = File("h200/within-features").cells
    of = {(cell.scene, cell.raw.get("features", {}).get("pairs", "triangles")): cell for cell in cells}
    kinds = "vertex-face", "edge-edge", "triangles"
    doc.table("features", f"< scene | {' | '.join(f'{kind} | pairs' for kind in kinds)}", (
        [f"`{scene}`", *(value for kind in kinds for value in (us(of[scene, kind]), of[scene, kind].counters["contacts_count"]))]
        for scene in dict.fromkeys(cell.scene for cell in cells)))


def quotes(doc: Document) -> None:
    features(doc)
    cards(doc)
    doc.says("{} cells on an H200 and {} on two cores found", *map(agreeing, ("h200", "pocl-2-cores")))
    file = File("h200/table2")
    ours, *fronts = ([later_ms(file.frames(scene, asked)) for scene in TABLE2.values()] for asked in (BVTT, *RADIX))
    doc.says("takes {} to {} of the time of the best front over a radix tree", *ratios(ours, map(min, *fronts)))
    doc.says("takes {} to {} times the memory of `bvtt`, and {} to {} times that of `block`", *memory(file, BVTT), *memory(file, BLOCK))
    for part in (pairs, frames, worlds, rebuild):
        part(doc)
