# SPDX-License-Identifier: MIT
"""Reads result files of swivel_bench."""
import json
from statistics import median

UNITS = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}


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
    """The nanoseconds of each benchmark: an arm where it says so, otherwise a call."""
    medians, rounds = {}, {}
    for entry in read_document(path)["benchmarks"]:
        name = entry.get("run_name", entry.get("name")).removesuffix("/real_time")
        if entry.get("error_occurred"):
            continue
        if entry.get("run_type") != "aggregate":
            rounds.setdefault(name, []).append(nanoseconds(path, entry))
        elif entry.get("aggregate_name") == "median":
            medians[name] = nanoseconds(path, entry)
    for name, values in rounds.items():
        medians.setdefault(name, median(values))
    if not medians:
        raise Refused(f"{path}: no benchmark in it has a time")
    return medians
