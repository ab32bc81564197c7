from plots.console import effects_table
from plots.evidence.quotes import Document, File
from plots.read import effects
from plots.words.tables import span

COLLIDERS = ("leaf", "group", "block", "bvtt")
BUILDERS = ("perfect", "oibvh-wide4", "oibvh-wide8", "apetrei-fused", "hploc")


def quotes(doc: Document) -> None:
    cells = effects.frames_of(File("h200/effects").cells)
    doc.table("effects", f"< choice, against | < level | {' | '.join(effects_table.TITLES)}", (
        [f"{choice}, `{reference}`", f"`{level}`", *columns]
        for choice, level, reference, *columns, _ in effects_table.rows_of_ratios(cells)))
    frames = {name: effects.logs_of([cell for cell in cells if cell.collider == name], of_query=False) for name in COLLIDERS}

    def ratio(builder: str, collider: str) -> str:
        found = effects.ratio_of(frames[collider], 0, builder)
        return f"{found.mean:.2f} ({span(found.by_scene.values(), 2)})" if found else "-"

    doc.table("by-collider", "< builder | " + " | ".join(f"`{name}`" for name in COLLIDERS),
              ([f"`{builder}`", *(ratio(builder, name) for name in COLLIDERS)] for builder in BUILDERS))
    doc.table("predict", "< measure | < of | " + " | ".join(f"`{name}`" for name in effects_table.titles_of_ranks(cells)[2:]),
              effects_table.rows_of_ranks(cells))
    for of_query, what in ((False, "a frame's"), (True, "a query's")):
        by = effects.shares(cells, of_query)
        doc.says(f"of {what} time the collider decides {{}} %, the builder {{}} %, both together {{}} %, order and leaves {{}} %",
                 *(100 * by[name] for name in ("collider", "builder", "builder × collider")), 100 * (by["order"] + by["leaves"]))
    doc.says("are queried in {} times the time of an implicit tree",
             next(one.query.mean for one in effects.effects(cells) if one.level == "sah-binned"))
    two_cores(doc)


def two_cores(doc: Document) -> None:
    cells = effects.frames_of(File("pocl-2-cores/effects").cells)
    by = effects.shares(cells, of_query=False)
    frame = {one.level: one.frame.mean for one in effects.effects(cells) if one.frame}
    doc.says("PoCL, seven of the meshes, {} cells", len(cells))
    doc.says("The collider decides {} % of a frame's variance, the builder {} %: `leaf` takes {} and `bvtt` {} times as long as `block`, a\n"
             "radix tree {} times as long as an implicit one, the padded tree {}, `hploc` {}. `kd` takes {} times as long as `hilbert30`, mesh order\n{}",
             100 * by["collider"], 100 * by["builder"], *(frame[level] for level in ("leaf", "bvtt", "apetrei-fused", "perfect", "hploc", "kd", "mesh")))
