from quotes import Document, File, later_ms, listed, sah, us

of_frames = listed("docs/collisions")
SCENES, RADIX, BVTT = list(of_frames.TABLE2.values()), of_frames.RADIX, of_frames.BVTT
SELF = [scene for scene in SCENES if "nbody" not in scene]


def ends(values: list[float]) -> tuple[float, float]:
    return min(values), max(values)


def builds(doc: Document) -> None:
    table1, fig8, printed = File("h200/table1"), File("h200/fig8"), File("h200/fig8-printed")
    scenes = list(dict.fromkeys(cell.scene for cell in table1.cells))

    def over(file: File, names: list[str], rival: str) -> list[float]:
        return [us(file.cell(name, rival)) / min(us(file.cell(name, one)) for one in ("oibvh-single", "oibvh-multi")) for name in names]

    def refined(exponent: int) -> str:
        return f"refine:torus:1024:{1 << exponent}"

    doc.says("| {} to {} times `apetrei`, which is as printed; {} to {} times `apetrei-fused`", *ends(over(table1, scenes, "apetrei")),
             *ends(over(table1, scenes, "apetrei-fused")))
    doc.says("| {} to {} times `apetrei` from 2^10 to 2^24",
             *ends(over(fig8, [refined(exponent) for exponent in range(10, 25)], "apetrei")))
    doc.says("| {} and {} ns a thousand triangles",
             *(us(fig8.cell(refined(exponent), "oibvh-single")) * 1e6 / (1 << exponent) for exponent in (22, 24)))
    most = fig8.cell(refined(24), "oibvh-single")
    doc.says("| {} at 2^24, another device", most.counters["nodes_count"] / us(most) * 1e-3)
    small, large = ([us(printed.cell(refined(exponent), name)) for name in ("oibvh-single-printed", "oibvh-multi")]
                    for exponent in (13, 16))
    doc.says("| as printed, {} times at 2^13, and {} times at 2^16", small[1] / small[0], large[0] / large[1])
    doc.says("its trees take {} % of the bytes", 100 * sum(table1.cell(scene, "oibvh-multi").counters["tree_bytes"] for scene in scenes)
             / sum(table1.cell(scene, "apetrei").counters["tree_bytes"] for scene in scenes))
    doc.says("| saves {} to {} % of its bytes |", *ends([100 - 100 * table1.cell(scene, "oibvh-multi").counters["tree_bytes"]
                                                  / table1.cell(scene, "perfect").counters["tree_bytes"] for scene in scenes]))
    doc.says("the padded tree takes {} to {} times the time of `oibvh-multi`",
             *ends([us(table1.cell(scene, "perfect")) / us(table1.cell(scene, "oibvh-multi")) for scene in scenes]))


def frames(doc: Document) -> None:
    file, rebuild = File("h200/table2"), File("h200/rebuild")

    def times(asked: str) -> list[float]:
        return [later_ms(file.frames(scene, asked)) for scene in SCENES]

    def over(those: list[float], others: list[float]) -> tuple[float, float]:
        return ends([one / other for one, other in zip(those, others)])

    ours, fronts, refits = times(BVTT), [min(values) for values in zip(*map(times, RADIX))], times(of_frames.REFIT)
    best = [min(RADIX, key=lambda asked: later_ms(file.frames(scene, asked))) for scene in SCENES]
    doc.says("| {} to {} times as fast as a front |", *over(fronts, ours))
    doc.says("| 4 times | {} to {} times |", *over(times(of_frames.FRESH), ours))
    doc.says("the pipeline takes {} to {} of the time of refits without a front, `block` over the same tree {} to {} |",
             *over(ours, refits),
             *over(times(of_frames.BLOCK), refits))
    doc.says("| it takes {} to {} times as long as a front |", *over(times(of_frames.FROM_ROOT), fronts))
    doc.says("| {} to {} % of a front |", *over([100 * of_frames.most_mb(file.frames(scene, BVTT)) for scene in SCENES],
                                               [of_frames.most_mb(file.frames(scene, front)) for scene, front in zip(SCENES, best)]))
    peaks = [[sum(cell.counters["bvtt_peak_count"] for cell in file.frames(scene, asked)[1:]) for scene in SCENES]
             for asked in (BVTT, RADIX[0])]
    doc.says("| {} to {} % smaller than the entries", *ends([100 - 100 * one / other for one, other in zip(*peaks)]))
    refitted, rebuilt = ([us(cell, "broad") for cell in rebuild.frames("cloth_ball_sim", asked)]
                         for asked in (of_frames.REFIT, "group over oibvh-multi"))
    doc.says("take {} of the time of those over the pipeline's rebuilt trees in the first frame, {} times in the last of {} (",
             refitted[0] / rebuilt[0], refitted[-1] / rebuilt[-1], len(rebuilt))
    tracked = [file.frames(scene, asked) for scene in SCENES for asked in RADIX] + [rebuild.frames("cloth_ball_sim", asked)
                                                                                    for asked in RADIX[:2]]
    doc.says("| {} of {} frames of fronts", sum(those[-1].counters["restarts_count"] for those in tracked),
             sum(len(those) - 1 for those in tracked))

    def share(scene: str, *stages: str) -> float:
        those = file.frames(scene, BVTT)[1:]
        return 100 * sum(us(cell, *(stage for stage in stages if stage in cell.samples[0])) for cell in those) / sum(map(us, those))

    tree = ("bounds", "codes", "sort", "hierarchy", "refit")
    doc.says("| {} to {} %, {} to {} % |", *ends([share(scene, *tree) for scene in SELF]), *ends([share(scene, "broad") for scene in SELF]))
    doc.says("| 95, 5 % | {}, {} %: all trees", *(share("unc_nbody, 15 between", *stages) for stages in (tree, ["broad"])))
    doc.says("fronts over one tree take {} to {} times as long", *over(times(RADIX[2]), times(RADIX[0])))

    table3, grid = File("h200/table3"), "hierarchical grid"
    both = [[later_ms(table3.frames(scene, asked)) for scene in of_frames.TABLE3.values()] for asked in (grid, BVTT)]
    doc.says("the hierarchical grid takes {} to {} of its time", *over(*both))
    both = [[of_frames.most_mb(table3.frames(scene, asked)) for scene in of_frames.TABLE3.values()] for asked in (BVTT, grid)]
    doc.says("| {} to {} times that of the hierarchical grid |", *over(*both))


def trees(doc: Document) -> None:
    table4, fig13, builders = File("h200/table4"), File("h200/fig13"), File("h200/builders")

    def cost(file: File, scene: str) -> float:
        return sah(file, scene, "oibvh-multi, morton30-axis") / sah(file, scene, "apetrei-fused, morton30-axis")

    doc.says("| 1.67 to 2.66 times the cost | {} to {} times |",
             *ends([cost(table4, scene) for scene in {cell.scene for cell in table4.cells}]))
    away = [cost(fig13, scene) for scene in dict.fromkeys(cell.scene for cell in fig13.cells) if "dragon" in scene]
    doc.says("| {} times at the mesh, at most {} times on the dragon", away[0], max(away))

    printed = File("h200/fig8-printed")
    pairs = [[us(printed.cell(f"refine:torus:1024:{1 << exponent}", name)) for name in ("oibvh-single-printed", "oibvh-multi")]
             for exponent in (13, 14, 15)]
    doc.says("the faster up to 2^13 triangles ({} and {} µs), equal at 2^14 ({}) and the slower from 2^15 on ({} and {};", *pairs[0],
             pairs[1][0], *pairs[2])
    doc.says("the Happy Buddha's costs are {} and {};", *(sah(table4, "happy_buddha_1087716", f"{name}, morton30-axis")
                                                         for name in ("apetrei-fused", "oibvh-multi")))
    doc.says("as printed, by {} to {} % on three meshes",
             *ends([100 * us(builders.cell(scene, "oibvh-single-printed"), "hierarchy")
                    / us(builders.cell(scene, "oibvh-multi"), "hierarchy") - 100 for scene in ("bunny", "unc_cloth_ball", "happy_buddha_1087716")]))
    doc.says("the bunny's 144,046 triangles take {} µs where single work-items take {} (",
             *(us(builders.cell("bunny", name), "hierarchy") for name in ("oibvh-single", "oibvh-single-printed")))


def quotes(doc: Document) -> None:
    builds(doc)
    frames(doc)
    trees(doc)
