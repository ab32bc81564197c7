"""What was run on what: the circumstances of a result file, in words."""
from typing import Any


def binary(count: float) -> str:
    for unit in ("bytes", "KiB", "MiB", "GiB"):
        if count < 1024 or unit == "GiB":
            return f"{count:,.4g} {unit}"
        count /= 1024
    raise AssertionError


def facts_of(document: dict[str, Any]) -> list[tuple[str, str]]:
    run = document["run"]
    program, host, device = run["program"], run["host"], run["device"]
    tuning, costs = run.get("tuning"), run.get("node_costs")
    facts = [
        ("Command", " ".join(run["command"])),
        ("Run", f"{run['id']}, from {run['started_at']} to {run.get('finished_at', 'no end: it was stopped, or goes on')}"),
        ("Program", f"bvhbench {program['version']}, commit {program['commit']}{' with local changes' if program['dirty'] else ''}, "
                    f"{program['build_type']} build, {program['compiler']}, -march={program['arch']}, kernels {program['kernels']}"),
        ("Machine", f"{host['name']}: {host['cpu']}, {host['threads']} threads, {host['os']}"),
        ("Device", f"{device['name']} ({device['kind']}), {device['compute_units']} compute units, "
                   f"{binary(device['global_memory_bytes'])} of memory, {binary(device['local_memory_bytes'])} local, "
                   f"groups of up to {device['max_group_size']}, timer resolution {device['timer_resolution_ns']} ns"),
        ("Driver", f"{device['platform']}, {device['driver']}, {device['opencl']}, {device['opencl_c']}"),
        ("Libraries", ", ".join(f"{name} {version}" for name, version in run["libraries"].items()))]
    if "copy_rate_bytes_per_s" in run:
        over = f", over buffers of {binary(run['copy_rate_buffer_bytes'])}" if "copy_rate_buffer_bytes" in run else ""
        facts.append(("Copy rate", f"{run['copy_rate_bytes_per_s'] / 1e9:,.4g} GB/s read and written{over}"))
    if "launch_cost_ns" in run:
        facts.append(("A launch", f"{run['launch_cost_ns'] / 1e3:.4g} µs with next to nothing to do"))
    if "compile_ns" in run:
        facts.append(("Compiling kernels", f"{run['compile_ns'] / 1e9:.4g} s, in no sample"))
    if tuning:
        values = ", ".join(f"{name} {value}" for name, value in tuning["values"].items())
        facts.append(("Tuning", f"{tuning['from']}" + (f": {values}" if values else "")))
    if costs:
        facts.append(("Costs in sah_cost and epo", f"an inner node {costs['inner']:g}, a triangle {costs['triangle']:g}"))
    facts.append(("Result format", document["format"]))
    return facts


def sentence_of(document: dict[str, Any]) -> str:
    run = document["run"]
    program, device = run["program"], run["device"]
    where = f", of {run['host']['cpu']}" if device["kind"] == "cpu" and run["host"]["cpu"] not in device["name"] else ""
    return (f"{device['name']}{where}, driver {device['driver']}, {device['opencl_c']}; commit {program['commit'][:10]}"
            f"{' with local changes' if program['dirty'] else ''}; {run['started_at']}")


def warnings_of(document: dict[str, Any]) -> list[str]:
    """What makes numbers worth less, a sentence each."""
    run = document["run"]
    program = run["program"]
    told = [(program["dirty"], "The program had changes that are in no commit."),
            (program["build_type"] != "Release", f"The program was a {program['build_type']} build: its times are not those of a release."),
            ("finished_at" not in run, "The run has no end: it was stopped, or goes on. What is missing was not measured."),
            (run["device"]["kind"] == "cpu", "Kernels ran on a processor: times say nothing about a GPU.")]
    return [sentence for is_so, sentence in told if is_so]
