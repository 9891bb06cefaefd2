"""The project's files, as the checks of this folder see them. A check is a module with problems(root) -> lines."""

import pathlib
import re

FOLDERS = ("lod", "data", "terrain", "objects", "render", "sim", "tests")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def sources(root, suffixes=(".h", ".cpp")):
    """C++ files below the fixed folders: (path from the root with slashes, text), sorted."""
    root = pathlib.Path(root)
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in suffixes and path.is_file():
                yield path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")


def without_comments(text):
    """The same lines, comments blanked."""
    return COMMENT.sub(lambda comment: "\n" * comment.group().count("\n"), text)


def line_of(text, position):
    """The 1-based line of a character position."""
    return text.count("\n", 0, position) + 1


class Skipped(Exception):
    """A check that cannot run here; its text says why."""
