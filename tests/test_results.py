#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The scripts that read result files of swivel_bench, as people run them: plot.py, tables.py, pages.py, record.py and
in_turns.py. The pages that show results show those of bench/results."""
import importlib.util
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BENCH = Path(__file__).resolve().parent.parent / "bench"
LEVELS = ["L1", "L2", "L3", "memory"]


def result(ns):
    """A result with one aggregate and two rounds of each benchmark; ns: nanoseconds an arm by name."""
    entries = []
    for name, value in ns.items():
        entries += [{"run_name": name, "run_type": "iteration", "time/arm": value * 3e-9},
                    {"run_name": name, "run_type": "aggregate", "aggregate_name": "mean", "time/arm": value * 2e-9},
                    {"run_name": name, "run_type": "aggregate", "aggregate_name": "median", "time/arm": value * 1e-9}]
    return {"context": {"cpu": "A", "isas": "avx2 sse2", "commit": "abc"}, "benchmarks": entries}


def full_result():
    ns = {f"growth/{isa}/{10 ** n}": 10.0 + n for isa in ("avx2", "sse2") for n in range(8)}
    ns |= {f"P/{isa}/{level}": 5.0 for isa in ("avx2", "sse2") for level in LEVELS}
    ns |= {"limits/full_arm/free/0/avx2": 4.0} | {f"limits/full_arm/{kind}/{share}/avx2": 4.0 + share for share in (5, 14, 50, 100)
                                                  for kind in ("limited", "infeasible")}
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

    def bench(self, name, document, more=""):
        """A program that writes this result where swivel_bench would."""
        path = self.folder / name
        path.write_text(f"#!{sys.executable}\nimport sys\n{more}\n"
                        "out = next(a for a in sys.argv if a.startswith('--benchmark_out='))\n"
                        f"open(out.split('=')[1], 'w').write({json.dumps(document)!r})\n", encoding="utf-8")
        path.chmod(0o755)
        return str(path)

    def run_script(self, script, *arguments):
        return subprocess.run([sys.executable, str(BENCH / script), *arguments], capture_output=True, text=True, check=False)

    def require_refused(self, script, said, *arguments):
        run = self.run_script(script, *arguments)
        self.assertEqual((run.returncode, run.stdout), (2, ""), run.stderr)
        self.assertIn(said, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_refused_input(self):
        self.require_refused("tables.py", "No such file", str(self.folder / "missing.json"))
        self.require_refused("tables.py", "not JSON", self.file("text.json", "ns"))
        self.require_refused("tables.py", "not a result", self.file("list.json", "[]"))
        self.require_refused("tables.py", "no benchmark", self.file("empty.json", result({})))
        self.require_refused("plot.py", "no growth/", self.file("good.json", result({"x": 1})))
        self.require_refused("record.py", "not a name", "../elsewhere")
        for script in ("plot.py", "tables.py", "pages.py", "record.py", "in_turns.py"):
            self.assertIn("usage:", self.run_script(script, "--help").stdout)

    def test_tables(self):
        ns = {"P/avx512/L2": 2.0, "P/avx2/L2": 3.0, "loop_trig/v4": 6.8, "loop_trig/v3": 6.0, "single_glm/v4": 1.5, "hand/avx512": 1.9,
              "P/avx512/memory": 3.0, "copy/P/memory": 2.4, "calls/here/avx512/16": 190.0, "calls/hand/avx512/16": 30.0,
              "calls/here/avx512/64": 110.0, "calls/hand/avx512/64": 125.0, "threads/1/resident/memory": 3.0, "threads/2/resident/memory": 2.0,
              "bound/avx512/divider": 1.3, "bound/avx512/arithmetic": 1.2, "bound/avx2/divider": 0.9, "bound/avx2/arithmetic": 1.0,
              "bodies/avx512": 130.0, "bodies_one_limb/avx512": 49.0, "bodies_from_rows/avx512": 110.0, "bodies/copy": 10.0, "bodies_glm/v4": 660.0,
              "bound_forward/avx512/divider": 0.1, "bound_forward/avx512/arithmetic": 11.0, "bound_limbs/avx512/divider": 60.0,
              "bound_limbs/avx512/arithmetic": 44.0, "bodies_threads/2": 66.0, "bodies_processes/2": 60.0, "character/avx512/legs": 120.0, "character/avx512/all": 260.0,
              "bound_character/avx512/divider": 200.0, "bound_character/avx512/arithmetic": 150.0, "character_glm/v4": 1300.0}
        document = result(ns)
        document["context"] |= {"isas": "avx512 avx2", "level_of/v4": "avx512", "level_of/v3": "avx2"}
        run = self.run_script("tables.py", self.file("few.json", document))
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        rows = {tuple(re.split(r"  +", line)[:-2]): re.split(r"  +", line)[-2:] for line in run.stdout.splitlines()}
        for row, end in {("P in cache", "AVX-512", "2.00", "loop with two acos", "6.80", "3.4"): ["3.3", "kept"],
                         ("P in cache", "AVX2", "3.00", "loop with two acos", "6.00", "2.0"): ["3.3", "missed"],
                         ("P in cache, AVX-512", "2.00", "bound of the ports", "1.30", "1.54"): ["1.6", "kept"],
                         ("P in cache, AVX2", "3.00", "bound of the ports", "1.00", "3.00"): ["2", "missed"],
                         ("P in cache, AVX-512", "2.00", "the same stages by hand", "1.90", "1.05"): ["1.05", "missed"],
                         ("P out of cache, AVX-512", "3.00", "copy of its rows", "2.40", "1.25"): ["1.2", "missed"],
                         ("16, AVX-512", "190", "30.0", "+160", "150", "missed"): ["–", "–"],
                         ("64, AVX-512", "110", "125", "-15", "150", "kept"): ["–", "–"],
                         ("resident, in memory", "2", "3.00"): ["2.00", "1.50"],
                         ("bodies", "AVX-512", "130", "glm, one body at a time", "660", "5.1"): ["5", "kept"],
                         ("poses in, forward kinematics, AVX-512: 17%", "22.0", "bound of the ports", "11.0"): ["2.00", "–"],
                         ("goals in, AVX-512: 15%", "20.0", "–", "–"): ["–", "–"],
                         ("four limbs, joints out, AVX-512: 68%", "88.0", "bound of the ports", "60.0"): ["1.47", "–"],
                         ("all, AVX-512", "130", "both bounds and a copy", "81.0", "1.60"): ["1.5", "missed"],
                         ("all, AVX-512", "130", "the goal", "110", "1.18"): ["1", "missed"],
                         ("legs alone, AVX-512", "120", "–", "–"): ["–", "–"],
                         ("a character, AVX-512", "260", "its stages' bounds", "200", "1.30"): ["1.5", "kept"],
                         ("a character, AVX-512", "260", "the goal", "200", "1.30"): ["1", "missed"],
                         ("characters", "AVX-512", "260", "glm, one at a time", "1300"): ["5.0", "–"],
                         ("all, two threads", "66.0", "two processes side by side", "60.0", "1.10"): ["1.11", "kept"]}.items():
            self.assertEqual(rows.get(row), end, run.stdout)
        self.assertNotIn("whole frame", run.stdout)  # it was not measured
        # Without a goal, a rival that is faster is told; and a goal that the bound rules out is none.
        document["benchmarks"] = result({"P/avx2/L2": 3.0, "loop_light/v3": 2.0, "loop_trig/v3": 6.0, "bound/avx2/divider": 2.0,
                                         "bound/avx2/arithmetic": 1.0})["benchmarks"]
        said = self.run_script("tables.py", self.file("less.json", document)).stdout
        self.assertRegex(said, r"loop with one acos +2\.00 +0\.7 +– +\*\*swivel loses")
        self.assertRegex(said, r"loop with two acos +6\.00 +2\.0 +–\n")
        # Where the bound is not known, the goal stays.
        document["benchmarks"] = result({"P/avx2/L2": 3.0, "loop_trig/v3": 6.0, "bound/avx2/divider": 2.0})["benchmarks"]
        said = self.run_script("tables.py", self.file("no_bound.json", document)).stdout
        self.assertRegex(said, r"loop with two acos +6\.00 +2\.0 +3\.3 +missed\n")

    def test_pages(self):
        self.file("cpu.json", full_result())
        page = self.file("page.md", "Text.\n\n<!-- bench: held cpu -->\nold\n<!-- bench end -->\n\nMore.\n")
        options = ("--page", page, "--results", str(self.folder))
        self.assertEqual(self.run_script("pages.py", "--check", *options).returncode, 1)
        if importlib.util.find_spec("matplotlib"):
            self.assertEqual(self.run_script("pages.py", *options).returncode, 0)
            self.assertEqual(self.run_script("pages.py", "--check", *options).returncode, 0)
            text = Path(page).read_text(encoding="utf-8")
            self.assertIn("| full arm, limited | 4.00 | 9.00 | 18.0 | 54.0 | 104 |", text)
            self.assertTrue(text.startswith("Text.\n\n<!-- bench: held cpu -->\n") and text.endswith("<!-- bench end -->\n\nMore.\n"))
        for wrong, said in (("<!-- bench: none cpu -->\n<!-- bench end -->\n", "no table none"), ("<!-- bench: held cpu -->\n", "not well-formed"),
                            ("<!-- bench: held gone -->\n<!-- bench end -->\n", "No such file")):
            self.require_refused("pages.py", said, "--page", self.file("wrong.md", wrong), "--results", str(self.folder))

    def test_pages_of_sentences(self):
        for name, ns in (("a", 2.5), ("b", 3.5)):
            document = full_result()
            document["benchmarks"] += result({"P/avx2/L2": ns})["benchmarks"]
            self.file(f"{name}.json", document)
        sentence = "An arm takes <!-- bench: arm b -->{}<!-- bench end -->.\n"
        says = sentence.format("3.50 nanoseconds on one core with AVX2")
        table = "<!-- bench: summary b -->\n<!-- bench end -->\n"
        options = ("--check", "--results", str(self.folder), "--page")
        for page, code in ((says, 0), (sentence.format("2.50 nanoseconds on one core with AVX2"), 1), (says + table, 1)):
            run = self.run_script("pages.py", *options, self.file("page.md", page))
            self.assertEqual(run.returncode, code, run.stderr)
        self.require_refused("pages.py", "no sentence held", *options[1:], self.file("page.md", sentence.format("").replace("arm b", "held b")))
        self.require_refused("pages.py", "features/at_rest/avx2", *options[1:],
                             self.file("page.md", sentence.format("").replace("arm b", "answer b")))

    def test_record_without_ozz(self):
        run = self.run_script("record.py", "cpu", "--busy", "--binary", self.bench("swivel_bench", full_result()), "--results", str(self.folder), "--page",
                              self.file("page.md", "No block.\n"))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stderr, "^note: this build has no ozz-animation.*\n$")
        self.assertIn('"run_name": "P/avx2/L2"', (self.folder / "cpu.json").read_text(encoding="utf-8"))

    def test_the_pages_show_their_results(self):
        run = self.run_script("pages.py", "--check")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_in_turns(self):
        turns = self.folder / "turns"
        binaries = [self.bench(name, result({"P": ns, name: 1.0}), f"open({str(turns)!r}, 'a').write('{name} ')")
                    for name, ns in (("old", 2.0), ("new", 2.1))]
        run = self.run_script("in_turns.py", *binaries, "--rounds", "2")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertRegex(run.stdout, r"P +2\.00 +2\.10 +1\.050 +1\.05 +1\.05  slower\n1 of 1 rows")
        self.assertEqual(turns.read_text(encoding="utf-8"), "old new new old ")
        self.assertEqual(self.run_script("in_turns.py", *reversed(binaries), "--rounds", "1").returncode, 0)
        self.require_refused("in_turns.py", "No such file", "/nowhere", binaries[0])

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "python3-matplotlib is not installed")
    def test_pictures(self):
        path = self.file("full.json", full_result())
        pictures = []
        for _ in range(2):
            run = self.run_script("plot.py", path, "--out", str(self.folder))
            self.assertEqual(run.returncode, 0, run.stderr)
            pictures.append([(self.folder / name).read_text(encoding="utf-8") for name in ("speed.svg", "roofline.svg", "limits.svg")])
        self.assertEqual(pictures[0], pictures[1])
        for picture in pictures[0]:
            self.assertIn("<svg", picture)
            self.assertNotIn("<dc:date>", picture)
        broken = full_result()
        del broken["context"]["flops_per_ns/avx2"]
        self.require_refused("plot.py", "flops_per_ns/avx2", self.file("broken.json", broken))


if __name__ == "__main__":
    unittest.main()
