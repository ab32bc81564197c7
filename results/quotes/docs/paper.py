from plots.evidence.quotes import Document, File, ends, later_ms, listed, ratios, sah, us

of_frames, of_claims = listed("docs/collisions"), listed("claims")
SCENES, RADIX, BVTT = list(of_frames.TABLE2.values()), of_frames.RADIX, of_frames.BVTT
SELF = [scene for scene in SCENES if "nbody" not in scene]
scenes_of = of_claims.scenes_of


def builds(doc: Document) -> None:
    table1, fig8, printed, builders = (File(f"h200/{name}") for name in ("table1", "fig8", "fig8-printed", "builders"))

    def of(what: str, name: str) -> list[float]:
        cells = [table1.cell(scene, name) for scene in scenes_of(table1)]
        return [cell.counters["tree_bytes"] if what == "bytes" else us(cell) for cell in cells]

    def refined(file: File, name: str, exponent: int) -> float:
        return us(file.cell(f"refine:torus:1024:{1 << exponent}", name))

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
    meeting, apetrei, fixed = ([us(fig8.cell(scene, name)) for scene in scenes_of(fig8)]
                               for name in ("oibvh-multi-printed", "apetrei", "oibvh-multi"))
    doc.says("`apetrei` takes {} to {} times as long, fixed steps without atomics {} to {}", *ratios(apetrei, meeting), *ratios(fixed, meeting))


def parameters(doc: Document) -> None:
    """What the paper leaves to its user: the size of a group and the levels of a step."""
    file = File("h200/group-and-jump")
    sizes = {scene: {int(dict(cell.options)["group_size"]): us(cell, "hierarchy") for cell in file.cells
                     if (cell.scene, cell.called) == (scene, "oibvh-multi")} for scene in scenes_of(file)}
    doc.says("takes {} to {} times as long with 16 as with 256, with 512 {} to {}",
             *(end for size in (16, 512) for end in ratios([of[size] for of in sizes.values()], [of[256] for of in sizes.values()])))
    jumps = [{int(dict(cell.collider_options)["jump"]): us(cell, "broad") for cell in file.cells if cell.scene == scene and cell.collider == "bvtt"}
             for scene in scenes_of(file)]
    best = [min(times, key=lambda jump: times[jump]) for times in jumps]
    doc.says("The best are {}, {}, {}, {} on the bunny, UNC's cloth ball, a hairball and torus:2880000; with 5 a query takes {} to {} times as long",
             *best, *ratios([times[5] for times in jumps], map(min, (times.values() for times in jumps))))


def frames(doc: Document) -> None:
    table2, rebuild, table3 = (File(f"h200/{name}") for name in ("table2", "rebuild", "table3"))

    def times(asked: str) -> list[float]:
        return [later_ms(table2.frames(scene, asked)) for scene in SCENES]

    def share(scene: str, *stages: str) -> float:
        those = table2.frames(scene, BVTT)[1:]
        return 100 * sum(us(cell, *(stage for stage in stages if stage in cell.samples[0])) for cell in those) / sum(map(us, those))

    ours, fronts = times(BVTT), [min(one) for one in zip(*map(times, RADIX), strict=True)]
    doc.says("4 times | {} to {} times", *ratios(times(of_frames.FRESH), ours))
    doc.says("(Sec. 5) | none | it takes {} to {} times", *ratios(times(of_frames.FROM_ROOT), fronts))
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
    one_tree = ratios(times(BVTT.replace(")", ", one tree of the scene)")), times(BVTT))
    doc.says("the pipeline over one tree takes {} to {} times as long, fronts {} to {}", *one_tree,
             *ratios(times(RADIX[2]), times(RADIX[0])))
    ours, grid = ([table3.frames(scene, asked) for scene in of_frames.TABLE3.values()] for asked in (BVTT, "hierarchical grid"))
    doc.says("| {} to {} times that of the grid", *ratios(map(of_frames.most_mb, ours), map(of_frames.most_mb, grid)))


def quotes(doc: Document) -> None:
    builds(doc)
    parameters(doc)
    frames(doc)
    of_claims.rows(doc)
    table4, fig13 = File("h200/table4"), File("h200/fig13")
    away = of_claims.cost_ratios(fig13, scenes_of(fig13, "dragon"))
    doc.says("| {} times at the mesh, at most {} times on the dragon", away[0], max(away))
    doc.says("the Happy Buddha's costs are {} and {};", *(sah(table4, "happy_buddha_1087716", asked) for asked in of_claims.PRINTED))
