// Lets an exported body fall on a floor in Jolt Physics, and writes its surface as it lies there:
//   springlod export ASSET.glb --to jolt --level 1 -o body
//   npm install jolt-physics
//   node jolt_drop.mjs body.mjs [fallen.obj]
import { writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [bodyFile, objFile] = process.argv.slice(2);
if (!bodyFile) {
  console.error("usage: node jolt_drop.mjs BODY.mjs [FALLEN.obj]");
  process.exit(2);
}
// From the current folder, where npm installed it.
const here = createRequire(join(process.cwd(), "drop.mjs"));
let joltPackage;
try {
  joltPackage = here.resolve("jolt-physics/wasm-compat");
} catch {
  console.error("jolt-physics is not installed in this folder: npm install jolt-physics");
  process.exit(1);
}
const { default: initJolt } = await import(pathToFileURL(joltPackage).href);
const Jolt = await initJolt();
const body = await import(pathToFileURL(resolve(bodyFile)).href);

// A world with two layers: what rests, and what moves.
const still = 0, moving = 1;
const settings = new Jolt.JoltSettings();
const pairs = new Jolt.ObjectLayerPairFilterTable(2);
pairs.EnableCollision(still, moving);
const layers = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
for (const layer of [still, moving])
  layers.MapObjectToBroadPhaseLayer(layer, new Jolt.BroadPhaseLayer(layer));
settings.mObjectLayerPairFilter = pairs;
settings.mBroadPhaseLayerInterface = layers;
settings.mObjectVsBroadPhaseLayerFilter =
  new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
const world = new Jolt.JoltInterface(settings);
const bodies = world.GetPhysicsSystem().GetBodyInterface();

// A floor whose top is at y = 0.
const floor = new Jolt.BodyCreationSettings(new Jolt.BoxShape(new Jolt.Vec3(100, 1, 100)),
  new Jolt.RVec3(0, -1, 0), new Jolt.Quat(0, 0, 0, 1), Jolt.EMotionType_Static, still);
bodies.AddBody(bodies.CreateBody(floor).GetID(), Jolt.EActivation_DontActivate);

// The body, half of its length above the floor.
const size = 2 * body.nodes.position.reduce((most, p) => Math.max(most, Math.abs(p)), 0);
const soft = bodies.CreateSoftBody(
  body.creationSettings(Jolt, body.sharedSettings(Jolt), moving, [0, size, 0]));
bodies.AddBody(soft.GetID(), Jolt.EActivation_Activate);

const steps = Math.round(3 / body.settings.step);
for (let step = 0; step <= steps; ++step) {
  if (step % Math.round(0.25 / body.settings.step) === 0) {
    const heights = body.nodePositions(Jolt, soft).filter((_, i) => i % 3 === 1);
    console.log(`${(step * body.settings.step).toFixed(2)} s: ${body.name} is between ` +
      `${Math.min(...heights).toFixed(3)} and ${Math.max(...heights).toFixed(3)} m high`);
  }
  world.Step(body.settings.step, 1);
}

if (objFile) {
  const points = body.skinPositions(body.nodePositions(Jolt, soft));
  const lines = [];
  for (let i = 0; i < points.length; i += 3) lines.push(`v ${points.slice(i, i + 3).join(" ")}`);
  const corners = body.skin.triangles;
  for (let t = 0; t < corners.length; t += 3)
    lines.push(`f ${corners.slice(t, t + 3).map((corner) => corner + 1).join(" ")}`);
  await writeFile(objFile, lines.join("\n") + "\n");
  console.log(`wrote ${objFile}`);
}
process.exit(0);
