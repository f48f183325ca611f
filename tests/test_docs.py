#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The documentation's pages. mkdocs builds them without a warning, so their links lead to pages; anchors exist, too, and nothing is fetched
from elsewhere. The reference has every public name of its headers, and every feature has its how-to. What the README points at is there."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools/site"))
import api_page  # noqa: E402
import snippets  # noqa: E402

DOCS = ROOT / "docs"
FETCHED = {("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("link", "href")}
NOT_FETCHED = {"canonical", "next", "prev", "edit"}  # rel of links that only say where something is


class Page(HTMLParser):
    """A page's anchors, the links of its own text, and what it fetches."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.fetched = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if "id" in values:
            self.anchors.add(values["id"])
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        for key, value in attributes:
            if (tag, key) in FETCHED and value and values.get("rel") not in NOT_FETCHED:
                self.fetched.append(value)


def build(folder):
    if not shutil.which("mkdocs"):
        raise RuntimeError("mkdocs is missing; run: tools/setup mkdocs mkdocs-material libjs-katex nodejs")
    return subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--site-dir", folder], cwd=ROOT, capture_output=True, text=True,
                          env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"})


class Programs(unittest.TestCase):
    """What pages show is what docs_snippets and the tests of examples build and run."""

    def test_pages_show_the_programs_that_are_tested(self):
        for page in DOCS.rglob("*.md"):
            with self.subTest(page=page.relative_to(ROOT)):
                snippets.check(page.read_text(encoding="utf-8"), ROOT)

    def test_every_program_is_shown(self):
        text = "".join(page.read_text(encoding="utf-8") for page in DOCS.rglob("*.md"))
        for program in [*(DOCS / "snippets").glob("*.cpp"), *(ROOT / "examples").glob("*.c*")]:
            for part in re.findall(r"// \[(\w+)\]", program.read_text(encoding="utf-8")):
                if part != "end":
                    name = str(program.relative_to(ROOT)) + ("" if part == "shown" else f": {part}")
                    self.assertIn(f"<!-- {name} -->\n", text, "shown on no page")


class Readme(unittest.TestCase):
    """What the README points at is there, and it shows the program that the tests build and run."""

    def setUp(self):
        self.text = (ROOT / "README.md").read_text(encoding="utf-8")

    def test_it_shows_the_program_that_is_tested(self):
        hello = (ROOT / "examples/hello.cpp").read_text(encoding="utf-8")
        self.assertIn(f"```cpp\n{snippets.part_of(hello, 'examples/hello.cpp', 'shown')}\n```", self.text)

    def test_links_lead_to_files(self):
        for page in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "SECURITY.md", ROOT / "examples/README.md"):
            for link in re.findall(r"\]\(([^)#:]+)", page.read_text(encoding="utf-8")):
                self.assertTrue((page.parent / link).exists(), f"{page.relative_to(ROOT)}: {link}")

    def test_the_tests_that_prove_a_promise_exist(self):
        tests = ROOT / "tests"
        rules = "".join(file.read_text(encoding="utf-8") for file in tests.rglob("CMakeLists.txt") if "node_modules" not in file.parts)
        names = {file.stem.removeprefix("test_") for kind in ("cpp", "py") for file in tests.glob(f"**/test_*.{kind}")}
        names |= {file.stem for file in tests.glob("*.cmake")}
        names |= {f"{file.parent.name}_{file.stem.removeprefix('test_')}" for file in tests.glob("**/test_*.py")}
        names |= set(re.findall(r"\bNAME (\w+)", rules))
        names |= {f"{platform}_digest" for platform in re.findall(r"swivel_platform\((\w+)", rules)}
        count = 0
        for page in (DOCS / "features.md", DOCS / "determinism.md", ROOT / "SECURITY.md"):
            column = None
            for line in page.read_text(encoding="utf-8").splitlines():
                cells = [cell.strip() for cell in line.split("|")]
                if not line.startswith("|"):
                    column = None
                elif column is None:
                    column = next((n for n, cell in enumerate(cells) if cell in ("test", "proved by")), 0)
                elif column and cells[column].strip("-"):
                    for name in re.findall(r"`(\w+)`", cells[column]):
                        count += 1
                        self.assertIn(name, names, f"{page.name}: {cells[1]}")
        self.assertGreater(count, 100)

    def test_security_has_what_it_names(self):
        self.assertIn("](SECURITY.md)", self.text)
        text = (ROOT / "SECURITY.md").read_text(encoding="utf-8")
        for program in re.findall(r"`((?:tools|tests)/[\w/]+)", text):
            self.assertTrue((ROOT / program).exists(), program)
        fuzzer = (ROOT / "tests/fuzz/fuzz_formats.cpp").read_text(encoding="utf-8")
        for reader in re.search(r"\*\*Files of motion and tables: (.*?)\.\*\*", text)[1].split(", "):
            name = {"crowd files (TOML)": "crowd", "targets (CSV)": "targets", "contacts (CSV)": "contacts", "heights (PNG)": "heights", "GLB": "gltf"}.get(reader, reader.lower())
            self.assertRegex(fuzzer, rf"{{'.', check_{name}", f"nothing tries {reader}")
        self.assertIn("sha256sum -- * >SHA256SUMS", (ROOT / "tools/release/build").read_text(encoding="utf-8"))

    def test_the_files_to_the_elbow_have_what_it_says(self):
        steps = re.findall(r"^\d\. (.*)$", (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"), re.M)
        self.assertEqual(len(steps), 4)
        for step in steps:
            code = "".join((ROOT / file).read_text(encoding="utf-8") for file in re.findall(r"\]\((.*?)\)", step))
            for name in re.findall(r"`(.*?)`", step):
                self.assertIn(name, code, step)


class Docs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="swivel_docs_"))
        result = build(cls.folder)
        if result.returncode or re.search("WARNING|ERROR", result.stderr):  # nothing else is worth a look then
            raise RuntimeError("the pages do not build without a warning:\n" + result.stderr)
        cls.pages = {path: Page(path.read_text(encoding="utf-8")) for path in cls.folder.rglob("*.html")}
        cls.code = re.sub(r"//.*|#include.*", "", "".join((ROOT / "include/swivel" / name).read_text(encoding="utf-8") for name in api_page.HEADERS))
        cls.enumerations = json.loads((ROOT / "tools/headers/headers.json").read_text(encoding="utf-8"))["swivel"]["enumerations"]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_every_page_is_built_and_in_the_navigation(self):
        self.assertEqual(len(self.pages), 1 + len(list(DOCS.rglob("*.md"))))  # and 404.html
        listed = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
        for page in DOCS.rglob("*.md"):
            self.assertIn(f": {page.relative_to(DOCS)}\n", listed, "mkdocs.yml's nav lacks it")

    def test_anchors_exist(self):
        for path, page in self.pages.items():
            for link in page.links:
                file, _, anchor = unquote(link).partition("#")
                target = self.pages.get((path.parent / file).resolve() if file else path)
                if anchor and target and not link.startswith("http"):
                    self.assertIn(anchor, target.anchors, f"{path.relative_to(self.folder)} links to {link}")

    def test_nothing_is_fetched_from_elsewhere(self):
        for path, page in self.pages.items():
            for link in page.fetched:
                with self.subTest(page=path.relative_to(self.folder), link=link):
                    self.assertEqual(urlsplit(link).netloc, "")
                    if path.name != "404.html":
                        self.assertTrue((path.parent / unquote(urlsplit(link).path)).is_file(), "no such file")
        for style in self.folder.rglob("*.css"):
            self.assertNotRegex(style.read_text(encoding="utf-8"), r"(@import|url\()\s*[\"']?(https?:)?//", style.name)

    def test_formulas_are_set(self):
        self.assertIn('class="katex', (self.folder / "mathematics.html").read_text(encoding="utf-8"))
        for path in self.pages:
            self.assertNotIn("arithmatex", path.read_text(encoding="utf-8"))

    def test_reference_has_every_public_name(self):
        names = set(re.findall(r"\b(?:swivel|SWIVEL)_\w+", self.code)) - {"SWIVEL_API", "SWIVEL_SHARED"}
        self.assertGreater(len(names), 140)
        self.assertEqual(names - self.pages[self.folder / "api.html"].anchors, set())
        ids = re.findall(r'\bid="([^"]*)"', (self.folder / "api.html").read_text(encoding="utf-8"))
        self.assertEqual([name for name in names if ids.count(name) > 1], [], "more than one anchor")

    def test_every_field_is_in_detail(self):
        text = (DOCS / "fields.md").read_text(encoding="utf-8")
        for name in self.enumerations["swivel_field"]:
            if not name.endswith("_END"):
                self.assertRegex(text, rf"(?m)^\| `{name.removeprefix('SWIVEL_')}`(?: \*)? \|", "docs/fields.md lacks it")

    def test_every_feature_has_a_how_to(self):
        text = "".join(page.read_text(encoding="utf-8") for page in (DOCS / "howto").glob("*.md"))
        for name in self.enumerations["swivel_features"]:
            self.assertIn(f"`{name}`", text, "no page of docs/howto says it")


if __name__ == "__main__":
    unittest.main()
