// One room as glTF in many encodings: with plain geometry, with the features that place and paint the
// same geometry, and compressed.
import {Document, Logger, NodeIO} from '@gltf-transform/core';
import {
  ALL_EXTENSIONS, EXTMeshGPUInstancing, KHRLightsPunctual, KHRMaterialsEmissiveStrength, KHRTextureTransform,
} from '@gltf-transform/extensions';
import {draco, meshopt, quantize, reorder, sparse, unweld, weld} from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import {MeshoptDecoder, MeshoptEncoder} from 'meshoptimizer';
import {box, grid, png} from './room_parts.mjs';

const UV = {scale: [3, 2], rotation: 0.4, offset: [0.25, 0.1]};
const BEND = Math.PI / 6;  // of the skinned column's upper half

const aroundY = (angle) => [0, Math.sin(angle / 2), 0, Math.cos(angle / 2)];

function transformed([u, v]) {
  const [c, s, x, y] = [Math.cos(UV.rotation), Math.sin(UV.rotation), u * UV.scale[0], v * UV.scale[1]];
  return [c * x + s * y + UV.offset[0], c * y - s * x + UV.offset[1]];
}

const inPairs = (list) => list.flatMap((x, k) => (k % 2 === 0 ? [[x, list[k + 1]]] : []));

class Room {
  constructor() {
    this.document = new Document().setLogger(new Logger(Logger.Verbosity.SILENT));
    this.buffer = this.document.createBuffer();
    this.scene = this.document.createScene();
    this.document.getRoot().setDefaultScene(this.scene);
  }
  accessor(array, type) {
    return this.document.createAccessor().setType(type).setArray(array).setBuffer(this.buffer);
  }
  floats(list, type) { return this.accessor(new Float32Array(list), type); }
  material(name, color) {
    return this.document.createMaterial(name).setMetallicFactor(0).setBaseColorFactor([...color, 1]);
  }
  texture(name, width, height, pixel) {
    return this.document.createTexture(name).setMimeType('image/png').setImage(png(width, height, pixel));
  }
  primitive(shape, material, attributes = {}) {
    const primitive = this.document.createPrimitive().setMaterial(material)
      .setIndices(this.accessor(new Uint16Array(shape.indices), 'SCALAR'))
      .setAttribute('POSITION', this.floats(shape.positions, 'VEC3'))
      .setAttribute('NORMAL', this.floats(shape.normals, 'VEC3'));
    for (const [name, accessor] of Object.entries(attributes)) primitive.setAttribute(name, accessor);
    return primitive;
  }
  mesh(name, primitive) { return this.document.createMesh(name).addPrimitive(primitive); }
  add(name, mesh) {
    const node = this.document.createNode(name).setMesh(mesh);
    this.scene.addChild(node);
    return node;
  }
}

function addPanel(room, features) {
  const bricks = room.material('bricks', [1, 1, 1]).setBaseColorTexture(
    room.texture('bricks', 32, 32, (x, y) => (((x >> 3) + (y >> 3)) % 2 ? [230, 120, 60, 255] : [60, 90, 200, 255])));
  const shape = grid([0.01, 0.5, 0.5], [0, 2, 0], [0, 0, 3], 5);
  if (!features) {
    const uvs = room.floats(inPairs(shape.uvs).flatMap(transformed), 'VEC2');
    room.add('panel', room.mesh('panel', room.primitive(shape, bricks, {TEXCOORD_0: uvs})));
    return;
  }
  const transform = room.document.createExtension(KHRTextureTransform).createTransform();
  transform.setScale(UV.scale).setRotation(UV.rotation).setOffset(UV.offset);
  bricks.getBaseColorTextureInfo().setTexCoord(1).setExtension('KHR_texture_transform', transform);
  room.add('panel', room.mesh('panel', room.primitive(shape, bricks, {
    TEXCOORD_0: room.floats(shape.uvs.map(() => 0.5), 'VEC2'), TEXCOORD_1: room.floats(shape.uvs, 'VEC2'),
  })));
}

function addPainted(room) {
  const shape = grid([5.99, 0.5, 0.5], [0, 0, 3], [0, 2, 0], 5);
  const colors = [];
  for (let k = 0; k < shape.positions.length; k += 3) {
    colors.push(shape.positions[k + 1] / 3, shape.positions[k + 2] / 4, 0.5, 1);
  }
  const color = room.floats(colors, 'VEC4');
  room.add('painted', room.mesh('painted', room.primitive(shape, room.material('painted', [1, 1, 1]), {COLOR_0: color})));
}

function addLeaf(room) {
  const cut = room.texture('leaf', 64, 64, (x, y) => [40, 180, 40, Math.hypot(x - 31.5, y - 31.5) < 24 ? 255 : 0]);
  const leaf = room.material('leaf', [1, 1, 1]).setBaseColorTexture(cut).setDoubleSided(true)
    .setAlphaMode('MASK').setAlphaCutoff(0.5);
  const shape = grid([2, 0.5, 2], [2, 0, 0], [0, 2, 0], 8);
  room.add('leaf', room.mesh('leaf', room.primitive(shape, leaf, {TEXCOORD_0: room.floats(shape.uvs, 'VEC2')})));
}

function addBoxes(room, features, red) {
  const places = [[1, 0.3, 1], [1, 0.3, 3], [5, 0.3, 1]], angles = [0, 0.5, 1], sizes = [1, 1.2, 0.8];
  const mesh = room.mesh('boxes', room.primitive(box([-0.2, -0.2, -0.2], [0.2, 0.2, 0.2], 2), red));
  if (features) {
    const instances = room.document.createExtension(EXTMeshGPUInstancing).createInstancedMesh()
      .setAttribute('TRANSLATION', room.floats(places.flat(), 'VEC3'))
      .setAttribute('ROTATION', room.floats(angles.flatMap(aroundY), 'VEC4'))
      .setAttribute('SCALE', room.floats(sizes.flatMap((s) => [s, s, s]), 'VEC3'));
    room.add('boxes', mesh).setExtension('EXT_mesh_gpu_instancing', instances);
    return;
  }
  places.forEach((place, k) => {
    const size = [sizes[k], sizes[k], sizes[k]];
    room.add(`box${k}`, mesh).setTranslation(place).setRotation(aroundY(angles[k])).setScale(size);
  });
}

// A box whose top rises and which moves aside.
function addMorph(room, features, red) {
  const shape = box([3, 0.02, 3], [3.5, 0.52, 3.5], 2);
  const weights = [0.6, 0.5];
  const targets = [
    shape.positions.map((x, k) => (k % 3 === 1 && x > 0.3 ? 0.5 : 0)), shape.positions.map((x, k) => (k % 3 === 0 ? 0.2 : 0)),
  ];
  if (!features) {
    shape.positions = shape.positions.map((x, k) => x + weights[0] * targets[0][k] + weights[1] * targets[1][k]);
    room.add('morph', room.mesh('morph', room.primitive(shape, red)));
    return;
  }
  const primitive = room.primitive(shape, red);
  for (const target of targets) {
    const positions = room.floats(target, 'VEC3');
    primitive.addTarget(room.document.createPrimitiveTarget().setAttribute('POSITION', positions));
  }
  room.add('morph', room.mesh('morph', primitive).setWeights([0, 0])).setWeights(weights);
}

// A column whose upper half is bent about the joint at (4.7, 1).
function addSkin(room, features, white) {
  const shape = box([4.5, 0.02, 2.6], [4.9, 2.02, 3], 4);
  const upper = shape.positions.filter((_, k) => k % 3 === 1).map((y) => Math.min(1, Math.max(0, (y - 0.8) / 0.4)));
  if (!features) {
    const bent = [];
    upper.forEach((w, k) => {
      const [x, y, z] = shape.positions.slice(3 * k, 3 * k + 3);
      const [c, s, dx, dy] = [Math.cos(BEND), Math.sin(BEND), x - 4.7, y - 1];
      bent.push(x * (1 - w) + (4.7 + dx * c - dy * s) * w, y * (1 - w) + (1 + dx * s + dy * c) * w, z);
    });
    room.add('skin', room.mesh('skin', room.primitive({...shape, positions: bent}, white)));
    return;
  }
  const root = room.document.createNode('lower').setTranslation([4.7, 0, 2.8]);
  const bend = room.document.createNode('upper').setTranslation([0, 1, 0]);
  bend.setRotation([0, 0, Math.sin(BEND / 2), Math.cos(BEND / 2)]);
  root.addChild(bend);
  room.scene.addChild(root);
  const inverse = (y) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -4.7, -y, -2.8, 1];
  const skin = room.document.createSkin().addJoint(root).addJoint(bend);
  skin.setInverseBindMatrices(room.floats([...inverse(0), ...inverse(1)], 'MAT4'));
  const primitive = room.primitive(shape, white, {
    JOINTS_0: room.accessor(new Uint8Array(upper.flatMap(() => [0, 1, 0, 0])), 'VEC4'),
    WEIGHTS_0: room.floats(upper.flatMap((w) => [1 - w, w, 0, 0]), 'VEC4'),
  });
  // A skinned mesh is where its joints are: where its node is does not count.
  room.add('skin', room.mesh('skin', primitive)).setSkin(skin).setTranslation([9, 9, 9]);
}

function addLights(room) {
  const strength = room.document.createExtension(KHRMaterialsEmissiveStrength).createEmissiveStrength();
  const lamp = room.material('lamp', [0, 0, 0]).setEmissiveFactor([1, 0.9, 0.8])
    .setExtension('KHR_materials_emissive_strength', strength.setEmissiveStrength(50));
  room.add('lamp', room.mesh('lamp', room.primitive(grid([2.5, 2.9, 1.5], [1, 0, 0], [0, 0, 1], 2), lamp)));
  const spot = room.document.createExtension(KHRLightsPunctual).createLight('spot').setType('spot')
    .setIntensity(200).setColor([1, 1, 0.8]).setInnerConeAngle(0.3).setOuterConeAngle(0.6);
  const down = room.document.createNode('spot').setTranslation([1, 2.8, 2]);
  down.setRotation([-Math.SQRT1_2, 0, 0, Math.SQRT1_2]).setExtension('KHR_lights_punctual', spot);
  room.scene.addChild(down);
  const camera = room.document.createCamera().setType('perspective').setYFov(1.1).setZNear(0.01);
  room.scene.addChild(room.document.createNode('eye').setTranslation([3, 1.5, 3.9]).setCamera(camera));
}

function makeRoom(features) {
  const room = new Room();
  const white = room.material('white', [0.7, 0.7, 0.7]), red = room.material('red', [0.7, 0.2, 0.2]);
  room.add('room', room.mesh('room', room.primitive(box([0, 0, 0], [6, 3, 4], 6, true), white)));
  addPanel(room, features);
  addPainted(room);
  addLeaf(room);
  addBoxes(room, features, red);
  addMorph(room, features, red);
  addSkin(room, features, white);
  addLights(room);
  return room.document;
}

// Writes the rooms to a folder. Returns the files' names, the plain one first.
export async function writeRooms(folder) {
  await Promise.all([MeshoptEncoder.ready, MeshoptDecoder.ready]);
  const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
    'draco3d.encoder': await draco3d.createEncoderModule(), 'draco3d.decoder': await draco3d.createDecoderModule(),
    'meshopt.encoder': MeshoptEncoder, 'meshopt.decoder': MeshoptDecoder,
  });
  const fine = {quantizePosition: 16, quantizeTexcoord: 16, quantizeColor: 16};
  const files = [
    ['plain.glb', false], ['features.glb', true], ['features.gltf', true], ['sparse.glb', true, sparse({ratio: 1})],
    ['unwelded.glb', true, unweld()], ['reordered.glb', true, weld(), reorder({encoder: MeshoptEncoder})],
    ['quantized.glb', true, quantize(fine)], ['draco.glb', true, draco({...fine, quantizeTexcoord: 14})],
    ['draco_sequential.glb', false, draco({method: 'sequential', quantizePosition: 16})],
    ['meshopt_medium.glb', true, meshopt({encoder: MeshoptEncoder, level: 'medium', ...fine})],
    ['meshopt_high.glb', true, meshopt({encoder: MeshoptEncoder, level: 'high', ...fine})],
  ];
  for (const [name, features, ...steps] of files) {
    const room = makeRoom(features);
    if (steps.length > 0) await room.transform(...steps);
    await io.write(`${folder}/${name}`, room);
  }
  return files.map(([name]) => name);
}
