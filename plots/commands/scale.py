"""bvhbench scale: runs one scene on more and more ranks, a start of `bvhbench cluster` for each cell.

Needs the standard library alone, because machines with many devices often have no more.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from typing import Any

from ..files import output, reserved
from ..files.json_files import Refused, parsed
from ..program import child, command

FORMAT = "cluster-runs-1.1"
RANKS = (1, 2, 4, 8)
HALO_RANKS, HALO_BOXES = (2, 8, 64), (1, 64)
STRONG, WEAK, HALO = 67_108_864, 33_554_432, 1_152_000  # triangles: in all, a rank, in all
PIPELINE = ("builder", "order", "collider")
QUICK = 64  # with --quick, sizes are divided by this


@dataclass(frozen=True)
class Cell:
    scene: str
    ranks: int
    partition: str = "rcb"
    boxes: int = 0  # that a rank tells the others; 0: ranks run, else what they would send is counted

    def words(self) -> list[str]:
        return ["cluster", self.scene, "--partition", self.partition, "--simulate" if self.boxes else "--ranks", str(self.ranks),
                *(["--boxes", str(self.boxes)] if self.boxes else [])]

    @property
    def label(self) -> str:
        boxes = f", {self.boxes} box{'es' * (self.boxes > 1)} a rank" if self.boxes else ""
        return f"{self.scene}, {self.ranks} rank{'s' * (self.ranks > 1)}, {self.partition}{boxes}"


def parser() -> command.Parser:
    words = command.Parser(
        "scale", "Run one scene on more and more devices: strong and weak scaling, and the share of the halo",
        "Each cell is a start of `bvhbench cluster` with ranks on this host. The file is written anew after each cell. More ranks "
        "than there are devices are noted as failed. halo counts what ranks would send, and runs none.",
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
    add("--quick", action="store_true", help=f"scenes of one {QUICK}th of the size")
    return words


def ranks_of(arguments: argparse.Namespace) -> list[int]:
    if not arguments.ranks:
        return list(HALO_RANKS if arguments.experiment == "halo" else RANKS)
    if not re.fullmatch(r"[1-9]\d{0,3}(,[1-9]\d{0,3})*", arguments.ranks):
        raise output.WrongUsage(f"--ranks is a list of rank counts, as 1,2,4, not '{arguments.ranks}'")
    return sorted({int(one) for one in arguments.ranks.split(",")})


def cells_of(arguments: argparse.Namespace) -> list[Cell]:
    kind, is_bare = arguments.experiment, re.fullmatch(r"[a-z-]+", arguments.scene)
    if kind == "weak" and not is_bare:
        raise output.WrongUsage(f"weak needs a generator's name, whose size grows with the ranks, not '{arguments.scene}'")

    def scene(triangles: int) -> str:
        return f"{arguments.scene}:{triangles // (QUICK if arguments.quick else 1)}" if is_bare else arguments.scene

    ranks = ranks_of(arguments)
    if kind == "halo":
        return [Cell(scene(HALO), count, partition, boxes) for count in ranks
                for partition in ([arguments.partition] if arguments.partition else ["rcb", "curve"]) for boxes in HALO_BOXES]
    return [Cell(scene(WEAK * count if kind == "weak" else STRONG), count, arguments.partition or "rcb") for count in ranks]


def measured(cell: Cell, options: list[str]) -> dict[str, Any]:
    """Runs a cell. Returns its entry of the file."""
    entry: dict[str, Any] = {"scene": cell.scene, "ranks": cell.ranks, "partition": cell.partition}
    with tempfile.TemporaryDirectory(prefix="bvhbench-") as folder:
        file, errors = pathlib.Path(folder, "cell.json"), pathlib.Path(folder, "errors")
        with errors.open("wb") as taken:
            code, _ = child.run([*cell.words(), "--json", str(file), *options], errors=taken)
        said = errors.read_text(errors="replace")
        print(said, end="", file=sys.stderr, flush=True)
        if code - 128 in command.ENDING:
            raise command.Ended(code - 128)
        if code == 2:  # wrong usage, which other cells share
            raise SystemExit(code)
        if not file.exists():
            sentence = re.search(r"^bvhbench: (.+)", said, re.MULTILINE)
            return entry | {"status": "failed", "reason": sentence[1] if sentence else f"bvhbench cluster ended with exit code {code}"}
        result = parsed(file)
        is_wrong = result.get("check", {}).get("verdict") == "differs"
        return entry | ({"status": "failed", "reason": f"a wrong answer: {result['check']['detail']}"} if is_wrong else
                        {"status": "measured"}) | {"result": result}


def topology() -> dict[str, str]:
    """Returns how the host's NVIDIA devices are linked, as nvidia-smi prints it; nothing where it cannot tell."""
    try:
        done = subprocess.run(["nvidia-smi", "topo", "-m"], capture_output=True, text=True, timeout=60, check=True)
    except (OSError, subprocess.SubprocessError):
        return {}
    return {"topology": re.sub(r"\x1b\[[\d;]*m", "", done.stdout).rstrip()}


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    samples = arguments.samples if arguments.samples is not None else 3 if arguments.experiment == "halo" else 20
    if not 1 <= samples <= 10000:
        raise output.WrongUsage(f"--samples: {samples} is not from 1 to 10000")
    cells, runs = cells_of(arguments), []
    document = {"format": FORMAT, "experiment": arguments.experiment, "command": ["bvhbench", "scale", *words], **topology(), "runs": runs}
    options = command.common_words(arguments, "--force") + ["--samples", str(samples)]
    for name in PIPELINE:
        options += [f"--{name}", getattr(arguments, name)] if getattr(arguments, name) else []
    with reserved.reserved(arguments.out, "--out", arguments.force):
        for number, cell in enumerate(cells, 1):
            entry = measured(cell, options)
            runs.append(entry)
            output.write(arguments.out, (json.dumps(document, indent=1) + "\n").encode())
            print(f"[{number}/{len(cells)}] {cell.label}: {found(entry)}", flush=True)
    if all(entry["status"] == "failed" for entry in runs):
        raise Refused(f"no cell was measured; the first: {runs[0]['reason']}")
    return 1 if any("wrong" in entry.get("reason", "") for entry in runs) else 0


def found(entry: dict[str, Any]) -> str:
    """Returns what a cell found, for its line."""
    if entry["status"] != "measured":
        return entry["reason"]
    result = entry["result"]
    frame = f"{result['frame_ns'] / 1e6:.3f} ms, " if "frame_ns" in result else ""
    verdict = f", {result['check']['verdict'].replace('_', ' ')}" if "check" in result else ""
    return f"{frame}halo {100 * result['halo_share']:.1f} %{verdict}"
