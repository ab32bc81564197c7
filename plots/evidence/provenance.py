"""Says which result files do not speak of the kernels that are there.

    python3 -m plots.evidence.provenance   # prints each file of results/ that has a dirty or unknown commit, or is older than its kernels

A file is older than a kernel if a kernel file that one of its cells launched has another text now: comments and blanks do not count,
nor does the host's code. The stages of a cell say which kernels it launched. A shallow clone lacks commits: known() is false then.
"""
import functools
import pathlib
import re
import subprocess
import sys
from collections.abc import Iterator
from typing import Any, NamedTuple

from ..files.json_files import files_in, parsed
from ..read.cells import Cell

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPS = "collide/skips.cpp"  # rules, and where each is off
PRINTED = "builders/implicit/build_meeting"  # in a folder of others, and one builder's alone
MANY = "collide/queues/many_"  # in a folder of others; runs for scenes of MANY_OBJECTS or more
MANY_OBJECTS = 512
UNDECIDED = "collide/narrow/narrow_undecided"  # in a folder of others, and that of FILTERS alone
FILTERS = ("filter-f64", "filter-f32")
APART = (PRINTED, MANY, UNDECIDED)
# Where the kernels of a stage are: beginnings of paths. A builder makes the stages of OF_BUILDER, a collider `broad`.
STAGES = {"bounds": ("builders/stages/bounds",), "codes": ("builders/stages/code",), "sort": ("builders/stages/sort/",),
          "order": ("builders/stages/medians/", "builders/ordered/", "builders/stages/sort/at_once"),
          "gather": ("builders/stages/gather",), "ropes": ("collide/walks/ropes",),
          "collapse": ("collide/walks/collapse", "collide/walks/line_up"),
          "narrow": ("collide/narrow/",), "near": ("collide/near",), "margin": ("collide/margin", "collide/standing"), "objects": (MANY, "collide/object_order")}
OF_RANKS = {"boxes": ("cluster/top_boxes",), "exchange": ("cluster/",)}  # one rank has nothing to exchange
OF_FIRST = {"first contact": ("collide/first/", "collide/narrow/")}  # beside `broad`
OF_WITHIN = {"within": ("collide/within/", "collide/narrow/")}
OF_SEPARATION = {"separation": ("collide/separation/", "collide/within/pad")}
OF_SWEPT = {"narrow between frames": ("collide/impacts/", "collide/moving/advance"), "narrow of queries": ("collide/moving/",),
            "narrow in doubles": ("collide/wide_impacts/", "collide/impacts/find", "collide/moving/")}  # in place of `narrow`
OF_FILTERS = {"narrow of filters": ("collide/narrow/", UNDECIDED)}  # the same
OF_BUILDER = ("hierarchy", "refit", "build")
OF_FRAME = ("bounds", "codes", "sort", "hierarchy", "boxes")  # of `bvhbench cluster`
BUILDERS = {"oibvh-wide": ("oibvh/wide/",), "oibvh-multi-printed": ("oibvh/", "builders/implicit/", PRINTED), "oibvh": ("oibvh/", "builders/implicit/"),
            "perfect": ("baselines/perfect/", "builders/implicit/"),
            "hploc": ("baselines/hploc/",), **{name: ("baselines/radix/",) for name in ("karras", "apetrei", "lbvh-levels")}}
COLLIDERS = {"leaf": ("collide/walks/leaf", "collide/walks/line_walk", "collide/walks/wide_walk"),
             "group": ("collide/walks/group", "collide/walks/eight_below"), "block": ("collide/walks/block",), "bvtt": ("collide/queues/",),
             "front": ("collide/front/",), "front-leaf": ("collide/front/",), "grid": ("collide/grid/",),
             "all-pairs": ("collide/worlds/all_pairs", "collide/worlds/eight"), "sort-sweep": ("collide/worlds/sweep", "collide/worlds/eight")}
# A rule of SKIPS that no device uses unless it is forced: it is no part of other cells.
NEVER_USED = re.compile(r"\{skip_\w+, [^{}]*? never, never\},")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|^\s*#\s*include.*?$", re.DOTALL | re.MULTILINE)


class Work(NamedTuple):
    """Stages that a builder and a collider went through. The collider is empty if there was none."""

    builder: str
    collider: str
    stages: tuple[str, ...]

    def places(self, on_cpu: bool) -> set[str]:
        """Returns the beginnings of the paths of the kernels that were launched. Code from outside and of the host has none."""
        collider = "group" if on_cpu and self.collider == "block" else self.collider  # which `block` is on a processor
        of_collider = {*COLLIDERS[collider], "collide/sinks/", SKIPS} if collider in COLLIDERS else set()
        if collider == "grid":
            return of_collider
        own = next((paths for name, paths in BUILDERS.items() if self.builder.startswith(name)), ())
        stages = {path for stage in self.stages for path in (STAGES | OF_RANKS | OF_FIRST | OF_WITHIN | OF_SEPARATION | OF_SWEPT | OF_FILTERS).get(stage, own if stage in OF_BUILDER else ())}
        return of_collider | (stages - set(own) if self.builder == "oibvh-host" else stages)


def git(*words: str, given: bytes = b"") -> bytes:
    return subprocess.run(["git", "-C", str(ROOT), *words], input=given, capture_output=True, check=True).stdout


def history() -> str:
    """Returns why the history cannot be asked; empty if it can."""
    try:
        return "the clone is shallow" if git("rev-parse", "--is-shallow-repository").strip() == b"true" else ""
    except (OSError, subprocess.CalledProcessError):
        return "there is no git repository"


@functools.cache
def is_in_history(commit: str) -> bool:
    done = subprocess.run(["git", "-C", str(ROOT), "merge-base", "--is-ancestor", commit, "HEAD"], capture_output=True, check=False)
    return done.returncode == 0


def programs(document: dict[str, Any]) -> Iterator[tuple[str, bool]]:
    """Yields commit and dirtiness of each program that made a part of a result file."""
    parts = document.get("merged_from") or [document["run"]["program"]]
    yield from ((part["commit"], part["dirty"]) for part in parts)


def is_of_many(cell: Cell) -> bool:
    """True if pairs of its objects are found in their order (collide/object_order.h), or may be."""
    return cell.collider in COLLIDERS and cell.scene_facts.get("objects", 0) >= MANY_OBJECTS


def narrow_of(cell: Cell) -> str:
    """Returns the entry of STAGES, OF_SWEPT or OF_FILTERS that a cell's stage `narrow` is."""
    method = cell.raw.get("collider", {}).get("options", {}).get("narrow", "")
    if {cell.accuracy.get("method"), method} & set(FILTERS):
        return "narrow of filters"
    if cell.accuracy.get("axis") == "queries":
        return "narrow of queries"
    return "narrow" if not cell.swept else "narrow in doubles" if method.startswith("ccd-f64") else "narrow between frames"


def works(document: dict[str, Any]) -> set[Work]:
    """Returns what the cells of a result file did. `bvhbench stress` launches all kernels but those of several ranks."""
    cells = [Cell(raw) for raw in document["cells"]]
    found = {Work(cell.builder, cell.collider or "", (*(narrow_of(cell) if stage == "narrow" else stage
                                                        for stage in cell.samples[0]), *(("objects",) if is_of_many(cell) else ()),
                                                        *(OF_FIRST if "first_contact" in cell.raw else ()),
                                                        *(OF_WITHIN if "within_distance" in cell.raw else ()),
                                                        *(OF_SEPARATION if "separation" in cell.raw else ())))
             for cell in cells if cell.samples}
    found |= {Work(cell.builder, cell.collider or "", (*OF_FRAME, *(("exchange",) if cell.cluster["ranks_count"] > 1 else ())))
              for cell in cells if cell.cluster and cell.status == "measured"}
    if document.get("stress"):
        found |= {Work(builder, collider, (*STAGES, *OF_BUILDER)) for builder in BUILDERS for collider in COLLIDERS}
    return found


def is_kernel(path: str) -> bool:
    return path.endswith((".cl", ".clh")) or path == SKIPS


def code_of(text: bytes) -> str:
    return " ".join(NEVER_USED.sub(" ", " ".join(COMMENT.sub(" ", text.decode()).split())).split())


@functools.cache
def blobs(commit: str) -> dict[str, str]:
    """Returns the kernel files of a commit: path to the name of the text."""
    entries = (line.split("\t") for line in git("ls-tree", "-r", commit).decode().splitlines())
    return {path: about.split()[2] for about, path in entries if is_kernel(path)}


@functools.cache
def blob_code(name: str) -> str:
    return code_of(git("cat-file", "blob", name))


@functools.cache
def code_now() -> dict[str, str]:
    paths = [path for path in git("ls-files").decode().splitlines() if is_kernel(path)]
    return {path: code_of((ROOT / path).read_bytes()) for path in paths}


@functools.cache
def is_changed(place: str, commit: str, on_cpu: bool) -> bool:
    """True if the kernels of a place have another text than at the commit, under whatever names."""
    def is_there(path: str) -> bool:
        return path.startswith(place) and (place in APART or not path.startswith(APART)) and (on_cpu or "_chunks." not in path)  # of processors alone

    then = sorted(blob_code(name) for path, name in blobs(commit).items() if is_there(path))
    return then != sorted(code for path, code in code_now().items() if is_there(path))


def faults(document: dict[str, Any]) -> list[str]:
    """Returns what is wrong with a result file's origin: nothing if it speaks of the kernels that are there."""
    made = set(programs(document))
    strange = sorted({commit for commit, _ in made if not is_in_history(commit)})
    found = [f"its commit {commit[:8]} is not in the history" for commit in strange]
    found += ["its program had changes that were in no commit"] if any(dirty for _, dirty in made) else []
    on_cpu = document["run"]["device"]["kind"] == "cpu"
    all_places = sorted({place for work in works(document) for place in work.places(on_cpu)})
    commits = sorted({commit for commit, _ in made} - set(strange))
    changed = [place for place in all_places if any(is_changed(place, commit, on_cpu) for commit in commits)]
    return found + ([f"older than {', '.join(changed)}"] if changed else [])


def result_files() -> dict[str, pathlib.Path]:
    """Returns the measurements of results/ by their path below it."""
    folder = ROOT / "results"
    return {str(path.relative_to(folder)): path for path in files_in(folder) if path.name.endswith(".json.xz")}


def main() -> int:
    if why := history():
        print(f"provenance.py: {why}: nothing is known of the commits that result files name", file=sys.stderr)
        return 3
    found = {name: those for name, path in result_files().items() if (those := faults(parsed(path)))}
    print("".join(f"{name}: {'; '.join(those)}\n" for name, those in found.items()), end="")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
