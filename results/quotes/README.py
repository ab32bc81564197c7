import math

from plots.evidence.quotes import ONE_SET, Document, File, asked_of, ends, frame_ms, listed, sah, us
from plots.read import ranking, ranking_text
from plots.words import tables

AS_PRINTED = "bvtt over oibvh-multi"
SCANS = ("bunny_69451", "armadillo_86482", "turbineblade_199034", "dragon_202520", "happy_buddha_1087716")


def told(row: ranking.Row | None, best: ranking.Row) -> str:
    """Returns a family's time and how many times the best that is, or a dash where it has no place (ranking.Ranking.unplaced)."""
    if row is None:
        return "—"
    time = tables.three_digits(row.ns * 1e-6)
    return f"**{time}**" if row is best else f"{time} ({'=' if row.tied else f'× {ranking_text.number(row.ratio)}'})"


def by_host(rows: list[ranking.Row]) -> dict[str, float]:
    """Returns the least milliseconds by the host's clock (Row.host_ns) of the host's libraries, and of all of ours under the name "ours"."""
    times: dict[str, float] = {}
    for row in rows:
        family = ranking_text.family(row)
        name = family if family in ("Embree", "FCL") else "ours"
        times[name] = min(times.get(name, math.inf), row.host_ns({cell.frame for cell in row.cells}) * 1e-6)
    return times


def told_of_host(time: float, ours: float) -> str:
    return f"**{tables.three_digits(time)}**" if time == ours else f"{tables.three_digits(time)} (× {ranking_text.number(time / ours)})"


def families(doc: Document) -> None:
    """The tables of families, in both files by scene, and what is said of them."""
    bests, as_printed, hosts, samples = [], [], [], {}
    for machine in ("h200", "pocl-2-cores"):
        found = ranking.ranked(File(f"{machine}/families").cells)
        as_printed += [row.ratio for rows in found.scenes.values() for row in rows if asked_of(row.first) == AS_PRINTED]
        bests += [{ranking_text.family(row): row for row in ranking_text.best_of_families(rows)} for rows in found.scenes.values()]
        hosts += map(by_host, found.scenes.values())
        samples[machine] = [len(cell.samples) for rows in found.scenes.values() for row in rows for cell in row.cells]
    on_h200 = list(ranking.ranked(File("h200/families").cells).scenes.values())
    labels = {"implicit trees": "implicit trees, the paper's", "front tracking": "front tracking, over any tree"}
    for family in [name for name in bests[1] if name not in hosts[0]]:
        doc.row(labels.get(family, family), *(told(of.get(family), next(iter(of.values()))) for of in bests))
    bunny = on_h200[0][0].first
    assert bunny.scene == "bunny" and bunny.counters["contacts_count"] == 0, "README says that the bunny has no contact"
    for name, label in (("ours", "ours, the best"), ("Embree", "Embree"), ("FCL", "FCL")):
        doc.row(label, *(told_of_host(of[name], of["ours"]) for of in hosts))
    doc.says("medians of {} samples, on two cores {} to {},", max(samples["h200"]), *ends(samples["pocl-2-cores"]))
    doc.says("with `bvtt`, the paper's pipeline takes {} to {} times the best", min(as_printed[:3]), max(as_printed[:3]))

    def ratios(collider: str, tree: str) -> list[float]:
        return [next(row.ratio for row in rows if row.first.collider == collider and row.first.called.endswith(tree)) for rows in on_h200]

    block, bvtt = ratios("block", "over oibvh-multi"), ratios("bvtt", "over oibvh-single (hilbert30)")
    doc.says("with `block` over the same trees it takes {} to {} times the best, and with `bvtt` along a Hilbert curve {} to {}",
             min(block), max(block), min(bvtt), max(bvtt))
    listed("claims").radix_by_collider(doc)
    assert all(of["implicit trees"].ratio == 1 for of in bests[:3]), "README says that it wins on all three scenes"


def quality(doc: Document) -> None:
    trees, orders = File("h200/quality"), File("h200/orders")
    scans, hairball = ([100 * sah(trees, scene, "oibvh-multi, kd") / sah(trees, scene, "apetrei-fused") - 100 for scene in those]
                       for those in (SCANS, ["hairball:200000"]))
    doc.says("`--order kd` brings the paper's tree within {} % of a radix tree's cost on five scans, {} % on a hairball", max(scans), *hairball)
    doc.says("from triangles to tree of torus:2880000 it takes {} µs, the paper's order {} µs and the radix tree {} µs",
             *(us(orders.cell("torus:2880000", name)) for name in ("oibvh-multi, kd", "oibvh-multi, morton30-axis", "apetrei-fused")))


def strong_scaling() -> tuple[float, float]:
    """Returns how many times as fast as one four devices are, over the scene where that is least and where it is most."""
    runs = [File(f"h200/cluster-{name}").results() for name in ("strong", "strong-buddha", "strong-hairball")]
    return ends(frame_ms(one) / frame_ms(four) for one, _, four in runs)


def quotes(doc: Document) -> None:
    families(doc)
    frames, table2 = listed("docs/collisions"), File("h200/table2")
    doc.says("of Table 2, in {} to {} times less memory", *frames.memory(table2, frames.BLOCK))
    listed("claims").bullets(doc, "sizes", "refit")
    quality(doc)
    of_rivals, rivals = listed("docs/rivals"), File("h200/rivals")
    doc.says("nine CUDA libraries takes {} to {} times as long as `block`", *ends(of_rivals.best_ratios(rivals)))
    doc.says("({} to {} where it refits and ours rebuilds)", *of_rivals.best_refits(rivals))
    doc.says("and {} to {} times as long as `group` over our radix tree", *ends(of_rivals.best_ratios(rivals, "group over apetrei-fused")))

    most, = File("h200/cluster-most").results()
    doc.says("four H200 find the {} pairs of a torus of 2,147,483,648 triangles in {} ms a frame (three, that do not move) after {} s of cutting",
             most["pairs_count"], frame_ms(most), 1e-9 * most["partition_ns"])
    doc.says("they find the pairs {} to {} times as fast as one", *strong_scaling())

    headlines, pairs = File("h200/headlines"), File("h200/pairs")
    torus, (kd, hilbert) = "torus:2880000", (f"block over oibvh-single ({order}, sorted leaves)" for order in ("kd", "hilbert30"))
    doc.says("{} ms | `run headlines` |\n| the same of torus:144046 | {} ms |",
             *(us(headlines.cell(scene, "oibvh-single")) * 1e-3 for scene in (torus, "torus:144046")))
    for scene, text in ((torus, "triangles to all {} pairs, written, along `hilbert30`, torus:2880000 | {} ms"),
                        ("happy_buddha_1087716", "the same of the Happy Buddha, {} pairs | {} ms")):
        cell = headlines.cell(scene + ONE_SET, hilbert)
        doc.says(text, cell.counters["pairs_count"], us(cell) * 1e-3)
    cell = pairs.cell(torus + ONE_SET, kd)
    doc.says("whose order takes {} ms (triangles to pairs {} ms) | {} ms",
             *(us(cell, *stages) * 1e-3 for stages in (["order"], [], ["broad"])))

    equality = File("h200/equality")
    doc.says("{} trees of every size from 1 to 600", sum(cell.verdict == "agrees" for cell in equality.cells))
