from plots.evidence.quotes import Document, File, ends, frame_ms, listed, ratios, sah
from plots.read import ranking, ranking_text

of_orders, of_rivals, of_stress, of_readme = (listed(name) for name in ("docs/orders", "docs/rivals", "docs/stress", "README"))


def quotes(doc: Document) -> None:
    quality = File("h200/quality")
    best: dict[str, list[float]] = {}
    found = ranking.ranked(File("h200/families").cells)
    for rows in found.scenes.values():
        for row in ranking_text.best_of_families(rows):
            best.setdefault(ranking_text.family(row), []).append(row.ratio)
    if max(best["implicit trees"]) > 1:
        raise ValueError("the page says that implicit trees win on all three scenes")
    doc.says("Front tracking takes {} to {} times as long where a scene moves, a hierarchical grid {} to {}, radix trees {} to {}.",
             *(end for family in ("front tracking", "hierarchical grid", "radix trees") for end in ends(best[family])))
    doc.says("By the host's clock, with copies, Embree on 16 threads takes {} to {} times as long",
             *ends(of["Embree"] / of["ours"] for of in map(of_readme.by_host, found.scenes.values())))
    listed("claims").bullets(doc)
    listed("claims").radix_by_collider(doc)
    kd, radix = ([sah(quality, scene, asked) for scene in of_orders.SCANS] for asked in ("oibvh-multi, kd", "apetrei-fused"))
    doc.says("brings it within {} % on five scans", 100 * ratios(kd, radix)[1] - 100)
    doc.says("takes {} to {} times as long as `block` over\n`oibvh-single`", *ends(of_rivals.best_ratios(File("h200/rivals"))))
    doc.says("(`agreement`, {} cells), and of {} cells over", listed("docs/collisions").agreeing("h200"), of_stress.right_of("h200/stress")[0])
    most, = File("h200/cluster-most").results()
    doc.says("{} to {} times as fast as one, and those of a torus of 2,147,483,648, which one cannot hold, in {} ms a frame, after {} s of cutting",
             *of_readme.strong_scaling(), frame_ms(most), 1e-9 * most["partition_ns"])
