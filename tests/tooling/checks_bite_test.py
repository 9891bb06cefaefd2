"""Each check of this folder finds the fault it is there for, and nothing in a clean tree."""

import pathlib
import shutil
import tempfile
import unittest

import docs
import format as source_format
import layers
import project
import shape

CLEAN = {
    "lod/base/math.h": "// Sums.\n#pragma once\nint sum(int a, int b);\n",
    "lod/view.h": '// Views; getenv is not used here.\n#pragma once\n#include "lod/base/math.h"\n',
    "data/grid.h": '// Grids.\n// Two lines.\n#pragma once\n#include <vector>\n\n#include "lod/base/math.h"\n',
    "terrain/front.cpp": '#include "terrain/front.h"\n\n#include "data/grid.h"\n#include "lod/view.h"\n',
    "render/context.cpp": "#include <EGL/egl.h>\n#include <epoxy/gl.h>\n",
    "render/CMakeLists.txt": "configure_file(shaders.in shaders.h)\n",
    "render/shaders.cpp": '#include "shaders.h"\n',
    "sim/loop.cpp": '#include <chrono>\n\n#include "terrain/front.h"\nusing Clock = std::chrono::steady_clock;\n',
    "objects/tree.h": "// The tree.\n#pragma once\n",
    "terrain/front.h": "// The front.\n#pragma once\n",
    "tests/sim/loop_test.cpp": "#include <chrono>\nusing Clock = std::chrono::steady_clock;\n",
    "tests/render/context_test.cpp": "#include <epoxy/gl.h>\n",
    "README.md": "See `lod/view.h`, `build/release/x.txt` and [frames](docs/frame.md#one).\n```\n`no/file.h`\n```\n",
    "docs/frame.md": "Back to [the start](../README.md), or https://example.org/a.html.\n",
}

FAULTS = [
    (layers, "lod/base/up.h", '// Up.\n#pragma once\n#include "lod/view.h"\n', "lod/base must not include"),
    (layers, "lod/up.cpp", '#include "data/grid.h"\n', "lod must not include"),
    (layers, "data/up.cpp", '#include "lod/view.h"\n', "data must not include"),
    (layers, "render/side.cpp", '#include "terrain/front.h"\n', "render must not include"),
    (layers, "objects/side.cpp", '  # include "terrain/front.h"\n', "objects must not include"),
    (layers, "terrain/side.cpp", '#include "objects/tree.h"\n', "terrain must not include"),
    (layers, "data/up.cpp", '#include "terrain/front.h"\n', "data must not include"),
    (layers, "terrain/up.cpp", '#include "shaders.h"\n', "no file of the project"),
    (layers, "sim/gl.cpp", "#include <epoxy/gl.h>\n", "GL is for render"),
    (layers, "lod/window.cpp", "#include <GLFW/glfw3.h>\n", "GL is for render"),
    (layers, "lod/late.cpp", "\nauto t = std::chrono::steady_clock::now();\n", "lod/late.cpp:2: steady_clock"),
    (layers, "render/late.cpp", "auto t = time(nullptr);\n", "only sim reads clocks"),
    (layers, "sim/env.cpp", 'auto h = std::getenv("HOME");\n', "getenv is banned"),
    (shape, "lod/bare.h", "#pragma once\nint x;\n", "expected a comment"),
    (shape, "lod/open.h", "// Open.\n#include <vector>\n#pragma once\n", "expected a comment"),
    (shape, "lod/view.cpp", '#include <vector>\n\n#include "lod/view.h"\n', "expected its own"),
    (shape, "lod/long.cpp", "\n" * 401, "401 lines"),
    (docs, "docs/lost.md", "See `lod/gone.h`.\n", "docs/lost.md:1: lod/gone.h does not exist"),
    (docs, "docs/lost.md", "\nSee [it](gone.md).\n", "docs/lost.md:2: gone.md does not exist"),
    (source_format, "lod/ugly.cpp", "int   x=1 ;\n", "lod/ugly.cpp:1: not as clang-format"),
]


class ChecksBite(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        shutil.copy(pathlib.Path(__file__).parents[2] / ".clang-format", self.root)
        for path, text in CLEAN.items():
            self.write(path, text)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def problems(self, check):
        try:
            return check.problems(self.root)
        except project.Skipped as reason:
            self.skipTest(str(reason))

    def test_a_clean_tree_is_clean(self):
        for check in (layers, shape, docs, source_format):
            with self.subTest(check=check.__name__):
                self.assertEqual(self.problems(check), [])

    def test_each_fault_is_found(self):
        for check, path, text, expected in FAULTS:
            with self.subTest(path=path, expected=expected):
                self.write(path, text)
                found = self.problems(check)
                (self.root / path).unlink()
                self.assertEqual(len(found), 1, found)
                self.assertIn(expected, found[0])


if __name__ == "__main__":
    unittest.main()
