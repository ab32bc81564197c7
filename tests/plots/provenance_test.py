"""Tests that result files speak of the kernels that are there, or are listed as older (plots/evidence/provenance.py)."""
import json
import pathlib
import subprocess
import unittest
from unittest import mock

from base import ROOT, InFolder, cell, document  # first: it adds the source root to sys.path

from plots.evidence import provenance

# results/older.json has for each reason the files that do not speak of the kernels that are there. The list may only shrink: who
# measures a file again takes it off and lowers this number. Who changes a kernel and cannot measure raises it, and says so. Files of
# turns/ do not count: they are of a program before a change.
MOST_LISTED = 69


class ResultFiles(unittest.TestCase):
    def setUp(self) -> None:
        if why := provenance.history():
            self.skipTest(f"{why}: nothing is known of the commits that result files name")

    def test_are_of_these_kernels_or_listed(self) -> None:
        reasons = json.loads((ROOT / "results" / "older.json").read_text(encoding="utf-8"))
        listed = [f"{name}.json.xz" for names in reasons.values() for name in names]
        self.assertEqual(len(listed), len(set(listed)), "a file is listed twice")
        files = provenance.result_files()
        self.assertEqual([name for name in listed if name not in files], [], "listed files that are not there")
        faults = {name: provenance.faults(provenance.parsed(path)) for name, path in files.items()}
        wrong = [f"{name}: {'; '.join(those)}; results/older.json does not list it" for name, those in faults.items() if those
                 and name not in listed]
        wrong += [f"{name} is of these kernels: take it off results/older.json" for name in listed if not faults[name]]
        self.assertEqual(wrong, [], "\n".join(["", *wrong]))
        self.assertLessEqual(sum(not name.startswith("turns/") for name in listed), MOST_LISTED, "results/older.json may only shrink")

    def test_tell_what_is_wrong_with_them(self) -> None:
        head = provenance.git("rev-parse", "HEAD").decode().strip()
        made = document(cell("oibvh-multi"), program={"commit": head, "dirty": False}, device={"kind": "gpu"})
        now = {path: provenance.blob_code(name) for path, name in provenance.blobs(head).items()}
        with mock.patch.object(provenance, "code_now", lambda: now):
            provenance.is_changed.cache_clear()
            self.assertEqual(provenance.faults(made), [])
            made["run"]["program"]["dirty"] = True
            self.assertEqual(provenance.faults(made), ["its program had changes that were in no commit"])
            made["run"]["program"] = {"commit": "0123456789" * 4, "dirty": False}
            self.assertEqual(provenance.faults(made), ["its commit 01234567 is not in the history"])
        made["run"]["program"]["commit"] = head
        changed = now | {path: text + " x" for path, text in now.items() if path in ("oibvh/build_groups.cl", "collide/walks/leaf.clh")}
        with mock.patch.object(provenance, "code_now", lambda: changed):
            provenance.is_changed.cache_clear()
            self.assertEqual(provenance.faults(made), ["older than oibvh/"])
        provenance.is_changed.cache_clear()


class Kernels(InFolder):
    def test_are_compared_without_comments_and_blanks(self) -> None:
        text = b"// one\n#include \"a.clh\"\nint a;  /* two\n */ int b;\n"
        self.assertEqual(provenance.code_of(text), provenance.code_of(b"int  a;\n\nint b; // c"))
        self.assertNotEqual(provenance.code_of(b"int a;"), provenance.code_of(b"int b;"))

    def test_are_those_of_the_stages(self) -> None:
        work = provenance.Work("oibvh-multi", "block", ("sort", "hierarchy", "broad"))
        self.assertEqual(work.places(False), {"builders/stages/sort/", "oibvh/", "builders/implicit/", "collide/walks/block",
                                              "collide/sinks/", provenance.SKIPS})
        self.assertIn("collide/walks/group", work.places(True))
        self.assertEqual(provenance.Work("embree-low", "", ("bounds", "hierarchy")).places(True), {"builders/stages/bounds"})
        self.assertEqual(provenance.Work("none", "culbvh", ("build", "broad")).places(False), set())

    def test_of_steps_depend_on_their_precision(self) -> None:
        for narrow, stage in (("ccd-1e-6", "narrow between frames"), ("ccd-f64-1e-6", "narrow in doubles")):
            raw = cell("oibvh-multi", swept={"pairs": "edge-edge"}, collider={"name": "group", "options": {"narrow": narrow}})
            self.assertEqual(provenance.narrow_of(provenance.Cell(raw)), stage)

    def test_of_one_rank_are_not_those_of_an_exchange(self) -> None:
        for ranks, place in ((1, "cluster/top_boxes"), (2, "cluster/")):
            cell = {"experiment": "cluster", "scene": {"name": "torus:9"}, "builder": {"name": "oibvh-multi"}, "operation": "cluster",
                    "status": "measured", "cluster": {"ranks_count": ranks}}
            work, = provenance.works({"cells": [cell]})
            self.assertIn(place, work.places(False))
            self.assertEqual("cluster/" in work.places(False), ranks > 1)

    def test_have_places_that_are_there(self) -> None:
        tables = (provenance.STAGES, provenance.OF_RANKS, provenance.OF_SWEPT, provenance.BUILDERS, provenance.COLLIDERS)
        places = [path for table in tables for paths in table.values() for path in paths]
        kernels = [str(path.relative_to(ROOT)) for ending in ("*.cl", "*.clh") for path in ROOT.rglob(ending)]
        self.assertEqual([place for place in places if not any(path.startswith(place) for path in kernels)], [])

    def test_are_not_asked_for_without_a_history(self) -> None:
        with mock.patch.object(provenance, "ROOT", pathlib.Path(self.folder)):
            self.assertEqual(provenance.history(), "there is no git repository")
        if provenance.history() == "there is no git repository":
            self.skipTest("there is no git repository to clone")
        subprocess.run(["git", "clone", "--quiet", "--depth", "1", f"file://{ROOT}", f"{self.folder}/shallow"], check=True,
                       capture_output=True)
        with mock.patch.object(provenance, "ROOT", pathlib.Path(self.folder) / "shallow"):
            self.assertEqual(provenance.history(), "the clone is shallow")
