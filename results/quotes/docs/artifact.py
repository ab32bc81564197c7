import datetime
import functools

from plots.console import claims
from plots.evidence.quotes import ROOT, Document, File, sah
from plots.read import effects, ranking, ranking_text, results


@functools.cache
def minutes(file: str) -> str:
    """Returns how long the run of a file took."""
    run = File(file).document["run"]
    begun, ended = (datetime.datetime.fromisoformat(run[key]) for key in ("started_at", "finished_at"))
    return f"{max(1, round((ended - begun).total_seconds() / 60))}"


def of_paper(doc: Document) -> None:
    rows = []
    experiments = dict.fromkeys(claim.experiment for claim in claims.CLAIMS)
    runs = {name: results.everything(str(ROOT / "results" / "h200" / f"{name}.json.xz")) for name in experiments}
    for claim in claims.CLAIMS:
        values = claims.ratios(claim, runs[claim.experiment])
        ours = claim.says.format(f"{min(values):.2f}", f"{max(values):.2f}")
        rows.append([claim.text, f"`bvhbench reproduce {claim.experiment}`", minutes(f"h200/{claim.experiment}"),
                     minutes(f"pocl-2-cores/{claim.experiment}"), ours, claims.verdict(values, claim.confirmed_from, claim.in_part_from)])
    doc.table("paper", "< claim | < command | minutes: H200 | two cores | < expected on an H200 | < verdict", rows)


def own(doc: Document) -> None:
    rows = ranking.ranked(File("h200/families").cells).scenes.values()
    radix = [next(row.ratio for row in of if ranking_text.family(row) == "radix trees") for of in rows]
    doc.says("a radix tree's frame takes {} to {} times the best there", min(radix), max(radix))
    by = effects.shares(effects.frames_of(File("h200/effects").cells), False)
    doc.says("the collider {} % of the variance, the builder {} %", 100 * by["collider"], 100 * by["builder"])
    orders = File("h200/orders")
    doc.says("SAH {} and {} of Morton's on the tori", *(sah(orders, scene, "oibvh-multi, hilbert30") / sah(orders, scene, "oibvh-multi")
                                                       for scene in ("torus:144046", "torus:2880000")))


def quotes(doc: Document) -> None:
    of_paper(doc)
    own(doc)
