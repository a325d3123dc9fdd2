// node validate.mjs FILE...: runs the Khronos glTF validator; exits 1 on any error.
import { readFile } from "node:fs/promises";
import { basename } from "node:path";
import validator from "gltf-validator";

// Views that only the extension refers to look unused to the validator, which does not know it.
const expected = ["UNUSED_OBJECT", "UNSUPPORTED_EXTENSION"];
const severities = ["error", "warning", "info", "hint"];
const files = process.argv.slice(2);
if (files.length === 0) {
  console.error("usage: node validate.mjs FILE...");
  process.exit(2);
}

let errors = 0;
for (const file of files) {
  let issues;
  try {
    const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
      uri: basename(file),
      ignoredIssues: expected,
    });
    issues = report.issues;
  } catch (failure) {
    console.log(`${file}: ${failure}`);
    errors += 1;
    continue;
  }
  console.log(
    `${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ` +
      `${issues.numInfos} infos, ${issues.numHints} hints`,
  );
  for (const issue of issues.messages)
    console.log(`  ${severities[issue.severity]} ${issue.code} ${issue.pointer ?? ""}: ${issue.message}`);
  errors += issues.numErrors;
}
process.exit(errors > 0 ? 1 : 0);
