"""bvhbench best: finds the fastest builder and collider for scenes on a device."""
import json
import os
import pathlib
import tempfile

from ..console import best_table as page
from ..console import run as circumstances
from ..files import documents, output
from ..files.output import WrongUsage
from ..files.reserved import is_replaced, reserved
from ..program import child, command
from ..racing import alone
from ..racing.plan import MOST, NAME, Plan
from ..read import merging, ranking, results
from ..sweeping.planned import Json


def parser() -> command.Parser:
    words = command.Parser(
        "best", "Say which builder and collider is the fastest for scenes of yours, and by how much",
        "Races the builders, orders and colliders that the device has against each other; one that is beaten is not measured "
        "further. Prints them by time, then which to take, and the command that measures it alone, which it runs. Several scenes "
        "are one class: each has a table, and all together one.",
        [("bvhbench best bunny.obj", "which pipeline for a mesh with itself?"),
         ("bvhbench best my/folder --frames 0:10 --adjacent drop --narrow exact", "for frames of an animation, to contacts"),
         ("bvhbench best a.ply b.ply --for build --builders oibvh-multi,karras,apetrei-fused", "which of these builds, over both?")],
        "docs/races.md")
    add = words.add_argument
    add("scenes", nargs="*", metavar="SCENE", help="scenes, data sets, mesh files or folders; none: a small set that is generated")
    add("--for", dest="objective", choices=ranking.OBJECTIVES, default="frame",
        help="frame, query, build or memory: what is to be small")
    for key, what in (("builders", "names of `list builders`"), ("orders", "names of `list orders`"),
                      ("colliders", "names of `list colliders`"), ("boxes", "names of `list formats`")):
        add(f"--{key}", help=f"only these: {what}, with commas between")
    add("--with-libraries", action="store_true", help="on a GPU too: what runs on the host, and Embree and FCL")
    add("--frames", help="a:b, from frame a to before b; all, if it is not given")
    add("--objects", help="what gets a tree of its own: auto, one, mesh or components")
    add("--pairs-of", help="all, between or within: pairs of all triangles, between objects or within")
    add("--adjacent", help="keep or drop pairs that share a vertex index")
    add("--narrow", help="which pairs intersect: a name of `list narrow`, exact, or none")
    add("--within", help="pairs of triangles at most this far apart, as of `collide`")
    add("--features", action="store_const", const="true", help="the same of vertices and faces, or edges: --pairs-of between or within")
    add("--max-samples", type=int, default=MOST, help="samples of those that nobody beats")
    add("--all", action="store_true", help="print every row, and all that was left out")
    add("--out", default="best.json", help="the result file; the figure is beside it")
    return words


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    if not ranking.FEWEST_OF_BEST <= arguments.max_samples <= 1_000_000:
        raise WrongUsage(f"--max-samples: {arguments.max_samples} is not from {ranking.FEWEST_OF_BEST} to 1000000")
    plan = Plan(arguments, child.facts(command.common_words(arguments, "--force"))["device"]["kind"] == "cpu")
    picture = picture_of(arguments.out)
    with reserved(arguments.out, "--out", arguments.force, plan.files):
        for path in (picture, picture.with_suffix(".svg")) if picture else ():
            output.check(path, map(pathlib.Path, plan.files), arguments.force, output.is_picture)
        print(plan.note(arguments.all), end="", flush=True)
        code, document = measured(plan, words)
        if document is None:
            return code
        text = merging.document_text(document["run"], list(map(documents.line_of, document["cells"])), [], [], document["format"])
        output.write(arguments.out, text.encode(errors="surrogateescape"))
    run = results.Run(pathlib.Path(arguments.out), document)
    found = ranking.ranked(run.all_cells, plan.objective)
    print(page.text(found, arguments.all), circumstances.warnings(run), circumstances.untuned(run), sep="", end="", flush=True)
    figure = drawn(run, found, picture, arguments.force) if picture and found.rows else ""
    print(f"written: {arguments.out}{figure}", flush=True)
    for line in alone.lines(plan, found, run) if code == 0 else ():
        print(line, flush=True)
    return code


def picture_of(out: str) -> pathlib.Path | None:
    """Returns the path of the figure, or None if the result goes to a device or pipe."""
    path = pathlib.Path(out).with_suffix(".png")
    if path == pathlib.Path(out):
        raise WrongUsage(f"--out: {out} is the name of the figure; name a .json file")
    return path if is_replaced(out) else None


def measured(plan: Plan, words: list[str]) -> tuple[int, Json | None]:
    """Runs the race. Returns the exit code of its process and the result file, or None if there is none. Exits with the process's
    code if it could not begin."""
    with tempfile.TemporaryDirectory(prefix="bvhbench-") as folder:
        described, file = os.path.join(folder, f"{NAME}.json"), os.path.join(folder, "result.json")
        output.write(described, json.dumps(plan.experiment(), indent=1).encode())
        code, _ = child.run(["run", described, "--out", file, "--quiet", *plan.words])
        if not os.path.exists(file):
            return code, None
        document = documents.read(file)
    document["run"]["command"] = ["bvhbench", NAME, *words]
    document["cells"] += [one.raw | {"status": "skipped", "reason": one.why_not} for one in plan.cells if one.why_not]
    return code, document


def drawn(run: results.Run, found: ranking.Ranking, picture: pathlib.Path, force: bool) -> str:
    """Draws the figure. Returns its name for the message, or why there is none; the measurement is of use without."""
    try:
        from ..draw import style
        from ..figures import best_bars

        style.set_up()
        paths = style.save(best_bars.draw(run, found), picture.parent, picture.stem, [pathlib.Path(run.path)], force)
        return f", {paths[0]}"
    except ModuleNotFoundError as error:
        return f"; no figure: there is no module {error.name}"

