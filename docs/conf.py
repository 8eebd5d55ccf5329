# The site that script/docs makes of this folder. Its pages are plain Markdown and read well as such.
import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = Path(os.environ["DYNAMICFILTER_BUILD"])  # holds the Python package
sys.path[:0] = [str(ROOT / "docs/_ext"), str(BUILD / "python")]

project = "DynamicFilter"
author = "the authors of DynamicFilter"
version = release = re.search(r"VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text().split("project(")[1])[1]

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "headers", "equations", "sources", "stubs", "furo_repair"]
exclude_patterns = ["_*"]
highlight_language = "none"
smartquotes = False  # docstrings hold code
default_role = "literal"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
html_math_renderer = "mathml"

breathe_show_include = False  # it names files without their folders
breathe_show_enumvalue_initializer = True

html_theme = "furo"
html_title = "DynamicFilter"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
