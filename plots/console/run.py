"""Prints the circumstances of a run."""
from ..read import results
from ..words.tables import counted, duration

NEAREST = ", the nearest"  # how the origin of values of another device ends


def text(run: results.Run) -> str:
    facts = run.facts
    device, program, memory, tuning = facts["device"], facts["program"], facts.get("host_memory"), facts.get("tuning", {})
    changes = " " + results.changes_text(program) if program["dirty"] and program["commit"] != "unknown" else ""
    lines = [f"device: {device['platform']}/{device['name']}, driver {device['driver']}",
             f"program: {program['version']}, commit {program['commit']}{changes}, "
             f"{program['build_type']}"]
    lines += warnings(run).splitlines()
    lines += [f"NO RESULT: made under the test hook {hook}={value}" for hook, value in facts.get("test_hooks", {}).items()]
    if memory:
        lines.append("memory: {} MiB at most, {} predicted, {} given".format(
            *(memory[key] >> 20 for key in ("peak_bytes", "predicted_bytes", "given_bytes"))))
    if facts.get("launch_cost_ns"):
        lines.append(f"launch cost: {duration(facts['launch_cost_ns'])}")
    if tuning.get("values"):
        values = " ".join(f"{name}={value}" for name, value in sorted(tuning["values"].items()))
        lines.append(f"tuned by {tuning['from']}: {values}")
    if run.copy_rate:
        lines.append(f"copy rate: {run.copy_rate * 1e-9:.1f} GB/s, read plus written")
    if run.costs != results.USUAL_COSTS:
        lines.append("costs in sah_cost and epo: " + results.costs_text(run.costs))
    return "".join(f"{line}\n" for line in lines)


def warnings(run: results.Run) -> str:
    """Returns a line for each circumstance that makes times longer or uncertain."""
    return "".join(f"warning: {warning}\n" for warning in run.facts.get("conditions", {}).get("warnings", []))


def untuned(run: results.Run) -> str:
    """Returns a line if the numbers that kernels are cut up by were not found on this device; empty if they were."""
    origin = run.facts.get("tuning", {}).get("from", "none")
    if origin != "none" and not origin.endswith(NEAREST):
        return ""
    whose = "the defaults" if origin == "none" else f"from {origin}"
    return f"not tuned on this device: values are {whose}; `bvhbench tune` searches better ones (docs/tuning.md)\n"


def merged(run: results.Run) -> str:
    """Returns the number of runs of a merged file, its hosts, and its devices and commits if several; empty for other files."""
    sources = run.document.get("merged_from", [])
    if not sources:
        return ""
    hosts = sorted({source["host"] for source in sources})
    devices = sorted({f"{source['device']}, driver {source['driver']}" for source in sources})
    commits = sorted({source["commit"][:10] + (" with changes" if source["dirty"] else "") for source in sources})
    text = f"merged from {counted(len(sources), 'run')} on {'; '.join(hosts)}"
    text += f"\nof several devices:  {'; '.join(devices)}" if len(devices) > 1 else ""
    text += f"\nof several commits:  {'; '.join(commits)}" if len(commits) > 1 else ""
    return f"{text}\n"
