"""The program that measures, run as a child: it says on standard error what it does, and ends when this process is told to."""
import contextlib
import json
import os
import signal
import subprocess
from collections.abc import Iterator
from typing import Any

import command
from json_files import Refused

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def run(words: list[str], is_kept: bool = False, given: bytes | None = None) -> tuple[int, bytes]:
    """The child's exit code, 128 and more for a signal, and what it printed on standard output if that is kept. `given` is its
    standard input. Signals that end this process are handed on, so that the child keeps what it has; then its code is 128 and
    the signal.

    The child is in a group of its own: a terminal's Ctrl-C reaches it once, through this process. A second one would end it
    before it has kept anything."""
    environment = {**os.environ, "BVHBENCH_PARENT": str(os.getpid())}  # however this process ends, the child ends with it
    with handed_on() as children:
        try:
            child = subprocess.Popen([command.PROGRAM, *words], env=environment, process_group=0,
                                     stdin=subprocess.DEVNULL if given is None else subprocess.PIPE,
                                     stdout=subprocess.PIPE if is_kept else subprocess.DEVNULL)
        except OSError as error:
            raise Refused(f"the program {command.PROGRAM} cannot be run: {error.strerror}") from error
        children(child)
        printed, _ = child.communicate(given)
    return (child.returncode if child.returncode >= 0 else 128 - child.returncode), printed or b""


@contextlib.contextmanager
def handed_on() -> Iterator[Any]:
    """Gives a function that says which child gets the signals that end this process, those from before it was there too."""
    children: list[subprocess.Popen[bytes]] = []
    early: list[int] = []

    def hand_on(number: int, _frame: Any) -> None:
        for child in children:
            child.send_signal(number)
        if not children:
            early.append(number)

    def add(child: subprocess.Popen[bytes]) -> None:
        children.append(child)
        for number in early:
            child.send_signal(number)

    before = {number: signal.getsignal(number) for number in ENDING}
    for number, handler in before.items():
        if handler != signal.SIG_IGN:  # as under nohup
            signal.signal(number, hand_on)
    try:
        yield add
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def facts(words: list[str]) -> dict[str, Any]:
    """Facts of a run that would begin now, as in result files: its device, host and program. Ends this process as the child
    ended, which has said why, if there is none."""
    code, printed = run(["facts", *words], is_kept=True)
    if code != 0:
        raise SystemExit(code)
    return json.loads(printed)["run"]


def settled(experiments: list[dict[str, Any]], words: list[str]) -> list[dict[str, Any]]:
    """What the program says of each experiment: its cells, triangles and files, or an error. Ends this process as the child
    ended if it could not say."""
    code, printed = run(["settle", *words], is_kept=True, given=json.dumps(experiments).encode())
    if code != 0:
        raise SystemExit(code)
    return json.loads(printed)
