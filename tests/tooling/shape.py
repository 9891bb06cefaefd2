"""A header begins with a comment that says what it is for, then #pragma once; a source includes its own header first, so
that the header is known to compile alone; no file is longer than one idea."""

import re

import project

MAX_LINES = 400
FIRST_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)
HEADER_START = re.compile(r"\A//[^\n]*\w[^\n]*\n(//[^\n]*\n)*#pragma once\n")


def problems(root):
    found = []
    sources = list(project.sources(root))
    paths = {path for path, _ in sources}
    for path, text in sources:
        lines = text.count("\n")
        if lines > MAX_LINES:
            found.append(f"{path}: {lines} lines; expected at most {MAX_LINES}")
        if path.endswith(".h") and not HEADER_START.match(text):
            found.append(f"{path}:1: expected a comment that says what the header is for, then #pragma once")
        own_header = re.sub(r"\.cpp$", ".h", path)
        first = FIRST_INCLUDE.search(text)
        if path.endswith(".cpp") and own_header in paths and not (first and first.group(1) == own_header):
            found.append(f'{path}: expected its own "{own_header}" as the first include')
    return found
