// node jolt_rates.mjs FOLDER...: the error of hanging bodies in Jolt at different rates, and that of
// other recipes at the exported rate; the tables of docs/export.md. A folder is one that
// hang_jobs.lua wrote.
import { basename, join, resolve } from "node:path";
import { readJobs } from "./jobs.mjs";
import { hang } from "./jolt_world.mjs";

// What is measured: factors of the exported rate, iterations in a step of the world, and hang's
// options.
const rates = [0.125, 0.25, 0.5, 1, 2, 4].map((factor) =>
  ({ name: factor === 1 ? "as exported" : `x ${factor}`, factor }));
const recipes = [
  { name: "as exported", whole: true },
  { name: "10 x N/10", tenth: true },
  { name: "N x 1" },
  { name: "in dm", options: { scale: 10 } },
  { name: "in cm", options: { scale: 100 } },
  { name: "compliance 1/k", options: { substep: 0 } },
];

function measure(file, job, { factor = 1, whole = false, tenth = false, options }) {
  const { iterations, step } = file.settings;
  const each = whole ? iterations : tenth ? Math.ceil(iterations / 10) : 1;
  const error = hang(file, job, (factor * iterations) / step, each, options) / job.elongation - 1;
  return `${(100 * error).toFixed(1)} %`;
}

async function table(folders, columns) {
  console.log(`| body | level | N | estimate | ${columns.map(({ name }) => name).join(" | ")} |`);
  console.log(`|---|--:|--:|--:|${columns.map(() => "--:").join("|")}|`);
  for (const folder of folders)
    for (const job of await readJobs(folder)) {
      const file = await import(join(resolve(folder), "jolt", `level_${job.level}.mjs`));
      const { iterations, error } = file.settings;
      console.log(`| ${basename(folder)} | ${job.level} | ${iterations} | ` +
        `${(100 * error).toFixed(1)} % | ` +
        `${columns.map((column) => measure(file, job, column)).join(" | ")} |`);
    }
}

const folders = process.argv.slice(2);
await table(folders, rates);
console.log("");
await table(folders.filter((folder) => !/_(soft|stiff)$/.test(folder)), recipes);
process.exit(0);
