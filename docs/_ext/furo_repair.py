"""Debian's Furo needs a web server for its style, a bundler for its script, and forgets the dark colours of those
who prefer them. Put right in the site, so that it opens from a folder; does nothing where Furo is whole."""
import re
from pathlib import Path

NORMALIZE = Path("/usr/share/javascript/normalize.css/normalize.css")


def repair(app, exception):
    static = Path(app.outdir) / "_static"
    style, script = static / "styles/furo.css", static / "scripts/furo.js"
    css = style.read_text()
    normalize = NORMALIZE.read_text() if NORMALIZE.exists() else ""
    css = re.sub(r"@import url\(/javascript/normalize[^;]*;", lambda _: normalize, css)
    dark = re.search(r'body\[data-theme="dark"\] (\{\s*--color[^}]*\})', css)
    if dark and "prefers-color-scheme" not in css:
        css += f'\n@media (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark[1]} }}\n'
    style.write_text(css)
    js = script.read_text()
    if js.startswith("import Gumshoe"):
        script.write_text((static / "scripts/gumshoe-patched.js").read_text() + js.split("\n", 1)[1])


def setup(app):
    app.connect("build-finished", repair)
