// node jolt_rates.mjs FOLDER...: the error of hanging bodies in Jolt at different rates, beside the
// two terms that report/export/substep_window.hpp estimates; the table of docs/export.md. A folder
// is one that hang_jobs.lua wrote:
//   for unit in cm dm m; do for kind in soft stiff; do springlod --unsafe run
//     tests/peers/hang_jobs.lua -- out/rates/${unit}_$kind $unit $kind; done; done
import { basename, join, resolve } from "node:path";
import { readJobs } from "./jobs.mjs";
import { hang } from "./jolt_world.mjs";

const factors = [0.25, 0.5, 1, 2, 4, 10];
const rateName = (factor) => (factor === 1 ? "as exported" : `x ${factor}`);
console.log(`| body | level | as exported [1/s] | ${factors.map(rateName).join(" | ")} |`);
console.log(`|---|--:|--:|${factors.map(() => "--:").join("|")}|`);
for (const folder of process.argv.slice(2)) {
  for (const job of await readJobs(folder)) {
    const file = await import(join(resolve(folder), "jolt", `level_${job.level}.mjs`));
    const exported = file.settings.iterations / file.settings.step;
    const cells = factors.map((factor) => {
      const error = hang(file, job, factor * exported, 1) / job.elongation - 1;
      return `${(100 * error).toFixed(1)} %`;
    });
    console.log(`| ${basename(folder)} | ${job.level} | ${exported.toFixed(0)} ` +
      `(${(100 * file.settings.error).toFixed(1)} %) | ${cells.join(" | ")} |`);
  }
}
