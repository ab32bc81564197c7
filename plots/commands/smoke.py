"""bvhbench smoke: runs every builder and collider over small scenes and compares the results with a baseline."""
import argparse
import contextlib
import os
import pathlib
import tempfile

from ..comparing import baseline, baseline_changes
from ..console import cells as cells_page, run as run_page
from ..files import output
from ..files.json_files import Refused
from ..files.output import WrongUsage
from ..files.reserved import is_input, is_replaced, reserved
from ..program import child, command
from ..read import results

TOLERANCE = (1, 1e12)


def parser() -> command.Parser:
    words = command.Parser(
        "smoke", "Run every builder and collider over small scenes and compare all with a baseline; 1 if it differs",
        "Every builder and collider, under a minute on two cores. 1 and a line for whatever is not as the baseline says.",
        [("bvhbench smoke", "is all as before?"),
         ("bvhbench smoke --update", "a change was meant: the baseline goes along in the commit")], "docs/ci.md")
    words.add_argument("--baseline", default="", help="the baseline; default: results/baseline/smoke-<device kind>.json")
    words.add_argument("--update", action="store_true", help="write the baseline instead of comparing with it")
    words.add_argument("--filter", default="", help="only cells whose scene/builder this matches")
    words.add_argument("--out", help="write the result file")
    words.add_argument("--tolerance", type=command.number, default=5,
                       help="by how much a time beside the others of its scene may be longer, as a ratio")
    return words


def checked(words: list[str]) -> argparse.Namespace:
    """Parses the command line. Uses no tuning file by default, so that the comparison does not depend on tuned devices."""
    arguments = parser().parse_args(words)
    if not TOLERANCE[0] <= arguments.tolerance <= TOLERANCE[1]:
        raise WrongUsage(f"--tolerance must be a ratio from {TOLERANCE[0]:g} to {TOLERANCE[1]:g}, not {arguments.tolerance:g}")
    if arguments.update and arguments.filter:
        raise WrongUsage("--update writes the whole baseline, so --filter is not for it")
    if arguments.update and (arguments.plugin or arguments.program or os.environ.get("BVHBENCH_PLUGINS")):
        raise WrongUsage("--update writes a baseline of this program's own builders and colliders, without any from outside")
    if arguments.tuning is None:
        arguments.tuning = ""
    return arguments


def main(words: list[str]) -> int:
    arguments = checked(words)
    facts = child.facts(command.common_words(arguments))
    for hook in facts.get("test_hooks", {}) if arguments.update else ():
        raise WrongUsage(f"--update: {hook} is set, which changes times for tests")
    kind = facts["device"]["kind"]
    path = arguments.baseline or str(results.FOLDER / "baseline" / f"smoke-{kind}.json")
    if arguments.update:
        with reserved(path, "--baseline", arguments.force, may_replace=baseline.is_baseline):
            return update(arguments, path, kind)
    before = baseline.read(path, kind)  # fails before the minute of measuring
    run, code = measured(arguments, path)
    found = baseline_changes.compare(before, baseline.of_run(run), arguments.tolerance, bool(arguments.filter))
    print(baseline_changes.report(found, arguments.tolerance), end="")
    return 1 if found.regressions else code


def update(arguments: argparse.Namespace, path: str, kind: str) -> int:
    """Writes a baseline. Raises Refused if a cell failed or is wrong."""
    run, _ = measured(arguments, path)
    for cell in run.all_cells:
        if cell.verdict in ("failed", "differs"):
            raise Refused(f"--update: {cell.builder} on {cell.scene_facts['name']} is {cell.verdict}: "
                          "no baseline is made of that")
    output.write(path, baseline.text_of(kind, baseline.of_run(run)).encode())
    print(f"written: {path}")
    return 0


def measured(arguments: argparse.Namespace, kept_from: str) -> tuple[results.Run, int]:
    """Runs the experiment. Returns its result file and the child's exit code: 0, 1 if a check differs, or 4 if nothing was
    measured. Exits with the child's code if it wrote no file; the child has reported why."""
    out = arguments.out
    if out and os.path.exists(out) and is_input(out, kept_from):
        raise WrongUsage(f"--out: {out} is read by this command; it is not replaced, choose another file")
    with contextlib.ExitStack() as stack:
        is_kept = out and is_replaced(out)
        file = out if is_kept else f"{stack.enter_context(tempfile.TemporaryDirectory(prefix='bvhbench-'))}/smoke.json"
        earlier = identity(file)
        filter_ = ["--filter", arguments.filter] if arguments.filter else []
        code, _ = child.run(["run", "smoke", "--out", file, *filter_, *command.common_words(arguments)])
        if code not in (0, 1, 4) or identity(file) == earlier:
            raise SystemExit(code)
        run = results.everything(file)
        if out and file != out:
            output.write(out, pathlib.Path(file).read_bytes())
    print(run_page.text(run), cells_page.text(run, only_wrong=True), sep="", end="")
    return run, code


def identity(file: str) -> tuple[int, int] | None:
    """Returns the inode and time of the file that has this name now. They change when the file is replaced."""
    with contextlib.suppress(OSError):
        about = os.stat(file)
        return about.st_ino, about.st_mtime_ns
    return None
