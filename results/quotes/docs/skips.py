import savings
from quotes import Document, File, us
from savings import Saving


def spread(values: list[float], form: str) -> str:
    """Returns "0.98 to 1.02", or one number where both would be the same."""
    low, high = form.format(min(values)), form.format(max(values))
    return low if low == high else f"{low} to {high}"


def entries(found: list[Saving]) -> tuple[str, str]:
    """Returns the share of the work avoided and the ratio of times, over pipelines."""
    those = [one for one in found if one.skips_something]
    if not those:
        return "nothing", ""
    forced = " (forced)" if all(one.is_forced for one in those) else ""
    return (f"{spread([100 * one.share(one.work) for one in those], '{:.0f}')} % of {those[0].work}".replace("-0 %", "0 %"),
            spread([savings.times(one) for one in those], "{:.2f}") + forced)


def quotes(doc: Document) -> None:
    found = {machine: savings.of_scenes(File(f"{machine}/skips").cells) for machine in ("h200", "pocl-2-cores")}
    rows = dict.fromkeys((one.rule, one.first.scene, one.work) for one in found["h200"] if one.skips_something)
    for rule, scene, work in rows:
        both = [entries([one for one in those if (one.rule, one.first.scene, one.work) == (rule, scene, work)]) for those in found.values()]
        # A rule has two rows in a scene if trees of the device and of the host are spared different work.
        share, times = both[0]
        doc.says(f"| `{rule}` | {scene} | {{}} % of {work} | {{}} | {{}} | {{}} |", share.partition(" %")[0], times, *both[1])
    for name, text in (("h200", "take {} to {} of the time on an H200"), ("pocl-2-cores", "and {} to {} on two cores (1,000,000")):
        near = File(f"{name}/rule-near")
        collider = "block" if name == "h200" else "group"
        pairs = [[cell for cell in near.cells if dict(cell.collider_options).get("no_skip", "") == off] for off in ("", "near")]
        shares = [us(one) / us(other) for one, other in zip(*pairs)]
        doc.says(text, min(shares), max(shares))
    used = [savings.times(one) for one in found["h200"] if not one.is_forced and one.skips_something]
    doc.says("noise, which is up to {} % there: the most", 100 * (1 - min(used)))
    forced = [1 / savings.times(one) for one in found["h200"] if one.rule == "near" and one.is_forced and one.skips_something]
    doc.says("`near` would cost {} to {} times the frame", min(forced), max(forced))
