// A world of Jolt's for one soft body, and the hang test.
import initJolt from "jolt-physics/wasm-compat";

export const Jolt = await initJolt();
/** Layers of what rests and what moves. */
export const still = 0, moving = 1;

/** A world in which moving things touch all others. Jolt.destroy() ends it. */
export function makeWorld(gravity) {
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
  Jolt.destroy(settings);
  world.GetPhysicsSystem().SetGravity(new Jolt.Vec3(...gravity));
  return world;
}

/** Adds a soft body with creation settings to a world. */
export function addBody(world, settings) {
  const bodies = world.GetPhysicsSystem().GetBodyInterface();
  const body = bodies.CreateSoftBody(settings);
  bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
  return body;
}

/** Axes with y up, as in the exported files. */
export const yUp = ([x, y, z]) => [x, z, -y];

/** Elongation [m] of a level held at an end, from its exported module: the mean over the last 40 %
 *  of the time in which its vibrations die out. `rate`: substeps a second; `iterations` of them are
 *  one step of the world. `substep`: what the edges are told [s]; with 0, they have the compliance
 *  1/k. `scale`: units of length a metre. */
export function hang(file, job, rate, iterations, { substep = 1 / rate, scale = 1 } = {}) {
  const world = makeWorld(yUp(job.gravity).map((g) => g * scale));
  const shared = scaled(file.sharedSettings(Jolt, job.held, substep), scale);
  const settings = file.creationSettings(Jolt, shared, moving, file.center.map((x) => x * scale));
  const frequency = Math.sqrt(Math.hypot(...job.gravity) / job.elongation);
  settings.mNumIterations = iterations;
  // Jolt damps what a substep adds for gravity, too.
  settings.mLinearDamping = 2 * frequency;
  settings.mGravityFactor = 1 / (1 - settings.mLinearDamping / rate);
  settings.mAllowSleeping = false;
  const body = addBody(world, settings);
  Jolt.destroy(settings);
  const along = job.gravity.map((g) => g / Math.hypot(...job.gravity));
  const direction = yUp(along);
  const elongation = () => {
    const now = file.nodePositions(Jolt, body);
    let total = 0;
    for (const n of job.free)
      for (let axis = 0; axis < 3; ++axis)
        total += direction[axis] * (now[3 * n + axis] / scale -
          file.nodes.position[3 * n + axis] - file.center[axis]);
    return total / job.free.length;
  };
  const steps = Math.max(10, Math.ceil((16 / frequency) * (rate / iterations)));
  let total = 0, count = 0;
  for (let step = 0; step < steps; ++step) {
    world.Step(iterations / rate, 1);
    if (step < 0.6 * steps) continue;
    total += elongation();
    count += 1;
  }
  Jolt.destroy(world);
  return total / count;
}

/** Shared settings in another unit of length. Masses and compliances [s2/kg] keep their numbers. */
function scaled(shared, scale) {
  if (scale === 1) return shared;
  for (let n = 0; n < shared.mVertices.size(); ++n) {
    const { mPosition } = shared.mVertices.at(n);
    for (const axis of ["x", "y", "z"]) mPosition[axis] *= scale;
  }
  for (let s = 0; s < shared.mEdgeConstraints.size(); ++s)
    shared.mEdgeConstraints.at(s).mRestLength *= scale;
  return shared;
}
