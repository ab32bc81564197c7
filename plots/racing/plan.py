"""What `best` measures: its scenes, and the candidates that can be, each as the program describes it."""
import argparse
import re

from ..files.output import WrongUsage
from ..program import child, command
from ..read.ranking import FEWEST_OF_BEST
from ..sweeping.planned import Json, Planned, Sweep, expanded
from ..words import tables
from . import candidates

NAME = "best"
# The scenes without SCENE: one that collides with itself, a cloth that falls, and many objects.
OWN = ({"scene": "hairball:30000"}, {"scene": "cloth-ball:20000:16", "frames": "12:15"},
       {"scene": "n-body:20000:16", "frames": "8:10", "pairs_of": "between"})
QUESTION = ("adjacent", "narrow", "pairs_of", "within")
OF_SCENE = ("frames", "objects", "features")
RACES = {"frame": "whole", "build": "whole", "query": "query", "memory": "memory"}
UNTIL, LEAST, MOST = 0.05, FEWEST_OF_BEST, 12  # quartile range, and samples, of those that nobody beats
USUAL = "soup:70"  # a scene to check names with


def list_of(what: str, words: list[str]) -> candidates.List:
    """Returns the names of a list of the program, each with its text. `words` are the common options."""
    _, printed = child.run(["list", what, *words], is_kept=True)
    return dict((*line.split(maxsplit=1), "")[:2] for line in printed.decode(errors="replace").splitlines())


def scenes_of(arguments: argparse.Namespace) -> list[Json]:
    of_scene = {key: value for key in OF_SCENE if (value := getattr(arguments, key)) is not None}
    if not arguments.scenes:
        if of_scene:
            raise WrongUsage(f"--{next(iter(of_scene))} is about scenes of yours, and none is named")
        return [{"scene": scene["scene"]} if arguments.objective == "build" else dict(scene) for scene in OWN]
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
            option = next(iter(self.query), "colliders").replace("_", "-")
            raise WrongUsage(f"--{option} is for pairs, and --for build makes trees only")
        if arguments.features and self.query.get("pairs_of", "all") == "all":
            raise WrongUsage("--features has two questions: choose by --pairs-of between, of vertices and faces, or within, of edges")
        self.scenes, self.words, self.notes = scenes_of(arguments), command.common_words(arguments, "--force"), []
        self.sweep = Sweep(NAME, "Which builder and collider is the fastest?", 1, 0, False, "", [])
        self.check_names(arguments)
        self.files = self.read_scenes(bool(arguments.scenes))
        asked = candidates.Asked(self.objective, is_cpu, arguments.with_libraries, self.query.get("narrow", "none") != "none",
                                 any(has_several(scene.get("frames")) for scene in self.scenes),
                                 *(named(arguments, key) for key in ("builders", "orders", "colliders", "boxes")))
        self.product = candidates.Product(asked, lambda what: list_of(what, self.words))
        self.cells = self.expanded(self.scenes[0], self.product.candidates())
        if all(one.why_not for one in self.cells):
            raise WrongUsage(f"nothing can be measured: {self.cells[0].why_not}" if self.cells else "the product is empty")

    @property
    def possible(self) -> list[Planned]:
        return [one for one in self.cells if not one.why_not]

    def known(self, asked: list[Planned]) -> list[Json]:
        """Returns the program's description of each. Raises WrongUsage for the first that it refuses."""
        answers = child.expanded([self.sweep.experiment([one]) for one in asked], self.words) if asked else []
        if error := next((answered["error"] for answered in answers if answered.get("error")), ""):
            raise WrongUsage(error)
        return answers

    def expanded(self, scene: Json, pairs: list[tuple[Json | None, Json | None]]) -> list[Planned]:
        """Returns each cell once, as the program describes it, or with the reason why it cannot be."""
        planned = [Planned(dict(scene), builder and dict(builder), collider and dict(collider),
                           {"trees": "auto"} | self.query if collider else {}) for builder, collider in pairs]
        known = expanded(planned, self.sweep, lambda experiments: child.expanded(experiments, self.words))
        return list({one.cell.identity: one for one in reversed(known)}.values())[::-1]

    def read_scenes(self, are_named: bool) -> list[str]:
        """Returns the files of the scenes. Reads those that are named as `bvhbench scene` does, which finds what is wrong with their files;
        takes all frames of what moves unless some are named; and notes what the question leaves open. Raises WrongUsage, or ends with
        the code of `bvhbench scene`."""
        collider = None if self.objective == "build" else {"name": "leaf"}
        files = self.known([Planned(dict(scene), {"name": "oibvh-multi"}, collider, dict(self.query) if collider else {})
                            for scene in self.scenes])
        single = []
        for scene in self.scenes if are_named else ():
            code, printed = child.run(["scene", scene["scene"], *self.words], is_kept=True)
            if code:
                raise SystemExit(code)
            frames, objects = (int((re.search(rb"^%s +(\d+)" % what, printed, re.MULTILINE) or [0, 1])[1]) for what in (b"frames", b"objects"))
            single += [scene["scene"]] * (objects == 1)
            if frames > 1 and collider and "frames" not in scene:
                scene["frames"] = "0:"
            if frames > 1 and scene.get("frames", "0:") == "0:":
                what = f"all {frames} frames; --frames a:b takes those from a to before b" if collider else f"frame 0 of {frames}"
                self.notes.append(f"{scene['scene']}: {what}")
        if collider and "features" not in self.scenes[0] and self.query.get("pairs_of") != "between":
            is_kept = self.query.get("adjacent", "keep") == "keep"
            line = f"pairs of neighbours, which share a vertex index, are {'kept: --adjacent drop leaves them out' if is_kept else 'dropped'}"
            self.notes.append(line + f", which suits one object that meets itself ({', '.join(single)})" * (is_kept and len(single) > 0))
        return [file for answered in files for file in answered["files"] if file]

    def check_names(self, arguments: argparse.Namespace) -> None:
        """Raises WrongUsage for a name that the program does not know."""
        keys = {"builders": "name", "orders": "order", "boxes": "boxes"}
        self.known([Planned({"scene": USUAL}, {"name": "oibvh-multi", key: name}, None, {}) for what, key in keys.items() for name in named(arguments, what)]
                   + [Planned({"scene": USUAL}, {"name": "oibvh-multi"}, {"name": name}, {}) for name in named(arguments, "colliders")])

    def experiment(self) -> Json:
        """Returns the race as an experiment of `run`."""
        described = self.sweep.experiment(self.possible)
        del described["samples"]
        scenes = [scene["scene"] if self.objective == "build" else scene for scene in self.scenes]
        return described | {"scenes": scenes, "race": RACES[self.objective], "until": UNTIL, "min_samples": LEAST, "max_samples": self.most}

    def note(self, all_: bool) -> str:
        """Returns what is measured and what is not, as lines."""
        impossible = len(self.cells) - len(self.possible)
        line = f"{tables.counted(len(self.possible), 'candidate')} for {tables.counted(len(self.scenes), 'scene')}"
        lines = [*self.notes, line + (f"; {impossible} more cannot be" if impossible else "")]
        lines += [f"    without {', '.join(names)}: {why}" for why, names in self.product.without.items()] if all_ else []
        return "".join(f"{line}\n" for line in lines)
