// Pieces of a room made by program: pictures, grids and boxes, as arrays of numbers.
import zlib from 'node:zlib';

// A PNG of width x height pixels; `pixel(x, y)`: r g b a, 0..255.
export function png(width, height, pixel) {
  const row = 4 * width + 1;
  const raw = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) raw.set(pixel(x, y), y * row + 1 + 4 * x);
  }
  const chunk = (type, data) => {
    const bytes = Buffer.alloc(12 + data.length);
    bytes.writeUInt32BE(data.length);
    bytes.write(type, 4, 'latin1');
    data.copy(bytes, 8);
    bytes.writeUInt32BE(zlib.crc32(bytes.subarray(4, 8 + data.length)), 8 + data.length);
    return bytes;
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 6], 8);  // 8 bits, RGBA
  return Buffer.concat([
    Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', header), chunk('IDAT', zlib.deflateSync(raw)),
    chunk('IEND', Buffer.alloc(0)),
  ]);
}

// The parallelogram origin, origin + u, origin + v in n x n squares; its front is where u x v points.
export function grid(origin, u, v, n) {
  const positions = [], normals = [], uvs = [], indices = [];
  const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...cross);
  for (let a = 0; a <= n; ++a) {
    for (let b = 0; b <= n; ++b) {
      positions.push(...origin.map((x, k) => x + (u[k] * a + v[k] * b) / n));
      normals.push(...cross.map((x) => x / length));
      uvs.push(a / n, 1 - b / n);
    }
  }
  for (let a = 0; a < n; ++a) {
    for (let b = 0; b < n; ++b) {
      const q = a * (n + 1) + b;
      indices.push(q, q + n + 1, q + n + 2, q, q + n + 2, q + 1);
    }
  }
  return {positions, normals, uvs, indices};
}

// A box from `low` to `high` that shows its outside, or its inside: each face n x n squares.
export function box(low, high, n, inward = false) {
  const [x, y, z] = high.map((h, k) => h - low[k]);
  const faces = [
    [low, [0, 0, z], [0, y, 0]], [[high[0], low[1], low[2]], [0, y, 0], [0, 0, z]],
    [low, [x, 0, 0], [0, 0, z]], [[low[0], high[1], low[2]], [0, 0, z], [x, 0, 0]],
    [low, [0, y, 0], [x, 0, 0]], [[low[0], low[1], high[2]], [x, 0, 0], [0, y, 0]],
  ];
  const all = {positions: [], normals: [], uvs: [], indices: []};
  for (const [origin, u, v] of faces) {
    const face = inward ? grid(origin, v, u, n) : grid(origin, u, v, n);
    const first = all.positions.length / 3;
    all.positions.push(...face.positions);
    all.normals.push(...face.normals);
    all.uvs.push(...face.uvs);
    all.indices.push(...face.indices.map((index) => index + first));
  }
  return all;
}
