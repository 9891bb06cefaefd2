// What RTIN (npm's @mapbox/martini) makes of a raster, and how far any triangle mesh is from it.
//
//   node rtin_mesh.mjs rtin HEIGHTS SIDE M,M,...   for each tolerance: triangles, and the error they really have
//   node rtin_mesh.mjs ply HEIGHTS SIDE MESH.ply   the same of a mesh from `harrier terrain extract`
//   node rtin_mesh.mjs fractal HEIGHTS SIDE        writes a relief to compare on
//
// HEIGHTS: SIDE x SIDE little-endian floats, row by row from the north-west; SIDE = 2^k + 1. One line of JSON.
// The package is looked for in the working directory.
import fs from 'node:fs';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';

const [, , what, heightsFile, sideText, detail] = process.argv;
const side = Number(sideText);

function readHeights() {
    const bytes = fs.readFileSync(heightsFile);
    return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + side * side * 4));
}

/// The largest vertical distance of any sample from the triangles over it; infinite when one is not covered.
/// corners: x, y of each vertex in samples; triangles: three vertices each.
function largestError(heights, corners, triangles) {
    const worst = new Float64Array(side * side).fill(-1);
    for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => {
            const x = corners[2 * triangles[t + k]], y = corners[2 * triangles[t + k] + 1];
            return {x, y, h: heights[y * side + x]};
        });
        const area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        for (let y = Math.min(a.y, b.y, c.y); y <= Math.max(a.y, b.y, c.y); ++y) {
            for (let x = Math.min(a.x, b.x, c.x); x <= Math.max(a.x, b.x, c.x); ++x) {
                const v = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
                const w = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
                if (!(v >= 0 && w >= 0 && v + w <= 1)) continue;
                const error = Math.abs(a.h + v * (b.h - a.h) + w * (c.h - a.h) - heights[y * side + x]);
                worst[y * side + x] = Math.max(worst[y * side + x], error);
            }
        }
    }
    return worst.reduce((most, one) => (one < 0 ? Infinity : Math.max(most, one)), 0);
}

async function rtin(heights, tolerances) {
    const require = createRequire(pathToFileURL(process.cwd() + '/'));
    const {default: Martini} = await import(pathToFileURL(
        require.resolve('@mapbox/martini/package.json').replace('package.json', 'index.js')));
    const tile = new Martini(side).createTile(heights);
    return tolerances.map((tolerance) => {
        const {vertices, triangles} = tile.getMesh(tolerance);
        return {tolerance, triangles: triangles.length / 3, measured: largestError(heights, vertices, triangles)};
    });
}

/// Binary PLY with x, y, z in double, one-metre samples, the south-west pixel's corner at the origin.
function ply(heights, file) {
    const bytes = fs.readFileSync(file);
    const start = bytes.indexOf('end_header\n') + 11, header = bytes.toString('latin1', 0, start);
    const count = (name) => Number(header.match(new RegExp(`element ${name} (\\d+)`))[1]);
    const corners = [], triangles = [];
    let moved = 0;
    for (let i = 0, at = start; i < count('vertex'); ++i, at += 24) {
        const x = bytes.readDoubleLE(at) - 0.5, y = side - 0.5 - bytes.readDoubleLE(at + 8);
        corners.push(Math.round(x), Math.round(y));
        const height = heights[Math.round(y) * side + Math.round(x)];
        moved = Math.max(moved, Math.abs(x - Math.round(x)), Math.abs(y - Math.round(y)),
                         Math.abs(bytes.readDoubleLE(at + 16) - height));
    }
    for (let i = 0, at = start + 24 * count('vertex'); i < count('face'); ++i, at += 14) {
        for (let k = 0; k < 3; ++k) triangles.push(bytes.readInt32LE(at + 1 + 4 * k));
    }
    return {triangles: count('face'), measured: largestError(heights, corners, triangles), moved};
}

/// Sums of smooth noise, each octave half as wide and half as high; the same on every machine.
function fractal() {
    const heights = new Float32Array(side * side);
    const noise = (x, y, octave) => {
        let h = (x * 374761393 + y * 668265263 + octave * 974634777) | 0;
        h = Math.imul(h ^ (h >>> 13), 1274126177);
        return ((h ^ (h >>> 16)) >>> 0) / 4294967296;
    };
    for (let octave = 0, cell = side - 1, height = 300; cell >= 1; ++octave, cell /= 2, height /= 2) {
        for (let y = 0; y < side; ++y) {
            for (let x = 0; x < side; ++x) {
                const i = Math.floor(x / cell), j = Math.floor(y / cell), u = x / cell - i, v = y / cell - j;
                const north = noise(i, j, octave) * (1 - u) + noise(i + 1, j, octave) * u;
                const south = noise(i, j + 1, octave) * (1 - u) + noise(i + 1, j + 1, octave) * u;
                heights[y * side + x] += height * (north * (1 - v) + south * v);
            }
        }
    }
    fs.writeFileSync(heightsFile, new Uint8Array(heights.buffer));
    return {};
}

const commands = {
    rtin: () => rtin(readHeights(), detail.split(',').map(Number)),
    ply: () => ply(readHeights(), detail),
    fractal,
};
console.log(JSON.stringify(await commands[what]()));
