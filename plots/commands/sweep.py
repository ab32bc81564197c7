"""bvhbench sweep: measures a product of scenes, builders, colliders and options, one process for each cell; can be resumed."""
import argparse
import contextlib
import json
import os
import subprocess
import sys
from typing import Any

import answer
import child
import command
import documents
import merging
import output
import results
import tables
from cells import Cell
from json_files import Refused, value_of
from output import WrongUsage
from reserved import reserved
from sweeping import processes
from sweeping.folder import Folder, device_words
from sweeping.planned import Json, Sweep
from sweeping.product import swept_of
from sweeping.units import Shard, Unit, shard_called, shards_of, units_of

LISTS = ("scenes", "builders", "orders", "colliders")  # options that take comma-separated values
USUAL_DOUBLES = "recentred"
OPENING_S = 600  # some drivers took a minute to compile two kernels


def parser() -> command.Parser:
    words = command.Parser(
        "sweep", "Measure a product of scenes, sizes, builders, orders, colliders and options, a process a cell; go on where it "
        "was interrupted",
        "Each cell, or scene, has a process of its own, so a crash costs one cell. The same command again goes on where it was "
        "interrupted. The folder has sweep.json, a result file like any other, once cells are there.",
        [("bvhbench sweep --scenes torus --sizes 1000:1000000:x10 --builders oibvh-multi,karras --out out/sizes", "eight cells"),
         ("bvhbench sweep docs/sweep.json --shard 2/8 --out out/part-2", "the second of eight machines"),
         ("bvhbench sweep docs/sweep.json --out out/all --dry-run", "which cells, and how many")], "docs/sweeps.md",
        several_devices=True)
    add = words.add_argument
    add("file", nargs="?", default="", metavar="FILE",
        help="the sweep as JSON (docs/sweeps.md); options take the place of its keys")
    add("--name", dest="sweep", help="the sweep's name: cells' experiment, and the result file's")
    add("--scenes", action="append", help="scenes, data sets or mesh files; {size}, or a generator's bare name, takes each size")
    add("--sizes", help="triangles: 1000,30000 or 1000:1000000:x10 or 1000:5000:+1000")
    add("--builders", action="append", help="names of `list builders`")
    add("--orders", action="append", help="names of `list orders`")
    add("--colliders", action="append", help="names of `list colliders`; without, cells are builds; with, whole frames")
    add("--set", action="append", default=[],
        help="KEY=V1,V2: goes through values of an option: boxes, leaves, items, builder.group_size, narrow, adjacent, jump, "
        "frames and others; may be said again")
    add("--samples", type=int, help="timed runs a cell; default: 20")
    add("--warm-up", type=int, help="runs before them that do not count; default: 3")
    words.add_costs()
    add("--out", required=True, help="the folder of the sweep: the same command goes on with what is there")
    add("--device", action="append",
        help="as for all commands; more than once: processes are dealt to these, which must be alike")
    add("--jobs", type=int, help="processes at a time; default: one for each --device, else 1")
    add("--shard", default="", help="i/n: only the i-th of n parts, for n machines; then merge their files")
    add("--together", choices=("cell", "scene"), default="cell",
        help="cell or scene: what a process measures; of a scene all at once, so that samples of builders are interleaved")
    add("--cell-limit", type=command.number, default=0,
        help="seconds that a process may take in all before it is ended; 0: no end")
    add("--continue-other-commit", action="store_true",
        help="keep cells that another commit has measured, and go on with this one")
    add("--retry-failed", action="store_true", help="measure cells that failed again")
    add("--dry-run", action="store_true", help="print the cells and measure none")
    return words


def described(arguments: argparse.Namespace) -> Json:
    """Returns the sweep's file, with its keys overridden by the command line."""
    description: Any = {}
    if arguments.file:
        try:
            description = value_of(documents.file_text(arguments.file, "the sweep's file"))
        except ValueError as error:
            raise WrongUsage(str(error)) from error
        if not isinstance(description, dict):
            raise WrongUsage("a sweep must be an object")
    for key in LISTS:
        if values := getattr(arguments, key):
            description[key] = [value for words in values for value in words.split(",")]
    for key in ("sweep", "sizes", "samples", "warm_up"):
        if (value := getattr(arguments, key)) is not None:
            description[key] = value
    if arguments.quality:
        description["quality"] = True
    for words in arguments.set:
        key, equals, values = words.partition("=")
        if not equals or not key:
            raise WrongUsage(f"--set is KEY=V1,V2, not '{words}'")
        chosen = description.setdefault("set", {})
        if isinstance(chosen, dict):  # otherwise it is refused with the file
            chosen[key] = values.split(",")
    return description


def planned(arguments: argparse.Namespace) -> Sweep:
    words = command.common_words(arguments, "--device")
    try:
        return swept_of(described(arguments), lambda experiments: child.settled(experiments, words))
    except WrongUsage as wrong:
        raise WrongUsage(f"{arguments.file}: {wrong}" if arguments.file else str(wrong)) from wrong


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    if arguments.jobs is not None and not 1 <= arguments.jobs <= 1024:
        raise WrongUsage(f"--jobs: {arguments.jobs} is not from 1 to 1024")
    shard = shard_called(arguments.shard) if arguments.shard else Shard()
    sweep = planned(arguments)
    settings = f"{arguments.doubles or USUAL_DOUBLES} {float(arguments.sah_inner)} {float(arguments.sah_triangle)}"
    every = units_of(sweep, arguments.together == "scene", settings)
    shards = shards_of(every, shard.of)
    units = [unit for unit, own in zip(every, shards, strict=True) if own == shard.number]
    line = f"{sweep.name}: {sweep.product}: {tables.counted(len(sweep.cells), 'cell')}"
    if none := sum(bool(one.why_not) for one in sweep.cells):
        line += f", {none} of which cannot be"
    if not shard.is_all:
        line += f"; shard {arguments.shard} has {sum(len(unit.cells) for unit in units)}"
    print(line, flush=True)
    if not arguments.dry_run:
        return measured(arguments, words, sweep, every, units, shard)
    print(cells_table(sweep, every, shards, shard), end="")
    return 0


def cells_table(sweep: Sweep, units: list[Unit], shards: list[int], shard: Shard) -> str:
    table = tables.Table("<scene", "triangles", "<what", "shard", "<")
    rows = [(one, "" if shard.is_all else str(own), "") for unit, own in zip(units, shards, strict=True)
            if shard.is_all or own == shard.number for one in unit.cells]
    rows += [(one, "", f"cannot be: {one.why_not}") for one in sweep.cells if one.why_not and shard.number == 1]
    for one, own, why in rows:
        table.row(one.cell.scene, tables.whole(one.triangles or None), one.cell.pipeline, own, why)
    return table.text()


def facts_of(arguments: argparse.Namespace, program: str, device: str | None) -> Json:
    """Returns the facts of a run on the device. Raises Refused."""
    words = ["facts", *command.common_words(arguments, "--device"), *processes.device_words(device)]
    try:
        done = subprocess.run([command.PROGRAM, *words], executable=program, env=child.environment(),
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", check=False,
                              timeout=OPENING_S)
    except subprocess.TimeoutExpired as late:
        raise Refused(f"the process that opens the device took longer than {OPENING_S} s") from late
    if done.returncode:
        sentence = done.stderr.strip().rpartition("bvhbench: ")[2].split("\n")[0]
        raise Refused(sentence or f"the process that opens the device ended with {done.returncode}")
    return json.loads(done.stdout.splitlines()[-1])


def devices_of(arguments: argparse.Namespace) -> list[str | None]:
    """Returns the device of each concurrent process; None leaves the choice to the program."""
    named = arguments.device or [None]
    return [named[place % len(named)] for place in range(arguments.jobs or len(named))]


def facts_of_all(arguments: argparse.Namespace, program: str, devices: list[str | None]) -> Json:
    """Returns the facts of the first device. Raises WrongUsage if another device differs."""
    known = {device: facts_of(arguments, program, device) for device in dict.fromkeys(devices)}
    first = known[devices[0]]
    for other in known.values():
        if (one := device_words(first["run"])) != (another := device_words(other["run"])):
            raise WrongUsage(f"the devices of a sweep must be alike, and these are {one} and {another}; sweep each by itself, "
                             "and merge --other-devices")
    return first


def measured(arguments: argparse.Namespace, words: list[str], sweep: Sweep, every: list[Unit], units: list[Unit],
             shard: Shard) -> int:
    costs = (arguments.sah_inner, arguments.sah_triangle)
    cost_words = [] if costs == results.USUAL_COSTS else ["--sah-inner", str(costs[0]), "--sah-triangle", str(costs[1])]
    with contextlib.ExitStack() as held:
        program, devices = held.enter_context(processes.kept_program()), devices_of(arguments)
        about = facts_of_all(arguments, program, devices)
        facts = about["run"] | {"command": ["bvhbench", "sweep", *words], "node_costs": {"inner": costs[0], "triangle": costs[1]}}
        task = processes.Task(devices, program, [*cost_words, *command.common_words(arguments, "--device", "--force")],
                              arguments.cell_limit, arguments.retry_failed,
                              lambda device: facts_of(arguments, program, device), facts)
        folder = Folder(arguments.out, sweep, arguments.together == "scene", every, shard, facts, about["format"],
                        arguments.continue_other_commit, held)
        inputs = [arguments.file] * bool(arguments.file) + sorted({file for one in sweep.cells for file in one.files})
        held.enter_context(reserved(str(folder.result_file), "--out", arguments.force, inputs,
                                    lambda text: is_of_sweep(text, sweep.name)))
        if len(devices) > 1 and (facts["device"]["kind"] == "cpu" or len(set(devices)) < len(devices)):
            print("note: processes share a device, and disturb each other's times", flush=True)
        if folder.note:
            print(folder.note, flush=True)
        stop = processes.Stop()
        with command.signals_to(stop.remember):
            try:
                processes.Runner(units, folder, task, stop).run()
            except (Refused, OSError):
                written(sweep, units, shard, folder, facts)  # keeps finished cells before the error is reported
                raise
            cells = written(sweep, units, shard, folder, facts)
    if stop.number:
        output.say("bvhbench: stopped; finished cells are kept")
        sys.stdout.flush()
        os._exit(128 + stop.number)
    return code_of(cells)


def is_of_sweep(text: bytes, name: str) -> bool:
    """True if the text is a result file of this sweep, written earlier."""
    try:
        return all(cell["experiment"] == name for cell in documents.document_of(text, "the result file")["cells"])
    except Refused:
        return False


def written(sweep: Sweep, units: list[Unit], shard: Shard, folder: Folder, facts: Json) -> list[Cell]:
    """Merges all finished units into one file, whose run is the sweep's. Returns its cells."""
    there = [folder.done(unit) for unit in units]
    run = facts | ({"finished_at": processes.now()} if all(there) else {})
    skipped = [one.raw | {"status": "skipped", "reason": one.why_not} for one in sweep.cells if one.why_not and shard.number == 1]
    own = {"format": folder.format, "run": run, "cells": skipped}
    parts = [("the sweep", own), *((str(path), document) for path, document in filter(None, there))]
    merged = merging.merge(parts, other_commits=True)
    output.write(folder.result_file, merged.text.encode(errors="surrogateescape"))
    cells = [Cell(raw) for raw in value_of(merged.text.encode(errors="replace"))["cells"]]
    count = {status: sum(cell.status == status for cell in cells) for status in ("measured", "skipped", "failed")}
    print(f"{tables.counted(len(cells), 'cell')}: " + ", ".join(f"{number:,} {status}" for status, number in count.items()))
    print(f"{answer.of_cells(cells)}{answer.warning_lines(cells)}written: {folder.result_file}", flush=True)
    return cells


def code_of(cells: list[Cell]) -> int:
    if cells and all(cell.status != "measured" for cell in cells):
        output.say(f"bvhbench: nothing was measured: {cells[0].reason}"
                   + (f" (the first of {len(cells)} cells)" if len(cells) > 1 else ""))
        return 4
    return 1 if any(cell.verdict == "differs" for cell in cells) else 0
