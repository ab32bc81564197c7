from plots.evidence.quotes import Document, File, us
from plots.read import savings
from plots.read.savings import Saving
from plots.words.tables import span


def entries(found: list[Saving]) -> tuple[str, str]:
    """Returns the share of the work avoided and the ratio of times, over pipelines."""
    if not (those := [one for one in found if one.skips_something]):
        return "nothing", ""
    return (span([100 * one.share(one.work) for one in those], 0, "-"),
            span([savings.times(one) for one in those], 2, "-") + "*" * all(one.is_forced for one in those))


def quotes(doc: Document) -> None:
    machines = {"h200": "block", "pocl-2-cores": "group"}
    near = {machine: File(f"{machine}/rule-near") for machine in machines}
    scenes = {machine: file.cells[0].scene for machine, file in near.items()}
    frames = [[near[machine].frames(scenes[machine], f"{collider}{rule} over oibvh-multi") for rule in ("", " (without near)")]
              for machine, collider in machines.items()]
    doc.table("near", "< frame | H200 | two cores", (
        [str(number), *(f"{us(one) / us(other):.2f}" for one, other in pairs)]
        for number, pairs in enumerate(zip(*(zip(*both, strict=True) for both in frames), strict=True))))
    found = [savings.of_scenes(File(f"{machine}/skips").cells) for machine in machines]
    sums = [{(one.first.scene, one.pipeline): one for one in those if one.rule == savings.ALL} for those in found]
    found = [[one for one in those if one.rule != savings.ALL] for those in found]
    rows = dict.fromkeys((one.rule, one.first.scene, one.work) for one in found[0] if one.skips_something)
    # A rule has two rows in a scene if trees of the device and of the host are spared different work.
    doc.table("savings", "< rule, work | < scene | H200: avoided | times | two cores: avoided | times", (
        [f"`{rule}`, {work}", scene, *(entry for those in found for entry in entries(
            [one for one in those if (one.rule, one.first.scene, one.work) == (rule, scene, work)]))]
        for rule, scene, work in sorted(rows, key=lambda row: list(savings.WORK).index(row[0]))))
    doc.table("sums", "< scene | < pipeline | H200 | two cores", (
        [scene, pipeline, *(f"{savings.times(those[scene, pipeline]):.2f}" if (scene, pipeline) in those else "" for those in sums)]
        for scene, pipeline in dict.fromkeys(key for those in sums for key in those)))
    used = [savings.times(one) for one in found[0] if not one.is_forced and one.skips_something]
    doc.says("noise, which is up to {} % there", 100 * (1 - min(used)))
