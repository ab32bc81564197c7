from quotes import Document, File, us


def quotes(doc: Document) -> None:
    rule = File("h200/rule-sorted")
    doc.says("a\n  frame took {} us instead of {} (", *(us(rule.frames("cloth-ball:1000000:6", asked)[1]) for asked in (
        "block (without near) over oibvh-multi (hilbert30)", "block (without sorted, near) over oibvh-multi (hilbert30)")))
    wide, ratios = File("h200/wide"), {}
    for collider in ("group", "leaf"):
        ratios[collider] = [us(wide.cell(scene, f"{collider} over oibvh-wide8-q8"), "broad")
                            / us(wide.cell(scene, f"{collider} over oibvh-wide8"), "broad")
                            for scene in dict.fromkeys(cell.scene for cell in wide.cells)]
    doc.says("In Morton order `group` took {} to {} times as long as over `oibvh-wide8` and `leaf` {} to {} times",
             *(end for values in ratios.values() for end in (min(values), max(values))))
