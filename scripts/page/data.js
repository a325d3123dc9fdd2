"use strict";
// Data of the 3D view, as s.view packs them (docs/pictures.md): base64 of little-endian numbers.

const viewData = (() => {
  const arrays = {u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, i16: Int16Array};

  function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  // A typed array; the machines that run browsers are little-endian, as are the numbers.
  const numbers = (base64, type) => new arrays[type](bytesOf(base64).buffer);
  const whole = (packed) => numbers(packed.data, packed.type);

  // Rows of weights. Their sums become 1 again, which rounding has changed.
  function rows(packed) {
    const count = whole(packed.count);
    const node = whole(packed.node);
    const rounded = numbers(packed.weight, "i16");
    const start = new Uint32Array(count.length + 1);
    const weight = new Float32Array(node.length);
    for (let p = 0; p < count.length; ++p) {
      start[p + 1] = start[p] + count[p];
      let sum = 0;
      for (let e = start[p]; e < start[p + 1]; ++e) sum += rounded[e];
      for (let e = start[p]; e < start[p + 1]; ++e) weight[e] = rounded[e] / sum;
    }
    return {start, node, weight};
  }

  // The points that rows make of nodes: x, y, z of each, one after the other.
  function interpolate(map, nodes, into) {
    const {start, node, weight} = map;
    for (let p = 0; p + 1 < start.length; ++p) {
      let x = 0, y = 0, z = 0;
      for (let e = start[p]; e < start[p + 1]; ++e) {
        const n = 3 * node[e], w = weight[e];
        x += w * nodes[n];
        y += w * nodes[n + 1];
        z += w * nodes[n + 2];
      }
      into[3 * p] = x;
      into[3 * p + 1] = y;
      into[3 * p + 2] = z;
    }
    return into;
  }

  // A body with pose(t): the positions of its nodes, linear between the frames.
  function body(packed, times) {
    const quantized = numbers(packed.positions, "u16");
    const count = 3 * packed.nodes;
    const scale = packed.size / 65535;
    const pose = new Float32Array(count);
    return {
      label: packed.label, chain: packed.chain, level: packed.level,
      nodes: packed.nodes, springs: packed.springs,
      ends: whole(packed.ends), colour: whole(packed.colour),
      toBase: packed.to_base ? rows(packed.to_base) : null,
      pose(t) {
        let k = 0;
        while (k + 2 < times.length && times[k + 1] <= t) ++k;
        const last = Math.min(k + 1, times.length - 1);
        const span = times[last] - times[k];
        const share = span > 0 ? Math.min(1, Math.max(0, (t - times[k]) / span)) : 0;
        for (let i = 0; i < count; ++i) {
          const a = quantized[k * count + i], b = quantized[last * count + i];
          pose[i] = packed.low[i % 3] + scale * (a + share * (b - a));
        }
        return pose;
      },
    };
  }

  // Number of the group of each corner of the triangles: corners at one vertex whose triangles
  // meet at less than `angle` share a normal.
  function smoothGroups(triangles, positions, angle = Math.PI / 5) {
    const least = Math.cos(angle);
    const at = new Map(); // vertex -> its groups {normal, number}
    const group = new Uint32Array(triangles.length);
    const vertex = [];
    for (let t = 0; t < triangles.length; t += 3) {
      const n = faceNormal(triangles, positions, t);
      const length = Math.hypot(n[0], n[1], n[2]) || 1;
      for (let k = 0; k < 3; ++k) {
        const v = triangles[t + k];
        if (!at.has(v)) at.set(v, []);
        const near = at.get(v).find(({normal, size}) =>
          (n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2]) > least * length * size);
        const own = near || {normal: n, size: length, number: vertex.push(v) - 1};
        if (!near) at.get(v).push(own);
        group[t + k] = own.number;
      }
    }
    return {group, vertex: Uint32Array.from(vertex)};
  }

  // The normal of the triangle at `t`, as long as twice its area.
  function faceNormal(triangles, x, t) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2];
    const vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
    return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  }

  function surface(packed) {
    return {triangles: whole(packed.triangles), colour: whole(packed.colour),
            rows: rows(packed.rows)};
  }

  return {whole, numbers, rows, interpolate, body, surface, smoothGroups, faceNormal};
})();
