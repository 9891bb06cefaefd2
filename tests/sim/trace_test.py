"""A GL call trace of `harrier fly`: one indirect draw a frame, nothing allocated after the first.

Usage: trace_test.py HARRIER SCENE. Exit 77 (skipped) where apitrace is not installed.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile

FRAMES = 12
DRAW = re.compile(r"\bgl(Multi)?Draw\w*\(")
ALLOCATION = re.compile(r"\bgl(Named)?Buffer(Storage|Data)\(|\bglTex\w*(Storage|Image)\w*\(|\bgl(Create|Gen)\w+\(")


def calls_of(harrier, scene):
    with tempfile.TemporaryDirectory() as folder:
        trace = os.path.join(folder, "fly.trace")
        subprocess.run(["apitrace", "trace", "--api", "egl", "-o", trace, harrier, "fly", scene, "--frames", str(FRAMES),
                        "--ops", "300", "--size", "160x90"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        dump = subprocess.run(["apitrace", "dump", "--color=never", trace], check=True, capture_output=True, text=True)
    return dump.stdout.splitlines()


def main():
    if shutil.which("apitrace") is None:
        print("skipped: apitrace is not installed")
        return 77
    draws, late_allocations = [], []
    for line in calls_of(sys.argv[1], sys.argv[2]):
        if DRAW.search(line):
            draws.append(line)
        elif draws and ALLOCATION.search(line):
            late_allocations.append(line)
    print(f"{len(draws)} draws in {FRAMES} frames, {len(late_allocations)} allocations after the first")
    ok = len(draws) == FRAMES and all("glMultiDrawElementsIndirect(" in line for line in draws) and not late_allocations
    for line in draws[:2] + late_allocations[:5]:
        print(line[:160])
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
