#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The scripts that read result files of swivel_bench, as people run them: bench/compare.py and bench/plot.py."""
import importlib.util
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BENCH = Path(__file__).resolve().parent.parent / "bench"
LEVELS = ["L1", "L2", "L3", "memory"]


def result(ns, cpu="A"):
    """A result with one aggregate and two rounds of each benchmark; ns: nanoseconds an arm by name."""
    entries = []
    for name, value in ns.items():
        entries += [{"run_name": name, "run_type": "iteration", "time/arm": value * 3e-9},
                    {"run_name": name, "run_type": "aggregate", "aggregate_name": "mean", "time/arm": value * 2e-9},
                    {"run_name": name, "run_type": "aggregate", "aggregate_name": "median", "time/arm": value * 1e-9}]
    return {"context": {"cpu": cpu, "isas": "avx2 sse2", "commit": "abc"}, "benchmarks": entries}


def full_result():
    ns = {f"growth/{isa}/{10 ** n}": 10.0 + n for isa in ("avx2", "sse2") for n in range(8)}
    ns |= {f"P/{isa}/{level}": 5.0 for isa in ("avx2", "sse2") for level in LEVELS}
    full = result(ns)
    full["context"] |= {f"copy_bytes_per_ns/{level}": "50" for level in LEVELS}
    full["context"] |= {"flops_per_ns/avx2": "100", "flops_per_ns/sse2": "50", "row_bytes": "60"}
    full["context"] |= {f"ops/{kind}": "40" for kind in ("roots", "divisions", "multiplications", "additions")}
    return full


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        return str(path)

    def run_script(self, script, *arguments):
        return subprocess.run([sys.executable, str(BENCH / script), *arguments], capture_output=True, text=True, check=False)

    def require_refused(self, script, said, *arguments):
        run = self.run_script(script, *arguments)
        self.assertEqual((run.returncode, run.stdout), (2, ""), run.stderr)
        self.assertIn(said, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_ratio_of_medians(self):
        old = self.file("old.json", result({"P/avx2/L1": 2, "same": 3, "gone": 1}))
        new = self.file("new.json", result({"P/avx2/L1": 2.5, "same": 3.1, "came": 1}))
        run = self.run_script("compare.py", old, new)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, r"P/avx2/L1 +2\.000 +2\.500 +1\.250  slower\n")
        self.assertRegex(run.stdout, r"same +3\.000 +3\.100 +1\.033\n")
        self.assertIn("only in the old file: gone\n", run.stdout)
        self.assertIn("only in the new file: came\n", run.stdout)
        self.assertIn("1 moved by more than 5 %, 1 of them slower", run.stdout)
        self.assertEqual(self.run_script("compare.py", old, new, "--fail").returncode, 1)
        self.assertEqual(self.run_script("compare.py", new, old, "--fail").returncode, 0)
        self.assertIn("\n0 moved", self.run_script("compare.py", old, new, "--threshold", "30").stdout)

    def test_rounds_without_aggregates(self):
        rounds = {"context": {"cpu": "A"}, "benchmarks": [
            {"run_name": "x", "run_type": "iteration", "cpu_time": value, "time_unit": "us"} for value in (1, 9, 2)]}
        path = self.file("rounds.json", rounds)
        self.assertRegex(self.run_script("compare.py", path, path).stdout, r"x +2000\.000 +2000\.000 +1\.000\n")

    def test_refused_input(self):
        good, other = self.file("good.json", result({"x": 1})), self.file("other.json", result({"x": 1}, cpu="B"))
        self.require_refused("compare.py", "different CPUs, A and B", good, other)
        self.assertEqual(self.run_script("compare.py", good, other, "--other-cpu").returncode, 0)
        self.require_refused("compare.py", "No such file", good, str(self.folder / "missing.json"))
        self.require_refused("compare.py", "not JSON", good, self.file("text.json", "ns"))
        self.require_refused("compare.py", "not a result", self.file("list.json", "[]"), good)
        self.require_refused("compare.py", "no benchmark", self.file("empty.json", result({})), good)
        self.require_refused("plot.py", "no growth/", good)
        for script in ("compare.py", "plot.py"):
            self.assertIn("usage:", self.run_script(script, "--help").stdout)

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "python3-matplotlib is not installed")
    def test_pictures(self):
        path = self.file("full.json", full_result())
        pictures = []
        for _ in range(2):
            run = self.run_script("plot.py", path, "--out", str(self.folder))
            self.assertEqual(run.returncode, 0, run.stderr)
            pictures.append([(self.folder / name).read_text(encoding="utf-8") for name in ("speed.svg", "roofline.svg")])
        self.assertEqual(pictures[0], pictures[1])
        for picture in pictures[0]:
            self.assertIn("<svg", picture)
            self.assertNotIn("<dc:date>", picture)
        broken = full_result()
        del broken["context"]["flops_per_ns/avx2"]
        self.require_refused("plot.py", "flops_per_ns/avx2", self.file("broken.json", broken))


if __name__ == "__main__":
    unittest.main()
