"""The pages name only files that exist: paths in backticks (from the root) and links (from the page)."""

import pathlib
import re

import project

FENCED = re.compile(r"^```.*?^```[^\n]*$|<!--.*?-->", re.DOTALL | re.MULTILINE)
NAMED = re.compile(r"`((?:[\w.-]+/)+[\w.-]*\.[A-Za-z]\w*)`")
LINKED = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
MADE_BY_RUNNING = ("build/", "out/")


def problems(root):
    root = pathlib.Path(root)
    found = []
    for page in [root / "README.md", *sorted((root / "docs").rglob("*.md"))]:
        text = FENCED.sub(lambda block: "\n" * block.group().count("\n"), page.read_text(encoding="utf-8"))
        named = [(hit, root / hit.group(1)) for hit in NAMED.finditer(text)
                 if not hit.group(1).startswith(MADE_BY_RUNNING)]
        linked = [(hit, page.parent / hit.group(1)) for hit in LINKED.finditer(text) if ":" not in hit.group(1)]
        for hit, path in named + linked:
            if not path.exists():
                place = f"{page.relative_to(root)}:{project.line_of(text, hit.start())}"
                found.append(f"{place}: {hit.group(1)} does not exist")
    return found
