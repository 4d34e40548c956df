# The site: Sphinx reads the pages where they stand (tools/site). Strict: see tests/site.
import re
from pathlib import Path

project = "strut"
copyright = "the authors of strut, BSD 3-clause"
html_title = "strut"
extensions = ["myst_parser"]
root_doc = "docs/index"
exclude_patterns = ["build", "**/CMakeFiles", "docs/site", ".git"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # pages that are shown from a heading on
html_theme = "alabaster"
html_theme_options = {
    "description": "Crushing foams and impact by correspondence peridynamics",
    "fixed_sidebar": True,
    "page_width": "1100px",
    "sidebar_width": "260px",
    "body_max_width": "none",
}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_static_path = []
html_copy_source = False
html_show_sourcelink = False
highlight_language = "none"

ROOT = Path(__file__).resolve().parent.parent


def first_sentence(source):
    """The comment at the head of a source, to its first full stop; empty without one."""
    head = re.match(r"(?:#pragma once\n|\n)*((?://[^\n]*\n)+)", source.read_text())
    text = " ".join(line[2:].strip() for line in head[1].splitlines()) if head else ""
    return re.split(r"(?<=\.)\s", text)[0].replace("|", r"\|")


def files():
    rows = []
    for room in ("src", "contact", "materials", "tools"):
        for source in sorted((ROOT / room).rglob("*.[ch]pp")):
            if source.suffix == ".hpp" or not source.with_suffix(".hpp").exists():
                rows.append(f"| `{source.relative_to(ROOT)}` | {first_sentence(source)} |")
    return "\n| file | what |\n|---|---|\n" + "\n".join(rows) + "\n"


def add_files(app, page, text):
    if page == "docs/files":
        text[0] += files()


def setup(app):
    app.connect("source-read", add_files)
