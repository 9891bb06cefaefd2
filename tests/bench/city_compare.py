"""A city of 56,157 objects beside OpenSceneGraph and plain OpenGL: overview, flight and drive, 1280 x 720.

    python3 -B tests/bench/city_compare.py --flight build/release/city_flight --work build/city [--peers DIR]
        [--frames N] [--rounds N]

Builds the peers' osg_city.cpp and rawcity.cpp in --work where their sources and libraries are, runs each way of each
program and ours at 2 px in turns, round after round, and prints a table of medians: wall and processor time of a frame,
triangles, draw items. Neighbours on a shared machine slow down whole rounds, so what counts is the median of the rounds'
ratios; they hardly touch processor time. Status 1 when by either time a frame of ours takes more than a third of
OpenSceneGraph's best level-of-detail row or more than plain OpenGL's distance levels, 77 when the peers cannot be had.
Nothing is written outside --work, where the city's tree is kept."""

import argparse
import itertools
import json
import pathlib
import re
import statistics
import subprocess
import sys

SKIPPED = 77
ROOT = pathlib.Path(__file__).resolve().parents[2]
FIGURES = ["wall_ms", "cpu_ms", "triangles", "items", "error_px"]
OURS = "Harrier, at most 2 px"
WAYS = ["over", "fly", "drive"]
OSG_LIBRARIES = ["osg", "osgDB", "osgUtil", "osgViewer", "osgGA", "OpenThreads", "EGL", "GL", "png"]
# name, program, mode; the levels of detail state no error
ROWS = [
    ("OpenSceneGraph, distance levels", "osg_city", "lod"),
    ("OpenSceneGraph, pixel-size levels", "osg_city", "lodpx"),
    ("plain OpenGL, distance levels, far objects dropped", "rawcity", "lod"),
    ("plain OpenGL, pixel-size levels", "rawcity", "lodpx"),
    ("plain OpenGL, culled, everything", "rawcity", "cull"),
]


def compile_peer(source, libraries, out):
    command = ["g++", "-O2", "-std=c++17", source, "-o", out, *[f"-l{name}" for name in libraries]]
    return subprocess.run(list(map(str, command)), capture_output=True).returncode == 0


def figure(pattern, text):
    found = re.search(pattern, text)
    return float(found.group(1)) if found else float("nan")


def run_peer(program, mode, way, frames):
    done = subprocess.run([program, mode, way, str(frames)], cwd=program.parent, capture_output=True, text=True)
    line = [text for text in done.stdout.splitlines() if "frame ms" in text][-1]
    return {
        "wall_ms": figure(r"frame ms .*?med ([0-9.]+)", line),
        "cpu_ms": figure(r"cpu-ms med ([0-9.]+)", line),
        "triangles": figure(r"(?:tris|prims) med ([0-9]+)", line),
        "items": figure(r"(?:cmds|drawables) med ([0-9]+)", line),
        "error_px": None,
    }


def run_ours(flight, tree, frames):
    done = subprocess.run([flight, tree, "2", str(frames)], capture_output=True, text=True, check=True)
    return {row["way"]: row for row in map(json.loads, done.stdout.splitlines())}


def cell(row):
    error = "not told" if row["error_px"] is None else f"{row['error_px']:.2f}"
    return (f"{row['wall_ms']:.1f} | {row['cpu_ms']:.1f} | {row['triangles']:.0f} | {row['items']:.0f} | {error}")


def run_round(folder, flight, tree, frames):
    """{program: {way: row}}, all programs once."""
    table = {name: {way: run_peer(folder / program, mode, way, frames) for way in WAYS}
             for name, program, mode in ROWS}
    table[OURS] = run_ours(flight, tree, frames)
    return table


def median_of(rounds, name, way):
    rows = [table[name][way] for table in rounds]
    return {key: None if rows[0][key] is None else statistics.median(row[key] for row in rows) for key in FIGURES}


def limits(table, way, time):
    """What ours may take, by rival."""
    osg = min(table[name][way][time] for name, program, _ in ROWS if program == "osg_city")
    return {"a third of OpenSceneGraph's best": osg / 3,
            "plain OpenGL's distance levels": table[ROWS[2][0]][way][time]}


def verdicts(rounds):
    lost = 0
    for time, way in itertools.product(["wall_ms", "cpu_ms"], WAYS):
        for rival in limits(rounds[0], way, time):
            ratios = [table[OURS][way][time] / limits(table, way, time)[rival] for table in rounds]
            is_kept = statistics.median(ratios) <= 1.0
            lost += not is_kept
            print(f"{way}, {time}: {statistics.median(ratios):.2f} of {rival} "
                  f"({min(ratios):.2f} to {max(ratios):.2f}): {'kept' if is_kept else 'missed'}")
    return lost


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--flight", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--peers", type=pathlib.Path, default=ROOT.parent / "shared" / "peers")
    parser.add_argument("--frames", type=int, default=30)
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    # osg_city leaves its picture two folders up, in out.
    folder = (arguments.work / "a" / "b").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    (arguments.work / "out").mkdir(exist_ok=True)
    built = (compile_peer(arguments.peers / "osg" / "osg_city.cpp", OSG_LIBRARIES, folder / "osg_city") and
             compile_peer(arguments.peers / "gl" / "rawcity.cpp", ["EGL", "epoxy"], folder / "rawcity"))
    if not built:
        print("the peers' sources or libraries are not here")
        return SKIPPED
    flight, tree = arguments.flight.resolve(), folder / "city.hdlod"
    if not tree.exists():
        run_ours(flight, tree, 1)
    rounds = [run_round(folder, flight, tree, arguments.frames) for _ in range(arguments.rounds)]
    print("| program | way | wall ms | processor ms | triangles | items | error px |\n|---|---|---|---|---|---|---|")
    for name in rounds[0]:
        for way in WAYS:
            print(f"| {name} | {way} | {cell(median_of(rounds, name, way))} |")
    return 1 if verdicts(rounds) else 0


if __name__ == "__main__":
    sys.exit(main())
