#!/usr/bin/env python3
"""Measures how often `compare` is right, for two runs of one build, and for a builder that is slowed by 10 %.

Usage: compare_trials.py <bvhbench> [--trials N] [--samples N] [--keep FOLDER] [--slow FACTOR]

Takes about three minutes and needs an idle machine, so it is run by .ci/nightly instead of a test. In each trial three runs
sample by turns (`run --turns`): two unchanged ones, and one in which the test hook BVHBENCH_SLOW slows a builder, another
one in each trial. The first run is compared with the second, with the slowed one, and with the second run of the previous
trial, which ran at another time. Exits with 1 unless

- at least 95 % of the cells of unchanged runs are SAME or UNSURE, both by turns and at different times,
- the slowed cell is SLOWER in at least 90 % of the trials.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

BUILDERS = ["perfect", "karras", "apetrei-fused", "lbvh-levels", "oibvh-single", "oibvh-multi"]
VERDICTS = ("SAME", "FASTER", "SLOWER", "UNSURE")


def experiment(samples: int) -> dict:
    return {"experiment": "trial", "scenes": ["torus:20000"], "builders": BUILDERS, "samples": samples, "warm_up": 5}


def measure(program: pathlib.Path, folder: pathlib.Path, trial: int, slow: str) -> None:
    """Runs the three runs of a trial by turns."""
    runs = []
    for name in ("before", "after", "slow"):
        environment = {**os.environ, "BVHBENCH_SLOW": slow if name == "slow" else ""}
        runs.append(subprocess.Popen([program, "run", folder / "trial.json", "--out", folder / f"{name}{trial}.json",
                                      "--turns", f"{folder / f'turns{trial}'}:3"], env=environment,
                                     stdout=subprocess.DEVNULL))
    if any([run.wait() for run in runs]):
        sys.exit("a run failed")


def verdicts(program: pathlib.Path, before: pathlib.Path, after: pathlib.Path) -> dict[str, str]:
    """Returns the verdict of each cell, by its builder."""
    done = subprocess.run([program, "compare", before, after, "--all", "--allow-dirty", "--test-hooks"],
                          capture_output=True, text=True)
    assert done.returncode in (0, 1), done
    found = {}
    for line in done.stdout.splitlines():
        words = line.split()
        if words and words[-1] in VERDICTS and ": " in line and "together" not in line:
            found[line.split(": ", 1)[1].split("  ")[0].strip()] = words[-1]
    return found


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--samples", type=int, default=240)
    parser.add_argument("--slow", type=float, default=1.10)
    parser.add_argument("--keep", type=pathlib.Path, help="folder of the runs; those that are there are not made again")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        if not (folder / "trial.json").exists():
            (folder / "trial.json").write_text(json.dumps(experiment(options.samples)))
            for trial in range(options.trials):
                measure(options.program, folder, trial, f"{BUILDERS[trial % len(BUILDERS)]}:{options.slow}")
        quiet, cells, found = {"by turns": 0, "apart": 0}, {"by turns": 0, "apart": 0}, 0
        for trial in range(options.trials):
            slowed = BUILDERS[trial % len(BUILDERS)]
            before, after, slow = (folder / f"{name}{trial}.json" for name in ("before", "after", "slow"))
            told = {"by turns": verdicts(options.program, before, after)}
            if trial > 0:
                told["apart"] = verdicts(options.program, folder / f"after{trial - 1}.json", before)
            for how, of_cells in told.items():
                cells[how] += len(of_cells)
                quiet[how] += sum(verdict in ("SAME", "UNSURE") for verdict in of_cells.values())
            slower = verdicts(options.program, before, slow)
            found += slower[slowed] == "SLOWER"
            print(f"trial {trial}: {slowed} slowed {slower[slowed]};",
                  "; ".join(how + " " + ", ".join(f"{cell} {verdict}" for cell, verdict in of_cells.items()
                                                  if verdict in ("SLOWER", "FASTER")) for how, of_cells in told.items()))
    for how, count in quiet.items():
        print(f"of one build, {how}: {count} of {cells[how]} cells SAME or UNSURE ({100 * count / cells[how]:.1f} %,"
              " at least 95 wanted)")
    print(f"slowed by {options.slow}: found in {found} of {options.trials} trials (at least 90 % wanted)")
    enough = all(count >= 0.95 * cells[how] for how, count in quiet.items())
    return 0 if enough and found >= 0.9 * options.trials else 1


if __name__ == "__main__":
    sys.exit(main())
