"""What `best` measures: its scenes, and the candidates that can be, each as the program describes it."""
import argparse
import os

from ..files.json_files import Refused
from ..files.output import WrongUsage
from ..program import child, command
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
UNTIL, LEAST, MOST = 0.05, 5, 12  # quartile range, and samples, of those that nobody beats
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
            option = next(iter(self.query), "colliders").replace("_", "-")
            raise WrongUsage(f"--{option} is for pairs, and --for build makes trees only")
        if arguments.features and self.query.get("pairs_of", "all") == "all":
            raise WrongUsage("--features has two questions: choose by --pairs-of between, of vertices and faces, or within, of edges")
        self.scenes = scenes_of(arguments)
        self.words = command.common_words(arguments, "--force")
        self.sweep = Sweep(NAME, "Which builder and collider is the fastest?", 1, 0, False, "", [])
        self.files = self.check_scenes()
        self.check_names(arguments)
        several = any(has_several(scene.get("frames")) for scene in self.scenes)
        has_narrow = self.query.get("narrow", "none") != "none"
        asked = candidates.Asked(self.objective, is_cpu, arguments.with_libraries, has_narrow, several,
                                 *(named(arguments, key) for key in ("builders", "orders", "colliders", "boxes")))
        self.product = candidates.Product(asked, lambda what: list_of(what, self.words))
        self.cells = self.expanded(self.scenes[0], self.product.candidates())
        if all(one.why_not for one in self.cells):
            raise WrongUsage(f"nothing can be measured: {self.cells[0].why_not}" if self.cells else "the product is empty")

    @property
    def possible(self) -> list[Planned]:
        return [one for one in self.cells if not one.why_not]

    def expand(self, experiments: list[Json]) -> list[Json]:
        return child.expanded(experiments, self.words)

    def expanded(self, scene: Json, pairs: list[tuple[Json | None, Json | None]]) -> list[Planned]:
        """Returns each cell once, as the program describes it, or with the reason why it cannot be."""
        planned = [Planned(self.scene_of(scene), builder and dict(builder), collider and dict(collider),
                           {"trees": "auto"} | self.query if collider else {}) for builder, collider in pairs]
        return list({one.cell.identity: one for one in reversed(expanded(planned, self.sweep, self.expand))}.values())[::-1]

    def scene_of(self, scene: Json) -> Json:
        return {"scene": scene["scene"]} if self.objective == "build" else dict(scene)

    def check_scenes(self) -> list[str]:
        """Returns the files of the scenes. Raises WrongUsage or Refused."""
        files = []
        for scene in self.scenes:
            collider = None if self.objective == "build" else {"name": "leaf"}
            one = Planned(self.scene_of(scene), {"name": "oibvh-multi"}, collider, dict(self.query) if collider else {})
            answered, = self.expand([self.sweep.experiment([one])])
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
        for answered in self.expand([self.sweep.experiment([one]) for one in asked]) if asked else []:
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
