"""Links from pages to files of the repository become links to pages that show them, at the line that
defines the name in the link's text. So the site needs nothing outside itself."""
import html
from pathlib import Path

from docutils import nodes
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import TextLexer, get_lexer_for_filename
from pygments.util import ClassNotFound
from sphinx import addnodes
from sphinx.transforms import SphinxTransform

from symbols import line_of

ROOT = Path(__file__).resolve().parents[2]
shown = set()


class SourceLinks(SphinxTransform):
    default_priority = 200  # before Sphinx copies what is linked

    def apply(self):
        folder = Path(self.env.doc2path(self.env.docname)).parent
        kinds = (addnodes.pending_xref, addnodes.download_reference)
        for node in list(self.document.findall(lambda n: isinstance(n, kinds))):
            file = (folder / node.get("reftarget", "").split("#")[0]).resolve()
            if not file.is_file() or ROOT / "docs" in file.parents:
                continue
            name = file.relative_to(ROOT).as_posix()
            shown.add(name)
            line = line_of(file.read_text(), node.astext())
            uri = "../" * self.env.docname.count("/") + f"code/{name}.html"
            if line:
                uri += f"#line-{line}"
            link = nodes.reference("", "", refuri=uri, internal=True)
            link += node.children[0].children if isinstance(node.children[0], nodes.inline) else node.children
            node.replace_self(link)


def pages(app):
    for name in sorted(shown):
        text = (ROOT / name).read_text()
        try:
            lexer = get_lexer_for_filename(name)
        except ClassNotFound:
            lexer = TextLexer()
        body = f"<h1>{html.escape(name)}</h1>"
        body += highlight(text, lexer, HtmlFormatter(lineanchors="line", wrapcode=True))
        yield f"code/{name}", {"title": name, "body": body, "parents": []}, "page.html"


def setup(app):
    app.add_transform(SourceLinks)
    app.connect("html-collect-pages", pages)
