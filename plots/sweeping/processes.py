"""Runs one process for each unit of a sweep, several at a time. A crash costs one unit."""
import collections
import contextlib
import datetime
import os
import select
import subprocess
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import child
import command
import documents
import merging
import output
import tables
import terminal
from cells import Cell
from json_files import Refused
from sweeping.folder import Folder, finished
from sweeping.units import TimeLeft, Unit, rough

LOOK_S = 0.1  # interval at which signals and time limits are checked
PATIENCE_S = 5  # time for processes to end after a request
MOST_ERRORS = 1 << 16  # bytes kept of a process's standard error


class Stop:
    """Remembers the signal (0: none) that asked this process to end, so that finished cells are assembled first."""

    number = 0

    def remember(self, number: int, _frame: Any) -> None:
        if self.number:  # the second signal ends this process and its children at once
            os._exit(128 + number)
        self.number = number


@contextlib.contextmanager
def kept_program() -> Iterator[str]:
    """Yields a path of this program's file that stays valid until the end, even if the file is replaced."""
    try:
        file = open(command.PROGRAM, "rb")
    except OSError as error:
        raise Refused(f"the program {command.PROGRAM} cannot be run: {error.strerror}") from error
    with file:
        yield f"/proc/{os.getpid()}/fd/{file.fileno()}"


@dataclass(frozen=True)
class Task:
    devices: list[str | None]  # of each concurrent process; None: the program's choice
    program: str  # path of its file
    words: list[str]  # options of all processes
    cell_limit_s: float  # 0: no limit
    retry_failed: bool
    facts: Callable[[str | None], dict[str, Any]]  # of a device; raises Refused if it is gone
    run: dict[str, Any]  # facts of the sweep's run


class Process:
    def __init__(self, unit: Unit, folder: Folder, task: Task, device: str | None) -> None:
        folder.begin(unit)
        self.unit, self.device, self.file = unit, device, folder.cell_file(unit)
        self.began, self.given_up, self.said = time.monotonic(), "", b""
        words = ["run", str(folder.experiment_file(unit)), "--out", str(self.file), "--quiet", *task.words, *device_words(device)]
        self.child = child.started(words, task.program, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE)
        assert self.child.stderr
        self.errors = self.child.stderr.fileno()

    @property
    def seconds(self) -> float:
        return time.monotonic() - self.began

    def take(self) -> bool:
        """Reads the available standard error and keeps its end. True if the process has ended."""
        piece = os.read(self.errors, MOST_ERRORS)
        self.said = (self.said + piece)[-MOST_ERRORS:]
        if not piece:
            self.child.wait()
            self.child.stderr.close()
        return not piece

    def end_if_late(self, limit_s: float) -> None:
        if limit_s and self.seconds > limit_s and not self.given_up:
            limit = tables.exact(limit_s)
            self.given_up = f"its process took longer than {limit} s and was ended; --cell-limit gives a cell more"
            self.child.kill()

    def sentence(self) -> str:
        """Returns the last line in the program's format for errors. A driver may print other lines before and after it."""
        said = [line for line in self.said.decode(errors="replace").splitlines() if line.startswith("bvhbench: ")]
        return said[-1].removeprefix("bvhbench: ") if said else ""


def readable(files: list[int]) -> set[int]:
    """Returns the files with something to read or at their end, after at most LOOK_S."""
    waiting = select.poll()
    for file in files:
        waiting.register(file, select.POLLIN)
    return {file for file, _ in waiting.poll(1000 * LOOK_S)}


def device_words(device: str | None) -> list[str]:
    return [] if device is None else ["--device", device]


@dataclass(frozen=True)
class Loss:
    why: str
    is_skipped: bool = False
    may_be_the_device: bool = False
    was_stopped: bool = False


def loss_of(process: Process) -> Loss:
    code, sentence = process.child.returncode, process.sentence()
    if process.given_up:
        return Loss(process.given_up)
    if code < 0 and -code not in command.ENDING:
        return Loss(f"its process crashed (signal {-code})" + (f": {sentence}" if sentence else ""), may_be_the_device=True)
    was_stopped = (-code if code < 0 else code - 128) in command.ENDING
    ended = f"ended with exit code {code}" if code >= 0 else f"crashed (signal {-code})"
    why = sentence if sentence and not was_stopped else f"its process {ended} and left no result"
    return Loss(why, code == 2, code == 3, was_stopped)


class Runner:
    """Runs the units that are not done, until `stop` has a signal."""

    def __init__(self, units: list[Unit], folder: Folder, task: Task, stop: Stop) -> None:
        self.folder, self.task, self.stop, self.total, self.done = folder, task, stop, len(units), 0
        self.left, self.line = TimeLeft(), terminal.MovingLine()
        self.waiting = collections.deque(unit for unit in units if not self.is_done(unit))
        self.slots: list[Process | None] = [None] * len(task.devices)

    def is_done(self, unit: Unit) -> bool:
        there = self.folder.done(unit)
        if there is None or (self.task.retry_failed and any(cell["status"] == "failed" for cell in there[1]["cells"])):
            return False
        self.count(unit, there[1], max(0.5, seconds_of(there[1]["run"])))  # files have whole seconds
        return True

    def count(self, unit: Unit, document: dict[str, Any], seconds: float) -> None:
        """Counts a finished unit. Only measured cells are used to estimate the remaining time."""
        self.done += 1
        if document["cells"][0]["status"] == "measured":
            self.left.add(unit.kind, unit.triangles, seconds)

    def run(self) -> None:
        """Runs all units. Raises Refused if the device is gone."""
        try:
            while not self.stop.number and (self.waiting or any(self.slots)):
                for place, slot in enumerate(self.slots):
                    if slot is None and self.waiting:
                        self.slots[place] = Process(self.waiting.popleft(), self.folder, self.task, self.task.devices[place])
                self.show_progress()
                ready = readable([slot.errors for slot in self.slots if slot])
                for place, slot in enumerate(self.slots):
                    if slot is None:
                        continue
                    slot.end_if_late(self.task.cell_limit_s)
                    if slot.errors in ready and slot.take():
                        self.slots[place] = None
                        self.conclude(slot)
        finally:
            self.line.clear()
            self.end_all()

    def conclude(self, process: Process) -> None:
        unit = process.unit
        if finished(process.file) is None:
            if process.file.exists():  # its partial results are kept under another name
                process.file.rename(process.file.with_suffix(".part"))
            loss = loss_of(process)
            if loss.was_stopped and self.was_interrupted():
                return
            if loss.may_be_the_device and not self.has_device(process.device, loss.why):
                return
            self.record_loss(unit, loss)
        document = finished(process.file)
        if document is None:
            raise Refused(f"{process.file} is gone")
        self.count(unit, document, process.seconds)
        self.tell(unit, document, process.seconds)

    def was_interrupted(self) -> bool:
        """True if this process gets a signal too, since Ctrl-C may reach the child first."""
        until = time.monotonic() + 1
        while not self.stop.number and time.monotonic() < until:
            time.sleep(LOOK_S)
        return bool(self.stop.number)

    def has_device(self, device: str | None, why: str) -> bool:
        """Raises Refused if the device is gone, since all remaining cells would fail. False if a signal ended the check."""
        try:
            self.task.facts(device)
            return True
        except Refused as refusal:
            if self.stop.number:
                return False
            raise Refused(f"the device is gone after {self.done} of {self.total} cells ({why}; {refusal}); they are kept, and "
                          "the same command goes on") from refusal

    def record_loss(self, unit: Unit, loss: Loss) -> None:
        run = {**self.task.run, "finished_at": now()}
        end = {"status": "skipped" if loss.is_skipped else "failed", "reason": loss.why}
        lines = [documents.line_of(one.raw | end) for one in unit.cells]
        output.write(self.folder.cell_file(unit), merging.document_text(run, lines, [], [], self.folder.format).encode())

    def tell(self, unit: Unit, document: dict[str, Any], seconds: float) -> None:
        cell = Cell(document["cells"][0])
        what = f"{cell.verdict}: {cell.reason}" if cell.reason else cell.verdict
        if len(document["cells"]) > 1:
            what = f"{len(document['cells'])} results"
        line = f"[{self.done}/{self.total}] {unit.label}: {what}, {seconds:.1f} s"
        if self.done < self.total and self.left.all:
            line += f"; about {rough(self.seconds_left())} left"
        self.line.clear()
        print(line, flush=True)  # so that logs can be followed

    def show_progress(self) -> None:
        running = ", ".join(slot.unit.label for slot in self.slots if slot)
        left = f"; about {rough(self.seconds_left())} left" if self.left.all else ""
        self.line.show(output.printable(f"[{self.done}/{self.total}]{left}: {running}").replace("\n", " "))

    def seconds_left(self) -> float:
        def takes(unit: Unit) -> float:
            return self.left.seconds_of(unit.kind, unit.triangles)

        seconds = sum(takes(unit) for unit in self.waiting)
        seconds += sum(max(0.0, takes(slot.unit) - slot.seconds) for slot in self.slots if slot)
        return seconds / len(self.slots)

    def end_all(self) -> None:
        """Asks all processes to end, so that drivers can clean up, then kills the rest. Their cells will be measured again."""
        running = [slot.child for slot in self.slots if slot]
        for one in running:
            one.terminate()
        until = time.monotonic() + PATIENCE_S
        for one in running:
            try:
                one.communicate(timeout=max(0.0, until - time.monotonic()))
            except subprocess.TimeoutExpired:
                one.kill()
                one.wait()


def now() -> str:
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")


def seconds_of(run: dict[str, Any]) -> float:
    began, ended = (datetime.datetime.strptime(run[key], "%Y-%m-%dT%H:%M:%SZ") for key in ("started_at", "finished_at"))
    return (ended - began).total_seconds()
