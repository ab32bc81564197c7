import math

import ranking
import results
from cells import Cell
from quotes import ONE_SET, Document, File, best, later_ms, us

PAIRS = ("torus:144046", "torus:2880000", "happy_buddha_1087716", "unc_cloth_ball")
BLOCK, GROUP, LEAF = (f"{name} over oibvh-multi (hilbert30, sorted leaves)" for name in ("block", "group", "leaf"))
BVTT, CDK18 = "bvtt (jump 2) over oibvh-multi", "bvtt (jump 1) over perfect"
FROM_ROOT = "bvtt (without start-level, jump 1) over oibvh-multi"
SAT = f"{BVTT}, contacts sat-f32"
FRONT, FRESH, REFIT = "front over oibvh-multi", "front (always rebuild) over apetrei-fused", "group (always refit) over apetrei-fused"
RADIX = [f"{name} over apetrei-fused" for name in ("front", "front-leaf", "front (one tree of the scene)",
                                                   "front-leaf (one tree of the scene)")]
TABLE2 = {"unc_cloth_ball for cloth-ball": "unc_cloth_ball, 15 between", "unc_cloth_funnel for funnel": "unc_cloth_funnel, 15 between",
          "unc_nbody for n-body": "unc_nbody, 15 between", "cloth-dress:49000 for flamenco": "cloth-dress:49000"}
TABLE3 = {"cloth-layers:127000 for andy": "cloth-layers:127000", "cloth-ball:18000 for bridson": "cloth-ball:18000",
          "cloth-layers:198000 for bridson-3": "cloth-layers:198000"}


def most_mb(frames: list[Cell]) -> float:
    return max(cell.counters["memory_bytes"] for cell in frames) * 1e-6


def copied_ms(row: ranking.Row, counter: str) -> float:
    return row.mean(counter) * 1e-6


def printed(table: str, label: str) -> str:
    """Returns the milliseconds that the paper prints for the rival and its tree: "2.3, 1.9"."""
    return ", ".join(f"{row['frame_ms']:g}" for row in results.printed(table)["rows"] if row["scene"] == label.split(" for ")[1])


def agreement(doc: Document) -> None:
    files = [File(f"{machine}/agreement").cells for machine in ("h200", "pocl-2-cores")]
    assert all(cell.verdict == "agrees" for file in files for cell in file)
    doc.says("{} cells on the H200 and {} on PoCL", *map(len, files))


def pairs(doc: Document) -> None:
    doc.under("## One set of triangles")
    cells = [cell for cell in File("h200/pairs").cells if cell.has_times]

    def soonest(those: list[Cell], order: str, tail: bool = False) -> str:
        there = [cell for cell in those if cell.builder != "none" and (not order or dict(cell.options)["order"] == order)]
        cell = min(there, key=lambda one: us(one, "ropes", "broad"))
        return f"{us(cell, 'ropes', 'broad'):.0f} `{cell.collider}`" + (f" over `{dict(cell.options)['order']}`" if tail else "")

    for scene in PAIRS:
        there = [cell for cell in cells if cell.scene == scene + ONE_SET]
        whole = File("h200/pairs").cell(scene + ONE_SET, "block over oibvh-single (hilbert30, sorted leaves)")
        doc.row(scene, whole.counters["pairs_count"], *(soonest(there, order) for order in ("kd", "hilbert30", "morton30")),
                soonest([cell for cell in there if cell.collider in ("leaf", "group")], "", True), us(whole))


def table2(doc: Document, machine: str) -> dict[str, dict[str, float]]:
    """Returns milliseconds a frame by row and scene."""
    file, times = File(f"{machine}/table2"), {}
    for label, scene in TABLE2.items():
        of = {asked: later_ms(file.frames(scene, asked))
              for asked in (BLOCK, GROUP, BVTT, FROM_ROOT, CDK18, SAT, FRONT, FRESH, REFIT, *RADIX)}
        of["front, radix"] = min(of[asked] for asked in RADIX)
        times[scene] = of
        if machine == "h200":
            shown = [of[asked] for asked in (BLOCK, BVTT, FROM_ROOT, CDK18, FRONT, "front, radix", FRESH, REFIT)]
            doc.row(label, *best(shown), printed("table2", label))
        else:
            shown = [of[asked] for asked in (GROUP, FROM_ROOT, CDK18, FRONT, "front, radix", FRESH, REFIT)]
            texts = [f"{time:.{0 if time >= 99.95 else 1 if time >= 9.995 else 2}f}" for time in shown]
            doc.row(label, *(f"**{text}**" if time == min(shown) else text for time, text in zip(shown, texts)))
    return times


def ratios(times: dict[str, dict[str, float]], one: str, other: str) -> list[float]:
    return sorted(of[one] / of[other] for of in times.values())


def findings_of_table2(doc: Document) -> None:
    doc.under("## Whole frames: Table 2", until="On two cores through PoCL")
    times, file = table2(doc, "h200"), File("h200/table2")
    for of in times.values():
        of["front"] = min(of[FRONT], of["front, radix"], *(of[asked] for asked in RADIX))
    low = ratios(times, BVTT, "front, radix")
    doc.says("takes {} and {} of the time of the best front over a radix tree on two scenes, {} and {} on the two others", *low)
    doc.says("takes {} to {} of the time of that pipeline, and {} to {} of that of `block`",
             *(end for other in (BVTT, BLOCK) for end in (min(ratios(times, "front", other)), max(ratios(times, "front", other)))))
    steps = {asked: {cell.samples[0]["broad"]["launches"] for scene in TABLE2.values() for cell in file.frames(scene, asked)[1:]}
             for asked in (FRONT, *RADIX)}
    front, leaf = steps[FRONT] | steps[RADIX[0]] | steps[RADIX[2]], steps[RADIX[1]] | steps[RADIX[3]]
    doc.says("launches {} to {}, and `front-leaf` {} in a frame that keeps its front and {} in one that maintains it", min(front),
             max(front),
             *sorted(leaf)[:2])  # a frame that makes a new tree takes more
    fresh, refits = ratios(times, FRESH, "front over apetrei-fused"), ratios(times, REFIT, "front over apetrei-fused")
    doc.says("a fresh one in every frame takes {} to {} times as long as `front` over the same tree", fresh[0], fresh[-1])
    doc.says("Refits alone, without a front, take {} to {} of its time", refits[0], refits[-1])
    memory = []
    for scene, of in times.items():
        front = min((FRONT, *RADIX), key=lambda asked: of[asked])
        memory.append(most_mb(file.frames(scene, front)) / most_mb(file.frames(scene, BLOCK)))
    doc.says("the best one of a scene takes {} to {} times that of `block`", min(memory), max(memory))
    nbody = "unc_nbody, 15 between"
    doc.says("takes {} MB; over one tree of the scene {} MB", most_mb(file.frames(nbody, RADIX[1])), most_mb(file.frames(nbody, RADIX[3])))
    root = ratios(times, FROM_ROOT, BVTT)
    doc.says("`bvtt` takes {} to {} times as long as from level 8", root[0], root[-1])
    saved = sorted(1e3 * (of[BVTT] - of[SAT]) for of in times.values())
    doc.says("`sat-f32` saves {} to {} µs", saved[0], saved[-1])
    cloth = file.frames("unc_cloth_ball, 15 between", SAT)
    doc.says("finds {} contacts too many of {} on `unc_cloth_ball`",
             *(sum(cell.counters[key] for cell in cloth) for key in ("false_count", "contacts_count")))

    doc.under("On two cores through PoCL", until="## Whole frames: Table 3")
    times = table2(doc, "pocl-2-cores")
    low, high = ratios(times, "front, radix", FROM_ROOT), ratios(times, "front, radix", GROUP)
    doc.says("takes {} to {} of the time of the paper's pipeline, and {} to {} times that of `group`", low[0], low[-1], high[0], high[-1])


def table3(doc: Document) -> None:
    doc.under("## Whole frames: Table 3")
    file, times = File("h200/table3"), {}
    for label, scene in TABLE3.items():
        times[scene] = {asked: later_ms(file.frames(scene, asked))
                        for asked in (BLOCK, BVTT, FROM_ROOT, CDK18, LEAF, GROUP, "hierarchical grid")}
        doc.row(label, *times[scene].values(), printed("table3", label))
    low, high = ratios(times, "hierarchical grid", BVTT), ratios(times, BLOCK, "hierarchical grid")
    doc.says("takes {} to {} of the time of the paper's pipeline, `bvtt`, and `block` {} to {} of the time of `grid`", low[0], low[-1],
             high[0], high[-1])


def rebuild(doc: Document) -> None:
    doc.under("## Rebuild, or refit")
    h200, pocl, scene = File("h200/rebuild"), File("pocl-2-cores/rebuild"), "cloth_ball_sim"
    rows = {"`block` over `oibvh-multi`, `hilbert30`": BLOCK, "`leaf` over `oibvh-multi`, `hilbert30`": LEAF,
            "`group` over `oibvh-multi`, `hilbert30`": GROUP, "`bvtt` over `oibvh-multi`": BVTT, "the same from the root": FROM_ROOT,
            "`front` over `oibvh-multi`": FRONT, "`front` over `apetrei-fused`": RADIX[0], "`front-leaf` over `apetrei-fused`": RADIX[1],
            "a fresh `front` in every frame, `apetrei-fused`": FRESH, "refits without a front, `group`, `apetrei-fused`": REFIT}
    times = {asked: (later_ms(h200.frames(scene, asked)), later_ms(pocl.frames(scene, asked))) for asked in rows.values()}
    for label, asked in rows.items():
        doc.row(label, *times[asked], most_mb(h200.frames(scene, asked)))
    fronts = (FRONT, *RADIX[:2])
    doc.says("rebuilding with `block` takes {} of the time of the best front", times[BLOCK][0] / min(times[asked][0] for asked in fronts))
    doc.says("The fronts equal the paper's `bvtt` within {} %",
             math.ceil(max(abs(100 * times[asked][0] / times[BVTT][0] - 100) for asked in fronts)))
    soonest = min(times[asked][1] for asked in fronts)
    doc.says("takes {} of the time of the paper's `bvtt` and {} times that of `group`", soonest / min(times[BVTT][1], times[FROM_ROOT][1]),
             soonest / times[GROUP][1])


def libraries(doc: Document) -> None:
    doc.under("## Beside Embree and FCL")
    scenes = [ranking.ranked(File(f"{machine}/families").cells).scenes for machine in ("h200", "pocl-2-cores")]
    up, back, more = ([[f(rows[0]) for rows in there.values()] for there in scenes]
                      for f in (lambda row: copied_ms(row, "upload_ns"), lambda row: copied_ms(row, "read_back_ns"),
                                lambda row: 1 + (copied_ms(row, "upload_ns") + copied_ms(row, "read_back_ns")) / (row.ns * 1e-6)))
    doc.says("beside an H200 {} to {} ms for the vertices and {} to {} ms for the contacts of these "
             "scenes, so that the\nbest frame takes {} to {} times",
             *(end for values in (up, back, more) for end in (min(values[0]), max(values[0]))))
    doc.says("{} to {} ms and {} to {} ms, at\nmost {} % of a frame",
             *(end for values in (up, back) for end in (min(values[1]), max(values[1]))),
             100 * max(more[1]) - 100)
    embree = [min(row.ratio for row in rows if row.first.builder == "none" and row.first.collider in ("embree", "embree-refit"))
              for rows in scenes[1].values()]
    doc.says("takes {} of the time of Embree on\n`unc_cloth_ball`, {} of that of Embree with refitted "
             "trees on the bunny and {} on `unc_nbody`",
             1 / embree[1], 1 / embree[0], 1 / embree[2])


def quotes(doc: Document) -> None:
    agreement(doc)
    pairs(doc)
    findings_of_table2(doc)
    table3(doc)
    rebuild(doc)
    libraries(doc)
