// What a page must do in Chromium: node check.mjs CHROMIUM FOLDER, the folder of make_page.lua.
// Prints every fault and ends with 1 if there is one.

import {statSync} from "node:fs";
import {join, resolve} from "node:path";
import {pathToFileURL} from "node:url";
import {Browser} from "./browser.mjs";

const [program, folder] = process.argv.slice(2);
const faults = [];
let checks = 0;

function expect(holds, what) {
  ++checks;
  if (!holds) faults.push(what);
}

const urlOf = (name) => pathToFileURL(resolve(join(folder, name))).href;

// The pixels of the 3D view as [r, g, b] counts: how many have the hue of a colour, and how many
// colours there are.
const pixels = `(() => {
  const {view} = springlodPage.view;
  view.draw();
  const {gl} = view, w = gl.drawingBufferWidth, h = gl.drawingBufferHeight;
  const bytes = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  const like = view.palette.map(() => 0);
  const seen = new Set();
  const direction = (c) => { const l = Math.hypot(...c) || 1; return c.map((v) => v / l); };
  const wanted = view.palette.map(direction);
  for (let i = 0; i < bytes.length; i += 4) {
    const c = [bytes[i], bytes[i + 1], bytes[i + 2]];
    seen.add(c[0] >> 3 << 10 | c[1] >> 3 << 5 | c[2] >> 3);
    const d = direction(c);
    wanted.forEach((q, k) => { if (q[0] * d[0] + q[1] * d[1] + q[2] * d[2] > 0.995) ++like[k]; });
  }
  return {total: w * h, like, colours: seen.size, sum: bytes.reduce((a, b) => (a + b) % 1e9, 0)};
})()`;

async function checkSize(browser, width, dark) {
  const name = `${width} px, ${dark ? "dark" : "light"}: `;
  const page = await browser.open(urlOf("index.html"), {width, height: 900, dark});
  const fits = await page.evaluate(
    "document.documentElement.scrollWidth <= document.documentElement.clientWidth");
  expect(fits, name + "the page is wider than the window");
  const seen = await page.evaluate(pixels);
  expect(seen.colours > 50, name + `the 3D view has ${seen.colours} colours`);
  seen.like.forEach((count, material) => expect(count > 0.001 * seen.total,
    name + `the 3D view shows no material ${material}: ${count} of ${seen.total} pixels`));
  const paper = await page.evaluate("getComputedStyle(document.body).backgroundColor");
  const bright = Number(paper.match(/\d+/)[0]) > 128;
  expect(bright !== dark, name + `the page is ${paper}`);
  const images = await page.evaluate(`[...document.images].map((i) => i.naturalWidth)`);
  expect(images.length === 2 && images.every((w) => w > 0), name + `images ${images} px wide`);
  // No text of a chart covers other text, and none is cut.
  const covered = await page.evaluate(`(() => {
    const bad = [];
    for (const svg of document.querySelectorAll(".plot > svg")) {
      const outer = svg.getBoundingClientRect();
      const texts = [...svg.querySelectorAll("text")].map((t) => [t.textContent,
        t.getBoundingClientRect()]);
      texts.forEach(([text, a], i) => {
        if (a.left < outer.left - 1 || a.right > outer.right + 1) bad.push("cut: " + text);
        for (const [other, b] of texts.slice(i + 1))
          if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 3 &&
              b.top < a.bottom - 3) bad.push(text + " over " + other);
      });
    }
    return bad;
  })()`);
  expect(covered.length === 0, name + `texts of charts: ${covered.join(", ")}`);
  expect(page.faults.length === 0, name + page.faults.join("; "));
  expect(page.requests.every((url) => url === urlOf("index.html")),
         name + `requests ${page.requests.join(", ")}`);
  await page.close();
}

async function checkUse(browser) {
  const page = await browser.open(urlOf("index.html"), {width: 1280, height: 900});
  const body = () => page.evaluate("springlodPage.view.view.body.label");
  expect(await body() === "base", "the base is not shown first");
  // A click on a point plays its level.
  const spot = await page.evaluate(`(() => {
    const point = document.querySelector('.point[data-clip="level 2"]');
    point.scrollIntoView({block: "center"});
    const box = point.querySelector(".target").getBoundingClientRect();
    return {x: box.x + box.width / 2, y: box.y + box.height / 2};
  })()`);
  for (const type of ["mousePressed", "mouseReleased"])
    await page.call("Input.dispatchMouseEvent", {type, ...spot, button: "left", clickCount: 1});
  await page.settle();
  expect(await body() === "level 2", "a click on its point does not show level 2");
  expect(await page.evaluate("springlodPage.view.playing || springlodPage.view.view.time > 0"),
         "a click on a point does not play");
  expect(await page.evaluate(`(() => { const f = document.getElementById("film-panel");
    return !f || !f.hidden && f.style.left.startsWith("66"); })()`),
         "the panel of level 2 is not marked in the film");
  expect(await page.evaluate(`[...document.querySelectorAll(".chosen")].length >= 2`),
         "level 2 is not marked in chart and table");
  // The same by keyboard.
  await page.evaluate(`document.querySelector('.point[data-clip="level 1"]').focus()`);
  await page.press("Enter", "Enter", "\r");
  expect(await body() === "level 1", "Enter on its point does not show level 1");
  await page.evaluate(`document.querySelector('#level').focus()`);
  await page.press("ArrowRight");
  expect(await body() === "level 2", "an arrow key on the slider does not change the level");
  await page.evaluate("springlodPage.view.pause(); springlodPage.view.view.time = 0");
  await page.evaluate("springlodPage.view.speed = 0.001"); // so that the end is far away
  await page.evaluate(`document.querySelector("canvas").focus()`);
  const before = await page.evaluate(pixels);
  await page.press("ArrowLeft");
  const turned = await page.evaluate(pixels);
  expect(before.sum !== turned.sum, "an arrow key does not turn the view");
  expect((await page.evaluate(`getComputedStyle(document.activeElement).outlineStyle`)) !== "none",
         "the focus is not visible");
  await page.press(" ", "Space", " ");
  expect(await page.evaluate("springlodPage.view.playing"), "space does not play");
  await page.evaluate("springlodPage.view.pause()");
  await page.evaluate("springlodPage.view.view.time = springlodPage.view.end");
  const late = await page.evaluate(pixels);
  expect(late.sum !== turned.sum, "the body does not move");
  // The film plays, if there is one.
  const film = await page.evaluate(`(async () => {
    const film = document.getElementById("film");
    if (!film) return "none";
    film.currentTime = 0.2;
    await new Promise((done) => { film.onseeked = done; setTimeout(done, 5000); });
    return film.videoWidth;
  })()`);
  expect(film === "none" || film === 600, `the film is ${film} px wide`);
  // Everything that can be operated has a name and can be reached.
  const nameless = await page.evaluate(`[...document.querySelectorAll(
    "button, input, canvas, [role=button]")].filter((e) => !(e.textContent.trim() ||
    e.getAttribute("aria-label") || (e.labels && e.labels.length))).map((e) => e.outerHTML)`);
  expect(nameless.length === 0, `without a name: ${nameless.join(" ")}`);
  expect(await page.evaluate("document.querySelector('h1').textContent") ===
         'Rods & rubber <thrown> "at" a floor', "the title is not as given");
  expect(page.faults.length === 0, page.faults.join("; "));
  await page.close();
}

async function checkStill(browser) {
  const page = await browser.open(urlOf("still.html"), {width: 1280, height: 900});
  expect(await page.evaluate("!document.querySelector('.play')"), "a page without motion plays");
  const seen = await page.evaluate(pixels);
  expect(seen.colours > 50, "still.html: the 3D view is empty");
  expect(page.faults.length === 0, page.faults.join("; "));
  await page.close();
}

async function checkWithoutWebgl(browser) {
  const page = await browser.open("about:blank", {width: 1280, height: 900});
  await page.call("Page.addScriptToEvaluateOnNewDocument",
    {source: "HTMLCanvasElement.prototype.getContext = () => null"});
  const loaded = page.once("Page.loadEventFired");
  await page.call("Page.navigate", {url: urlOf("index.html")});
  await loaded;
  await page.settle();
  expect((await page.evaluate("document.getElementById('scene').textContent")).includes("WebGL"),
         "no message without WebGL");
  expect(await page.evaluate("document.querySelectorAll('.plot svg').length") === 2,
         "no charts without WebGL");
  expect(page.faults.length === 0, page.faults.join("; "));
  await page.close();
}

expect(statSync(join(folder, "index.html")).size < 5e6, "the page has 5 MB or more");
const browser = new Browser(program);
for (const width of [400, 1280, 3840])
  for (const dark of [false, true]) await checkSize(browser, width, dark);
await checkUse(browser);
await checkStill(browser);
await checkWithoutWebgl(browser);
await browser.close();
for (const fault of faults) console.log("FAULT", fault);
console.log(`${checks} checks, ${faults.length} faults`);
process.exit(faults.length ? 1 : 0);
