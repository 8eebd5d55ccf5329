"""Links of pages, and where a name is defined in a source file: the site and its tests go by it."""
import re


def line_of(text, name):
    """Number of the line (from 1) that defines `name`, a function or a type; None: none does."""
    word = re.escape(name.split("::")[-1].removesuffix("()"))
    function = rf"^(?![\s/#]).*\b{word}\("
    member = rf"^ +(?!return|if|for|while|else)(?:\[\[nodiscard\]\] )?[\w:<>&*, ]+[ &*]{word}\("
    for kind in [function, rf"^\s*(?:class|struct|enum class|enum) {word}\b", member]:
        found = re.search(kind, text, re.MULTILINE)
        if found:
            return text.count("\n", 0, found.end()) + 1
    return None


def links(markdown):
    """(text, target) of every link and of every picture of a page; what stands in code is none."""
    markdown = re.sub(r"^```.*?^```$", "", markdown, flags=re.MULTILINE | re.DOTALL)
    return re.findall(r"\[((?:`[^`]*`|[^\[\]`])*)\]\(([^)\s]+)\)", markdown)
