#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A program for tests of --program: all pairs by comparing every two boxes. It is right, unless it is called as fault-NAME.py, where
NAME is a way in which it is to be wrong. Its method is then called plain-NAME."""
import json
import os
import pathlib
import signal
import sys
import time
from array import array

FAULT = pathlib.Path(sys.argv[0]).stem.partition("-")[2]
CONTROL = "\x1b[2Jname\x07\x9b31m\u202e\u2066<img src=x>"
METHOD = {"name": f"plain-{FAULT}".removesuffix("-"), "summary": "every two boxes, in Python", "query": True, "pairs": True}


class Plain:
    def create(self, request):
        assert request["method"] == METHOD["name"]

    def prepare(self, request):
        self.faces = values("I", request["faces"])
        assert len(self.faces) == 3 * request["triangles"]

    def load(self, request):
        points = values("f", request["points"])
        corners = [[points[3 * vertex:3 * vertex + 3] for vertex in self.faces[3 * k:3 * k + 3]] for k in range(len(self.faces) // 3)]
        self.boxes = [[(min(axis), max(axis)) for axis in zip(*triangle)] for triangle in corners]

    def query(self, _request):
        if FAULT == "hang":
            pathlib.Path("hangs").touch()
            time.sleep(600)
        if FAULT == "crash":
            os.kill(os.getpid(), signal.SIGSEGV)
        if FAULT == "exit":
            sys.exit("no such device")
        if FAULT in ("children", "daemons") and os.fork() == 0:
            if FAULT == "daemons":
                os.setsid()
                if os.fork() != 0:
                    os._exit(0)
            os.close(1)
            time.sleep(600)
        if FAULT == "many-children":
            for _ in range(4):
                if os.fork() == 0:
                    taken = b"x" * (200 << 20)
                    time.sleep(600)
                    os._exit(len(taken) == 0)
            time.sleep(600)
        if FAULT == "close":
            os.close(1)
            time.sleep(600)
        begin = time.monotonic_ns()
        self.found = [(a, b) for b in range(len(self.boxes)) for a in range(b)
                      if all(one[0] <= other[1] and other[0] <= one[1] for one, other in zip(self.boxes[a], self.boxes[b]))]
        end = time.monotonic_ns() + (10**12 if FAULT == "leak" else 0)
        if FAULT == "microseconds":
            begin, end = begin // 1000, end // 1000
        return {"stages": [{"name": "broad", "begin_ns": begin, "end_ns": end, "device": False}]}

    def pairs(self, request):
        found = self.found[:-1] if FAULT == "missed-pair" else self.found
        with open(request["pairs"], "wb") as file:
            array("I", [triangle for pair in found for triangle in pair]).tofile(file)
        return {"count": len(found) + (FAULT == "count")}

    def bytes(self, _request):
        return {"bytes": 4 * len(self.faces)}


def values(kind, path):
    with open(path, "rb") as file:
        return array(kind, file.read())


def hello():
    if FAULT == "dies-at-start":
        sys.exit("nothing works here")
    hostile = FAULT in ("control", "control-error")
    text = CONTROL if hostile else "Plain"
    return {"protocol": 2 if FAULT == "abi" else 1, "library": text, "version": CONTROL if hostile else "2.0", "licence": "MIT",
            "device": "host", "methods": [METHOD | {"summary": CONTROL} if hostile else METHOD]}


def say(text):
    sys.stdout.write(text)
    sys.stdout.flush()


plain = Plain()
for line in sys.stdin:
    request = json.loads(line)
    call = request["call"]
    if call == "quit":
        break
    reply = hello() if call == "hello" else getattr(plain, call)(request) or {}
    if call == "query" and FAULT == "not-json":
        say("Found some pairs!\n")
    elif call == "query" and FAULT == "no-stages":
        say('{"ok": true}\n')
    elif call == "query" and FAULT == "endless":
        for _ in range(5000):
            say(1000 * "x")
    elif call == "query" and FAULT == "control-error":
        say(json.dumps({"error": CONTROL + "\nand two lines"}) + "\n")
    elif call == "query" and FAULT == "error":
        say('{"error": "there are too many pairs"}\n')
    else:
        say(json.dumps({"ok": True, **reply}) + "\n")
