// node jolt.mjs FOLDER [--fall]: Jolt reads the levels that hang_jobs.lua wrote, hangs them, and
// lets one fall.
import { join, resolve } from "node:path";
import { check, checkNear, finish, percent, readJobs, sum } from "./jobs.mjs";
import { addBody, hang, Jolt, makeWorld, moving, still, yUp } from "./jolt_world.mjs";

const folder = resolve(process.argv[2]), falls = process.argv[3] === "--fall";
const single = 1e-7;

function checkRoundTrip(job, file) {
  const { nodes, springs, surface } = job.model;
  const level = `level ${job.level}`;
  const shared = file.sharedSettings(Jolt);
  const vertices = shared.mVertices, edges = shared.mEdgeConstraints;
  const read = { mass: [], position: [] };
  for (let n = 0; n < vertices.size(); ++n) {
    const { mPosition: p, mInvMass } = vertices.at(n);
    read.mass.push(1 / mInvMass);
    read.position.push(file.center[0] + p.x, file.center[1] + p.y, file.center[2] + p.z);
  }
  const expected = nodes.mass.flatMap((_, n) => yUp(nodes.rest.slice(3 * n, 3 * n + 3)));
  checkNear(read.mass, nodes.mass, 2 * single, `${level}: masses`);
  checkNear(read.position, expected, 2 * single, `${level}: positions`);
  check(Math.abs(sum(read.mass) / sum(nodes.mass) - 1) < single, `${level}: total mass`);

  // Optimize() sorts the edges.
  const key = (a, b) => Math.min(a, b) * nodes.mass.length + Math.max(a, b);
  const found = new Map();
  for (let s = 0; s < edges.size(); ++s) {
    const edge = edges.at(s);
    found.set(key(edge.get_mVertex(0), edge.get_mVertex(1)), [edge.mRestLength, edge.mCompliance]);
  }
  const of = springs.a.map((a, s) => found.get(key(a, springs.b[s])) ?? [NaN, NaN]);
  check(found.size === springs.a.length, `${level}: ${found.size} edges`);
  checkNear(of.map((edge) => edge[0]), springs.rest_length, 2 * single, `${level}: rest lengths`);
  // Without what Jolt adds in a substep.
  const substep = file.settings.step / file.settings.iterations;
  checkNear(of.map((edge) => edge[1]), springs.stiffness.map((k, s) => Math.max(0, 1 / k -
    substep ** 2 * (1 / nodes.mass[springs.a[s]] + 1 / nodes.mass[springs.b[s]]) / 2)),
  2 * single, `${level}: compliances`);
  if (surface)
    checkNear(file.skinPositions(expected), skinAtRest(surface, expected), 1e-6, `${level}: skin`);
  check(file.skin.triangles.length === (surface?.triangles.length ?? 0), `${level}: triangles`);
  shared.Release();
}

function skinAtRest({ binding }, positions) {
  const placed = [];
  for (let v = 0; v + 1 < binding.start.length; ++v) {
    const place = [0, 0, 0];
    for (let i = binding.start[v]; i < binding.start[v + 1]; ++i)
      for (let axis = 0; axis < 3; ++axis)
        place[axis] += binding.weight[i] * positions[3 * binding.node[i] + axis];
    placed.push(...place);
  }
  return placed;
}

// At the settings of the file, and outside the range of rates: with a quarter of the substeps of
// its lower end, with ten times those of its upper one. A body without a range has its best rate.
function checkHang(job, file) {
  const level = `level ${job.level}`;
  const { iterations, step, error: expected, substepsWithin: [from, to] } = file.settings;
  const recommended = iterations / step;
  const errorAt = (rate, each) => hang(file, job, rate, each) / job.elongation - 1;
  const error = errorAt(recommended, iterations);
  check(Math.abs(error) < (to > 0 ? 0.02 : expected),
    `${level}: elongation at ${recommended.toFixed(0)} Hz: ${percent(error)}, estimated up to ` +
    `${percent(expected)}`);
  for (const rate of to > 0 ? [from / 4, 10 * to] : [recommended / 8, 10 * recommended]) {
    const outside = errorAt(rate, Math.ceil(rate / 600));
    check(Math.abs(outside) > 0.05, `${level}: at ${rate.toFixed(0)} Hz: ${percent(outside)}`);
  }
}

// Falls on a floor, and comes to lie there in one piece.
function checkFall(job, file) {
  const world = makeWorld([0, -9.81, 0]);
  const bodies = world.GetPhysicsSystem().GetBodyInterface();
  const floor = new Jolt.BodyCreationSettings(new Jolt.BoxShape(new Jolt.Vec3(20, 1, 20)),
    new Jolt.RVec3(0, -1, 0), new Jolt.Quat(0, 0, 0, 1), Jolt.EMotionType_Static, still);
  bodies.AddBody(bodies.CreateBody(floor).GetID(), Jolt.EActivation_DontActivate);
  const body = addBody(world,
    file.creationSettings(Jolt, file.sharedSettings(Jolt), moving, [0, 1, 0]));
  let lowest = Infinity, farthest = 0, ofEnd = [];
  for (let step = 0; step < 4 / file.settings.step; ++step) {
    world.Step(file.settings.step, 1);
    ofEnd = file.nodePositions(Jolt, body);
    lowest = ofEnd.reduce((least, p, i) => (i % 3 === 1 ? Math.min(least, p) : least), lowest);
    farthest = ofEnd.reduce((most, p) => Math.max(most, Math.abs(p)), farthest);
  }
  const heights = ofEnd.filter((_, i) => i % 3 === 1);
  const level = `level ${job.level}`;
  check(lowest > -0.02 && farthest < 3, `${level}: falls no deeper than ${lowest.toFixed(4)} m`);
  check(Math.min(...heights) < 0.02 && Math.max(...heights) < 0.6,
    `${level}: lies between ${Math.min(...heights).toFixed(3)} and ` +
    `${Math.max(...heights).toFixed(3)} m`);
  Jolt.destroy(world);
}

for (const job of await readJobs(folder)) {
  const file = await import(join(folder, "jolt", `level_${job.level}.mjs`));
  checkRoundTrip(job, file);
  checkHang(job, file);
  if (falls && job.level === 1) checkFall(job, file);
}
finish();
