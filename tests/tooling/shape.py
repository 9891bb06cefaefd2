"""A header begins with a comment that says what it is for, then #pragma once; no file is longer than one idea."""

import re

import project

MAX_LINES = 400
HEADER_START = re.compile(r"\A//[^\n]*\w[^\n]*\n(//[^\n]*\n)*#pragma once\n")


def problems(root):
    found = []
    for path, text in project.sources(root):
        lines = text.count("\n")
        if lines > MAX_LINES:
            found.append(f"{path}: {lines} lines; expected at most {MAX_LINES}")
        if path.endswith(".h") and not HEADER_START.match(text):
            found.append(f"{path}:1: expected a comment that says what the header is for, then #pragma once")
    return found
