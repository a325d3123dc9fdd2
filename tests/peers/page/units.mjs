// The parts of a page that need no browser: node units.mjs

import assert from "node:assert/strict";
import {readFileSync} from "node:fs";

const folder = new URL("../../../scripts/page/", import.meta.url);
const load = (file, name) => new Function(
  readFileSync(new URL(file, folder), "utf8") + `\nreturn ${name};`)();
const viewData = load("data.js", "viewData");
const chart = load("chart.js", "chartView");
const orbit = load("camera.js", "orbit");

const base64 = (typed) => Buffer.from(typed.buffer).toString("base64");

// Positions between frames, and before and after them.
const body = viewData.body({
  label: "base", nodes: 2, springs: 1, low: [1, 2, 3], size: 4,
  ends: {type: "u8", data: base64(Uint8Array.of(0, 1))},
  colour: {type: "u8", data: base64(Uint8Array.of(0, 0))},
  positions: base64(Uint16Array.of(0, 0, 0, 65535, 0, 0, 65535, 0, 0, 65535, 65535, 0)),
}, [0, 2]);
assert.deepEqual([...body.pose(0)], [1, 2, 3, 5, 2, 3]);
assert.deepEqual([...body.pose(1)], [3, 2, 3, 5, 4, 3]);
assert.deepEqual([...body.pose(9)], [5, 2, 3, 5, 6, 3]);
assert.deepEqual([...body.pose(-1)], [1, 2, 3, 5, 2, 3]);

// Weights sum to 1 after rounding; a row of one node copies it.
const rows = viewData.rows({
  count: {type: "u8", data: base64(Uint8Array.of(2, 1))},
  node: {type: "u16", data: base64(Uint16Array.of(0, 1, 1))},
  scale: 1, weight: base64(Int16Array.of(16384, 16384, 32766)),
});
assert.deepEqual([...viewData.interpolate(rows, [0, 0, 0, 2, 4, 6], new Float32Array(6))],
                 [1, 2, 3, 2, 4, 6]);

// A right angle keeps its edge; a flat pair of triangles shares normals.
const square = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];
assert.equal(viewData.smoothGroups([0, 1, 2, 0, 2, 3], square).vertex.length, 4);
const step = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1];
assert.equal(viewData.smoothGroups([0, 1, 2, 0, 3, 1], step).vertex.length, 6);

// Ticks and their texts.
assert.deepEqual(chart.linearTicks(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1]);
assert.deepEqual(chart.linearTicks(-3, 12, 4), [0, 5, 10]);
assert.deepEqual(chart.logTicks(0.8, 12, 8), [1, 2, 5, 10]);
assert.deepEqual(chart.logTicks(1e-6, 1, 4), [1e-6, 1e-4, 1e-2, 1]);
assert.equal(chart.format(0.30000000000000004), "0.3");
assert.equal(chart.format(1e-6), "10⁻⁶");
assert.equal(chart.format(250000), "2.5·10⁵");
assert.equal(chart.tickText(0.002, true), "2·10⁻³");
assert.equal(chart.tickText(5000, true), "5·10³");
assert.deepEqual([0.02, 1, 100].map((v) => chart.tickText(v, true)), ["0.02", "1", "100"]);
assert.equal(chart.tickText(0.002, false), "0.002");
for (const values of [[1], [0], [], [5, 5], [-2, -1], [NaN, 1]])
  for (const log of [false, true]) {
    const axis = chart.axis(values, {log, most: 5});
    assert(axis.high > axis.low && axis.ticks.every(Number.isFinite), `${values} ${log}`);
  }

// Labels neither cover points nor each other, and stay inside.
const marks = Array.from({length: 30}, (_, i) => ({x: 20 + 17 * (i % 6), y: 15 + 25 * (i % 5),
                                                   label: "LOD-" + i}));
const room = {width: 200, height: 160, size: 12};
const boxes = chart.placeLabels(marks, [], room);
const placed = boxes.filter((box) => box);
assert(placed.length > 5);
placed.forEach((a, i) => {
  assert(a.x >= 0 && a.y >= 0 && a.x + a.w <= 200 && a.y + a.h <= 160);
  for (const b of placed.slice(i + 1))
    assert(a.x >= b.x + b.w || b.x >= a.x + a.w || a.y >= b.y + b.h || b.y >= a.y + a.h);
});

// Of points close together, no label is nearer to another point.
for (const apart of [4, 7, 12])
  for (let angle = 0; angle < 6.2; angle += 0.5) {
    const points = [-1, 0, 1].map((i) => ({x: 100 + i * apart * Math.cos(angle),
                                           y: 80 + i * apart * Math.sin(angle), label: "8"}));
    chart.placeLabels(points, [], room).forEach((box, i) => {
      if (!box) return;
      const distances = points.map((p) => Math.hypot(
        p.x - Math.min(Math.max(p.x, box.x), box.x + box.w),
        p.y - Math.min(Math.max(p.y, box.y), box.y + box.h)));
      assert(distances[i] <= Math.min(...distances), `${apart} px apart, angle ${angle}`);
    });
  }

// A label goes where no line is: the usual place is to the right.
const lone = [{x: 100, y: 80, label: "LOD-1"}];
assert(chart.placeLabels(lone, [], room)[0].x > 100);
assert(chart.placeLabels(lone, [[100, 80, 200, 80]], room)[0].x < 100);

// The target is in the middle of the picture, and up is up.
const camera = new orbit.Camera(0, 2);
const {matrix, eye} = camera.at([1, 2, 3], 400, 300);
const project = ([x, y, z]) => {
  const c = [0, 1, 3].map((i) => matrix[i] * x + matrix[4 + i] * y + matrix[8 + i] * z +
    matrix[12 + i]);
  return [c[0] / c[2], c[1] / c[2]];
};
const near = (a, b) => Math.abs(a - b) < 1e-5;
assert(near(project([1, 2, 3])[0], 0) && near(project([1, 2, 3])[1], 0));
assert(project([1, 2, 4])[1] > 0 && eye[0] > 1);
const wall = {normal: [1, 0, 0], offset: 0};
assert(Math.cos(orbit.freeAzimuth([wall])) > 0);
assert(Math.cos(orbit.freeAzimuth([{...wall, normal: [-1, 0, 0]}])) < 0);
console.log("ok");
