"""bvhbench report: makes one page of result files and of small 3D scenes."""
import argparse
import pathlib
import tempfile

from ..files import output
from ..files.json_files import Refused
from ..files.reserved import reserved
from ..page import history, report
from ..program import child, command
from ..read import input_files

BUILDER = ("order", "leaves", "boxes")  # options of the builder


def parser() -> command.Parser:
    words = command.Parser(
        "report", "Make one page of result files, and of small scenes in three dimensions",
        "The page needs no network and no server: tables to sort and filter, charts, and behind each number its samples. "
        "1 if an answer in a file was wrong, which the page shows.",
        [("bvhbench report peers.json -o report.html", "one file"),
         ("bvhbench report a.json b.json --scene torus:3000 -o report.html", "two, and a scene in three dimensions")],
        "docs/report.md")
    words.add_argument("files", nargs="*", metavar="FILE", help="result files, or folders of them")
    words.add_argument("-o", "--out", default="report.html", help="the page")
    words.add_argument("--history", action="store_true", help="files of several commits: each cell over them, and what changed where; "
                       "1 if an answer at the newest commit was wrong")
    words.add_argument("--scene", action="append", default=[],
                       help="small scenes to show: their triangles, the boxes of each level of a tree, and what collides")
    words.add_argument("--frame", type=int, default=0, help="of those scenes, from 0")
    words.add_argument("--builder", default="oibvh-multi", help="whose tree: a name of `list builders`")
    words.add_argument("--order", help="a name of `list orders`")
    words.add_argument("--leaves", help="mesh or sorted: where leaf boxes are kept; default: mesh, and sorted for boxes other than f32")
    words.add_argument("--boxes", help="what nodes keep their boxes in: a name of `list formats`")
    words.add_argument("--collider", default="leaf", help="what finds the pairs: a name of `list colliders`")
    words.add_argument("--view", action="append", default=[], type=pathlib.Path, help=argparse.SUPPRESS)  # a scene's file, for tests
    return words


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    if not (arguments.files or arguments.scene or arguments.view):
        raise output.WrongUsage("name result files, or a --scene to show")
    if arguments.history and (arguments.scene or arguments.view or not arguments.files):
        raise output.WrongUsage("--history is of result files alone: name files or folders, and no --scene")
    options = {key: getattr(arguments, key) for key in BUILDER if getattr(arguments, key) is not None}
    files = [pathlib.Path(file.path) for file in input_files.files_of(arguments.files)]
    inputs = [*map(str, files + arguments.view), *(scene_files(arguments, options) if arguments.scene else [])]
    with reserved(arguments.out, "--out", arguments.force, inputs, output.is_page), \
            tempfile.TemporaryDirectory(prefix="bvhbench-") as folder:
        views = [view(arguments, scene, options, pathlib.Path(folder, str(number)))
                 for number, scene in enumerate(arguments.scene)]
        made = history.make(files) if arguments.history else report.make(files, arguments.view + views)
        return report.write(*made, pathlib.Path(arguments.out))


def scene_files(arguments: argparse.Namespace, options: dict[str, str]) -> list[str]:
    """Returns the files that the scenes are read from. Raises WrongUsage for wrong arguments, before any file is opened."""
    experiments = [{"experiment": "view", "scenes": [scene],
                    "pipelines": [{"builder": {"name": arguments.builder, **options}, "collider": arguments.collider,
                                   "adjacent": "drop", "narrow": "exact"}]} for scene in arguments.scene]
    files: list[str] = []
    for answer in child.expanded(experiments, command.common_words(arguments)):
        if "error" in answer:
            raise output.WrongUsage(answer["error"])
        files += answer.get("files", [])
    return files


def view(arguments: argparse.Namespace, scene: str, options: dict[str, str], file: pathlib.Path) -> pathlib.Path:
    """Writes the program's description of the scene to `file`. Exits with the program's code if it fails."""
    said = {"scene": scene, "frame": str(arguments.frame), "builder": arguments.builder, "collider": arguments.collider, **options}
    words = ["view", *(word for key, value in said.items() for word in (f"--{key}", value))]
    code, text = child.run([*words, *command.common_words(arguments)], is_kept=True)
    if code != 0:
        raise SystemExit(code)
    if not text.startswith(b"{"):
        raise Refused(f"the scene {scene} cannot be shown: a driver has printed something else")
    file.write_bytes(text)
    return file
