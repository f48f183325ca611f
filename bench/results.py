# SPDX-License-Identifier: MIT
"""Reads result files of swivel_bench. Knows no table and no picture."""
import json
from statistics import median

UNITS = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}
NOTES = ("limited", "infeasible", "hard", "arms/call", "bytes/arm")  # counters that rows have beside their time


class Refused(Exception):
    """What is wrong with the input, in one line."""


def read_document(path):
    try:
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
    except OSError as error:
        raise Refused(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise Refused(f"{path}: not JSON ({error}); write it with --benchmark_out={path}") from error
    if not isinstance(document, dict) or "context" not in document or "benchmarks" not in document:
        raise Refused(f"{path}: not a result of Google Benchmark; write it with swivel_bench --benchmark_out={path}")
    return document


def nanoseconds(path, entry):
    if "time/arm" in entry:
        return entry["time/arm"] * 1e9
    try:
        return entry["cpu_time"] * UNITS[entry["time_unit"]]
    except KeyError as error:
        raise Refused(f"{path}: benchmark {entry.get('name')} has no {error}") from error


def read_results(path):
    """The file's context, and the nanoseconds of each benchmark: an arm where it says so, otherwise a call."""
    context, times, _ = read_all(path)
    return context, times


def read_all(path):
    """The same, and the notes of each benchmark."""
    document = read_document(path)
    medians, rounds, notes = {}, {}, {}
    for entry in document["benchmarks"]:
        name = entry.get("run_name", entry.get("name")).removesuffix("/real_time")
        if entry.get("error_occurred"):
            continue
        if entry.get("run_type") != "aggregate":
            rounds.setdefault(name, []).append(nanoseconds(path, entry))
        elif entry.get("aggregate_name") == "median":
            medians[name] = nanoseconds(path, entry)
        else:
            continue
        notes[name] = {note: entry[note] for note in NOTES if note in entry}
    for name, values in rounds.items():
        medians.setdefault(name, median(values))
    if not medians:
        raise Refused(f"{path}: no benchmark in it has a time")
    return document["context"], medians, notes


def write_short(path):
    """Leaves in a result file what is read of it: the context and each benchmark's median, a line each."""
    document = read_document(path)
    document["context"].pop("host_name", None)
    kept = [{key: value for key, value in entry.items() if key in ("run_name", "run_type", "aggregate_name", "time/arm", *NOTES)}
            for entry in document["benchmarks"] if entry.get("aggregate_name") == "median"]
    lines = ",\n".join("    " + json.dumps(entry) for entry in kept)
    context = json.dumps(document["context"], indent=2).replace("\n", "\n  ")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f'{{\n  "context": {context},\n  "benchmarks": [\n{lines}\n  ]\n}}\n')
