// node check_viewers.mjs OUT NAME...: OUT/NAME.glb and OUT/NAME.lightmapped.glb, from the camera that they bring, in
// three.js, Babylon.js and model-viewer, and OUT/NAME.lit.glb in three.js with plugins, in headless Chromium. Each picture is held against OUT/NAME.png and
// that of three.js, and written beside it as NAME.KIND.VIEWER.png. Prints the mean differences over the pixels that show a
// surface; ends with 1 where one is over its bound: a picture in a wrong colour space, or without its light, differs by far more.
import {spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {dirname, extname, join, normalize, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {PNG} from 'pngjs';

// Of the range of a channel, mean over the surface's pixels.
const BOUND = 0.04;           // to the picture
const ALIKE_BOUND = 0.02;     // to that of three.js
const PATIENCE_MS = 120_000;  // for one picture, rendered without a graphics card
const here = dirname(fileURLToPath(import.meta.url));
const [out, ...names] = process.argv.slice(2);

const types = {'.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.glb': 'model/gltf-binary'};
let arrived;  // takes what the page sends
const server = createServer((request, response) => {
  const {pathname} = new URL(request.url, 'http://127.0.0.1');
  if (request.method === 'POST') {
    const parts = [];
    request.on('data', (part) => parts.push(part));
    request.on('end', () => {
      response.end();
      arrived(pathname === '/picture', Buffer.concat(parts).toString());
    });
    return;
  }
  const path = normalize(decodeURIComponent(pathname));
  try {
    const bytes = readFileSync(path.startsWith('/out/') ? join(resolve(out), path.slice(5)) : join(here, path));
    response.setHeader('Content-Type', types[extname(path)] ?? 'application/octet-stream');
    response.end(bytes);
  } catch {
    response.statusCode = 404;
    response.end();
  }
});
await new Promise((listening) => server.listen(0, '127.0.0.1', listening));

// Where the file's node `view` looks from.
function cameraOf(file) {
  const bytes = readFileSync(file);
  const {nodes, cameras} = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
  const {matrix, camera} = nodes.find((node) => node.name === 'view');
  const {yfov, zfar} = cameras[camera].perspective ?? {};
  // reach: about as far as the scene goes.
  return {eye: matrix.slice(12, 15), ahead: matrix.slice(8, 11).map((x) => -x), yfov, reach: zfar / 20};
}

async function show(viewer, file, width, height) {
  const profile = mkdtempSync(join(tmpdir(), 'viewer-'));
  const asked = new URLSearchParams({viewer, file: `/out/${file}`, width, height,
                                     camera: JSON.stringify(cameraOf(join(out, file)))});
  const browser = spawn('chromium', ['--headless=new', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader', '--no-first-run', '--hide-scrollbars', `--user-data-dir=${profile}`,
    `--window-size=${width},${height}`, `http://127.0.0.1:${server.address().port}/viewer.html?${asked}`],
    {stdio: 'ignore'});
  const ended = new Promise((resolve) => browser.on('exit', resolve));
  let timer;
  try {
    return await new Promise((resolve, reject) => {
      timer = setTimeout(() => reject(new Error('no picture came')), PATIENCE_MS);
      browser.on('error', () => reject(new Error('chromium cannot be run')));
      arrived = (ok, text) => ok ? resolve(PNG.sync.read(Buffer.from(text.split(',')[1], 'base64')))
                                 : reject(new Error(text));
    });
  } finally {
    clearTimeout(timer);
    browser.kill('SIGKILL');
    await ended;
    try {
      rmSync(profile, {recursive: true, force: true, maxRetries: 20, retryDelay: 200});
    } catch (error) {
      console.log(`${profile} stays: ${error.message}`);  // the browser's helpers write a little longer than it lives
    }
  }
}

// Mean difference over the pixels that show a surface: those where our picture is not of the background's colour.
function difference(ours, theirs, others = ours) {
  if (ours.width !== theirs.width || ours.height !== theirs.height) {
    throw new Error(`${theirs.width} x ${theirs.height} pixels in place of ${ours.width} x ${ours.height}`);
  }
  const background = [0x12, 0x14, 0x16];
  let sum = 0, pixels = 0;
  for (let i = 0; i < ours.data.length; i += 4) {
    if (background.every((code, c) => ours.data[i + c] === code)) continue;
    ++pixels;
    for (let c = 0; c < 3; ++c) sum += Math.abs(others.data[i + c] - theirs.data[i + c]) / (3 * 255);
  }
  return sum / Math.max(pixels, 1);
}

let bad = names.length === 0;
for (const name of names) {
  const ours = PNG.sync.read(readFileSync(join(out, `${name}.png`)));
  for (const kind of ['glb', 'lightmapped.glb', 'lit.glb']) {
    const file = `${name}.${kind}`;
    let first;
    for (const viewer of kind === 'lit.glb' ? ['three'] : ['three', 'babylon', 'model-viewer']) {
      if (viewer === 'model-viewer' && cameraOf(join(out, file)).yfov === undefined) {
        console.log(`${file} in ${viewer}: left out, it has no orthographic camera`);
        continue;
      }
      try {
        const theirs = await show(viewer, file, ours.width, ours.height);
        writeFileSync(join(out, `${file}.${viewer}.png`), PNG.sync.write(theirs));
        const mean = difference(ours, theirs), apart = first ? difference(ours, theirs, first) : 0;
        const over = (value, bound) => `${value.toFixed(4)}${value > bound ? `, over ${bound}` : ''}`;
        console.log(`${file} in ${viewer}: ${over(mean, BOUND)}` + (first ? `; from three.js ${over(apart, ALIKE_BOUND)}` : ''));
        bad ||= mean > BOUND || apart > ALIKE_BOUND;
        first ??= theirs;
      } catch (error) {
        console.log(`${file} in ${viewer}: ${error.message}`);
        bad = true;
      }
    }
  }
}
server.close();
process.exitCode = bad ? 1 : 0;
