#!/usr/bin/env python3
"""Tests what a user is told about a mesh: by `scene`, by one line of other commands and in result files; and what is said of objects
inside others, of contacts that only touch and of frames with other triangles."""
import json
import pathlib
import sys

from program import cells_after, expect, main, only, run

QUERY = ("collide", "--builder", "oibvh-single", "--collider", "leaf", "--adjacent", "drop", "--samples", "1")
CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
         (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def boxes(*ranges: tuple[str, float, float], without: int = 0) -> str:
    """Returns cubes [low, high]^3 as OBJ, the last without some of its faces."""
    text = ""
    for k, (name, low, high) in enumerate(ranges):
        text += f"o {name}\n" + "".join(f"v {' '.join(str(low + c * (high - low)) for c in corner)}\n" for corner in CORNERS)
        faces = FACES[without:] if k == len(ranges) - 1 else FACES
        text += "".join("f " + " ".join(str(8 * k + c + 1) for c in face) + "\n" for face in faces)
    return text


def stl(text: str) -> str:
    """Returns an OBJ file's triangles as STL, which share no vertices."""
    lines = [line.split() for line in text.splitlines()]
    points = [words[1:] for words in lines if words[0] == "v"]
    facets = ["facet\n" + "".join(f"vertex {' '.join(points[int(c) - 1])}\n" for c in words[1:]) + "endfacet\n"
              for words in lines if words[0] == "f"]
    return "solid\n" + "".join(facets) + "endsolid\n"


def test_a_scene_is_described_as_a_table_and_as_json() -> None:
    pathlib.Path("cube.stl").write_text(stl(boxes(("a", 0, 1))))
    told = expect(0, "scene", "cube.stl", "--json", "facts.json")
    assert "--weld would join 28 of 36 vertices" in told, told
    scene, = json.loads(pathlib.Path("facts.json").read_text())["scenes"]
    assert scene["mesh"]["open_edges"] == 36 and scene["mesh"]["weldable_vertices"] == 28, scene
    assert (scene["mesh"]["low"], scene["mesh"]["high"]) == ([0, 0, 0], [1, 1, 1]), scene
    told = expect(0, "scene", "cube.stl", "--weld")
    assert "surprises" not in told and "joined" in told, told


def test_a_scene_that_is_refused_leaves_the_others() -> None:
    pathlib.Path("good.obj").write_text(boxes(("a", 0, 1)))
    pathlib.Path("bad.stl").write_text("solid\nfacet\n")
    done = run("scene", "bad.stl", "good.obj", "--json", "both.json")
    assert done.returncode == 3 and "scene good.obj" in done.stdout, done
    assert done.stderr == "bvhbench: bad.stl, line 2: the file ends inside the facet of line 2\n", done.stderr
    assert [scene["name"] for scene in json.loads(pathlib.Path("both.json").read_text())["scenes"]] == ["good.obj"]
    expect(2, "scene", "good.obj", "--json", "good.obj", says="good.obj")
    expect(2, "scene", "nothing", says="no scene is called 'nothing'")


def test_a_surprise_is_told_in_one_line_and_stands_in_the_result() -> None:
    pathlib.Path("cube.stl").write_text(stl(boxes(("a", 0, 1))))
    done = run(*QUERY, "--scene", "cube.stl", "--narrow", "exact", "--json", "apart.json")
    assert done.stderr.count("no two triangles share an edge, and --weld would join 28 of 36 vertices\n") == 1, done.stderr
    expect(0, *QUERY, "--scene", "cube.stl", "--narrow", "exact", "--weld", "--json", "welded.json")
    apart, welded = only("apart.json"), only("welded.json")
    assert apart["scene"]["mesh"]["shared_edges"] == 0 and welded["scene"]["mesh"]["shared_edges"] == 18
    assert welded["scene"]["reading"]["joined_vertices"] == 28
    counts = [[cell["counters"][key] for key in ("contacts_count", "touching_count")] for cell in (apart, welded)]
    assert counts == [[48, 48], [0, 0]], counts


def test_objects_inside_others_are_named() -> None:
    pathlib.Path("nested.obj").write_text(boxes(("a", 0, 4), ("b", 1, 2), ("c", 3, 5), ("d", 1.25, 1.5)))
    told = expect(0, *QUERY, "--scene", "nested.obj", "--narrow", "exact", "--containment", "--json", "nested.json")
    assert told.count("lies wholly inside") == 3 and "object 'b' lies wholly inside 'a', without a contact" in told, told
    cell = only("nested.json")
    assert [(one["object"], one["inside"]) for one in cell["contained"]] == [("b", "a"), ("d", "a"), ("d", "b")], cell
    assert cell["counters"]["contained_count"] == 3
    crossing = cell["counters"]["contacts_count"] - cell["counters"]["touching_count"]
    assert crossing == 6, cell["counters"]  # three faces of a's corner and of c's, each pair of them along an edge
    pathlib.Path("open.obj").write_text(boxes(("b", 1, 2), ("a", 0, 4), without=1))
    told = expect(0, *QUERY, "--scene", "open.obj", "--narrow", "exact", "--containment")
    assert "no object lies wholly inside" in told and "1 of its objects are not closed" in told, told
    expect(2, *QUERY, "--scene", "open.obj", "--containment", says="--containment needs all exact contacts")
    # A cube in the corner of another one, outside of it, that has one of its vertices: no contact, and no inside.
    text = boxes(("outer", 0, 2), ("inner", -1, 0)).replace(f"f {8 + 8} ", "f 1 ").replace(f" {8 + 8}", " 1")
    pathlib.Path("corner.obj").write_text(text)
    told = expect(0, *QUERY, "--scene", "corner.obj", "--narrow", "exact", "--containment")
    assert "no object lies wholly inside" in told, told


def test_frames_may_have_other_triangles_where_trees_are_rebuilt() -> None:
    folder = pathlib.Path("changing")
    folder.mkdir()
    (folder / "f1.obj").write_text(boxes(("a", 0, 2), ("b", 1, 3)))
    (folder / "f2.obj").write_text(boxes(("a", 0, 2), ("b", 1, 3), ("c", 1.5, 4)))
    words = ("--scene", "changing", "--frames", "0:", "--narrow", "exact")
    cells = cells_after(*QUERY[:4], "block,leaf,grid", *QUERY[5:], *words)
    assert [cell["scene"]["triangles"] for cell in cells] == [24] * 3 + [36] * 3
    assert {cell["check"]["verdict"] for cell in cells} == {"agrees"}
    for k in (0, 1):
        alone, = cells_after(*QUERY, "--scene", f"changing/f{k + 1}.obj", "--narrow", "exact")
        assert {cell["check"]["pairs_hash"] for cell in cells[3 * k:3 * k + 3]} == {alone["check"]["pairs_hash"]}, k
    for other in (("--update", "refit"), ("--between", "1"), ("--swept",)):
        expect(3, *QUERY, "--scene", "changing", "--frames", "0:", *other, says="f2.obj has other triangles than changing/f1.obj")
    expect(3, *QUERY[:4], "front", *QUERY[5:], *words, says="has other triangles than")
    expect(3, "build", "--builder", "oibvh-single", "--scene", "changing", says="has other triangles than")


if __name__ == "__main__":
    sys.exit(main(globals()))
