"""bvhbench scale: makes a plan of one scene on more and more ranks, and runs it.

Needs the standard library alone, because machines with many devices often have no more.
"""
import argparse
import json
import pathlib
import re
import tempfile

from ..files import output
from ..files.json_files import Json
from ..program import child, command

RANKS = (1, 2, 4, 8)
HALO_RANKS, HALO_BOXES = (2, 8, 64), (1, 64)
STRONG, WEAK, HALO = 67_108_864, 33_554_432, 1_152_000  # triangles: in all, a rank, in all
PIPELINE = ("builder", "order", "collider")
QUICK = 64  # with --quick, sizes are divided by this


def parser() -> command.Parser:
    words = command.Parser(
        "scale", "Run one scene on more and more devices: strong and weak scaling, and the share of the halo",
        "Writes a plan and measures it by `bvhbench run --resume`, with ranks on this host: the same command again goes on where it was "
        "interrupted. More ranks than there are devices are noted as failed. halo counts what ranks would send, and runs none.",
        [("bvhbench scale strong --out strong.json", "torus:67108864 on 1, 2, 4 and 8 devices"),
         ("bvhbench scale weak --out weak.json", "33,554,432 triangles a rank"),
         ("bvhbench scale halo --out halo.json --quick", "what ranks send, of a small scene")], "docs/cluster.md")
    add = words.add_argument
    add("experiment", metavar="EXPERIMENT", choices=("strong", "weak", "halo"), help="strong, weak or halo")
    add("--out", required=True, help="the result file")
    add("--scene", default="torus",
        help="a generator's name, which takes each experiment's size; or, but for weak, a scene with its size, or a file")
    add("--ranks", help="rank counts, as 1,2,4")
    for name in PIPELINE:
        add(f"--{name}", help=f"a name of `list {name}s`")
    add("--partition", choices=("rcb", "curve"), help="rcb or curve; default: rcb, and both for halo")
    add("--samples", type=int, help="timed frames a cell; default: 20, and for halo 3, of its largest part")
    add("--share-devices", action="store_true", help="let ranks share a device; for a try on one, gives no times")
    add("--quick", action="store_true", help=f"scenes of one {QUICK}th of the size")
    return words


def ranks_of(arguments: argparse.Namespace) -> list[int]:
    if not arguments.ranks:
        return list(HALO_RANKS if arguments.experiment == "halo" else RANKS)
    if not re.fullmatch(r"[1-9]\d{0,3}(,[1-9]\d{0,3})*", arguments.ranks):
        raise output.WrongUsage(f"--ranks is a list of rank counts, as 1,2,4, not '{arguments.ranks}'")
    return sorted({int(one) for one in arguments.ranks.split(",")})


def clusters_of(arguments: argparse.Namespace) -> list[Json]:
    """Returns the entries of the plan, one for each part."""
    kind, is_bare = arguments.experiment, re.fullmatch(r"[a-z-]+", arguments.scene)
    if kind == "weak" and not is_bare:
        raise output.WrongUsage(f"weak needs a generator's name, whose size grows with the ranks, not '{arguments.scene}'")

    def scene(triangles: int) -> str:
        return f"{arguments.scene}:{triangles // (QUICK if arguments.quick else 1)}" if is_bare else arguments.scene

    ranks, partitions = ranks_of(arguments), [arguments.partition] if arguments.partition else ["rcb", "curve"]
    if kind == "halo":
        return [{"scene": scene(HALO), "simulate": count, "partition": partition, "boxes": boxes}
                for count in ranks for partition in partitions for boxes in HALO_BOXES]
    return [{"scene": scene(WEAK * count if kind == "weak" else STRONG), "ranks": count, "partition": partitions[0]} for count in ranks]


def label_of(cluster: Json) -> str:
    count, boxes = cluster.get("ranks", cluster.get("simulate")), cluster.get("boxes")
    many = f", {boxes} box{'es' * (boxes > 1)} a rank" if boxes else ""
    return f"{cluster['scene']}, {count} rank{'s' * (count > 1)}, {cluster['partition']}{many}"


def plan_of(arguments: argparse.Namespace) -> Json:
    """Returns the plan for `run`: a part for each cell."""
    samples = arguments.samples if arguments.samples is not None else 3 if arguments.experiment == "halo" else 20
    asked = {name: value for name in PIPELINE if (value := getattr(arguments, name)) is not None} | {"samples": samples}
    asked |= {"share_devices": True} if arguments.share_devices and arguments.experiment != "halo" else {}
    return {"experiment": arguments.experiment,
            "parts": [{"label": label_of(cluster), "clusters": [cluster | asked]} for cluster in clusters_of(arguments)]}


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    with tempfile.TemporaryDirectory(prefix="bvhbench-") as folder:
        plan = pathlib.Path(folder, f"{arguments.experiment}.json")
        plan.write_text(json.dumps(plan_of(arguments), indent=1), encoding="utf-8")
        return child.run_shown([["run", str(plan), "--out", arguments.out, "--quiet", "--force" if arguments.force else "--resume",
                                 *command.common_words(arguments, "--force")]])
