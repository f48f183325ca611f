# SPDX-License-Identifier: MIT
"""What mkdocs does beyond mkdocs.yml. It compares programs on pages with docs/snippets, makes the reference from the headers of include/swivel, and
treats links that leave docs/. KaTeX sets the formulas during the build, so pages fetch nothing and need no scripts."""
import json
import posixpath
import re
import shutil
import subprocess
import sys
from html import unescape
from pathlib import Path

from mkdocs.exceptions import PluginError

sys.path.insert(0, str(Path(__file__).resolve().parent))
import api_page  # noqa: E402
import snippets  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
KATEX = Path("/usr/share/javascript/katex")  # Debian's libjs-katex
INCLUDE = "include/swivel"

# Sets every formula of standard input, a JSON list of [TeX, whether it stands alone].
SET_FORMULAS = f"""
const katex = require("{KATEX}/katex.js");
const formulas = JSON.parse(require("fs").readFileSync(0, "utf8"));
function set([tex, alone]) {{
    try {{
        return katex.renderToString(tex, {{displayMode: alone, throwOnError: true, strict: "error"}});
    }} catch (error) {{
        console.error(error.message);
        process.exit(1);
    }}
}}
console.log(JSON.stringify(formulas.map(set)));
"""
FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.S)


def on_files(files, config):
    """Leaves out docs/snippets: programs are parts of pages."""
    for file in [file for file in files if file.src_uri.startswith("snippets/")]:
        files.remove(file)
    return files


def on_page_markdown(markdown, page, config, files):
    try:
        snippets.check(markdown, ROOT)
        markdown = snippets.without_marks(markdown)
        if page.file.src_uri == "api.md":
            headers = {name: (ROOT / INCLUDE / name).read_text() for name in api_page.HEADERS}
            markdown = markdown.replace("<!-- headers -->", api_page.reference(headers))
    except (snippets.Missing, api_page.Unread) as error:
        raise PluginError(f"{page.file.src_uri}: {error}") from error
    return repository_links(markdown, page.file.src_uri)


def repository_links(markdown, source):
    """Changes links that leave docs/, which only the repository's readers can follow. A link to a header of the reference goes there. Of any
    other link, the text remains."""
    def replaced(match):
        target = posixpath.normpath(posixpath.join("docs", posixpath.dirname(source), match[2]))
        if target.startswith("docs/") or ":" in match[2]:
            return match[0]
        if not (ROOT / target).exists():
            raise PluginError(f"{source}: link to {target}, which is not in the repository")
        if posixpath.dirname(target) == INCLUDE and posixpath.basename(target) in api_page.HEADERS:
            return f"[{match[1]}]({posixpath.relpath('api.md', posixpath.dirname(source) or '.')})"
        return match[1]
    return re.sub(r"(?<!!)\[([^\]]*)\]\(([^)#\s]+)(?:#[^)\s]*)?\)", replaced, markdown)


def on_page_content(html, page, config, files):
    found = FORMULA.findall(html)
    if not found:
        return html
    formulas = json.dumps([[unescape(tex), kind == "["] for _, kind, tex in found])
    result = subprocess.run(["node", "-e", SET_FORMULAS], input=formulas, capture_output=True, text=True)
    if result.returncode:
        raise PluginError(f"{page.file.src_uri}: {result.stderr.strip()}")
    ready = iter(json.loads(result.stdout))
    return FORMULA.sub(lambda match: next(ready), html)


def on_post_build(config):
    target = Path(config["site_dir"]) / "katex"
    (target / "fonts").mkdir(parents=True, exist_ok=True)
    shutil.copy(KATEX / "katex.min.css", target)
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copy(font, target / "fonts")
