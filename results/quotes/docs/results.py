import answer
import ranking
from cells import Cell
from quotes import Document, File, frame_ms, listed, sah, us

of_readme, of_paper, of_frames, of_rivals = map(listed, ("README", "docs/paper", "docs/collisions", "docs/rivals"))
ends = of_paper.ends


def families(machine: str) -> dict[str, list[ranking.Row]]:
    """Returns the best pipeline of each family, scene by scene."""
    found: dict[str, list[ranking.Row]] = {}
    for rows in ranking.ranked(File(f"{machine}/families").cells).scenes.values():
        for row in answer.best_of_families(rows):
            found.setdefault(answer.family(row), []).append(row)
    return found


def which(doc: Document) -> None:
    doc.under("## Which pipeline")
    best = families("h200")
    times = [ends([row.ratio for row in best[family]])
             for family in ("implicit trees", "radix trees", "front tracking", "hierarchical grid", "Embree")]
    doc.says("takes {} ms on the bunny, {} on a cloth on a ball and {} on n-body",
             *(row.ns * 1e-6 for row in best["implicit trees"]))
    assert times[0] == (1, 1), "the page says that it wins on all three"
    doc.says("Radix trees take {} to {} times the best, front tracking {} to {} times, a hierarchical grid {} to {} times, and Embree on "
             "16 threads of the host {} to {} times", *(end for both in times[1:] for end in both))
    doc.under("## And without a GPU")
    best = families("pocl-2-cores")
    doc.says("implicit trees take {} to {} times the best, radix trees {} to {} times, Embree {} to {}, a hierarchical grid {} to {} and "
             "front tracking {} to {}.",
             *(end for family in ("implicit trees", "radix trees", "Embree", "hierarchical grid", "front tracking")
               for end in ends([row.ratio for row in best[family]])))


def builds(doc: Document) -> None:
    table1, fig8, printed, peers = (File(f"h200/{name}") for name in ("table1", "fig8", "fig8-printed", "peers"))

    def times(file: File, name: str) -> list[float]:
        return [us(file.cell(scene, name)) for scene in dict.fromkeys(cell.scene for cell in file.cells)]

    def over(file: File, rival: str) -> tuple[float, float]:
        ours = map(min, times(file, "oibvh-single"), times(file, "oibvh-multi"))
        return ends([theirs / own for theirs, own in zip(times(file, rival), ours)])

    doc.says("the construction is {} to {} times as fast as the radix tree as printed (`apetrei`), and {} to {} times as fast",
             *over(table1, "apetrei"), *over(table1, "apetrei-fused"))
    scan, stand_in = (us(table1.cell(scene, "oibvh-single")) for scene in ("happy_buddha_1087716", "buddha"))
    doc.says("Happy Buddha takes {} of the time of the torus", scan / stand_in)
    doc.says("the padded tree takes {} to {} times as long",
             *ends([padded / own for padded, own in zip(times(table1, "perfect"), times(table1, "oibvh-multi"))]))
    build = peers.cell("torus:2880000", "oibvh-single")
    doc.says("the torus of 2,880,000 triangles takes {} ms", us(build) * 1e-3)
    most = max((cell for cell in fig8.cells if cell.builder == "oibvh-single"), key=lambda cell: cell.triangles)
    doc.says("{} to {} times `apetrei` from 2^10 to 2^24 triangles, and {} billion nodes a second", *over(fig8, "apetrei"),
             most.counters["nodes_count"] / us(most) * 1e-3)
    single, several = times(fig8, "oibvh-single"), times(fig8, "oibvh-multi")
    doc.says("is faster than several at {} of {} sizes", sum(map(float.__lt__, single, several)), len(single))
    wins = [cell.triangles for cell in printed.cells if cell.builder == "oibvh-single-printed"
            and us(cell) < us(printed.cell(cell.scene, "oibvh-multi"))]
    doc.says("several up to 2^{} triangles", max(wins).bit_length() - 1)

    performance = listed("docs/performance")
    rate = File("h200/roofline").document["run"]["copy_rate_bytes_per_s"]
    doc.says("A build of 2,880,000 triangles takes {} times as long as copying the bytes that it must move: the stage `hierarchy` {} times, the sort {} times",
             *(us(build, *filter(None, [stage])) / performance.floor_us(build, stage, rate) for stage in ("", "hierarchy", "sort")))


def frames(doc: Document) -> None:
    doc.under("## Does rebuilding", until="## Is its tree")
    file, table3 = File("h200/table2"), File("h200/table3")
    names = (of_frames.FRONT, *of_frames.RADIX)
    fronts: list[list[float]] = [[], [], []]
    for scene in of_frames.TABLE2.values():
        times = {asked: of_frames.later_ms(file.frames(scene, asked)) for asked in (*names, of_frames.BVTT, of_frames.BLOCK)}
        best = min(names, key=times.__getitem__)
        fronts[0].append(min(times[asked] for asked in of_frames.RADIX) / times[of_frames.BVTT])
        fronts[1].append(times[best] / times[of_frames.BLOCK])
        fronts[2].append(of_frames.most_mb(file.frames(scene, best)) / of_frames.most_mb(file.frames(scene, of_frames.BLOCK)))
    doc.says("is {} to {} times as fast as the best front over a radix tree", *ends(fronts[0]))
    doc.says("rebuilding is {} to {} times as fast as the best front, which takes {} to {} times its memory", *ends(fronts[1]),
             *ends(fronts[2]))
    grid, bvtt, block = ([of_frames.later_ms(table3.frames(scene, asked)) for scene in of_frames.TABLE3.values()]
                         for asked in ("hierarchical grid", of_frames.BVTT, of_frames.BLOCK))
    doc.says("takes {} to {} of the time of the paper's pipeline, and `block` {} to {} of the time of the grid",
             *ends([one / other for one, other in zip(grid, bvtt)]), *ends([one / other for one, other in zip(block, grid)]))


def quality(doc: Document) -> None:
    table4, trees = File("h200/table4"), File("h200/quality")
    doc.says("{} to {} times the surface area cost",
             *ends([sah(table4, scene, "oibvh-multi, morton30-axis") / sah(table4, scene, "apetrei-fused, morton30-axis")
                    for scene in {cell.scene for cell in table4.cells}]))
    doc.says("it is within {} % of the radix tree on five scans",
             100 * max(sah(trees, scene, "oibvh-multi, kd") / sah(trees, scene, "apetrei-fused") - 1 for scene in of_readme.SCANS))


def libraries(doc: Document) -> None:
    file = File("h200/rivals")

    def times(scene: str) -> tuple[Cell, list[Cell]]:
        return file.cell(scene, of_rivals.FIRST), [file.cell(scene, asked) for asked in of_rivals.ROWS.values()]

    ratios = [min(of_rivals.triangles_to_pairs(cell) for cell in those if cell.outside) / of_rivals.triangles_to_pairs(ours)
              for ours, those in map(times, of_rivals.SCENES)]
    doc.says("takes {} to {} times as long as `block` over `oibvh-single`", *ends(ratios))


def answers(doc: Document) -> None:
    equality, agreement = File("h200/equality"), File("h200/agreement")
    doc.says("{} trees of every size from 1 to 600", sum(cell.verdict == "agrees" for cell in equality.cells))
    doc.says("{} cells of `agreement`", sum(cell.verdict == "agrees" for cell in agreement.cells))
    ours, right = listed("docs/stress").right_of("h200/stress")
    doc.says("of {} cells over scenes that are hard on purpose {} hold", ours, right)
    cloth = File("h200/table2").frames("unc_cloth_ball, 15 between", of_frames.SAT)
    doc.says("finds {} too many of {} on the cloth ball",
             *(sum(cell.counters[key] for cell in cloth) for key in ("false_count", "contacts_count")))


def devices(doc: Document) -> None:
    most, strong = ([run["result"] for run in File(f"h200/cluster-{name}").document["runs"]] for name in ("most", "strong"))
    doc.says("the pairs of 67,108,864 triangles {} times as fast as one, and the {} pairs of a torus of 2,147,483,648 triangles, "
             "which one cannot hold, in {} ms", frame_ms(strong[0]) / frame_ms(strong[2]), most[0]["pairs_count"], frame_ms(most[0]))


def quotes(doc: Document) -> None:
    for part in (builds, quality, libraries, answers, devices, which, frames):
        part(doc)
