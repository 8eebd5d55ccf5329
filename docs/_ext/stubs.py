"""Python's signatures with the types of the stubs, and its docstrings, which are plain text, as paragraphs."""
import ast
import re
from pathlib import Path

STUB = Path(__file__).resolve().parents[2] / "python/dynamicfilter/__init__.pyi"


def read_stub():
    """Of every public name: (arguments, type returned); of a property and a constant: (None, its type)."""
    tree = ast.parse(STUB.read_text())
    alias = {n.targets[0].id: ast.unparse(n.value) for n in tree.body if isinstance(n, ast.Assign)}
    found = {}

    def text(node):
        out = ast.unparse(node) if node else ""
        for name, meaning in alias.items():
            out = re.sub(rf"\b{name}\b", meaning, out)
        out = re.sub(r": Unpack\[\w+\]", "", out)
        return out.replace("NDArray[np.", "NDArray[")

    def visit(nodes, prefix):
        for n in nodes:
            if isinstance(n, ast.ClassDef) and n.name.startswith("_"):
                continue  # options by name: the docstrings list them
            if isinstance(n, ast.ClassDef):
                found[prefix + n.name] = (None, "")
                visit(n.body, f"{prefix}{n.name}.")
            elif isinstance(n, ast.AnnAssign):
                found[prefix + n.target.id] = (None, text(n.annotation))
            elif isinstance(n, ast.FunctionDef):
                arguments = "(" + re.sub(r"^self(, )?", "", text(n.args)) + ")"
                if n.name == "__init__":
                    found[prefix[:-1]] = (arguments, "")
                else:
                    found[prefix + n.name] = (None if n.decorator_list else arguments, text(n.returns))

    visit(tree.body, "dynamicfilter.")
    return found


TYPES = read_stub()


def signature(app, what, name, obj, options, arguments, returns):
    if name in TYPES and what != "property":
        return TYPES[name][0], TYPES[name][1] or None


def docstring(app, what, name, obj, options, lines):
    """A line that begins with an argument's name, or says what comes back, begins a paragraph."""
    text = []
    for line in lines:
        if line.startswith("    ") and text[-1:] == [""]:
            text += ["::", ""]  # code
        if re.match(r"(?:\w+(?: \[\w+\])?: |Returns |Raises |Options)", line):
            line = re.sub(r"^(\w+)((?: \[\w+\])?: )", r"**\1**\2", line)
            text.append("")
        text.append(line)
    if what == "property":
        text[:0] = [f"*{TYPES[name][1]}*: " + (text.pop(0) if text else "")]
    lines[:] = text


def setup(app):
    app.connect("autodoc-process-signature", signature)
    app.connect("autodoc-process-docstring", docstring)
