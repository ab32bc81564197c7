"""Figures of result files.

    python3 plots/figures FILE_OR_FOLDER... --out DIR [--only FIGURE]

A folder stands for all result files below it; their pictures go into folders of the same names below DIR. Files of a folder that
no figure is made of are passed over. A file without cells of an experiment with a figure of its own gets bars of medians
(overview.py). Exits 0; 2 for wrong usage; 3 if a file cannot be read or drawn.
"""
import argparse
import pathlib
import sys

sys.path[0] = str(pathlib.Path(__file__).resolve().parents[2])  # where the package is, in place of this folder

from plots.figures import catalog  # noqa: E402
from plots.files import output  # noqa: E402


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("given", nargs="+", type=pathlib.Path, metavar="FILE_OR_FOLDER")
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR", default=pathlib.Path("."), help="where pictures go (default: here)")
    parser.add_argument("--only", choices=catalog.NAMED, metavar="FIGURE", help=f"one of {', '.join(catalog.NAMED)}")
    parser.add_argument("--force", action="store_true", help="replace files of the pictures' names that are no pictures")
    arguments = parser.parse_args()

    def draw() -> int:
        refusals = catalog.draw_all(arguments.given, arguments.out, arguments.force, arguments.only)
        for refusal in refusals:
            output.say(refusal)
        return 3 if refusals else 0

    return output.to_an_end(draw)


if __name__ == "__main__":
    sys.exit(main())
