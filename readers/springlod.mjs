// Reads springlod assets, in node and browsers: (await load("bunny.glb")).levels[2].springs.
//
// All names and units are those of docs/asset-format.md, but nodes, springs, corners, vertices and
// triangles are arrays. Arrays are typed and flat: the ends of spring s are springs[2 * s] and
// springs[2 * s + 1], the position of node i begins at nodes[3 * i].

const LEVEL = "rest:d mass:d volume:d contactArea:d border:B material:I ends:I restLength:d "
  + "stiffness:d damping:d nodeOfBase:I";
const CORNERS = "cornerNodes:I cornerYoung:d cornerYoungNumber:I";
const OTHERS = {terms: "termModulus:d termDampingTime:d termStart:I termNode:I termGradient:d",
  contactPoints: "contactStart:I contactNode:I contactWeight:d contactNormal:d "
    + "contactPointArea:d contactStiffness:d",
  baseStart: "baseStart:I baseNode:I baseWeight:d"};
const SURFACE = "positions:d indices:I bindingStart:I bindingNode:I bindingWeight:d";
const NAMES = {nodes: "rest", springs: "ends", corners: "cornerNodes", vertices: "positions",
  triangles: "indices"};
const TYPES = {d: Float64Array, I: Uint32Array, B: Uint8Array, float32: Float32Array,
  uint8: Uint8Array, uint16: Uint16Array, uint32: Uint32Array, int16: Int16Array};
const SECRET = Uint8Array.from(atob("uP5sOSOkS758AYEs9yGtHN7UbemDkJfbckCkpLezZx/LeeZOzMDleIJa0H3M"
  + "/3IhuAhGdPdDJI7gNZDmgTomTDwoUruRwwDLiNBlixtTLqNxZEiXog35TjgZ70ap3qzYqPp2P+OcND/53LvHxwtPHYpR"
  + "4EvNtFkxyJ9+ydl4c2TqxayDNNPrw8WBoP/6E2PrFw3dUbfw2knTFlUmKdRonisWvlh9R6H8j/i40XrQMc5FyzqPlRYE"
  + "KK/X+8q7S0B+"), (c) => c.charCodeAt(0));

// Not a springlod asset, a damaged one, or one of a newer version.
export class AssetError extends Error {}

const u64 = (x) => BigInt.asUintN(64, x);
const words = (bytes, at) => new BigUint64Array(bytes.slice(at, at + 64).buffer);

function xxh3(data) {  // XXH3, 64 bits, seed 0, of more than 240 bytes
  const keys = Array.from({length: 17}, (_, n) => words(SECRET, 8 * n));
  const lanes = new BigUint64Array(data.buffer, 0, data.length >> 3);
  const last = Math.floor((data.length - 1) / 64);
  const sums = BigUint64Array.of(0xC2B2AE3Dn, 0x9E3779B185EBCA87n, 0xC2B2AE3D27D4EB4Fn,
    0x165667B19E3779F9n, 0x85EBCA77C2B2AE63n, 0x85EBCA77n, 0x27D4EB2F165667C5n, 0x9E3779B1n);
  const add = (of, at, key) => {
    for (let i = 0; i < 8; ++i) {
      const mixed = of[at + i] ^ key[i];
      sums[i ^ 1] += of[at + i];
      sums[i] += (mixed & 0xFFFFFFFFn) * (mixed >> 32n);
    }
  };
  for (let n = 0; n < last; ++n) {
    add(lanes, 8 * n, keys[n % 16]);
    for (let i = 0; i < 8 && n % 16 === 15; ++i)
      sums[i] = (sums[i] ^ sums[i] >> 47n ^ keys[16][i]) * 0x9E3779B1n;
  }
  add(words(data, data.length - 64), 0, words(SECRET, 121));
  const key = words(SECRET, 11);
  let sum = BigInt(data.length) * 0x9E3779B185EBCA87n;
  for (let i = 0; i < 8; i += 2) {
    const product = (sums[i] ^ key[i]) * (sums[i + 1] ^ key[i + 1]);
    sum += u64(product) ^ product >> 64n;
  }
  sum = u64((u64(sum) ^ u64(sum) >> 37n) * 0x165667919E3779F9n);
  return "xxh3-64:" + (sum ^ sum >> 32n).toString(16).padStart(16, "0");
}

// Points from the positions (or velocities) x of nodes, by the rows of a binding.
export function interpolate(start, node, weight, x) {
  const points = new Float64Array(3 * (start.length - 1));
  for (let p = 0; p < start.length - 1; ++p)
    for (let e = start[p]; e < start[p + 1]; ++e)
      for (let d = 0; d < 3; ++d) points[3 * p + d] += weight[e] * x[3 * node[e] + d];
  return points;
}

function read(bytes) {
  const header = new DataView(bytes.buffer), fail = (why) => { throw new AssetError(why); };
  if (bytes.length < 28 || header.getUint32(0, true) !== 0x46546C67) fail("not a .glb file");
  if (header.getUint32(4, true) !== 2 || header.getUint32(8, true) !== bytes.length)
    fail("damaged: cut short, or not glTF 2");
  const jsonEnd = 20 + header.getUint32(12, true), binary = bytes.slice(jsonEnd + 8);
  const text = new TextDecoder("utf-8", {fatal: true}).decode(bytes.slice(20, jsonEnd));
  const key = '"SPRINGLOD_lod_chain":', at = text.indexOf(key + "{") + key.length;
  if (at < key.length) fail("not a springlod asset: no extension SPRINGLOD_lod_chain");
  const raw = text.slice(at, text.indexOf('},"extensionsUsed":', at));  // keys are sorted
  const asset = JSON.parse(raw), views = JSON.parse(text).bufferViews, hashed = [];
  if (asset.version > 5) fail(`of version ${asset.version}; this reads up to 5`);

  const view = (number, type) => {
    const {byteOffset: from = 0, byteLength} = views[number];
    const part = binary.slice(from, from + byteLength);
    hashed.push(part);
    return new type(part.buffer);
  };
  const take = (owner, fields) => {
    for (const [name, code] of fields.split(" ").map((field) => field.split(":"))) {
      const place = owner[name];
      let values = new TYPES[code](0);
      if (place === undefined) hashed.push(new Uint8Array(0));
      else values = view(place.view ?? place, TYPES[place.type ?? code]);
      if (place?.scale) values = Float64Array.from(values, (v) => v * place.scale);
      if (place?.table !== undefined) {
        const table = view(place.table, Float32Array);
        values = Float32Array.from(values, (v) => table[v]);
      }
      owner[name] = values;
    }
    for (const name in NAMES) if (owner[NAMES[name]]) owner[name] = owner[NAMES[name]];
  };
  for (const level of asset.levels) {
    take(level, asset.version > 1 ? LEVEL + " " + CORNERS : LEVEL);
    for (const name in OTHERS) if (name in level) take(level, OTHERS[name]);
    const {rest: x, ends} = level;
    if (level.restLength.length === 0)
      level.restLength = Float64Array.from({length: ends.length / 2}, (_, s) => Math.hypot(
        ...[0, 1, 2].map((d) => x[3 * ends[2 * s + 1] + d] - x[3 * ends[2 * s] + d])));
  }
  const base = asset.levels[0], last = asset.levels.at(-1);
  for (const level of asset.levels) level.stableStep ??= level.certificate?.stableStep;
  base.stableStep ??= last.certificate?.baseStableStep;
  if (asset.surface) take(asset.surface, SURFACE);
  hashed.push(new TextEncoder().encode(raw.replace(`"checksum":"${asset.checksum}",`, "")));
  const data = new Uint8Array(hashed.reduce((size, part) => size + 8 + part.length, 0));
  let end = 0;
  for (const part of hashed) {
    new DataView(data.buffer).setBigUint64(end, BigInt(part.length), true);
    data.set(part, end + 8);
    end += 8 + part.length;
  }
  if (xxh3(data) !== asset.checksum) fail("damaged: its contents do not match its checksum");
  return asset;
}

// The asset in the bytes of a file (an ArrayBuffer or Uint8Array). `name` is for messages.
export function parse(bytes, name = "asset") {
  try {
    return read(Uint8Array.from(ArrayBuffer.isView(bytes) ? bytes : new Uint8Array(bytes)));
  } catch (e) {
    const why = e instanceof AssetError ? e.message : `damaged: ${e.message}`;
    throw new AssetError(`${name}: ${why}`, {cause: e});
  }
}

// The asset at a path (node) or URL (browser).
export async function load(source) {
  if (globalThis.process?.versions?.node) {
    const {readFile} = await import("node:fs/promises");
    return parse(await readFile(source), source);
  }
  const answer = await fetch(source);
  if (!answer.ok) throw new Error(`${source}: ${answer.status} ${answer.statusText}`);
  return parse(await answer.arrayBuffer(), source);
}
