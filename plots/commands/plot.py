"""bvhbench plot: draws every figure that result files have the cells for."""
import argparse
import contextlib
import pathlib

from ..files import json_files, output
from ..program import command


def parser() -> command.Parser:
    words = command.Parser(
        "plot", "Draw every figure that result files have the cells for",
        "Finds out which figures the cells of a file can make. PNG and SVG; equal numbers give equal bytes.",
        [("bvhbench plot out/sizes/sweep.json", "beside where you are"),
         ("bvhbench plot results --out pictures", "of every file below a folder")], "docs/sweeps.md")
    words.add_argument("files", nargs="+", metavar="FILE", help="result files, or folders of them")
    words.add_argument("--out", default="out", help="the folder for pictures")
    words.add_argument("--only", help=argparse.SUPPRESS)  # for `reproduce`: one figure, by its name in catalog.NAMED
    return words


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    from ..figures import catalog  # imported here, so that help does not need matplotlib

    if arguments.only not in (None, *catalog.NAMED):
        raise output.WrongUsage(f"--only: no figure is called '{arguments.only}'; there are: {', '.join(catalog.NAMED)}")
    folder, files = pathlib.Path(arguments.out), [pathlib.Path(file) for file in arguments.files]
    is_new = not folder.exists()
    output.make_folder(folder)
    output.check_pictures(folder, files, arguments.force)
    if refusals := catalog.draw_all(files, folder, arguments.force, arguments.only):
        if is_new:  # nothing was drawn: nothing is left
            with contextlib.suppress(OSError):
                folder.rmdir()
        raise json_files.Refused("; ".join(refusals))
    print(f"drawn into {arguments.out}")
    return 0
