"""./demo and ./check against a make-believe system: what they install, when they do nothing, how they refuse."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

PROJECT = pathlib.Path(__file__).parents[2]
NEEDED = ("bash", "cat", "comm", "dirname", "env", "grep", "mkdir", "nproc", "paste", "readlink", "sed", "sort", "tail", "touch")
LOG = 'echo "${0##*/} $*" >>"$CALLS"\n'
STUBS = {
    "id": 'echo "${FAKE_UID:-0}"\n',
    "dpkg-query": "cat \"$INSTALLED\"\n",
    "apt-get": LOG + 'case "$*" in *" install "*) [ -z "${APT_FAILS:-}" ] || { echo "E: no such package" >&2; exit 100; };; esac\n',
    "cmake": LOG + "case \"$1\" in --preset) mkdir -p build/release; touch build/release/build.ninja;\n"
                   'printf "CMAKE_HOME_DIRECTORY:INTERNAL=%s\\nHARRIER_TESTS:BOOL=%s\\n" "$PWD" "${3#*=}"'
                   " >build/release/CMakeCache.txt;; esac\n",
    "ctest": LOG,
    "g++": "",
}


class Setup(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        self.root = self.top / "a check out"
        self.root.mkdir()
        for name in ("demo", "check", "CMakePresets.json"):
            shutil.copy(PROJECT / name, self.root)
        shutil.copytree(PROJECT / "tools", self.root / "tools")
        self.bin = self.top / "bin"
        self.bin.mkdir()
        for name in NEEDED:
            (self.bin / name).symlink_to(shutil.which(name))
        for name, body in STUBS.items():
            self.stub(name, body)
        self.install(self.listed("packages.txt") + self.listed("packages-check.txt"))
        program = self.root / "build/release/harrier"
        program.parent.mkdir(parents=True)
        program.write_text("#!/bin/bash\n" + LOG)
        program.chmod(0o755)

    def stub(self, name, body):
        (self.bin / name).write_text("#!/bin/bash\n" + body)
        (self.bin / name).chmod(0o755)

    def listed(self, name):
        lines = (self.root / "tools" / name).read_text().splitlines()
        return [line.split()[0] for line in lines if line and not line.startswith("#")]

    def install(self, names):
        (self.top / "installed").write_text("".join(f"installed {name}\n" for name in names))

    def run_it(self, name, *arguments, **environment):
        (self.top / "calls").write_text("")
        run = subprocess.run(
            [shutil.which("bash"), str(self.root / name), *arguments], cwd=self.top, stdin=subprocess.DEVNULL,
            capture_output=True, text=True, timeout=60,
            env={"PATH": str(self.bin), "CALLS": str(self.top / "calls"),
                 "INSTALLED": str(self.top / "installed"), "CI": "true", **environment})
        return run, (self.top / "calls").read_text().splitlines()

    def assert_refuses(self, run, words):
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertIn(words, run.stderr)

    def test_demo_configures_once_builds_and_flies(self):
        first, calls = self.run_it("demo", "--frames", "3")
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertEqual([call.split()[0] for call in calls], ["cmake", "cmake", "harrier"])
        self.assertIn("--preset release -DHARRIER_TESTS=OFF", calls[0])
        self.assertEqual(calls[2], "harrier demo --frames 3")
        _, calls = self.run_it("demo")
        self.assertEqual([call.split()[0] for call in calls], ["cmake", "harrier"])
        self.assertIn("--build", calls[0])

    def test_check_turns_tests_on_and_demo_leaves_them_on(self):
        self.run_it("demo")
        run, calls = self.run_it("check", "-L", "lod")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("-DHARRIER_TESTS=ON", calls[0])
        self.assertTrue(calls[-1].startswith("ctest ") and calls[-1].endswith("-L lod"), calls)
        for again in ("demo", "check"):
            _, calls = self.run_it(again)
            self.assertFalse([call for call in calls if "--preset" in call], again)
        os.utime(self.root / "CMakePresets.json", (time.time() + 60, time.time() + 60))
        _, calls = self.run_it("demo")
        self.assertIn("-DHARRIER_TESTS=ON", calls[0])

    def test_a_moved_checkout_is_configured_afresh(self):
        self.run_it("demo")
        moved = self.root.with_name("moved")
        self.root.rename(moved)
        self.root = moved
        _, calls = self.run_it("demo")
        self.assertIn("--fresh", calls[0])

    def test_only_missing_packages_are_installed(self):
        self.install([name for name in self.listed("packages.txt") if name not in ("g++", "libgdal-dev")])
        run, calls = self.run_it("demo")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(calls[0].startswith("apt-get") and calls[0].endswith(" update"), calls)
        self.assertTrue(calls[1].endswith("install --no-install-recommends g++ libgdal-dev"), calls)

    def test_refusals_are_one_line(self):
        self.stub("g++", "")
        (self.bin / "g++").unlink()
        self.assert_refuses(self.run_it("demo")[0], "no C++ compiler")
        self.install(self.listed("packages.txt")[1:])
        self.assert_refuses(self.run_it("demo", FAKE_UID="1000")[0], "not root and no sudo")
        self.stub("sudo", "exit 1\n")
        self.assert_refuses(self.run_it("demo", FAKE_UID="1000")[0], "sudo refused")
        self.assert_refuses(self.run_it("demo", APT_FAILS="1")[0], "E: no such package")
        (self.bin / "apt-get").unlink()
        self.assert_refuses(self.run_it("check")[0], "not Debian")

    def test_sudo_installs_for_others(self):
        self.stub("sudo", LOG + 'while [ "${1#-}" != "$1" ]; do shift; done; exec "$@"\n')
        (self.bin / "true").symlink_to(shutil.which("true"))
        self.install([])
        run, calls = self.run_it("demo", FAKE_UID="1000")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(any(call.startswith("sudo -n env DEBIAN_FRONTEND=noninteractive apt-get") for call in calls))


if __name__ == "__main__":
    unittest.main()
