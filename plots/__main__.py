"""Runs the commands that read result files; the program starts it for them.

    python3 plots COMMAND ARGUMENTS...
"""
import importlib
import os
import pathlib
import sys

sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])  # where the package is, in place of the package's folder

from plots.program import command  # noqa: E402


def main(words: list[str]) -> int:
    try:
        return importlib.import_module(f"plots.commands.{words[0]}").main(words[1:])
    except ModuleNotFoundError:
        if not sys.flags.ignore_environment:
            raise
        os.execv(sys.executable, [sys.executable, *sys.argv])  # what the system lacks may be among the user's packages


if __name__ == "__main__":
    sys.exit(command.run(main, sys.argv[1:]))
