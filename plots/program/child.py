"""Runs the measuring program as a child process. It reports on standard error and ends when this process ends it."""
import contextlib
import functools
import json
import os
import subprocess
from collections.abc import Callable, Iterator
from typing import IO, Any

from ..files.json_files import Refused
from . import command


def started(words: list[str], **streams: int | IO[bytes] | None) -> subprocess.Popen[bytes]:
    """Starts the program. Raises Refused if it cannot be started.

    The child has its own process group, so a terminal's Ctrl-C reaches it only once, forwarded by this process. A second signal
    would end it before it has saved its results."""
    try:
        ends_with_us = {**os.environ, "BVHBENCH_PARENT": str(os.getpid())}  # for any reason
        return subprocess.Popen([command.PROGRAM, *words], env=ends_with_us, process_group=0, **streams)
    except OSError as error:
        raise Refused(f"the program {command.PROGRAM} cannot be run: {error.strerror}") from error


def code_of(child: subprocess.Popen) -> int:
    """Waits for a child and returns its exit code: 128 + signal number if a signal ended it."""
    code = child.wait()
    return code if code >= 0 else 128 - code


def run(words: list[str], is_kept: bool = False, given: bytes | None = None, errors: IO[bytes] | None = None) -> tuple[int, bytes]:
    """Runs the program. Returns its exit code (128 + signal number if a signal ended it) and, with `is_kept`, its standard
    output. `given` is its standard input, and `errors` takes its standard error. Signals that end this process are forwarded, so
    the child saves what it has."""
    with handed_on() as add:
        child = started(words, stdin=subprocess.DEVNULL if given is None else subprocess.PIPE,
                        stdout=subprocess.PIPE if is_kept else subprocess.DEVNULL, stderr=errors)
        add(child)
        printed, _ = child.communicate(given)
    return code_of(child), printed or b""


def run_shown(several: list[list[str]]) -> int:
    """Runs the program once for each list of words, at the same time; what they print is shown. Returns the largest exit code."""
    with handed_on() as add:
        children = []
        for words in several:
            children.append(started(words, stdin=subprocess.DEVNULL))
            add(children[-1])
        return max(map(code_of, children))


@contextlib.contextmanager
def handed_on() -> Iterator[Callable[[subprocess.Popen], None]]:
    """Yields a function that registers a child. Signals that end this process, even earlier ones, are forwarded to it."""
    children: list[subprocess.Popen] = []
    early: list[int] = []

    def hand_on(number: int, _frame: Any) -> None:
        early.extend([] if children else [number])
        for child in children:
            child.send_signal(number)

    def add(child: subprocess.Popen) -> None:
        children.append(child)
        for number in early:
            child.send_signal(number)

    with command.signals_to(hand_on):
        yield add


def answer(words: list[str], given: bytes | None = None) -> Any:
    """Returns the program's standard output parsed as JSON. Exits with the child's code if it fails; the child has said why."""
    code, printed = run(words, is_kept=True, given=given)
    if code != 0:
        raise SystemExit(code)
    return json.loads(printed)


def facts(words: list[str]) -> dict[str, Any]:
    """Returns the facts of a run that would start now, as in result files: device, host and program."""
    return answer(["facts", *words])["run"]


@functools.cache
def builders_of_any_order() -> frozenset[str]:
    """Returns the builders that order leaves as --order says, from the program's catalog."""
    return frozenset(name for name, order, _ in answer(["list", "builders", "--json"]) if order == "any order")


def expanded(experiments: list[dict[str, Any]], words: list[str]) -> list[dict[str, Any]]:
    """Returns the program's description of each experiment: its cells, triangles and files, or an error."""
    return answer(["expand", *words], json.dumps(experiments).encode())
