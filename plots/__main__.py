#!/usr/bin/env python3
"""Runs the commands that read result files; the program starts it for them.

    python3 plots COMMAND ARGUMENTS...
"""
import importlib
import sys

import command


def main(words: list[str]) -> int:
    return importlib.import_module(f"commands.{words[0]}").main(words[1:])


if __name__ == "__main__":
    sys.exit(command.run(main, sys.argv[1:]))
