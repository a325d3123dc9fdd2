// Screenshots of a page at several sizes, light and dark: node shoot.mjs CHROMIUM PAGE FOLDER [SCRIPT]
// SCRIPT is run in the page first, such as 'springlodPage.pick.play("level 2")'.

import {mkdirSync, writeFileSync} from "node:fs";
import {join, resolve} from "node:path";
import {pathToFileURL} from "node:url";
import {Browser} from "./browser.mjs";

const [program, file, folder, script] = process.argv.slice(2);
mkdirSync(folder, {recursive: true});
const browser = new Browser(program);
const url = pathToFileURL(resolve(file)).href;
for (const [width, height] of [[400, 800], [1280, 900], [3840, 2160]])
  for (const dark of [false, true]) {
    const page = await browser.open(url, {width, height, dark});
    if (script) await page.evaluate(script);
    await new Promise((done) => setTimeout(done, 500));
    const name = `${width}-${dark ? "dark" : "light"}.png`;
    writeFileSync(join(folder, name), await page.fullScreenshot());
    console.log(name, page.faults.join("; ") || "no fault", page.requests.length, "request");
    await page.close();
  }
await browser.close();
