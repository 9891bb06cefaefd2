"""Static meshes beside RTIN at equal measured error: npm's @mapbox/martini says a smaller error than it makes.

    python3 -B tests/bench/rtin_compare.py --harrier build/release/harrier --work build/rtin [--data DIR] [--largest SIDE]

For each terrain and tolerance: martini's mesh, the error it really has at the samples, and `harrier terrain extract`
with just that error as its limit. Prints a table; status 1 when a mesh of ours is larger than martini's or
farther from a sample than it promised, 77 when npm's package or gdal_translate cannot be had. Nothing is
written outside --work."""

import argparse
import array
import json
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77
PACKAGE = "@mapbox/martini@0.2.0"
NODE_PROGRAM = pathlib.Path(__file__).resolve().parent / "rtin_mesh.mjs"
TOLERANCES_M = [0.5, 1, 2, 5, 10, 20, 50]
# name, file, first column, first row, side; files that are not there are left out
WINDOWS = [
    ("Rainier", "mt_rainier_90m.tif", 88, 88, 1025),
    ("Fuji", "mt_fuji_90m.tif", 88, 88, 1025),
    ("Big Tujunga", "srtm_bigtujunga30m_utm11.tif", 400, 60, 513),
    ("Jacksboro", "jacksboro_srtm3.tif", 70, 40, 257),
    ("Europe, 30\"", "gtopo30_w030n60_recompressed.tif", 2500, 0, 1025),
]
HEADER = """ENVI
samples = {side}
lines = {side}
bands = 1
header offset = 0
file type = ENVI Standard
data type = 4
interleave = bsq
byte order = 0
map info = {{Arbitrary, 1, 1, 0, {side}, 1, 1}}
"""


class Unobtainable(Exception):
    pass


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def node(work, what, heights, side, *detail):
    return json.loads(run(["node", NODE_PROGRAM, what, heights, str(side), *map(str, detail)], work))


def install(work):
    """The package from npm into the work folder, once."""
    if not shutil.which("node") or not shutil.which("npm"):
        raise Unobtainable("node or npm is not installed")
    if (work / "node_modules/@mapbox/martini/package.json").exists():
        return
    (work / "package.json").write_text('{"private": true}\n')
    command = ["npm", "install", "--no-audit", "--no-fund", "--fetch-retries=1", PACKAGE]
    try:
        done = subprocess.run(command, cwd=work, capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired as late:
        raise Unobtainable(f"npm did not get {PACKAGE} in two minutes") from late
    if done.returncode != 0:
        raise Unobtainable(f"npm could not get {PACKAGE}")


def without_voids(heights, side):
    """Each void takes its left neighbour's height: both programs get the same samples, whatever they think of voids."""
    def is_void(height):
        return not -9000.0 < height < 9000.0
    last = next(height for height in heights if not is_void(height))
    for i in range(side * side):
        if is_void(heights[i]):
            heights[i] = last
        last = heights[i]
    return heights


def cut(work, data, name, window):
    """One square of a raster as bare floats."""
    if not shutil.which("gdal_translate"):
        raise Unobtainable("gdal_translate is not installed")
    file, col, row, side = window
    heights = work / f"{name}.img"
    square = [str(number) for number in (col, row, side, side)]
    run(["gdal_translate", "-q", "-ot", "Float32", "-of", "ENVI", "-srcwin", *square, data / file, heights], work)
    samples = array.array("f", heights.read_bytes())
    heights.write_bytes(without_voids(samples, side).tobytes())
    for extra in work.glob(f"{name}.*.xml"):
        extra.unlink()
    return heights


def terrains(work, data, largest):
    """name, file of bare floats, side"""
    for name, *window in WINDOWS:
        if (data / window[0]).exists() and window[3] <= largest:
            yield name, cut(work, data, pathlib.Path(window[0]).stem, window), window[3]
    heights, side = work / "fractal.img", min(largest, 1025)
    node(work, "fractal", heights, side)
    yield "fractal", heights, side


def rows(work, arguments):
    harrier = arguments.harrier.resolve()
    for name, heights, side in terrains(work, arguments.data.resolve(), arguments.largest):
        heights.with_suffix(".hdr").write_text(HEADER.format(side=side))
        for theirs in node(work, "rtin", heights, side, ",".join(map(str, TOLERANCES_M))):
            mesh = work / "mesh.ply"
            run([harrier, "terrain", "extract", heights, "--max-error", repr(theirs["measured"]), "--out", mesh],
                work)
            yield name, theirs, node(work, "ply", heights, side, mesh)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--harrier", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path("no-data"), help="folder of rasters")
    parser.add_argument("--largest", type=int, default=1025, help="leave out larger squares; 2^k + 1 samples")
    arguments = parser.parse_args()
    work = arguments.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    try:
        install(work)
        print("| terrain | martini's M | measured, m | triangles, martini | ours | ratio | ours measured, m |")
        print("|---|---|---|---|---|---|---|")
        bad = 0
        for name, theirs, ours in rows(work, arguments):
            ratio = ours["triangles"] / theirs["triangles"]
            is_good = ours["triangles"] <= theirs["triangles"] and ours["moved"] < 1e-9 and (
                ours["measured"] <= theirs["measured"] + 1e-9)
            bad += not is_good
            print(f"| {name} | {theirs['tolerance']} | {theirs['measured']:.3f} | {theirs['triangles']:,} | "
                  f"{ours['triangles']:,} | {ratio:.3f} | {ours['measured']:.3f} |" + ("" if is_good else " WORSE"))
    except Unobtainable as reason:
        print(f"skipped: {reason}")
        return SKIPPED
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
