"""Every source file is as clang-format 14, Debian 12's, leaves it."""

import re
import shutil
import subprocess

import project

VERSION = "14"


def problems(root):
    tool = shutil.which(f"clang-format-{VERSION}") or shutil.which("clang-format")
    if tool is None:
        raise project.Skipped("no clang-format here")
    version = subprocess.run([tool, "--version"], capture_output=True, text=True, check=True).stdout
    if not re.search(rf"version {VERSION}\.", version):
        raise project.Skipped(f"expected clang-format {VERSION}, found {version.strip()}")
    paths = [path for path, _ in project.sources(root)]
    if not paths:
        return []
    run = subprocess.run([tool, "--dry-run", "-Werror", *paths], cwd=root, capture_output=True, text=True)
    lines = {}
    for path, line in re.findall(r"^(\S[^\n]*?):(\d+):\d+: error: code should", run.stderr, re.MULTILINE):
        lines.setdefault(path, []).append(int(line))
    found = [f"{path}:{at[0]}: not as clang-format leaves it ({len(set(at))} lines)" for path, at in lines.items()]
    return found or ([run.stderr.strip()] if run.returncode else [])
