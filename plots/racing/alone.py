"""Measures the winner of a race alone, by the command that `best` prints, and compares the time with the race's."""
import shlex
from collections.abc import Iterator

from ..program import child
from ..read import ranking, ranking_text, results
from ..words.tables import duration
from .plan import Plan


def lines(plan: Plan, found: ranking.Ranking, race: results.Run) -> Iterator[str]:
    """Yields two lines for each scene: the command, and whether the intervals of its time and of the race's overlap, or what differs.
    Ends with the code of a command that fails."""
    best = ranking.chosen(found.rows)
    for scene in plan.scenes if best else ():
        options = plan.query | {key: value for key, value in scene.items() if key != "scene"}
        words = [word for key, value in options.items() for word in ("--" + key.replace("_", "-"), value) if word != "true"]
        line = ranking_text.repeated(best, scene["scene"], [*words, *plan.words])
        yield f"again, alone: {line}"
        rows = [row for rows in found.scenes.values() for row in rows if ranking.method(row.first) == ranking.method(best.first)
                and scene["scene"] in (row.first.scene_facts["name"], row.first.stand_in_for)]
        for row in rows[:1]:  # none, if all of the scene was skipped
            alone = results.Run(race.path, child.answer([*shlex.split(line)[1:], "--json", "/dev/stdout", "--quiet"]))
            yield f"    {compared(alone, row, found, race)}"


def compared(run: results.Run, row: ranking.Row, found: ranking.Ranking, race: results.Run) -> str:
    """Returns the time of the only row of a run beside that of a row of the race, and what else differs if their intervals do not overlap."""
    alone, measure = ranking.ranked(run.all_cells, found.objective).rows[0], ranking.Measure(found.objective, found.by_wall)
    (low, high), (own_low, own_high) = ranking.band(row, measure), ranking.band(alone, measure)
    said, of_race = f"{duration(own_low)} to {duration(own_high)}", f"the race's, {duration(low)} to {duration(high)}"
    if own_low <= high and low <= own_high:
        return f"{said}, within the noise of {of_race}"
    busy = [one.facts.get("conditions", {}).get("other_processes", 0) for one in (run, race)]
    return (f"{said}, not {of_race}: the machine copied {(run.copy_rate or 1) / (race.copy_rate or 1):.2f} times as fast as then, beside "
            f"{busy[0]:.1f} other processes, then {busy[1]:.1f}; and alone, no other candidate runs between samples")
