"""Equations as MathML, made by KaTeX while the site is built: to read them nothing is loaded or run."""
import functools
import os
import subprocess

from docutils import nodes


@functools.cache
def mathml(latex, display):
    options = ["--display-mode"] if display else []
    environment = {**os.environ, "NODE_PATH": "/usr/share/nodejs"}  # for a Node that is not Debian's
    done = subprocess.run(["katex", "--format", "mathml", *options], input=latex, text=True,
                          capture_output=True, env=environment)
    if done.returncode != 0 or "katex-error" in done.stdout:
        raise ValueError(f"KaTeX refuses {latex!r}: {done.stderr or done.stdout}")
    return done.stdout[done.stdout.index("<math"):done.stdout.index("</math>")] + "</math>"


def inline(translator, node):
    translator.body.append(mathml(node.astext(), False))
    raise nodes.SkipNode


def block(translator, node):
    translator.body.append(f'<div class="equation">{mathml(node.astext(), True)}</div>')
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
