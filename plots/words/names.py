"""The words of all figures and tables: stages, orders, scenes, builders, colliders and pipelines with their options."""
from collections.abc import Collection, Iterable, Mapping
from typing import Any

# Stages in the order in which they run, by the part of a frame that they belong to (docs/frames.md). A part is named after its
# stages, so that a figure and a table use one word for one thing.
PARTS = (("upload", "near", "margin", "pad", "bounds"), ("codes",), ("sort", "order"), ("gather", "hierarchy", "build", "refit", "to_device", "ropes"),
         ("collapse", "copy", "broad", "filter"), ("narrow", "exact", "read_back"))
STAGES = tuple(stage for stages in PARTS for stage in stages)
OF_BUILDS = ("bounds", "codes", "sort", "order", "gather", "hierarchy", "build", "refit")
OF_QUERIES = ("ropes", "collapse", "broad", "narrow")
BETWEEN = "between stages"
# Builders and colliders from outside, in the order in which their cells were read (cells.py).
OUTSIDE: dict[str, None] = {}

# Orders of leaves as in `list orders`. A figure shows an order by its place here, so that its number is the same in all figures.
ORDERS = ("morton30", "morton48", "morton63", "hilbert30", "hilbert48", "hilbert63", "morton30-axis", "morton48-axis",
          "morton63-axis", "hilbert30-axis", "hilbert48-axis", "hilbert63-axis", "hilbert30+kd1024", "kd", "morton24", "hilbert24")

# The default of each option and the wording of another value, in the order in which names show them.
OPTIONS = {"no_skip": ("", "without {}"), "force_skip": ("", "{} forced"),
           "jump": ("0", "jump {}"), "start_level": ("0", "from level {}"),
           "order": ("morton30", "{}"), "grid": ("object", "grid over the {}"), "group_size": ("0", "groups of {}"), "items": ("0", "{} items"),
           "leaves": ("mesh", "{} leaves"), "boxes": ("f32", "{} boxes"), "update": ("auto", "always {}"),
           "trees": ("object", "one tree of the {}")}
# What a collider chose itself where its options left it the choice: in place of them (Cell.used_options).
USED = {"start": ("", "from {}")}
# Options that change what is found. Figures show them elsewhere.
ANSWERS = {"pairs_of": ("all", "{} objects"), "adjacent": ("keep", "adjacent {}ped"), "narrow": ("none", "contacts {}"),
           "first": ("False", "first contact"), "within": ("none", "within {}"), "separation": ("none", "{} apart")}
# Where samples find their data, if not in hot caches.
CACHES = {"cold": "cold caches", "host": "from host to host"}
# Names that say more than the command line's.
CALLED = {"grid": "hierarchical grid"}
EXACT = ("none", "exact")  # values of `narrow` that give no wrong contacts
USUAL = {key: usual for key, (usual, _) in {**ANSWERS, **OPTIONS}.items()}


def non_default(options: Mapping[str, object], table: Mapping[str, tuple[str, str]]) -> list[str]:
    """Returns the words of the options that are not the defaults; `table` has each option's default and words. Only a cell that was not
    begun still has the choice `auto`."""
    return [words.format(options[key]) for key, (usual, words) in table.items() if str(options.get(key, usual)) not in (usual, "auto")]


def part(stages: tuple[str, ...], there: Collection[str]) -> str:
    """Returns the name of a part of a frame: those of its stages that are there, as "gather + hierarchy"."""
    return " + ".join(stage for stage in stages if stage in there)


def numbers(orders: Iterable[str]) -> dict[str, int]:
    """Returns the number of each order, smallest first. Orders that are not in ORDERS have the numbers after it."""
    distinct = dict.fromkeys(orders)
    places = {order: number for number, order in enumerate((*ORDERS, *(order for order in distinct if order not in ORDERS)), 1)}
    return {order: places[order] for order in sorted(distinct, key=places.__getitem__)}


def option(key: str, value: object) -> str:
    """Returns the words for one option's value, default or not: "mesh leaves"."""
    return OPTIONS[key][1].format(value) if key in OPTIONS else f"{key} {value}"


def variant(name: str, options: Mapping[str, object]) -> str:
    """Returns the name in figures: "bvtt (jump 2)"."""
    words = non_default(options, {**OPTIONS, **USED})
    return CALLED.get(name, name) + (f" ({', '.join(words)})" if words else "")


def pipeline(collider: str, collider_options: Mapping[str, object], builder: str, options: Mapping[str, object]) -> str:
    text = variant(collider, collider_options) + ("" if builder == "none" else f" over {variant(builder, options)}")
    narrow = collider_options.get("narrow", "none")
    return text if narrow in EXACT else f"{text}, contacts {narrow}"


def in_full(choice: Mapping[str, Any]) -> str:
    """Returns the name of a result file's builder or collider on the console: "bvtt, between objects, jump 2"."""
    options = choice.get("options", {})
    shown = {key: value for key, value in options.items() if key != "leaves" or options.get("boxes", "f32") == "f32"}
    return ", ".join([choice["name"], *non_default(shown, ANSWERS), *non_default(shown, {**OPTIONS, **USED})])


def scene(facts: Mapping[str, object]) -> str:
    """Returns the name of a scene, with its settings that are not the defaults."""
    objects, between = facts.get("objects_by"), facts.get("between", 0)
    told = {f"objects: {objects}": objects, f"{between} between": between, f"without {facts.get('exclude')}": facts.get("exclude")}
    return ", ".join([str(facts["name"]), *(text for text, is_set in told.items() if is_set)])


def frames(numbers: list[int]) -> str:
    return f"frame {numbers[0]}" if len(numbers) == 1 else f"{len(numbers)} frames"
