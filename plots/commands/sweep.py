"""bvhbench sweep: makes a plan of a product of scenes, builders, colliders and options, and runs it."""
import argparse
import json
import pathlib
import re
from typing import Any

from ..files import documents, output
from ..files.json_files import value_of
from ..files.output import WrongUsage
from ..files.reserved import reserved
from ..program import child, command
from ..read import merging, ranking_text, results
from ..read.cells import Cell, grouped
from ..sweeping.planned import Json, Planned, Sweep
from ..sweeping.product import swept_of
from ..words import tables

LISTS = ("scenes", "builders", "orders", "colliders")  # options that take comma-separated values
Shard = tuple[int, int]  # the i-th of n


def parser() -> command.Parser:
    words = command.Parser(
        "sweep", "Measure a product of scenes, sizes, builders, orders, colliders and options; go on where it was interrupted",
        "Writes a plan into the folder and measures it by `bvhbench run --resume`: each cell, or scene, has a process of its own, so a "
        "crash costs one cell, and the same command again goes on where it was interrupted. The result is sweep.json in the folder.",
        [("bvhbench sweep --scenes torus --sizes 1000:1000000:x10 --builders oibvh-multi,karras --out out/sizes", "eight cells"),
         ("bvhbench sweep docs/sweep.json --shard 2/8 --out out/part-2", "the second of eight machines"),
         ("bvhbench sweep docs/sweep.json --out out/all --dry-run", "which cells, and how many")], "docs/sweeps.md",
        several_devices=True)
    add = words.add_argument
    add("file", nargs="?", default="", metavar="FILE",
        help="the sweep as JSON (docs/sweeps.md); options take the place of its keys")
    add("--name", dest="sweep", help="the sweep's name: cells' experiment, and the result file's")
    add("--scenes", action="append", help="scenes, data sets or mesh files; {size}, or a generator's bare name, takes each size")
    add("--sizes", help="triangles: 1000,30000 or 1000:1000000:x10 or 1000:5000:+1000")
    add("--builders", action="append", help="names of `list builders`")
    add("--orders", action="append", help="names of `list orders`")
    add("--colliders", action="append", help="names of `list colliders`; without, cells are builds; with, whole frames")
    add("--set", action="append", default=[],
        help="KEY=V1,V2: goes through values of an option: boxes, leaves, items, builder.group_size, narrow, adjacent, jump, "
        "frames and others; may be said again")
    add("--samples", type=int, help="timed runs a cell; default: 20")
    add("--warm-up", type=int, help="runs before them that do not count; default: 3")
    words.add_costs()
    add("--out", required=True, help="the folder of the sweep: the same command goes on with what is there")
    add("--device", action="append",
        help="as for all commands; more than once: each of these measures a share, and they must be alike")
    add("--shard", default="", help="i/n: only the i-th of n parts, for n machines; then merge their files")
    add("--together", choices=("cell", "scene"), default="cell",
        help="cell or scene: what a process measures; of a scene all at once, so that samples of builders are interleaved")
    add("--continue-other-commit", action="store_true",
        help="keep cells that another commit has measured, and go on with this one")
    add("--retry-failed", action="store_true", help="measure cells that failed again")
    add("--dry-run", action="store_true", help="print the cells and measure none")
    return words


def described(arguments: argparse.Namespace) -> Json:
    """Returns the sweep's file, with its keys overridden by the command line."""
    description: Any = {}
    if arguments.file:
        try:
            description = value_of(documents.file_text(arguments.file, "the sweep's file"))
        except ValueError as error:
            raise WrongUsage(str(error)) from error
        if not isinstance(description, dict):
            raise WrongUsage("a sweep must be an object")
    for key in LISTS:
        if values := getattr(arguments, key):
            description[key] = [value for words in values for value in words.split(",")]
    for key in ("sweep", "sizes", "samples", "warm_up"):
        if (value := getattr(arguments, key)) is not None:
            description[key] = value
    if arguments.quality:
        description["quality"] = True
    for words in arguments.set:
        key, equals, values = words.partition("=")
        if not equals or not key:
            raise WrongUsage(f"--set is KEY=V1,V2, not '{words}'")
        chosen = description.setdefault("set", {})
        if isinstance(chosen, dict):  # otherwise it is refused with the file
            chosen[key] = values.split(",")
    return description


def planned(arguments: argparse.Namespace) -> Sweep:
    words = command.common_words(arguments, "--device")
    try:
        return swept_of(described(arguments), lambda experiments: child.expanded(experiments, words))
    except WrongUsage as wrong:
        raise WrongUsage(f"{arguments.file}: {wrong}" if arguments.file else str(wrong)) from wrong


def shard_called(text: str) -> Shard:
    found = re.fullmatch(r"(\d+)/(\d+)", text or "1/1")
    if not found or not 1 <= int(found[1]) <= int(found[2]):
        raise WrongUsage(f"--shard is i/n with i from 1 to n, not '{text}'")
    return int(found[1]), int(found[2])


def parts_of(sweep: Sweep, together: bool) -> list[list[Planned]]:
    """Returns the possible cells in parts, each of which a process measures."""
    return list(grouped((one for one in sweep.cells if not one.why_not),
                        lambda one: json.dumps(one.scene, sort_keys=True) if together else id(one)).values())


def plan_of(sweep: Sweep, parts: list[list[Planned]]) -> Json:
    """Returns the plan for `run`: its parts, and the cells that cannot be, as the result file has them."""
    def described(cells: list[Planned]) -> Json:
        what = f"{len(cells)} cells" if len(cells) > 1 else cells[0].cell.pipeline
        experiment = sweep.experiment(cells)
        del experiment["experiment"]
        return {"label": f"{cells[0].cell.scene}, {what}", **experiment}

    impossible = [one.raw | {"status": "skipped", "reason": one.why_not} for one in sweep.cells if one.why_not]
    return {"experiment": sweep.name, "parts": [described(cells) for cells in parts], "impossible": impossible}


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    shard, devices = shard_called(arguments.shard), arguments.device or [None]
    if len(devices) > 1 and shard[1] > 1:
        raise WrongUsage("--shard measures on one --device: take more shards")
    sweep = planned(arguments)
    parts = parts_of(sweep, arguments.together == "scene")
    line = f"{sweep.name}: {sweep.product}: {tables.counted(len(sweep.cells), 'cell')}"
    if none := sum(bool(one.why_not) for one in sweep.cells):
        line += f", {none} of which cannot be"
    if shard[1] > 1:
        line += f"; shard {arguments.shard} has {sum(len(cells) for cells in share_of(parts, shard))}"
    print(line, flush=True)
    if arguments.dry_run:
        print(cells_table(sweep, parts, shard), end="")
        return 0
    return measured(arguments, sweep, plan_of(sweep, parts), devices, shard)


def share_of(parts: list[list[Planned]], shard: Shard) -> list[list[Planned]]:
    return parts[shard[0] - 1::shard[1]]


def cells_table(sweep: Sweep, parts: list[list[Planned]], shard: Shard) -> str:
    table = tables.Table("<scene", "triangles", "<what", "<")
    rows = [(one, "") for cells in share_of(parts, shard) for one in cells]
    rows += [(one, f"cannot be: {one.why_not}") for one in sweep.cells if one.why_not and shard[0] == 1]
    for one, why in rows:
        table.row(one.cell.scene, tables.whole(one.triangles or None), one.cell.pipeline, why)
    return table.text()


def device_words(device: str | None) -> list[str]:
    return [] if device is None else ["--device", device]


def require_alike(devices: list[str | None], words: list[str]) -> None:
    """Raises WrongUsage unless all devices have the same name and driver."""
    known = []
    for device in dict.fromkeys(devices):
        facts = child.facts([*words, *device_words(device)])["device"]
        known.append(f"{facts['platform']}/{facts['name']}, driver {facts['driver']}")
        if known[0] != known[-1]:
            raise WrongUsage(f"the devices of a sweep must be alike, and these are {known[0]} and {known[-1]}; sweep each by itself, "
                             "and merge --other-devices")
    if facts["kind"] == "cpu" or len(known) < len(devices):
        print("note: processes share a device, and disturb each other's times", flush=True)


def measured(arguments: argparse.Namespace, sweep: Sweep, plan: Json, devices: list[str | None], shard: Shard) -> int:
    """Runs the plan: each device measures a share. Returns the exit code."""
    folder = pathlib.Path(arguments.out)
    common = command.common_words(arguments, "--device", "--force")
    if len(devices) > 1:
        require_alike(devices, common)
    output.make_folder(folder)
    result, file = folder / f"{sweep.name}.json", folder / "plan.json"
    if file == result:
        raise WrongUsage("--name: a sweep cannot be called plan")
    output.write(file, (json.dumps(plan, indent=1) + "\n").encode())
    costs = (arguments.sah_inner, arguments.sah_triangle)
    options = [*common, "--quiet", "--force" if arguments.force else "--resume"]
    options += [] if costs == results.USUAL_COSTS else ["--sah-inner", str(costs[0]), "--sah-triangle", str(costs[1])]
    options += [] if arguments.force else [f"--{name}" for name in ("continue-other-commit", "retry-failed")
                                           if getattr(arguments, name.replace("-", "_"))]
    shares = [shard] if len(devices) == 1 else [(place, len(devices)) for place in range(1, len(devices) + 1)]
    files = [folder / f"{sweep.name}-{i}of{n}.json" if n > 1 else result for i, n in shares]
    runs = [["run", str(file), "--out", str(out), "--only", f"{i}/{n}", *options, *device_words(device)]
            for device, out, (i, n) in zip(devices, files, shares, strict=True)]
    if len(devices) == 1:
        code = child.run_shown(runs)
        return summed_up(files[0], code)
    inputs = [arguments.file] * bool(arguments.file) + sorted({file for one in sweep.cells for file in one.files})
    with reserved(str(result), "--out", arguments.force, inputs, lambda _text: True):
        code = child.run_shown(runs)
        if code in (0, 1, 4) and all(one.exists() for one in files):
            merged = merging.merge(((str(one), documents.read(str(one))) for one in files), other_commits=True)
            output.write(result, merged.text.encode(errors="surrogateescape"))
    return summed_up(result, code)


def summed_up(file: pathlib.Path, code: int) -> int:
    """Prints how many cells a finished sweep has, and which builder is the fastest. Returns the exit code."""
    if code in (0, 1) and file.exists():
        cells = [Cell(raw) for raw in documents.read(str(file))["cells"]]
        count = {status: sum(cell.status == status for cell in cells) for status in ("measured", "skipped", "failed")}
        print(f"{tables.counted(len(cells), 'cell')}: " + ", ".join(f"{number:,} {status}" for status, number in count.items()))
        print(f"{ranking_text.of_cells(cells)}{ranking_text.warning_lines(cells)}written: {file}", flush=True)
    return code
