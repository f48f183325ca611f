#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""bench/in_turns.py, as people run it: it runs two builds of swivel_bench in turns and reads their result files."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent.parent / "bench/in_turns.py"


def result(ns):
    """A result with one aggregate and two rounds of each benchmark; ns: nanoseconds an arm by name."""
    entries = []
    for name, value in ns.items():
        entries += [{"run_name": name, "run_type": "iteration", "time/arm": value * 3e-9},
                    {"run_name": name, "run_type": "aggregate", "aggregate_name": "mean", "time/arm": value * 2e-9},
                    {"run_name": name, "run_type": "aggregate", "aggregate_name": "median", "time/arm": value * 1e-9}]
    return {"context": {"cpu": "A"}, "benchmarks": entries}


class InTurns(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def bench(self, name, content, more=""):
        """A program that writes this result where swivel_bench would."""
        path = self.folder / name
        text = content if isinstance(content, str) else json.dumps(content)
        path.write_text(f"#!{sys.executable}\nimport sys\n{more}\n"
                        "out = next(a for a in sys.argv if a.startswith('--benchmark_out='))\n"
                        f"open(out.split('=')[1], 'w').write({text!r})\n", encoding="utf-8")
        path.chmod(0o755)
        return str(path)

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, str(SCRIPT), *arguments], capture_output=True, text=True, check=False)

    def require_refused(self, said, *arguments):
        run = self.run_script(*arguments)
        self.assertEqual((run.returncode, run.stdout), (2, ""), run.stderr)
        self.assertIn(said, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_refused_input(self):
        good = self.bench("good", result({"P": 1}))
        self.require_refused("No such file", "/nowhere", good)
        for name, content, said in (("text", "ns", "not JSON"), ("list", "[]", "not a result"), ("empty", result({}), "no benchmark")):
            self.require_refused(said, self.bench(name, content), good)
        self.require_refused("failed: it ends", self.bench("broken", result({"P": 1}), "sys.exit('it ends')"), good)
        self.assertIn("usage:", self.run_script("--help").stdout)

    def test_rounds(self):
        turns = self.folder / "turns"
        binaries = [self.bench(name, result({"P": ns, name: 1.0}), f"open({str(turns)!r}, 'a').write('{name} ')")
                    for name, ns in (("old", 2.0), ("new", 2.1))]
        run = self.run_script(*binaries, "--rounds", "2")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertRegex(run.stdout, r"P +2\.00 +2\.10 +1\.050 +1\.05 +1\.05  slower\n1 of 1 rows")
        self.assertEqual(turns.read_text(encoding="utf-8"), "old new new old ")
        self.assertEqual(self.run_script(*reversed(binaries), "--rounds", "1").returncode, 0)


if __name__ == "__main__":
    unittest.main()
