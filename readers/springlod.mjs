// Reads springlod assets, in node and browsers: (await load("bunny.glb")).levels[2].springs.
// Names and units: docs/asset-format.md; nodes, springs, corners, vertices, triangles are arrays,
// typed and flat: spring s is between the nodes springs[2 * s] and springs[2 * s + 1].
const TYPES = {float64: Float64Array, float32: Float32Array, uint8: Uint8Array,
  uint16: Uint16Array, uint32: Uint32Array, int16: Int16Array};
const NAMES = [["nodes", "rest", 3], ["springs", "ends", 2], ["corners", "cornerNodes", 4],
  ["vertices", "positions", 3], ["triangles", "indices", 3]];
const CRC = Int32Array.from({length: 256}, (_, n) => {  // CRC-32 of each byte
  for (let bit = 0; bit < 8; ++bit) n = n >>> 1 ^ -(n & 1) & 0xEDB88320;
  return n;
});
export class AssetError extends Error {}  // not an asset, damaged, or of another version

export function interpolate(start, node, weight, x) {  // x: positions or velocities of the nodes
  const points = new Float64Array(3 * (start.length - 1));
  for (let p = 0; p < start.length - 1; ++p)
    for (let e = start[p]; e < start[p + 1]; ++e)
      for (let d = 0; d < 3; ++d) points[3 * p + d] += weight[e] * x[3 * node[e] + d];
  return points;
}

export function parse(file, name = "asset") {  // file: an ArrayBuffer or Uint8Array
  const bytes = new Uint8Array(file).slice(), head = new DataView(bytes.buffer);
  const check = (is, why) => { if (!is) throw new AssetError(`${name}: ${why}`); };
  check(bytes.length >= 28 && head.getUint32(0) === 0x676C5446, "not a .glb file");
  check(head.getUint32(8, true) === bytes.length, "damaged: cut short");
  const end = 20 + head.getUint32(12, true), text = new TextDecoder().decode(bytes.slice(20, end));
  const given = text.match(/"SPRINGLOD_lod_chain":{"checksum":"(crc32:\w{8})"/)?.[1];
  check(given, "not a springlod asset of version 6; springlod slim writes older ones again");
  bytes.set(new TextEncoder().encode("crc32:00000000"), 20 + text.indexOf(given));
  let crc = -1;
  for (let i = 0; i < bytes.length; ++i) crc = CRC[(crc ^ bytes[i]) & 255] ^ crc >>> 8;
  check(given === `crc32:${(~crc >>> 0).toString(16).padStart(8, "0")}`, "damaged: wrong checksum");
  const gltf = JSON.parse(text), asset = gltf.extensions.SPRINGLOD_lod_chain;
  check(asset.version === 6, `of version ${asset.version}: take a newer springlod.mjs`);
  const view = (number, type) => {
    const {byteOffset = 0, byteLength} = gltf.bufferViews[number], from = end + 8 + byteOffset;
    return new type(bytes.slice(from, from + byteLength).buffer);
  };
  const unpack = ({view: number, type, scale = 1, table}) => {
    const values = view(number, TYPES[type]), of = table && view(table, Float32Array);
    return of || scale !== 1 ? Float64Array.from(values, (v) => of ? of[v] : v * scale) : values;
  };
  for (const owner of [...asset.levels, asset.surface ?? {}]) {
    for (const key in owner) if (owner[key]?.type) owner[key] = unpack(owner[key]);
    for (const [count, field, width] of NAMES.filter(([name]) => name in owner)) {
      check(owner[field].length === width * owner[count], `damaged: ${count}`);
      owner[count] = owner[field];
    }
    if (owner.restLength?.length === 0)  // no spring has a force at rest
      owner.restLength = Float64Array.from(owner.stiffness, (_, s) => Math.hypot(...[0, 1, 2].map(
        (d) => owner.rest[3 * owner.ends[2 * s] + d] - owner.rest[3 * owner.ends[2 * s + 1] + d])));
  }
  return asset;
}

export async function load(path) {  // path: of a file (node), or a URL (browser)
  const files = globalThis.process?.versions.node && await import("node:fs/promises");
  return parse(files ? await files.readFile(path) : await (await fetch(path)).arrayBuffer(), path);
}
