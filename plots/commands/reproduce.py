"""bvhbench reproduce: measures, prints and draws the paper's tables and figures."""
import argparse
import contextlib
import functools
import os
import pathlib
import subprocess
import sys
from collections.abc import Callable

from ..console import claims, frame_table, paper, run as run_page, tree_costs
from ..files import output
from ..files.json_files import Refused
from ..files.reserved import reserved
from ..program import child, command
from ..read import results

PLOTS = pathlib.Path(__file__).resolve().parents[1]
PAGE_SCENE = ("--scene", "cloth-funnel:2000:4", "--frame", "3")  # small, and with contacts
CANNOT, NOTHING = 3, 4  # exit codes: something required is missing; nothing was measured

FRAMES = {name: functools.partial(frame_table.text, printed=name) for name in ("table2", "table3")}

# For each table or figure of the paper: the experiment that measures it, and the function that prints it.
SHOWN: dict[str, tuple[str, Callable[[results.Run], str]]] = {
    "table1": ("table1", paper.table1),
    "fig8": ("fig8", paper.fig8),
    "table2": ("table2", FRAMES["table2"]),
    "fig9": ("table2", FRAMES["table2"]),
    "fig10": ("table2", FRAMES["table2"]),
    "table3": ("table3", FRAMES["table3"]),
    "table4": ("table4", tree_costs.table4),
    "fig13": ("fig13", tree_costs.fig13),
}


def parser() -> command.Parser:
    words = command.Parser(
        "reproduce", "Measure, print and draw what the paper shows",
        "Writes result file and figure into --out, and prints our numbers beside the paper's. `all` goes through all of them, "
        "prints which claims they confirm, and makes report.html, one page of everything. Meshes that are not there are replaced by "
        "generated ones of as many triangles; table, figure and file say so.",
        [("bvhbench reproduce table1", "construction times, out/table1.json and pictures"),
         ("bvhbench reproduce all --quick", "every table and figure, small, and out/report.html"),
         ("bvhbench reproduce fig8 --device nvidia --data meshes", "on a GPU, with real meshes")], "docs/paper.md")
    words.add_argument("what", metavar="WHAT", help="table1 to table4, fig8, fig9, fig10, fig13; or all, and a page of all")
    words.add_argument("--out", default="out", help="folder for result files, figures and the page")
    words.add_argument("--quick", action="store_true", help="fewer scenes and samples")
    words.add_costs()
    return words


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    if arguments.what not in (*SHOWN, "all"):
        raise output.WrongUsage(f"WHAT: there is no '{arguments.what}'; there are: {', '.join(SHOWN)}, all")
    is_all = arguments.what == "all"
    # A run is named after its experiment if several figures share it, otherwise after the requested figure.
    runs = {experiment: [name for name, (other, _) in SHOWN.items() if other == experiment]
            for experiment, _ in SHOWN.values()} if is_all else {arguments.what: [arguments.what]}
    child.facts(command.common_words(arguments))  # exits if there is no such device, before a folder is created
    folder = pathlib.Path(arguments.out)
    output.make_folder(folder)
    output.check_pictures(folder, [], arguments.force)
    report_file = os.path.join(arguments.out, "report.html")
    files = {name: os.path.join(arguments.out, f"{name}.json") for name in runs}
    with contextlib.ExitStack() as kept:
        if is_all:
            kept.enter_context(reserved(report_file, "--out", arguments.force, may_replace=output.is_page))
        for file in files.values():  # checks all files before anything is measured
            with reserved(file, "--out", arguments.force):
                pass
        codes = [reproduced(arguments, files[name], shown) for name, shown in runs.items()]
    if is_all:
        print(claims.text({name: results.everything(file) for name, file in files.items()}), end="", flush=True)
    worst = max((code for code in codes if code != NOTHING), default=NOTHING)  # among the runs that measured something
    if worst == NOTHING or not is_all:
        return worst
    return page(arguments, list(files.values()), report_file) or worst


def reproduced(arguments: argparse.Namespace, file: str, shown: list[str]) -> int:
    """Runs the experiment, prints its table and draws its figures. Exits with the program's code if it was stopped."""
    experiment, table = SHOWN[shown[0]]
    words = ["run", experiment, "--out", file, "--quiet", "--sah-inner", str(arguments.sah_inner),
             "--sah-triangle", str(arguments.sah_triangle)]
    words += ["--quick"] * arguments.quick + ["--epo"] * arguments.quality
    code, printed = child.run([*words, *command.common_words(arguments)], is_kept=True)
    if code not in (0, 1, NOTHING):
        raise SystemExit(code)
    run = results.everything(file)
    print(run_page.text(run) + table(run) + printed.decode(errors="surrogateescape"), end="", flush=True)
    if code != NOTHING:
        for name in shown:
            draw(name, file, arguments)
    return code


def draw(name: str, file: str, arguments: argparse.Namespace) -> None:
    """Draws a figure in a process of its own, which says what it drew, or why not. A failed drawing does not invalidate the measurement."""
    words = ["plot", file, "--only", name, "--out", arguments.out, *["--force"] * arguments.force]
    with child.handed_on() as add:
        drawing = subprocess.Popen([sys.executable, str(PLOTS), *words])
        add(drawing)
        code = child.code_of(drawing)
    if code - 128 in command.ENDING:
        raise SystemExit(code)
    if code != 0:
        print(f"nothing was drawn; where Python and matplotlib are, draw it with: bvhbench {' '.join(words)}", flush=True)


def page(arguments: argparse.Namespace, files: list[str], out: str) -> int:
    """Makes the page of all results. On failure only prints how to make it elsewhere, because the results exist."""
    try:
        from . import report  # needs matplotlib

        return report.main([*files, "-o", out, *PAGE_SCENE, *command.common_words(arguments)])
    except ModuleNotFoundError as error:
        why = f"{sys.executable} has no module {error.name}"
    except Refused as refusal:
        why = str(refusal)
    except SystemExit as end:
        if end.code != CANNOT:
            raise
        why = "its scene cannot be shown"
    print(f"no page was made: {why}; elsewhere: bvhbench report {arguments.out}/*.json -o {out}")
    return 0
