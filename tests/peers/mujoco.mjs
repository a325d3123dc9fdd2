// node mujoco.mjs FOLDER: MuJoCo reads the levels that hang_jobs.lua wrote, and hangs them.
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import loadMujoco from "@mujoco/mujoco";
import { check, checkNear, finish, lowestFrequency, percent, readJobs, sum } from "./jobs.mjs";

const folder = process.argv[2];
const mujoco = await loadMujoco();

const mjcf = (job) => readFile(join(folder, "mujoco", `level_${job.level}.xml`), "utf8");
const rows = (array, first, columns) => Array.from(array).slice(first * columns);

// The bodies of nodes follow the world and the body that holds them all.
const firstNode = 2;

function checkRoundTrip(job, model) {
  const { nodes, springs } = job.model;
  const level = `level ${job.level}`;
  checkNear(rows(model.body_mass, firstNode, 1), nodes.mass, 1e-11, `${level}: masses`);
  checkNear(rows(model.body_pos, firstNode, 3), nodes.rest, 1e-11, `${level}: positions`);
  checkNear(Array.from(model.tendon_stiffness), springs.stiffness, 1e-11, `${level}: stiffness`);
  checkNear(Array.from(model.tendon_damping), springs.damping, 1e-11, `${level}: damping`);
  checkNear(rows(model.tendon_lengthspring, 0, 1).filter((_, i) => i % 2 === 0),
    springs.rest_length, 1e-11, `${level}: rest lengths`);
  check(Math.abs(sum(rows(model.body_mass, 0, 1)) / sum(nodes.mass) - 1) < 1e-12,
    `${level}: total mass ${sum(nodes.mass).toFixed(3)} kg`);
}

// The skin's vertices at rest as its bones give them, which is what MuJoCo draws.
function checkSkin(job, model) {
  const vertices = rows(model.skin_vert, 0, 3);
  const placed = new Float64Array(vertices.length), total = new Float64Array(vertices.length / 3);
  for (let bone = 0; bone < model.skin_bonenum[0]; ++bone) {
    const first = model.skin_bonevertadr[bone];
    const node = model.skin_bonebodyid[bone] - firstNode;
    for (let i = first; i < first + model.skin_bonevertnum[bone]; ++i) {
      const vertex = model.skin_bonevertid[i], weight = model.skin_bonevertweight[i];
      total[vertex] += weight;
      for (let axis = 0; axis < 3; ++axis)
        placed[3 * vertex + axis] += weight * job.model.nodes.rest[3 * node + axis];
    }
  }
  const level = `level ${job.level}`;
  checkNear(total, new Float64Array(total.length).fill(1), 1e-5, `${level}: weights of the skin`);
  checkNear(placed, vertices, 1e-5, `${level}: skin at rest`);
  check(model.skin_facenum[0] === job.model.surface.triangles.length / 3, `${level}: triangles`);
}

// A held node has no joints.
function heldMjcf(text, job) {
  const held = new Set(job.held);
  return text.split("\n").map((line) => {
    const node = /<body name="level_\d+_(\d+)"/.exec(line);
    return node && held.has(Number(node[1])) ? line.replace(/<joint [^>]*\/>/g, "") : line;
  }).join("\n");
}

// Mean elongation after it has come to rest, with damping of the nodes in proportion to their mass.
function hang(text, job) {
  const model = mujoco.MjModel.from_xml_string(text);
  const data = new mujoco.MjData(model);
  const frequency = lowestFrequency(job);
  for (let dof = 0; dof < model.nv; ++dof)
    model.dof_damping[dof] = 0.4 * frequency * model.body_mass[model.dof_bodyid[dof]];
  const steps = Math.round(60 / frequency / model.opt.timestep);
  for (let step = 0; step < steps; ++step) mujoco.mj_step(model, data);
  const reached = sum(job.free.map((n) =>
    data.xpos[3 * (n + firstNode)] - job.model.nodes.rest[3 * n])) / job.free.length;
  data.delete();
  model.delete();
  return reached;
}

// Whether small vibrations stay small. MuJoCo resets a state that has diverged, and its time.
function isStable(text, stepFactor) {
  const model = mujoco.MjModel.from_xml_string(text);
  const data = new mujoco.MjData(model);
  model.opt.timestep *= stepFactor;
  for (let dof = 0; dof < model.nv; ++dof) data.qvel[dof] = 0.01 * Math.sin(7 * dof * dof);
  const steps = 400;
  for (let step = 0; step < steps; ++step) mujoco.mj_step(model, data);
  const stable = data.time > (steps - 1) * model.opt.timestep;
  data.delete();
  model.delete();
  return stable;
}

for (const job of await readJobs(folder)) {
  const text = await mjcf(job);
  const model = mujoco.MjModel.from_xml_string(text);
  checkRoundTrip(job, model);
  checkSkin(job, model);
  model.delete();
  check(isStable(text, 1.2), `level ${job.level}: stable at 1.2 times the step of the file`);
  check(!isStable(text, 1.5), `level ${job.level}: unstable at 1.5 times that step`);
  const error = hang(heldMjcf(text, job), job) / job.elongation - 1;
  check(Math.abs(error) < 5e-5, `level ${job.level}: elongation, error ${percent(error)}`);
}
finish();
