"""The files of a sweep, from which it can be resumed:

    plan.json            its units, programs and device
    experiments/ID.json  the experiment that the process of a unit runs
    cells/ID.json        the result file of a unit, complete or unfinished
    NAME.json            all results merged; NAME-IofN.json for a shard

The ID of a unit is a hash of what is measured, by which program and on which device.
"""
import contextlib
import hashlib
import json
import pathlib
from typing import Any

import command
import documents
import file_lock
import output
import results
import tables
from json_files import Refused, value_of
from output import WrongUsage
from sweeping.planned import Sweep, hash_of
from sweeping.units import Shard, Unit

PLAN_FORMAT = 2  # format 1 named cells differently
PATIENCE_S = 5  # longer than a shard holds the plan's lock, and than a killed process takes to end


def program_words(facts: dict[str, Any]) -> str:
    """Returns words that identify the program. With uncommitted changes they include a hash of its file."""
    program = facts["program"]
    words = f"commit {program['commit'][:10]}"
    if results.is_dirty(program):
        words += f" with changes ({hashlib.sha256(pathlib.Path(command.PROGRAM).read_bytes()).hexdigest()[:16]})"
    kernels = "" if program["kernels"] == "embedded" else f", kernels of {program['kernels']}"
    return f"{words}, {program['version']} {program['build_type']} {program['compiler']} {program['arch']}{kernels}"


def device_words(facts: dict[str, Any]) -> str:
    """Returns words that identify the device, with its tuned values."""
    device = facts["device"]
    tuned = "".join(f", {name}={value}" for name, value in sorted(facts["tuning"]["values"].items()))
    return f"{device['platform']}/{device['name']}, driver {device['driver']}{tuned}"


def finished(path: pathlib.Path) -> dict[str, Any] | None:
    """Returns a unit's result file if its run has finished, otherwise None. Raises Refused if it is not a result file."""
    if not path.exists():
        return None
    document = documents.read(str(path))
    return document if "finished_at" in document["run"] and document["cells"] else None


class Folder:
    """The folder of a sweep, locked by one sweep or by several shards until `locks` are closed."""

    def __init__(self, folder: str, sweep: Sweep, together: bool, units: list[Unit], shard: Shard, facts: dict[str, Any],
                 format_: str, keeps_other_commit: bool, locks: contextlib.ExitStack) -> None:
        self.path, self.format = pathlib.Path(folder), format_
        self.device, self.programs = device_words(facts), [program_words(facts)]
        self.note = ""  # message about cells of an earlier program, which are kept
        part = f"{shard.number}of{shard.of}"
        self.result_file = self.path / (f"{sweep.name}.json" if shard.is_all else f"{sweep.name}-{part}.json")
        output.make_folder(self.path)
        subject = f"the sweep in {folder}"
        kind = file_lock.EXCLUSIVE if shard.is_all else file_lock.SHARED
        locks.enter_context(file_lock.locked(str(self.path / "lock"), kind, subject, PATIENCE_S))
        # Only one process at a time reads and writes the plan.
        with file_lock.locked(str(self.path / "lock-plan"), file_lock.EXCLUSIVE, subject, PATIENCE_S):
            if not shard.is_all:
                locks.enter_context(file_lock.locked(str(self.path / f"lock-{part}"), file_lock.EXCLUSIVE, subject, PATIENCE_S))
            if (self.path / "plan.json").exists():
                self.check_plan(plan_in(self.path / "plan.json"), units, keeps_other_commit)
            elif self.result_file.exists():
                raise WrongUsage(f"{self.result_file} is there and no sweep's: choose another --out or --name")
            for inside in ("cells", "experiments"):
                output.make_folder(self.path / inside)
            plan = {"format": PLAN_FORMAT, "sweep": sweep.name, "product": sweep.product, "device": self.device,
                    "programs": self.programs, "units": [unit.what for unit in units],
                    "together": "scene" if together else "cell"}
            output.write(self.path / "plan.json", (json.dumps(plan, indent=1) + "\n").encode())
        if shard.is_all:
            for name in ("plan.json", self.result_file.name, "cells/*.json", "experiments/*.json"):
                for left in self.path.glob(f"{name}.tmp*"):  # by processes that were killed while writing
                    left.unlink(missing_ok=True)

    def check_plan(self, plan: dict[str, Any], units: list[Unit], keeps_other_commit: bool) -> None:
        missing = set(plan["units"]) - {unit.what for unit in units}
        if missing:
            raise WrongUsage(f"{self.path} holds another sweep, '{plan['sweep']}' of {plan['product']}: {len(missing)} of the "
                             f"{tables.counted(len(plan['units']), 'cell')} that it measures are none of these; choose "
                             "another --out")
        if plan["device"] != self.device:
            raise WrongUsage(f"{self.path} holds a sweep on {plan['device']}, and this is {self.device}; choose another --out, "
                             "and merge --other-devices")
        notes = []
        for program in plan["programs"]:
            if program == self.programs[0]:
                continue
            there = [document for unit in units if (document := finished(self.cell_file(unit, program)))]
            if not there:
                continue
            by = f"{tables.counted(len(there), 'cell')} by {program}"
            if not keeps_other_commit:
                raise WrongUsage(f"{self.path} holds {by}, and this program is of {self.programs[0]}; --continue-other-commit "
                                 "keeps them and goes on, or choose another --out")
            if other := {document["format"] for document in there} - {self.format}:
                raise WrongUsage(f"{self.path} holds {by} in format {max(other)}, and this program writes {self.format}, which "
                                 "are not merged; choose another --out")
            self.programs.append(program)
            notes.append(f"kept: {by}; the others are measured by {self.programs[0]}")
        self.note = "\n".join(notes)

    def cell_file(self, unit: Unit, program: str = "") -> pathlib.Path:
        return self.path / "cells" / f"{hash_of(unit.what, program or self.programs[0], self.device)}.json"

    def experiment_file(self, unit: Unit) -> pathlib.Path:
        return self.path / "experiments" / self.cell_file(unit).name

    def done(self, unit: Unit) -> tuple[pathlib.Path, dict[str, Any]] | None:
        """Returns the result file of a finished unit, whichever program measured it, or None."""
        for program in self.programs:
            path = self.cell_file(unit, program)
            if document := finished(path):
                return path, document
        return None

    def begin(self, unit: Unit) -> None:
        """Removes an unfinished result of the unit and writes its experiment."""
        self.cell_file(unit).unlink(missing_ok=True)
        output.write(self.experiment_file(unit), (json.dumps(unit.experiment, indent=1) + "\n").encode())


def plan_in(path: pathlib.Path) -> dict[str, Any]:
    try:
        plan = value_of(documents.file_text(str(path), "the plan"))
        if plan["format"] != PLAN_FORMAT:
            age = "an older" if plan["format"] < PLAN_FORMAT else "a newer"
            raise Refused(f"{path} is of {age} program, which named cells in another way; choose another --out")
        for key, kind in (("sweep", str), ("product", str), ("device", str), ("programs", list), ("units", list)):
            if not isinstance(plan[key], kind) or (kind is list and not all(isinstance(item, str) for item in plan[key])):
                raise ValueError(f"its '{key}' is none")
        return plan
    except (ValueError, KeyError, TypeError) as error:
        raise Refused(f"{path} is no plan of a sweep: {output.described(error)}") from error
