"""Names of cells for other programs: "peers/torus:20000/oibvh-multi/order:hilbert30". Everything that identifies a cell and is
not the default is in its name, so that names are equal for equal cells of two files, and different for different cells."""
from ..read import input_files
from ..read.cells import OF_SCENE, Cell, grouped, parts
from ..read.results import Run

Owned = tuple[Run, Cell]  # a cell with the file that it is from


def name_of(cell: Cell) -> str:
    own = parts(cell.raw)
    words = [own["experiment"], own["scene"], *(f"{key}:{own[key]}" for key, usual in OF_SCENE.items() if own[key] != usual)]
    for name, options in (own[part] for part in ("builder", "collider") if part in own):
        words += [name] * (name != "none") + [f"{key}:{value}" for key, value in options]
    words += [f"{key}:{value}" for key, value in own.get("accuracy", {}).items()]
    words += ["refit"] * (own["operation"] == "refit") + ["sorted-leaves"] * cell.starts_from_leaves
    words += [f"swept:{own['swept'][0]}", f"to_frame:{own['swept'][1]}"] if cell.swept else [f"features:{own['swept'][0]}"] * bool(cell.features)
    words += [own["caches"]] * (own["caches"] != "hot")
    return "/".join(str(word).replace(" ", "_") for word in words)


def names_of(cells: list[Owned]) -> list[str]:
    """Returns a different name for each cell. A cell that several files have gets its file's name as well, and one that a file
    has several times a number from its second time on."""
    names = [name_of(cell) for _, cell in cells]
    files = {name: len({id(run) for run, _ in those}) for name, those in grouped(cells, lambda one: name_of(one[1])).items()}
    runs = {id(run): run for run, _ in cells}
    titles = dict(zip(runs, input_files.titles_of([run.path for run in runs.values()]), strict=True))
    names = [f"{name}/file:{titles[id(run)]}" if files[name] > 1 else name for name, (run, _) in zip(names, cells, strict=True)]
    times: dict[str, int] = {}
    numbered = []
    for name in names:
        times[name] = times.get(name, 0) + 1
        numbered.append(name if times[name] == 1 else f"{name}/again:{times[name]}")
    return numbered
