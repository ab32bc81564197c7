from collections.abc import Iterable

from plots.evidence.quotes import Document, File, ends, later_ms, listed, ratios, sah, us

of_frames = listed("docs/collisions")
SCENES, RADIX, BVTT = list(of_frames.TABLE2.values()), of_frames.RADIX, of_frames.BVTT
SELF = [scene for scene in SCENES if "nbody" not in scene]
PRINTED = ("apetrei-fused, morton30-axis", "oibvh-multi, morton30-axis")


def cost_ratios(file: File, scenes: Iterable[str]) -> list[float]:
    """Returns the cost of the paper's tree over that of the radix tree, both in the paper's order."""
    return [sah(file, scene, PRINTED[1]) / sah(file, scene, PRINTED[0]) for scene in scenes]


def scenes_of(file: File, part: str = "") -> list[str]:
    return list(dict.fromkeys(cell.scene for cell in file.cells if part in cell.scene))


def faster(file: File, rival: str) -> tuple[float, float]:
    """Returns how many times as long a rival's builds take as those of the faster of both implicit trees."""
    times = {name: [us(file.cell(scene, name)) for scene in scenes_of(file)] for name in (rival, "oibvh-single", "oibvh-multi")}
    return ratios(times[rival], map(min, times["oibvh-single"], times["oibvh-multi"]))


def builds(doc: Document) -> None:
    table1, fig8, printed, builders = (File(f"h200/{name}") for name in ("table1", "fig8", "fig8-printed", "builders"))

    def of(what: str, name: str) -> list[float]:
        cells = [table1.cell(scene, name) for scene in scenes_of(table1)]
        return [cell.counters["tree_bytes"] if what == "bytes" else us(cell) for cell in cells]

    def refined(file: File, name: str, exponent: int) -> float:
        return us(file.cell(f"refine:torus:1024:{1 << exponent}", name))

    doc.says("times | {} to {} times; {} to {} times `apetrei-fused`", *faster(table1, "apetrei"), *faster(table1, "apetrei-fused"))
    doc.says("(Fig. 8) | 3.2 to 6.2 times | {} to {} times", *faster(fig8, "apetrei"))
    doc.says("| {} and {} ns a thousand triangles", *(refined(fig8, "oibvh-single", size) * 1e6 / (1 << size) for size in (22, 24)))
    doc.says("| {} at 2^24", fig8.cell(f"refine:torus:1024:{1 << 24}", "oibvh-single").counters["nodes_count"]
             / refined(fig8, "oibvh-single", 24) * 1e-3)
    doc.says("as printed {} times at 2^13, {} times at 2^16",
             *(refined(printed, slower, size) / refined(printed, faster, size) for size, slower, faster in
               ((13, "oibvh-multi", "oibvh-single-printed"), (16, "oibvh-single-printed", "oibvh-multi"))))
    single, several = ([us(builders.cell(scene, name), "hierarchy") for scene in ("bunny", "unc_cloth_ball", "happy_buddha_1087716")]
                       for name in ("oibvh-single-printed", "oibvh-multi"))
    doc.says("| {} to {} % as printed", *(100 * ratio - 100 for ratio in ratios(single, several)))
    doc.says("| {} % of the bytes of `apetrei`", 100 * sum(of("bytes", "oibvh-multi")) / sum(of("bytes", "apetrei")))
    doc.says("up to 48.1 % | {} to {} %", *(100 - 100 * one for one in ratios(of("bytes", "oibvh-multi"), of("bytes", "perfect"))[::-1]))
    doc.says("the padded tree takes {} to {} times as long", *ratios(of("us", "perfect"), of("us", "oibvh-multi")))


def frames(doc: Document) -> None:
    table2, rebuild, table3 = (File(f"h200/{name}") for name in ("table2", "rebuild", "table3"))

    def times(asked: str) -> list[float]:
        return [later_ms(table2.frames(scene, asked)) for scene in SCENES]

    def memory(asked: Iterable[str]) -> list[float]:
        return [of_frames.most_mb(table2.frames(scene, one)) for scene, one in zip(SCENES, asked, strict=True)]

    def share(scene: str, *stages: str) -> float:
        those = table2.frames(scene, BVTT)[1:]
        return 100 * sum(us(cell, *(stage for stage in stages if stage in cell.samples[0])) for cell in those) / sum(map(us, those))

    best = [min(RADIX, key=lambda asked: later_ms(table2.frames(scene, asked))) for scene in SCENES]
    ours, fronts = times(BVTT), [min(one) for one in zip(*map(times, RADIX), strict=True)]
    doc.says("1 to 1.29 times | {} to {} times", *ratios(fronts, ours))
    doc.says("4 times | {} to {} times", *ratios(times(of_frames.FRESH), ours))
    doc.says("refits without a front take {} to {} times", *ratios(times(of_frames.REFIT), ours))
    doc.says("(Sec. 5) | none | it takes {} to {} times", *ratios(times(of_frames.FROM_ROOT), fronts))
    doc.says("| {} to {} % of a front", *(100 * one for one in ratios(memory([BVTT] * len(SCENES)), memory(best))))
    peaks = [[sum(cell.counters["bvtt_peak_count"] for cell in table2.frames(scene, asked)[1:]) for scene in SCENES]
             for asked in (BVTT, RADIX[0])]
    doc.says("| {} to {} % than that of `front`", *(100 - 100 * one for one in ratios(*peaks)[::-1]))
    refitted, rebuilt = ([us(cell, "broad") for cell in rebuild.frames("cloth_ball_sim", asked)]
                         for asked in (of_frames.REFIT, "group over oibvh-multi"))
    doc.says("take {} of the time of those over new trees in the first frame, {} in the last", refitted[0] / rebuilt[0],
             refitted[-1] / rebuilt[-1])
    tracked = [table2.frames(scene, asked) for scene in SCENES for asked in RADIX]
    tracked += [rebuild.frames("cloth_ball_sim", asked) for asked in RADIX[:2]]
    doc.says("{} of {} frames needed a new tree", sum(those[-1].counters["restarts_count"] for those in tracked),
             sum(len(those) - 1 for those in tracked))
    tree = "bounds", "codes", "sort", "hierarchy", "refit"
    doc.says("| {} to {} %, {} to {} %", *(end for stages in (tree, ["broad"]) for end in ends(share(scene, *stages) for scene in SELF)))
    doc.says("95, 5 % | {}, {} %", *(share("unc_nbody, 15 between", *stages) for stages in (tree, ["broad"])))
    doc.says("fronts over one tree take {} to {} times", *ratios(times(RADIX[2]), times(RADIX[0])))
    ours, grid = ([table3.frames(scene, asked) for scene in of_frames.TABLE3.values()] for asked in (BVTT, "hierarchical grid"))
    doc.says("the hierarchical grid takes {} to {} of its time", *ratios(map(later_ms, grid), map(later_ms, ours)))
    doc.says("| {} to {} times that of the grid", *ratios(map(of_frames.most_mb, ours), map(of_frames.most_mb, grid)))


def quotes(doc: Document) -> None:
    builds(doc)
    frames(doc)
    table4, fig13 = File("h200/table4"), File("h200/fig13")
    doc.says("1.67 to 2.66 times the cost | {} to {} times", *ends(cost_ratios(table4, scenes_of(table4))))
    away = cost_ratios(fig13, scenes_of(fig13, "dragon"))
    doc.says("| {} times at the mesh, at most {} times on the dragon", away[0], max(away))
    doc.says("the Happy Buddha's costs are {} and {};", *(sah(table4, "happy_buddha_1087716", asked) for asked in PRINTED))
