# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx makes the site from the pages of docs/: see scripts/docs."""

import re
import sys
from pathlib import Path

_HERE = Path(__file__).parent
_ROOT = _HERE.parents[1]
sys.path.insert(0, str(_HERE))

project = "bubblesim"
author = "the authors of bubblesim"
copyright = "the authors of bubblesim, BSD-3-Clause"  # noqa: A001  # Sphinx wants this name
_version = re.search(r"<version>(.*)</version>", (_ROOT / "package.xml").read_text())
release = version = _version[1] if _version else ""

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton", "github_pages"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
root_doc = "index"
exclude_patterns = ["README.md"]  # the list of pages on GitHub; index.rst is that of the site
suppress_warnings = ["myst.header"]  # pages begin details with a deeper heading

myst_heading_anchors = 4  # the links of GitHub to headings
myst_enable_extensions = ["colon_fence"]

autodoc_member_order = "groupwise"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True}

html_theme = "furo"
html_title = f"bubblesim {release}"
html_static_path = ["static"]
html_search_scorer = str(_HERE / "search_scorer.js")  # Sphinx looks for it in the working directory
html_css_files = ["site.css"]
html_js_files = ["dark.js"]
html_copy_source = False
html_theme_options = {"navigation_with_keys": True}
copybutton_prompt_text = r"\$ |>>> "
copybutton_prompt_is_regexp = True
