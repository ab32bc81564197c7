"""The program that measures, run as a child: it says on standard error what it does, and ends when this process is told to."""
import contextlib
import json
import os
import subprocess
from collections.abc import Callable, Iterator
from typing import Any

import command
from json_files import Refused


def environment() -> dict[str, str]:
    """The environment of a child that ends with this process, however that ends."""
    return {**os.environ, "BVHBENCH_PARENT": str(os.getpid())}


def started(words: list[str], program: str | None = None, **streams: int) -> subprocess.Popen[bytes]:
    """The program, in its file `program` if that has another name. Raises Refused if it cannot be run.

    It is in a group of its own: a terminal's Ctrl-C reaches it once, through this process. A second one would end it before it
    has kept anything."""
    try:
        return subprocess.Popen([command.PROGRAM, *words], executable=program, env=environment(), process_group=0, **streams)
    except OSError as error:
        raise Refused(f"the program {command.PROGRAM} cannot be run: {error.strerror}") from error


def run(words: list[str], is_kept: bool = False, given: bytes | None = None) -> tuple[int, bytes]:
    """The child's exit code, 128 and more for a signal, and what it printed on standard output if that is kept. `given` is its
    standard input. Signals that end this process are handed on, so that the child keeps what it has; then its code is 128 and
    the signal."""
    with handed_on() as add:
        child = started(words, stdin=subprocess.DEVNULL if given is None else subprocess.PIPE,
                        stdout=subprocess.PIPE if is_kept else subprocess.DEVNULL)
        add(child)
        printed, _ = child.communicate(given)
    return (child.returncode if child.returncode >= 0 else 128 - child.returncode), printed or b""


@contextlib.contextmanager
def handed_on() -> Iterator[Callable[[subprocess.Popen], None]]:
    """Gives a function that says which child gets the signals that end this process, those from before it was there too."""
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
    """What the program says as JSON. Ends this process as the child ended, which has said why, if it could not say."""
    code, printed = run(words, is_kept=True, given=given)
    if code != 0:
        raise SystemExit(code)
    return json.loads(printed)


def facts(words: list[str]) -> dict[str, Any]:
    """Facts of a run that would begin now, as in result files: its device, host and program."""
    return answer(["facts", *words])["run"]


def settled(experiments: list[dict[str, Any]], words: list[str]) -> list[dict[str, Any]]:
    """What the program says of each experiment: its cells, triangles and files, or an error."""
    return answer(["settle", *words], json.dumps(experiments).encode())
