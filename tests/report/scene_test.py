#!/usr/bin/env python3
"""Tests that a 3D scene shows what the program built and found: the boxes of `build --dump` and the pairs of `collide --pairs`,
drawn by a browser."""
import array
import base64
import gzip
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image

from page import GOLDEN, PROGRAM, ROOT, golden  # first: it takes the arguments

from browser import Browser

SCENE, FRAME, BUILDER = "two-spheres:1200", "5", "oibvh-multi"


def run(*words: object) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False,
                          env=os.environ | {"BVHBENCH_HOME": str(ROOT)})


class Scene(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.page = cls.folder / "scene.html"
        cls.made = run("report", GOLDEN / "table4.json", "--scene", SCENE, "--frame", FRAME,
                       "--builder", BUILDER, "--out", cls.page)
        if not cls.page.exists():
            raise AssertionError(f"no page was made: {cls.made}")
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)
        cls.browser.resize(800, 1000)

    def blob(self, name: str) -> bytes:
        text = re.search(rf'id="blob-{name}">([^<]*)<', self.page.read_text(encoding="utf-8"))[1]
        return gzip.decompress(base64.b64decode(text))

    def numbers(self, name: str, kind: str) -> list:
        return array.array(kind, self.blob(f"view-0-{name}")).tolist()

    def facts(self) -> dict:
        return json.loads(self.blob("head"))["views"][0]

    def test_it_is_made_and_leaves_nothing_else(self) -> None:
        self.assertEqual((self.made.returncode, self.made.stderr), (0, ""))
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name.startswith("scene")], ["scene.html"])

    def test_boxes_are_those_of_the_tree_level_by_level(self) -> None:
        # `build` uses a scene's first frame, so the shown frame is written as a mesh.
        mesh = self.folder / "mesh.obj"
        points, faces = self.numbers("points", "f"), self.numbers("faces", "I")
        lines = [f"v {' '.join(map(repr, points[k:k + 3]))}" for k in range(0, len(points), 3)]
        lines += [f"f {' '.join(str(corner + 1) for corner in faces[k:k + 3])}" for k in range(0, len(faces), 3)]
        mesh.write_text("\n".join(lines) + "\n", encoding="utf-8")
        done = run("build", "--builder", BUILDER, "--scene", mesh, "--samples", 1, "--dump", self.folder / "tree.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        nodes = json.loads((self.folder / "tree.json").read_text(encoding="utf-8"))["nodes"]
        expected, now = [], [0]
        while now:
            expected.append(sorted(tuple(nodes[node]["box"]["min"] + nodes[node]["box"]["max"]) for node in now))
            now = [child for node in now for child in nodes[node]["child"] if child >= 0]
        sides, levels, first = self.numbers("boxes", "f"), [], 0
        for level in self.facts()["levels"]:
            boxes = [tuple(sides[6 * box:6 * box + 6]) for box in range(first, first + level["count"])]
            levels.append(sorted(boxes))
            first += level["count"]
        self.assertEqual(len(levels), len(expected))
        exact = [[tuple(array.array("f", box)) for box in level] for level in expected]  # rounds JSON's digits to floats
        self.assertEqual(levels, [sorted(level) for level in exact])
        self.assertEqual(sum(level["leaves"] for level in self.facts()["levels"]), len(faces) // 3)

    def test_pairs_and_contacts_are_those_of_collide_and_checked(self) -> None:
        pairs, contacts = self.folder / "pairs.bin", self.folder / "contacts.bin"
        done = run("collide", "--collider", "brute", "--scene", SCENE, "--objects", "one", "--frames", FRAME, "--adjacent", "drop",
                   "--narrow", "exact", "--samples", 1, "--pairs", pairs, "--contacts", contacts)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.blob("view-0-pairs"), pairs.read_bytes())
        self.assertEqual(self.blob("view-0-contacts"), contacts.read_bytes())
        facts = self.facts()
        self.assertEqual((facts["state"], facts["title"]), ("agrees", f"{SCENE}, objects: one, frame {FRAME}: 1,200 triangles, leaf over {BUILDER}"))
        said = re.fullmatch(r" with CGAL boxes, .*contract\. (\d+) pairs of triangles .* overlap, (\d+) intersect; .*", facts["said"])
        self.assertGreater(int(said[2]), 20)
        self.assertGreater(int(said[1]), int(said[2]))

    def test_it_is_drawn_in_colour_and_a_level_is_chosen(self) -> None:
        browser = self.browser
        browser.open(self.page, "#overview")
        browser.all_drawn()

        def picture(level: int, triangles: str):
            browser.run("""const slider = document.querySelector(".view input[type=range]");
                const select = document.querySelector(".view select");
                slider.value = arguments[0]; slider.dispatchEvent(new Event('input'));
                select.value = arguments[1]; select.dispatchEvent(new Event('change'));""", level, triangles)
            url = browser.run("return document.querySelector('.view canvas').toDataURL('image/png')")
            return matplotlib.image.imread(io.BytesIO(base64.b64decode(url.split(",")[1])))[..., :3]

        def share(image, red, green, blue) -> float:
            """Returns the share of pixels whose channels match the flags: 1 above, -1 below, 0 either."""
            mask = sum((image[..., k] * flag for k, flag in enumerate((red, green, blue)) if flag)) > 0.25
            return float(mask.mean())

        all_triangles, colliding, none = (picture(4, which) for which in ("all", "some", "none"))
        for image, least in ((all_triangles, 0.05), (colliding, 0.005), (none, 0.001)):
            self.assertGreater(float((image.min(axis=-1) < 0.97).mean()), least)
        self.assertGreater(share(all_triangles, 1, 0, -1), 0.001)  # orange: contacts and pairs
        self.assertEqual(share(none, 1, 0, -1), 0.0)
        self.assertGreater(share(none, -1, 0, 1), 0.001)  # blue: boxes of inner nodes
        levels = self.facts()["levels"]
        last = picture(len(levels) - 1, "none")
        self.assertGreater(share(last, -1, 1, 0), 0.001)  # green: boxes of leaves
        self.assertFalse((last == none).all())
        said = browser.run("return document.querySelector('.view output').textContent")
        deepest = levels[-1]
        self.assertEqual(said, f"{len(levels) - 1} of {len(levels) - 1}: {deepest['count']:,} boxes, {deepest['leaves']:,} of leaves")
        self.assertIn("agrees", browser.run("return document.querySelector('.view .state').textContent"))
        for width in (1280, 400):
            browser.resize(width)
            self.assertEqual(browser.run("return document.documentElement.scrollWidth"), width)
        self.assertEqual((browser.complaints(), browser.requests()), ([], []))

    def test_a_wrong_scene_is_shown_as_wrong_and_its_boxes_are_not(self) -> None:
        view = self.folder / "wrong.view"
        cell = {"experiment": "view", "scene": {"name": SCENE}, "builder": {"name": BUILDER}, "status": "measured", "samples": [],
                "counters": {}, "check": {"verdict": "differs", "against": "contract", "detail": "box 7 is too small"}}
        run_facts = golden("table4")["run"]
        view.write_text(json.dumps({"run": run_facts, "cell": cell, "points": [0] * 9, "faces": [0, 1, 2], "levels": [], "pairs": [],
                                    "contacts": []}), encoding="utf-8")
        done = subprocess.run([sys.executable, ROOT / "plots", "report", "--view", view, "--out", self.folder / "wrong.html"],
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.browser.open(self.folder / "wrong.html")
        self.browser.all_drawn()
        said = self.browser.run("""return ["figcaption", "output"].map(
            (tag) => document.querySelector(".view " + tag).textContent);""")
        self.assertIn("differs with contract: box 7 is too small", said[0])
        self.assertEqual(said[1], "no boxes: the tree is wrong")

    def test_what_cannot_be_shown_is_refused_in_one_sentence(self) -> None:
        for code, words, said in (
                (2, ("--scene", "torus:100001"), "of up to 100000 triangles in three dimensions, and 'torus:100001' has 100001"),
                (2, ("--scene", "torus:100", "--frame", 1), "has frames 0 to 0, not 1"),
                (2, ("--scene", "torus:100", "--collider", "grid"), "the collider grid has none"),
                (2, ("--scene", "torus:100", "--builder", "no-such"), "no-such"),
                (3, ("--scene", self.folder / "no.obj"), "no.obj")):
            done = run("report", *words, "--out", self.folder / "refused.html")
            self.assertEqual((done.returncode, done.stdout), (code, ""), words)
            self.assertRegex(done.stderr, rf"^bvhbench: [^\n]*{re.escape(said)}[^\n]*\n$")
        self.assertEqual(list(self.folder.glob("refused*")), [])


if __name__ == "__main__":
    unittest.main()
