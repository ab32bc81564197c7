from quotes import Document, File, us


def quotes(doc: Document) -> None:
    rule = File("h200/rule-sorted")
    doc.says("a\n  frame took {} us instead of {} (", *(us(rule.frames("cloth-ball:1000000:6", asked)[1]) for asked in (
        "block (without near) over oibvh-multi (hilbert30)", "block (without sorted, near) over oibvh-multi (hilbert30)")))
