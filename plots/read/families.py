"""Families of builders and colliders: methods that work alike. To add a builder or collider, add the start of its name here."""
from .cells import Cell

EXPERIMENT = "families"  # compares the best of each

# The start of a builder's name, and its family. The first that fits counts.
BUILDERS = (("oibvh-wide", "wide trees"), ("oibvh-", "implicit trees"), ("perfect", "padded implicit trees"),
            ("karras", "radix trees"), ("apetrei", "radix trees"), ("lbvh-", "radix trees"), ("radix-", "radix trees"),
            ("hploc", "clustered trees"), ("heap-median", "host builders"),
            ("median-split", "host builders"), ("sah-binned", "host builders"), ("embree", "Embree"), ("fcl", "FCL"))
# Families whose trees are made on the host.
ON_HOST = ("host builders", "Embree", "FCL")
OWN_LEAVES = ("wide trees", *ON_HOST)  # keep leaf boxes in their own way, whatever is asked
# Colliders that make a family by themselves, whatever tree they use.
COLLIDERS = (("front", "front tracking"), ("grid", "hierarchical grid"), ("all-pairs", "all pairs"), ("sort-sweep", "sort and sweep"), ("brute", "sweep"), ("embree", "Embree"), ("fcl", "FCL"))

NO_FRAME_BEFORE = "start from the frame before, and there is one frame"


def first_fit(name: str, table: tuple[tuple[str, str], ...]) -> str | None:
    return next((family for start, family in table if name.startswith(start)), None)


def of_builder(name: str) -> str:
    return first_fit(name, BUILDERS) or name


def of_collider(name: str) -> str | None:
    """Returns the family that a collider makes by itself, or None if its tree decides."""
    return first_fit(name, COLLIDERS)


def keeps(collider: str, update: str = "") -> bool:
    """True if a collider with this option `update` starts from what it kept of the frame before, a front or a tree."""
    return update == "refit" or collider.endswith("-refit") or (of_collider(collider) == "front tracking" and update != "rebuild")


def of_cell(cell: Cell) -> str:
    if cell.outside:
        return cell.outside["library"]
    return of_collider(cell.collider or "") or of_builder(cell.builder)
