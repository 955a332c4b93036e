// node check_encodings.mjs LAMBERT: one room, plain and with instances, a morph, a skin, transformed
// textures, MASK and a spot, in eleven encodings, has the same patches and the same light. Ends with
// 1 where a file has not.
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {writeRooms} from './encoded_rooms.mjs';

const FARTHEST_M = 1e-3;     // of two middles of one patch: positions of 14 to 16 bits over 6 m
const REFLECTANCE = 0.004;   // vertex colours of 8 bits, textures at quantised places
const STANDARD_ERRORS = 4;   // of all light that is reflected

function readPatches(file) {
  const [head, ...lines] = fs.readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
  const column = Object.fromEntries(head.map((name, k) => [name, k]));
  return lines.map((line) => {
    const of = (name) => Number(line[column[name]]);
    const corners = [0, 1, 2].map((k) => ['x', 'y', 'z'].map((axis) => of(axis + k)));
    return {
      middle: [0, 1, 2].map((k) => (corners[0][k] + corners[1][k] + corners[2][k]) / 3),
      normal: cross(corners), area: of('area_m2'), reflectance: ['r', 'g', 'b'].map((c) => of(`reflectance_${c}`)),
      radiosity: of('radiosity_g'), stdError: of('std_error_g'),
    };
  });
}

function cross([a, b, c]) {
  const u = b.map((x, k) => x - a[k]), v = c.map((x, k) => x - a[k]);
  const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...n);
  return n.map((x) => x / length);
}

const distance = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

// The patch of the same place and side.
function partnerOf(patch, others) {
  let best = null, nearest = Infinity;
  for (const other of others) {
    const away = distance(patch.middle, other.middle);
    if (away < nearest && patch.normal.reduce((sum, x, k) => sum + x * other.normal[k], 0) > 0.99) {
      [best, nearest] = [other, away];
    }
  }
  return {best, nearest};
}

function power(patches) {
  let sum = 0, variance = 0;
  for (const {area, radiosity, stdError} of patches) {
    sum += area * radiosity;
    variance += (area * stdError) ** 2;
  }
  return {sum, variance};
}

// What differs, in words; "" for nothing.
function differenceOf(plain, other) {
  if (plain.length !== other.length) return `${other.length} patches of ${plain.length}`;
  for (const patch of plain) {
    const {best, nearest} = partnerOf(patch, other);
    if (nearest > FARTHEST_M) return `no patch at ${patch.middle}: the nearest is ${nearest} m away`;
    const off = Math.max(...patch.reflectance.map((x, k) => Math.abs(x - best.reflectance[k])));
    if (off > REFLECTANCE) return `a reflectance at ${patch.middle} differs by ${off}`;
  }
  const [a, b] = [power(plain), power(other)];
  const z = (b.sum - a.sum) / Math.sqrt(a.variance + b.variance);
  return Math.abs(z) < STANDARD_ERRORS ? '' : `its light differs by ${z} standard errors`;
}

const lambert = path.resolve(process.argv[2]);
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'encodings-'));
let bad = 0;
try {
  let plain = null;
  for (const name of await writeRooms(folder)) {
    const out = path.join(folder, `${name}.out`);
    execFileSync(lambert, ['bake', path.join(folder, name), '-o', out, '--method', 'pmcr', '--max-rays', '300000',
      '--adapt', 'off', '--progress', 'none'], {stdio: 'pipe'});
    const patches = readPatches(path.join(out, 'patches.csv'));
    plain ??= patches;
    const difference = differenceOf(plain, patches);
    console.log(`${name}: ${difference || `${patches.length} patches, as in the plain room`}`);
    if (difference) ++bad;
  }
} finally {
  fs.rmSync(folder, {recursive: true, force: true});
}
process.exitCode = bad > 0 ? 1 : 0;
