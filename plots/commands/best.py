"""bvhbench best: finds the fastest builder and collider for scenes on a device."""
import argparse
import json
import os
import pathlib
import tempfile
from typing import Any

import answer
import candidates
import child
import command
import documents
import merging
import output
import ranking
import results
import tables
from console import best as page
from json_files import Refused
from output import WrongUsage
from reserved import reserved
from sweeping.planned import Json, Planned, Sweep, settled

NAME = "best"
# The scenes without SCENE: one that collides with itself, a cloth that falls, and many objects.
OWN = ({"scene": "hairball:30000"}, {"scene": "cloth-ball:20000:16", "frames": "12:15"},
       {"scene": "n-body:20000:16", "frames": "8:10", "pairs_of": "between"})
QUESTION = ("adjacent", "narrow", "pairs_of")
OF_SCENE = ("frames", "objects")
RACES = {"frame": "whole", "build": "whole", "query": "query", "memory": "memory"}
UNTIL, LEAST, MOST = 0.05, 5, 12  # quartile range, and samples, of those that nobody beats
USUAL = "soup:70"  # a scene to check names with


def parser() -> command.Parser:
    words = command.Parser(
        "best", "Say which builder and collider is the fastest for scenes of yours, and by how much",
        "Races the builders, orders and colliders that the device has against each other; one that is beaten is not measured "
        "further. Prints them by time, then which to take, and the command that measures it alone. Several scenes are one class: "
        "each has a table, and all together one.",
        [("bvhbench best bunny.obj", "which pipeline for a mesh with itself?"),
         ("bvhbench best my/folder --frames 0:10 --adjacent drop --narrow exact", "for frames of an animation, to contacts"),
         ("bvhbench best a.ply b.ply --for build --builders oibvh-multi,karras,apetrei-fused", "which of these builds, over both?")],
        "docs/measuring.md")
    add = words.add_argument
    add("scenes", nargs="*", metavar="SCENE", help="scenes, data sets, mesh files or folders; none: a small set that is generated")
    add("--for", dest="objective", choices=ranking.OBJECTIVES, default="frame",
        help="frame, query, build or memory: what is to be small")
    for key, what in (("builders", "names of `list builders`"), ("orders", "names of `list orders`"),
                      ("colliders", "names of `list colliders`"), ("boxes", "names of `list formats`")):
        add(f"--{key}", help=f"only these: {what}, with commas between")
    add("--with-libraries", action="store_true", help="on a GPU too: what runs on the host, and Embree and FCL")
    add("--frames", help="a:b, from frame a to before b")
    add("--objects", help="what gets a tree of its own: auto, one, mesh or components")
    add("--pairs-of", help="all, between or within: pairs of all triangles, between objects or within")
    add("--adjacent", help="keep or drop pairs that share a vertex index")
    add("--narrow", help="which pairs intersect: a name of `list narrow`, exact, or none")
    add("--max-samples", type=int, default=MOST, help="samples of those that nobody beats")
    add("--all", action="store_true", help="print every row, and all that was left out")
    add("--out", default="best.json", help="the result file; the figure is beside it")
    return words


def list_of(what: str) -> candidates.List:
    """Returns the names of a list of the program, each with its text."""
    _, printed = child.run(["list", what], is_kept=True)
    return dict((*line.split(maxsplit=1), "")[:2] for line in printed.decode(errors="replace").splitlines())


def scenes_of(arguments: argparse.Namespace) -> list[Json]:
    of_scene = {key: value for key in OF_SCENE if (value := getattr(arguments, key)) is not None}
    if not arguments.scenes:
        if of_scene:
            raise WrongUsage(f"--{next(iter(of_scene))} is about scenes of yours, and none is named")
        return [dict(scene) for scene in OWN]
    if arguments.objective == "build" and of_scene:
        raise WrongUsage(f"--{next(iter(of_scene))} is for pairs, and --for build makes trees only, of the first frame")
    return [{"scene": scene} | of_scene for scene in dict.fromkeys(arguments.scenes)]


def has_several(frames: str | None) -> bool:
    first, colon, end = (frames or "0").partition(":")
    return bool(colon) and not (first.isdecimal() and end.isdecimal() and int(end) == int(first) + 1)


def named(arguments: argparse.Namespace, key: str) -> list[str]:
    text = getattr(arguments, key)
    return list(dict.fromkeys(text.split(","))) if text is not None else []


class Plan:
    """What is measured: the scenes, and the candidates that can be."""

    def __init__(self, arguments: argparse.Namespace, is_cpu: bool) -> None:
        self.objective, self.most = arguments.objective, arguments.max_samples
        self.query = {key: value for key in QUESTION if (value := getattr(arguments, key)) is not None}
        if self.objective == "build" and (self.query or arguments.colliders is not None):
            raise WrongUsage(f"--{next(iter(self.query), 'colliders').replace('_', '-')} is for pairs, and --for build makes trees only")
        self.scenes = scenes_of(arguments)
        self.words = command.common_words(arguments, "--force")
        self.sweep = Sweep(NAME, "Which builder and collider is the fastest?", 1, 0, False, "", [])
        self.files = self.check_scenes()
        self.check_names(arguments)
        several = any(has_several(scene.get("frames")) for scene in self.scenes)
        asked = candidates.Asked(self.objective, is_cpu, arguments.with_libraries, self.query.get("narrow", "none") != "none", several,
                                 *(named(arguments, key) for key in ("builders", "orders", "colliders", "boxes")))
        self.product = candidates.Product(asked, list_of)
        self.cells = self.settled(self.scenes[0], self.product.candidates())
        if all(one.why_not for one in self.cells):
            raise WrongUsage(f"nothing can be measured: {self.cells[0].why_not}" if self.cells else "the product is empty")

    @property
    def possible(self) -> list[Planned]:
        return [one for one in self.cells if not one.why_not]

    def settle(self, experiments: list[Json]) -> list[Json]:
        return child.settled(experiments, self.words)

    def settled(self, scene: Json, pairs: list[tuple[Json | None, Json | None]]) -> list[Planned]:
        """Returns each cell once, as the program describes it, or with the reason why it cannot be."""
        planned = [Planned(self.scene_of(scene), builder and dict(builder), collider and dict(collider),
                           dict(self.query) if collider else {}) for builder, collider in pairs]
        return list({one.cell.identity: one for one in reversed(settled(planned, self.sweep, self.settle))}.values())[::-1]

    def scene_of(self, scene: Json) -> Json:
        return {"scene": scene["scene"]} if self.objective == "build" else dict(scene)

    def check_scenes(self) -> list[str]:
        """Returns the files of the scenes. Raises WrongUsage or Refused."""
        files = []
        for scene in self.scenes:
            collider = None if self.objective == "build" else {"name": "leaf"}
            one = Planned(self.scene_of(scene), {"name": "oibvh-multi"}, collider, dict(self.query) if collider else {})
            answered, = self.settle([self.sweep.experiment([one])])
            if answered.get("error"):
                raise WrongUsage(answered["error"])
            there = [file for file in answered["files"] if file]
            if missing := next((file for file in there if not os.path.exists(file)), ""):
                raise Refused(f"scene '{scene['scene']}': there is no file {missing}")
            files += there
        return files

    def check_names(self, arguments: argparse.Namespace) -> None:
        """Raises WrongUsage for a name that the program does not know."""
        builder, collider = {"name": "oibvh-multi"}, {"name": "leaf"}
        asked = [Planned({"scene": USUAL}, {"name": name}, None, {}) for name in named(arguments, "builders")]
        asked += [Planned({"scene": USUAL}, builder | {"order": name}, None, {}) for name in named(arguments, "orders")]
        asked += [Planned({"scene": USUAL}, builder | {"boxes": name}, None, {}) for name in named(arguments, "boxes")]
        asked += [Planned({"scene": USUAL}, builder, collider | {"name": name}, {}) for name in named(arguments, "colliders")]
        for answered in self.settle([self.sweep.experiment([one]) for one in asked]) if asked else []:
            if answered.get("error"):
                raise WrongUsage(answered["error"])

    def experiment(self) -> Json:
        """Returns the race as an experiment of `run`."""
        described = self.sweep.experiment(self.possible)
        del described["samples"]
        scenes = [scene["scene"] if self.objective == "build" else scene for scene in self.scenes]
        return described | {"scenes": scenes, "race": RACES[self.objective], "until": UNTIL, "min_samples": min(LEAST, self.most),
                            "max_samples": self.most}

    def note(self, all_: bool) -> str:
        """Returns what is measured and what is not, as lines."""
        impossible = len(self.cells) - len(self.possible)
        line = f"{tables.counted(len(self.possible), 'candidate')} for {tables.counted(len(self.scenes), 'scene')}"
        lines = [line + (f"; {impossible} more cannot be" if impossible else "")]
        for why, names in self.product.without.items():
            lines.append(f"    without {', '.join(names)}: {why}" if all_ else "")
        return "\n".join(filter(None, lines)) + "\n"


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    if not 2 <= arguments.max_samples <= 1_000_000:
        raise WrongUsage(f"--max-samples: {arguments.max_samples} is not from 2 to 1000000")
    facts = child.facts(command.common_words(arguments, "--force"))
    plan = Plan(arguments, facts["device"]["kind"] == "cpu")
    picture = pathlib.Path(arguments.out).with_suffix(".png")
    with reserved(arguments.out, "--out", arguments.force, plan.files):
        for path in (picture, picture.with_suffix(".svg")):
            output.check(path, map(pathlib.Path, plan.files), arguments.force, output.is_picture)
        print(plan.note(arguments.all), end="", flush=True)
        code, document = measured(plan, words)
        if document is None:
            return code
        output.write(arguments.out, text_of(document).encode(errors="surrogateescape"))
    run = results.everything(arguments.out)
    found = ranking.ranked(run.all_cells, plan.objective)
    print(page.text(found, arguments.all), end="")
    if found.rows:
        print("".join(f"again, alone: {line}\n" for line in repeated(plan, found)), end="")
    print(f"written: {arguments.out}{drawn(run, found, picture, arguments.force)}", flush=True)
    return code


def measured(plan: Plan, words: list[str]) -> tuple[int, Json | None]:
    """Runs the race. Returns the exit code of its process and the result file, or None if there is none. Exits with the process's
    code if it could not begin."""
    with tempfile.TemporaryDirectory(prefix="bvhbench-") as folder:
        described, file = os.path.join(folder, f"{NAME}.json"), os.path.join(folder, "result.json")
        output.write(described, json.dumps(plan.experiment(), indent=1).encode())
        code, _ = child.run(["run", described, "--out", file, "--quiet", *plan.words])
        if not os.path.exists(file):
            return code, None
        document: dict[str, Any] = documents.read(file)
    document["run"]["command"] = ["bvhbench", NAME, *words]
    document["cells"] += [one.raw | {"status": "skipped", "reason": one.why_not} for one in plan.cells if one.why_not]
    return code, document


def text_of(document: Json) -> str:
    return merging.document_text(document["run"], [documents.line_of(cell) for cell in document["cells"]], [], [], document["format"])


def repeated(plan: Plan, found: ranking.Ranking) -> list[str]:
    """Returns the command lines that measure the best alone, one for each scene."""
    lines = []
    for scene in plan.scenes:
        options = plan.query | {key: value for key, value in plan.scene_of(scene).items() if key != "scene"}
        words = [word for key, value in options.items() for word in ("--" + key.replace("_", "-"), value)]
        lines.append(answer.repeated(found.rows[0], scene["scene"], [*words, *plan.words]))
    return lines


def drawn(run: results.Run, found: ranking.Ranking, picture: pathlib.Path, force: bool) -> str:
    """Draws the figure. Returns its name for the message, or why there is none; the measurement is of use without."""
    if not found.rows:
        return ""
    try:
        import best_bars
        import style

        style.set_up()
        paths = style.save(best_bars.draw(run, found), picture.parent, picture.stem, [pathlib.Path(run.path)], force)
        return f", {paths[0]}"
    except ModuleNotFoundError as error:
        return f"; no figure: there is no module {error.name}"

