"""Command lines of the commands that read result files: parsing, help pages and exit codes."""
import argparse
import contextlib
import difflib
import math
import os
import re
import signal
import sys
import textwrap
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

from ..files import host_memory, output
from ..words import terminal

WIDTH, COLUMN = 100, 30  # of a help page: its width, and the column where descriptions begin
PROGRAM = os.environ.get("BVHBENCH_PROGRAM", "bvhbench")  # the measuring program
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
SEE = "Options that all commands have, exit codes and environment: bvhbench --help"

# Options of the whole program. They may come before or after the command, and are passed on to measuring processes.
COMMON = ("--device", "--kernels", "--data", "--doubles", "--clock", "--tuning", "--memory-limit", "--time-limit")
COMMON_LISTS = ("--plugin", "--program")  # may be given several times
COMMON_FLAGS = ("--force", "--verbose", "--weld", "--wide")


class Parser(argparse.ArgumentParser):
    """An argument parser. `more` holds sentences that the help prints after the options; `examples` holds command lines, each
    with its effect. A command that takes several devices adds --device itself."""

    def __init__(self, command: str, description: str, more: str, examples: Sequence[tuple[str, str]], see: str,
                 several_devices: bool = False) -> None:
        super().__init__(prog=f"bvhbench {command}", description=description, allow_abbrev=False, add_help=False)
        self.more, self.examples, self.see = more, examples, see
        self._negative_number_matcher = re.compile(r"-\.?\d")  # -1% is a value too; its type refuses it
        self.add_argument("-h", "--help", action="help", help="Print this help message and exit")
        for option in COMMON:
            if option != "--device" or not several_devices:
                self.add_argument(option, help=argparse.SUPPRESS)
        for option in COMMON_LISTS:
            self.add_argument(option, action="append", default=[], help=argparse.SUPPRESS)
        for flag in COMMON_FLAGS:
            self.add_argument(flag, action="store_true", help=argparse.SUPPRESS)

    def parse_args(self, words: Sequence[str], namespace: None = None) -> argparse.Namespace:
        self.words = words
        arguments = super().parse_args(words, namespace)
        if arguments.memory_limit is not None:
            try:
                host_memory.limit = host_memory.bytes_of(arguments.memory_limit)
            except ValueError as error:
                self.error(f"--memory-limit: {error}")
        terminal.set_up(arguments.wide)
        if getattr(arguments, "out", None) == "":
            raise output.WrongUsage("--out names no file or folder")
        if getattr(arguments, "sah_inner", 1) == getattr(arguments, "sah_triangle", 1) == 0:
            raise output.WrongUsage("--sah-inner and --sah-triangle must not both be 0")
        return arguments

    def add_costs(self) -> None:
        self.add_argument("--epo", "--quality", dest="quality", action="store_true",
                          help="compute end-point overlap, which takes long")
        self.add_argument("--sah-inner", type=cost, default=1.2, help="what visiting an inner node costs")
        self.add_argument("--sah-triangle", type=cost, default=1, help="what testing a triangle costs")

    def error(self, message: str) -> NoReturn:
        """Raises WrongUsage, in the wording of the program's other commands."""
        message = re.sub(r"^the following arguments are required: (.*)", r"\1 is required", message.removeprefix("argument "))
        for word in self.words:
            if word.startswith("--") and (name := word.partition("=")[0]) not in self._option_string_actions:
                meant = difflib.get_close_matches(name, self._option_string_actions, 1)
                raise output.WrongUsage(f"there is no option {name}; "
                                        + (f"did you mean {meant[0]}?" if meant else f"`{self.prog} --help` lists them"))
        message = message.replace("unrecognized arguments:", "The following argument was not expected:")
        raise output.WrongUsage(f"{message}; `{self.prog.replace(' ', ' help ')}` says what it takes")

    def format_help(self) -> str:
        shown = [action for action in self._actions if action.help is not argparse.SUPPRESS]
        positionals = [action for action in shown if not action.option_strings]
        words = [self.prog, "[OPTIONS]", *(positional_usage(action) for action in positionals)]
        parts = [f"{wrapped(self.description)}\n\nUsage: {' '.join(words)}\n"]
        for title, actions in (("Positionals", positionals), ("Options", [action for action in shown if action.option_strings])):
            if actions:
                parts.append(f"{title}:\n{''.join(entry(action) for action in actions)}")
        parts.append(f"{wrapped(self.more)}\n")
        parts.append("Examples:\n" + "".join(f"  {line}\n      {wrapped(what, 6)}\n" for line, what in self.examples))
        return "\n".join(parts) + f"\n{SEE}\nMore: {self.see}\n"


def wrapped(text: str, margin: int = 0) -> str:
    """Wraps text to the page width. All lines but the first are indented by `margin`."""
    return textwrap.fill(text, WIDTH - margin, break_long_words=False, break_on_hyphens=False).replace("\n", "\n" + " " * margin)


def positional_usage(action: argparse.Action) -> str:
    name = f"{action.metavar}{'...' if action.nargs in ('*', '+') else ''}"
    return f"[{name}]" if action.nargs in ("?", "*") else name


def entry(action: argparse.Action) -> str:
    """Returns the help of one option: its name, the kind of its value, and its description from COLUMN on."""
    name = "  " + (",".join(action.option_strings) or action.metavar)
    if action.nargs != 0:
        name += " COUNT" if action.type is int else " NUMBER" if isinstance(action.type, Number) else " WORD"
        if action.default not in (None, [], "", argparse.SUPPRESS):
            name += f"={action.default}"
        if action.nargs in ("*", "+") or isinstance(action, argparse._AppendAction):
            name += " ..."
        if action.required and action.nargs not in ("?", "*"):
            name += ", required"
    if len(name) + 2 > COLUMN:
        name += "\n" + " " * COLUMN
    return f"{name:{COLUMN}}{wrapped(action.help, COLUMN)}\n"


@dataclass(frozen=True)
class Number:
    """A number from 0 to `most`. For a share, 5% is parsed as 0.05."""

    most: float
    what: str
    is_share: bool = False

    def __call__(self, text: str) -> float:
        is_percent = self.is_share and text.endswith("%")
        try:
            value = float(text.removesuffix("%") if is_percent else text) / (100 if is_percent else 1)
        except ValueError:
            value = math.nan
        if not 0 <= value <= self.most:
            raise argparse.ArgumentTypeError(f"must be {self.what}, not '{text}'")
        return value


number = Number(sys.float_info.max, "a number from 0 on")
cost = Number(1000000, "a number from 0 to 1000000")  # of a visit; the program accepts no larger cost


def share(most: float) -> Number:
    return Number(most, f"a share from 0 to {100 * most:.0f}%, as 5% or 0.05", is_share=True)


def common_words(arguments: argparse.Namespace, *without: str) -> list[str]:
    """Returns the common options that were given, as words for a measuring process."""
    words = []
    for option in COMMON:
        value = getattr(arguments, option[2:].replace("-", "_"))
        if value is not None and option not in without:
            words += [option, value]
    for option in COMMON_LISTS:
        if option not in without:
            words += [word for value in getattr(arguments, option[2:]) for word in (option, value)]
    return words + [flag for flag in COMMON_FLAGS if getattr(arguments, flag[2:]) and flag not in without]


class Ended(BaseException):
    """Raised when a signal asks this process to end."""


def end(number: int, _frame: Any) -> NoReturn:
    raise Ended(number)


@contextlib.contextmanager
def signals_to(handler: Callable[[int, Any], None]) -> Iterator[None]:
    """Installs `handler` for the signals that end this process, except those that are ignored, as under nohup."""
    before = {number: signal.getsignal(number) for number in ENDING}
    for number, earlier in before.items():
        if earlier != signal.SIG_IGN:
            signal.signal(number, handler)
    try:
        yield
    finally:
        for number, earlier in before.items():
            signal.signal(number, earlier)


def run(main: Callable[[list[str]], int], words: list[str]) -> int:
    """Runs a command and returns its exit code, which follows the program's convention. Errors are reported on standard error."""
    try:
        with signals_to(end):
            return output.to_an_end(lambda: main(words), "bvhbench: ")
    except Ended as ended:
        output.say("bvhbench: stopped")
        return 128 + ended.args[0]
