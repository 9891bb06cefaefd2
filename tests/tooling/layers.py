"""Includes point down the layers of docs/architecture.md; GL and clocks stay where they belong; getenv nowhere."""

import pathlib
import re

import project

# Who may include whom, from the root. sim and tests may include everything.
ALLOWED = {
    "lod/base": {"lod/base"},
    "lod": {"lod", "lod/base"},
    "data": {"data", "lod/base"},
    "terrain": {"terrain", "data", "lod", "lod/base"},
    "objects": {"objects", "data", "lod", "lod/base"},
    "render": {"render", "lod", "lod/base"},
}

# What may appear (comments aside) only in these layers.
RESTRICTED = (
    (re.compile(r"#\s*include\s*[<\"](epoxy|EGL|GL|GLES\d?|KHR|GLFW)/"), {"render"}, "GL is for render"),
    (re.compile(r"\b(steady_clock|system_clock|high_resolution_clock|utc_clock|clock_gettime|gettimeofday)\b"
                r"|\bstd::(time|clock)\s*\(|\btime\s*\(\s*(nullptr|NULL|0)\s*\)"),
     {"sim"}, "only sim reads clocks; elsewhere time is an input"),
    (re.compile(r"\b(secure_)?getenv\b"), set(), "getenv is banned; pass a parameter"),
)

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)


def layer_of(path):
    """"lod/base" or the top folder; for a test the folder it mirrors does not matter: "tests"."""
    return "lod/base" if path.startswith("lod/base/") else path.split("/")[0]


def is_test_of(path, layers):
    """Tests mirror the folders: tests/render may do what render may."""
    parts = path.split("/")
    return parts[0] == "tests" and len(parts) > 2 and parts[1] in layers


def is_generated(root, path, target):
    """A header that the folder's CMakeLists.txt makes."""
    cmake = pathlib.Path(root, path.split("/")[0], "CMakeLists.txt")
    return cmake.is_file() and pathlib.PurePosixPath(target).name in cmake.read_text(encoding="utf-8")


def problems(root):
    found = []
    for path, text in project.sources(root):
        layer = layer_of(path)
        for include in INCLUDE.finditer(text):
            place = f"{path}:{project.line_of(text, include.start())}"
            target = include.group(1)
            if is_generated(root, path, target):
                continue
            if not (pathlib.Path(root) / target).is_file():
                found.append(f'{place}: "{target}" is no file of the project; expected a path from the root, or <>')
            elif layer in ALLOWED and layer_of(target) not in ALLOWED[layer]:
                found.append(f"{place}: {layer} must not include {target}")
        code = project.without_comments(text)
        for pattern, layers, why in RESTRICTED:
            is_clock_in_test = layer == "tests" and layers == {"sim"}
            if layer in layers or is_test_of(path, layers) or is_clock_in_test:
                continue
            for hit in pattern.finditer(code):
                found.append(f"{path}:{project.line_of(code, hit.start())}: {hit.group().strip()}: {why}")
    return found
