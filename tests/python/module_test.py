"""Tests the Python module on a processor: its answers against sweeps in NumPy, and what it makes of wrong input."""
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np

import bvhbench

ROOT = pathlib.Path(__file__).resolve().parents[2]


def soup(count: int, seed: int = 1, size: float = 0.12) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    points = random.random((count, 1, 3)) + size * random.random((count, 3, 3))
    return points.reshape(-1, 3).astype(np.float32), np.arange(3 * count).reshape(-1, 3)


def overlapping(points: np.ndarray, faces: np.ndarray) -> set[tuple[int, int]]:
    """Returns the pairs of triangles whose boxes overlap, each with each."""
    corners = points[faces]
    low, high = corners.min(axis=1), corners.max(axis=1)
    touch = np.all((low[:, None] <= high[None]) & (low[None] <= high[:, None]), axis=2)
    return set(map(tuple, np.argwhere(np.triu(touch, 1)).tolist()))


def rows(pairs: np.ndarray) -> set[tuple[int, ...]]:
    found = list(map(tuple, pairs.tolist()))
    assert pairs.dtype == np.uint32 and len(set(found)) == len(found)
    return set(found)


def place(points: np.ndarray, pose: np.ndarray) -> np.ndarray:
    return (points @ pose[:3, :3].T + pose[:3, 3]).astype(np.float32)


class Answers(unittest.TestCase):
    def setUp(self) -> None:
        self.points, self.faces = soup(500)
        self.right = overlapping(self.points, self.faces)
        self.tree = bvhbench.Tree(self.points, self.faces, "cpu")

    def test_pairs_are_those_of_each_with_each(self) -> None:
        self.assertGreater(len(self.right), 50)
        self.assertEqual(rows(self.tree.pairs()), self.right)
        bvhbench.verify(self.tree.pairs(), self.points, self.faces)
        for answer, found in (("contacts", self.tree.contacts()), ("within", self.tree.within(0.02))):
            self.assertTrue(0 < len(found) != len(self.right))
            bvhbench.verify(found, self.points, self.faces, answer=answer, distance=0.02)
        self.assertIn(self.tree.first(), rows(self.tree.contacts()))
        self.assertIsNone(bvhbench.Tree(self.points[:3], self.faces[:1]).first())
        self.assertGreater(self.tree.memory, 500 * 24)
        self.assertEqual((self.tree.builder, self.tree.collider), ("oibvh-multi", "group"))

    def test_neighbours_are_left_out_if_asked(self) -> None:
        quad = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32), [[0, 1, 2], [0, 2, 3]]
        self.assertEqual(len(bvhbench.Tree(*quad).pairs()), 1)
        self.assertEqual(len(bvhbench.Tree(*quad, adjacent=False).pairs()), 0)
        bvhbench.verify([], *quad, adjacent=False)

    def test_moved_points_are_followed(self) -> None:
        moved = self.points + np.repeat(soup(500, 2)[0][::3], 3, axis=0) / 10
        for step in (self.tree.refit, self.tree.update, lambda points: self.tree.build(points, self.faces)):
            step(moved)
            self.assertEqual(rows(self.tree.pairs()), overlapping(moved, self.faces))
            self.tree.refit(self.points)
            self.assertEqual(rows(self.tree.pairs()), self.right)

    def test_objects_may_be_in_any_order(self) -> None:
        for objects in (np.sort(np.arange(500) % 3), np.arange(500) % 3):
            tree = bvhbench.Tree(self.points, self.faces, objects=objects)
            for among, wanted in (("all", self.right), ("between", {pair for pair in self.right if len(set(objects[list(pair)])) > 1}),
                                  ("within", {pair for pair in self.right if len(set(objects[list(pair)])) == 1})):
                self.assertEqual(rows(tree.pairs(among)), wanted)
            left = tree.pairs("between", exclude=[(2, 0)])
            self.assertEqual(rows(left), {pair for pair in self.right if set(objects[list(pair)]) in ({0, 1}, {1, 2})})
            self.assertTrue(np.array_equal(tree.objects_of(left), objects[left]))
            self.assertEqual(rows(tree.pairs("between", groups=[1, 2, 4], masks=[2, 1, 0])),
                             {pair for pair in self.right if set(objects[list(pair)]) == {0, 1}})
            moved = self.points + np.repeat(objects == 1, 3)[:, None] * np.float32(0.05)
            tree.update(moved, [1])
            self.assertEqual(rows(tree.pairs()), overlapping(moved, self.faces))

    def test_two_trees(self) -> None:
        points, faces = soup(300, 3)
        both = overlapping(np.vstack([self.points, points]), np.vstack([self.faces, faces + len(self.points)]))
        self.assertEqual(rows(self.tree.pairs_with(bvhbench.Tree(points, faces, "cpu"))), {(a, b - 500) for a, b in both if a < 500 <= b})
        self.assertEqual(len(self.tree.pairs_with(self.tree)), 500 + 2 * len(self.right))

    def test_a_scene_tells_objects_and_follows_poses(self) -> None:
        scene = bvhbench.Scene("cpu")
        parts = [soup(count, count, 0.3) for count in (40, 70, 30)]
        self.assertEqual([scene.add(*part) for part in parts], [0, 1, 2])
        pose = np.array([[0.6, -0.8, 0, 0.5], [0.8, 0.6, 0, -0.25], [0, 0, 1, 0], [0, 0, 0, 1]])
        moved = [parts[0], (place(parts[1][0], pose), parts[1][1]), parts[2]]
        scene.pairs()
        scene.place(1, pose)
        for now in (moved, [moved[0], moved[1], (parts[2][0] + 0.125, parts[2][1])]):
            scene.move(2, now[2][0])
            tree = bvhbench.Tree(np.vstack([points for points, _ in now]), np.vstack([parts[0][1], parts[1][1] + 120, parts[2][1] + 330]),
                                 objects=np.repeat([0, 1, 2], [40, 70, 30]))
            first = np.array([0, 40, 110], np.uint32)
            for answer in ("pairs", "contacts"):
                found = getattr(scene, answer)("between")
                self.assertEqual(rows(first[found[:, ::2]] + found[:, 1::2]), rows(getattr(tree, answer)("between")))
        self.assertEqual(len(scene.first("between")), 4)

    def test_threads_share_a_device_and_a_tree(self) -> None:
        wrong = []

        def ask() -> None:
            for _ in range(20):
                own = bvhbench.Tree(self.points, self.faces, "cpu")
                if rows(own.pairs()) != self.right or rows(self.tree.pairs()) != self.right:
                    wrong.append(1)

        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_wrong_pairs_are_shown(self) -> None:
        pairs = np.array(sorted(self.right))
        bvhbench.verify(pairs[::-1, ::-1], self.points, self.faces)
        with self.assertRaises(bvhbench.WrongPairs) as caught:
            bvhbench.verify(np.vstack([pairs[4:], [[7, 7]], pairs[5:6]]), self.points, self.faces)
        lost = ", ".join(str(tuple(pair)) for pair in pairs[:3].tolist())
        self.assertEqual(str(caught.exception), f"of {len(pairs)} pairs 4 missing: {lost} …; 1 too many: (7, 7); 1 repeated")
        with self.assertRaisesRegex(ValueError, "an answer is"):
            bvhbench.verify(pairs, self.points, self.faces, answer="overlaps")


class Input(unittest.TestCase):
    """What is no array of NumPy's that the library reads as it is."""

    def setUp(self) -> None:
        self.points, self.faces = soup(60)
        self.right = overlapping(self.points, self.faces)

    def test_any_layout_and_type_of_numbers(self) -> None:
        padded = np.zeros((180, 4), np.float32)
        padded[:, :3] = self.points
        frozen = self.points.copy()
        frozen.flags.writeable = False
        for points in (self.points.astype(np.float64), np.asfortranarray(self.points), padded[:, :3], frozen, self.points.tolist()):
            for faces in (self.faces, self.faces.astype(np.int32), self.faces.astype(">u2"), np.asfortranarray(self.faces), self.faces.tolist()):
                self.assertEqual(rows(bvhbench.Tree(points, faces).pairs()), self.right)

    def test_arrays_may_be_dropped(self) -> None:
        tree = bvhbench.Tree(self.points.copy(), self.faces.astype(np.uint32))
        tree.refit(self.points.copy())
        np.full((180, 3), np.nan, np.float32)  # likely where they were
        bvhbench.verify(tree.contacts(), self.points, self.faces, answer="contacts")

    def test_a_build_that_fails_leaves_nothing_behind(self) -> None:
        faces, bad = self.faces.astype(np.uint32), np.full((180, 3), np.nan, np.float32)
        tree = bvhbench.Tree(self.points, faces)
        with self.assertRaises(ValueError):
            tree.build(bad, faces[::-1].copy())
        with self.assertRaisesRegex(ValueError, "needs a tree"):
            tree.pairs()
        tree.build(self.points, faces)
        self.assertEqual(rows(tree.pairs()), self.right)

    def test_no_faces_have_no_pairs(self) -> None:
        for points in ([], self.points):
            tree = bvhbench.Tree(points, [])
            for pairs in (tree.pairs(), tree.contacts("between"), tree.within(1), tree.pairs_with(bvhbench.Tree(self.points, self.faces))):
                self.assertEqual(pairs.shape, (0, 2))
            tree.update(points)
            self.assertIsNone(tree.first())
        self.assertEqual(bvhbench.Scene().pairs().shape, (0, 4))

    def test_what_is_wrong_is_one_sentence(self) -> None:
        points, faces = self.points, self.faces
        bad = points.copy()
        bad[4, 1] = np.nan
        tree, scene = bvhbench.Tree(points, faces), bvhbench.Scene()
        scene.add(points, faces)
        for error, call, says in (
                (ValueError, lambda: bvhbench.Tree(bad, faces), "triangle 1 has a corner that is not finite"),
                (ValueError, lambda: bvhbench.Tree(points[:, :2], faces), r"points have the shape \(n, 3\), not \(180, 2\)"),
                (ValueError, lambda: bvhbench.Tree(points.ravel(), faces), r"points have the shape \(n, 3\), not \(540,\)"),
                (ValueError, lambda: bvhbench.Tree(points, faces[:, :2]), r"faces have the shape \(n, 3\), not \(60, 2\)"),
                (ValueError, lambda: bvhbench.Tree(points, faces - 1), "faces are from 0 to 4294967295, not -1"),
                (ValueError, lambda: bvhbench.Tree(points, faces + 2**32), "faces are from 0 to 4294967295, not 4294967475"),
                (ValueError, lambda: bvhbench.Tree(points, faces + 1), "triangle 59 names point 180, and there are 180"),
                (ValueError, lambda: bvhbench.verify([], points, faces + 1), "a face names point 180, and there are 180"),
                (TypeError, lambda: bvhbench.Tree(points, faces.astype(float)), "faces are integers, not float64"),
                (TypeError, lambda: bvhbench.Tree(points.astype(complex), faces), "points are real numbers, not complex128"),
                (ValueError, lambda: bvhbench.Tree(points, faces, order="morton"), "order"),
                (ValueError, lambda: bvhbench.Tree(points, faces, builder="karras"), "builder of the library"),
                (bvhbench.Unavailable, lambda: bvhbench.Tree(points, faces, "no such device"), "no such device"),
                (ValueError, lambda: bvhbench.Tree(points, faces, objects=[0, 1]), "there are 2 objects of triangles, and 60 triangles"),
                (ValueError, lambda: bvhbench.Tree(points, faces, objects=np.full(60, 1)), "object 0 is empty"),
                (ValueError, lambda: tree.refit(points[1:]), "the tree is over 180 points, and 179 are given"),
                (ValueError, lambda: tree.update(points, [1]), "there is no object 1, and there are 1"),
                (ValueError, lambda: tree.pairs("among"), "not 'among'"),
                (ValueError, lambda: tree.pairs(exclude=[(0, 1)]), "object 1"),
                (ValueError, lambda: tree.within(-1), "distance"),
                (ValueError, lambda: tree.within(np.inf), "distance"),
                (ValueError, lambda: scene.place(0, np.eye(3)), r"\(4, 4\) matrix"),
                (ValueError, lambda: scene.place(0, np.full((4, 4), np.nan)), r"\(4, 4\) matrix"),
                (ValueError, lambda: scene.place(1, np.eye(4)), "there is no object 1"),
                (ValueError, lambda: scene.add(points, []), "there are no triangles"),
                (bvhbench.Error, lambda: bvhbench.read(__file__), "module_test.py")):
            with self.assertRaisesRegex(error, says) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception).strip())
            self.assertTrue(isinstance(caught.exception, (bvhbench.Error, TypeError)))
        self.assertEqual(rows(tree.pairs()), self.right)  # as it was

    def test_rounding_that_matters_is_said(self) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            bvhbench.Tree(self.points.astype(float) + 1e-9, self.faces)
        with self.assertWarnsRegex(UserWarning, r"moves coordinates by up to 0\.03 of 1\.85"):
            bvhbench.Tree(self.points.astype(float) + 1e6, self.faces)


class Package(unittest.TestCase):
    def test_the_examples_of_the_guide_and_the_study_run(self) -> None:
        blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.DOTALL)
        exec("".join(block for block in blocks if "result.json" not in block), {})
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "cloth.png"
            subprocess.run([sys.executable, ROOT / "examples/python/cloth.py", picture], check=True)
            self.assertGreater(picture.stat().st_size, 10000)

    def test_the_best_is_a_table_with_a_sentence(self) -> None:
        table = bvhbench.best(*soup(300), builders="oibvh-multi,karras", colliders="leaf,group", orders="hilbert30", max_samples=5)
        self.assertEqual([1, *sorted(table.ratio[1:])], list(table.ratio))
        self.assertTrue({"karras", "oibvh-multi"} == set(table.builder) and table.right.all() and table["take"].sum() == 1 and "oibvh-multi" in table.attrs["sentence"])
        with self.assertRaisesRegex(bvhbench.Error, "no collider is called"):
            bvhbench.best(*soup(300), colliders="leef")

    def test_results_are_read_and_pandas_is_not_imported_before(self) -> None:
        done = subprocess.run([sys.executable, "-c", "import sys, bvhbench; print('pandas' in sys.modules)"], capture_output=True, text=True,
                              check=True)
        self.assertEqual(done.stdout, "False\n")
        table = bvhbench.read(ROOT / "results/h200/steps-in-doubles.json.xz")
        self.assertTrue({"scene", "builder", "stage", "ns"} <= set(table.columns) and len(table) > 10)
