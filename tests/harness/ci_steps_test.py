"""Runs the steps of the time gate that docs/ci.md prints, in a clone of this repository with one commit.

The clone's `bvhbench` is a script, so nothing is built or measured: `run` copies a result file that is committed beside it, and
`compare` is the real one. Steps that install packages, and those of GitHub, are left out; all others run as printed.
"""
import json
import os
import pathlib
import re
import stat
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAUNCHER = f"""#!/usr/bin/env bash
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
case $1 in
    run) [[ -f $2 && $5 == --out && $7 == --turns && $8 == *:2 ]]; sed "s|RUN|$6|" "$here/result.json" >"$6" ;;
    compare) exec {sys.executable} {ROOT}/plots "$@" ;;
esac
"""


def steps(workflow: int = -1) -> list[str]:
    """Returns the scripts of a workflow of the page, the last one unless told, without what needs a network."""
    block = re.findall(r"```yaml\n(.*?)```", (ROOT / "docs" / "ci.md").read_text(encoding="utf-8"), re.DOTALL)[workflow]
    found, lines = [], block.splitlines()
    for place, line in enumerate(lines):
        if not (run := re.match(r"( *)- run: (.*)", line)):
            continue
        text = run[2]
        if text == "|":
            margin = len(run[1]) + 4
            body = lines[place + 1:]
            end = next((at for at, other in enumerate(body) if other.strip() and not other.startswith(" " * margin)), len(body))
            text = "\n".join(other[margin:] for other in body[:end])
        if not text.startswith("apt-get") and "git clone" not in text:
            found.append(text)
    return found


def result(slower: float) -> str:
    """Returns a result file of two builders, with 60 samples each, of a run RUN; `slower` multiplies the times of one."""
    document = json.loads((ROOT / "tests" / "golden" / "table1.json").read_text(encoding="utf-8"))
    document["run"] |= {"id": "RUN", "conditions": {"warnings": []}}
    document["run"]["program"]["dirty"] = False
    document["run"].pop("test_hooks", None)
    document["cells"] = [
        {"experiment": "smoke", "scene": {"name": "soup:1000", "triangles": 1000}, "builder": {"name": builder}, "status": "measured",
         "counters": {}, "check": {"verdict": "agrees"},
         "samples": [{"order": 2 * number + place, "stages": [
             {"stage": "hierarchy", "launches": 1, "moved_bytes": 1, "busy_ns": ns, "span_ns": ns}]}
             for number in range(60) for ns in [int((100000 + 7919 * number % 1000) * (slower if place else 1))]]}
        for place, builder in enumerate(("karras", "oibvh-multi"))]
    return json.dumps(document)


class TimeGate(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.environment = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
        self.environment |= {"HOME": str(self.folder), "GIT_CONFIG_NOSYSTEM": "1", "BASE": "", "PYTHONDONTWRITEBYTECODE": "1"}
        self.run_in(self.folder, "git config --global user.name tester; git config --global user.email tester@example.org; "
                                 "git config --global --add safe.directory '*'")
        if (ROOT / ".git").exists():
            self.run_in(self.folder, f"git clone -q --depth 1 'file://{ROOT}' source")
        else:  # sources without history
            self.run_in(self.folder, f"git init -q source; mkdir -p source/harness; cp -r '{ROOT}/harness/experiments' source/harness/")
        self.source = self.folder / "source"

    def run_in(self, folder: pathlib.Path, script: str) -> subprocess.CompletedProcess:
        return subprocess.run(["bash", "-e", "-c", script], cwd=folder, env=self.environment, capture_output=True, text=True, check=False,
                              timeout=600)

    def commit(self, content: str) -> str:
        """Commits the launcher with a result file, and returns the commit."""
        launcher = self.source / "bvhbench"
        launcher.write_text(LAUNCHER, encoding="utf-8")
        launcher.chmod(launcher.stat().st_mode | stat.S_IXUSR)
        (self.source / "result.json").write_text(content, encoding="utf-8")
        done = self.run_in(self.source, "git add -A; git add -f result.json; git commit -q --allow-empty -m change; git rev-parse HEAD")
        self.assertEqual(done.returncode, 0, done)
        return done.stdout.strip()

    def gate(self, name: str, base: str) -> tuple[int, str]:
        """Runs the steps in a new clone; returns the exit code of the first that fails, and all output."""
        place = self.folder / name
        place.mkdir()
        self.assertEqual(self.run_in(place, f"git clone -q --depth 1 'file://{self.source}' checkout").returncode, 0)
        self.assertEqual(self.run_in(place / "checkout", "git rev-list --count HEAD").stdout, "1\n")
        self.environment["BASE"] = base
        said = ""
        for script in steps():
            done = self.run_in(place / "checkout", script)
            said += done.stdout + done.stderr
            if done.returncode:
                return done.returncode, said
        return 0, said

    def test_compares_with_the_base_or_with_the_parent(self) -> None:
        self.assertEqual(len(steps()), 5)
        first = self.commit(result(1))
        self.commit(result(2))
        self.commit(result(2))
        for name, base, code, says in (("parent", "", 0, "no regression"), ("new-branch", "0" * 40, 0, "no regression")):
            found, said = self.gate(name, base)
            self.assertEqual((found, says in said), (code, True), said)
        code, said = self.gate("base", first)
        self.assertEqual(code, 1, said)
        self.assertIn("SLOWER", said)
        self.assertIn("1 regression\n", said)
