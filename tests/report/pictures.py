#!/usr/bin/env python3
"""Pictures of a report, as a browser shows it: docs/pictures/report-1280.png, report-400.png and report-scene.png.

    tests/report/pictures.py --out docs/pictures

Of results/h200/table1.json.xz and orders.json.xz, and of a cloth on a ball, by the program in build/release.
"""
import argparse
import base64
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from browser import Browser  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SHOWN = ("table1.json.xz", "orders.json.xz")
PICTURES = (("report-1280.png", 1280, 1260, "#file-1", "header"), ("report-400.png", 400, 1560, "#file-1", "header"),
            ("report-scene.png", 1280, 830, "#overview", ".view"))
SCENE = ("--scene", "cloth-ball:6000", "--frame", "15")


def save(browser: Browser, path: pathlib.Path, height: int, top: str) -> None:
    """Saves the visible part of the page, from an element on."""
    browser.all_drawn()
    width = browser.run("return innerWidth")
    y = browser.run("return document.querySelector(arguments[0]).getBoundingClientRect().top + scrollY", top)
    clip = {"x": 0, "y": max(0, y - 8), "width": width, "height": height, "scale": 1}
    picture = browser.driver.execute_cdp_cmd("Page.captureScreenshot", {"clip": clip, "captureBeyondViewport": True})
    path.write_bytes(base64.b64decode(picture["data"]))
    print(path)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="DIR")
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    browser = Browser()
    try:
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "report.html"
            files = [ROOT / "results" / "h200" / name for name in SHOWN]
            program = ROOT / "build" / "release" / "harness" / "bvhbench"
            subprocess.run([program, "report", *files, *SCENE, "-o", page], check=True,
                           env=os.environ | {"BVHBENCH_HOME": str(ROOT)})
            for name, width, height, part, top in PICTURES:
                browser.resize(width)
                browser.open(page, part)
                save(browser, out / name, height, top)
    finally:
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
