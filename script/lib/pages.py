"""Pages of docs in which a script replaces its tables: each stands between two comments, and the text around them is written by hand."""


def put(page, script, name, text):
    """The page with `text` in the region `name` of `script`."""
    begin, end = f"<!-- {script}: {name} -->\n", f"<!-- end of {name} -->\n"
    before, rest = page.split(begin)
    return before + begin + text + end + rest.split(end)[1]
