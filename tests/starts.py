#!/usr/bin/env python3
"""How long the program takes to start: seconds from its call to its first sample, and to its end.

Usage: starts.py <bvhbench> [--starts N] [--first] [--scene NAME]

Runs each command once with an empty cache of kernels and then N times with what that left, and prints for each the first
start and the median, least and most of the later ones. The beginning of sampling is read off the line that the program
shows on a terminal, so it is given one. With --first, each of the N has an empty cache.
"""
import argparse
import os
import pathlib
import pty
import statistics
import subprocess
import sys
import tempfile
import time

COMMANDS = [("build", "--builder", "oibvh-multi"), ("build", "--builder", "oibvh-single"),
            ("build", "--builder", "apetrei-fused"), ("build", "--builder", "oibvh-multi", "--order", "kd"),
            ("build", "--builder", "oibvh-multi", "--order", "hilbert30+kd1024"), ("collide", "--collider", "group")]


def start(program: str, words: tuple[str, ...], cache: str) -> tuple[float, float]:
    """Returns the seconds to the first sample, and to the end."""
    terminal, theirs = pty.openpty()
    began = time.monotonic()
    with subprocess.Popen([program, *words], stdout=subprocess.DEVNULL, stderr=theirs,
                          env={**os.environ, "XDG_CACHE_HOME": cache, "POCL_CACHE_DIR": ""}) as process:
        os.close(theirs)
        shown, sampled = b"", None
        try:
            while text := os.read(terminal, 4096):
                shown += text
                if sampled is None and b"sampling" in shown:
                    sampled = time.monotonic() - began
        except OSError:  # the other end is closed
            pass
        finally:
            os.close(terminal)
    if process.returncode != 0:
        sys.exit(f"{' '.join(words)}: exit code {process.returncode}\n{shown.decode()}")
    ended = time.monotonic() - began
    return (ended if sampled is None else sampled), ended


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--starts", type=int, default=12)
    parser.add_argument("--scene", default="bunny")
    parser.add_argument("--first", action="store_true")
    options = parser.parse_args()
    print(f"{'seconds to':44} {'first sample':^25} {'end':^25}")
    print(f"{'':44} " + 2 * f"{'once':>6} {'median':>6} {'least':>5} {'most':>5} ")
    for words in COMMANDS:
        words += ("--scene", options.scene)
        with tempfile.TemporaryDirectory() as folder:
            times = [start(options.program, words, folder)]
            for k in range(options.starts):
                cache = pathlib.Path(folder, str(k)) if options.first else folder
                times.append(start(options.program, words, str(cache)))
        row = f"{' '.join(words):44.44} "
        for first, *later in zip(*times):
            row += f"{first:6.2f} {statistics.median(later):6.2f} {min(later):5.2f} {max(later):5.2f} "
        print(row, flush=True)


if __name__ == "__main__":
    main()
