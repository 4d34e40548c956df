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
