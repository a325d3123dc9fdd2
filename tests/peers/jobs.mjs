// What the tests of the engines share: the jobs of hang_jobs.lua, and checks.
import { readFile } from "node:fs/promises";
import { join } from "node:path";

/** The jobs of a folder, each with the arrays of its level. */
export async function readJobs(folder) {
  const jobs = JSON.parse(await readFile(join(folder, "jobs.json"), "utf8"));
  for (const job of jobs)
    job.model = JSON.parse(await readFile(join(folder, "json", `level_${job.level}.json`), "utf8"));
  return jobs;
}

let failures = 0;

/** Prints a check, and counts it if it fails. */
export function check(passed, text) {
  console.log(`${passed ? "ok    " : "FAILED"} ${text}`);
  if (!passed) failures += 1;
}

/** Checks that all numbers of a list are near those expected, relative to the largest. */
export function checkNear(values, expected, tolerance, text) {
  const size = expected.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  let worst = values.length === expected.length ? 0 : Infinity;
  for (let i = 0; i < expected.length; ++i)
    worst = Math.max(worst, Math.abs(values[i] - expected[i]) / size);
  check(worst <= tolerance, `${text}: ${worst.toExponential(1)}, at most ${tolerance}`);
}

export const sum = (list) => list.reduce((total, value) => total + value, 0);
export const percent = (ratio) => `${(100 * ratio).toFixed(3)} %`;

/** Angular frequency of the lowest mode, about: that of a mass on a spring which gravity extends by
 *  the elongation [rad/s]. */
export const lowestFrequency = (job) => Math.sqrt(Math.hypot(...job.gravity) / job.elongation);

export function finish() {
  process.exit(failures > 0 ? 1 : 0);
}
