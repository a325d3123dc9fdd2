// A headless Chromium, driven by the DevTools protocol over a pipe: no package is needed.

import {spawn} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";

export class Browser {
  constructor(program) {
    this.home = mkdtempSync(join(tmpdir(), "springlod-page-"));
    this.process = spawn(program, [
      "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--remote-debugging-pipe",
      "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
      "--no-first-run", "--disable-background-networking", "--disable-component-update",
      `--user-data-dir=${this.home}`, "about:blank",
    ], {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"]});
    this.ended = new Promise((resolve) => this.process.on("exit", resolve));
    this.calls = new Map();
    this.listeners = [];
    this.number = 0;
    let rest = Buffer.alloc(0);
    this.process.stdio[4].on("data", (bytes) => {
      rest = Buffer.concat([rest, bytes]);
      for (let end = rest.indexOf(0); end >= 0; end = rest.indexOf(0)) {
        this.receive(JSON.parse(rest.subarray(0, end).toString()));
        rest = rest.subarray(end + 1);
      }
    });
  }

  receive(message) {
    if (message.id === undefined) {
      for (const listener of this.listeners) listener(message);
      return;
    }
    const {resolve, reject} = this.calls.get(message.id);
    this.calls.delete(message.id);
    if (message.error) reject(new Error(message.error.message));
    else resolve(message.result);
  }

  call(method, params = {}, sessionId = undefined) {
    const id = ++this.number;
    this.process.stdio[3].write(JSON.stringify({id, method, params, sessionId}) + "\0");
    return new Promise((resolve, reject) => this.calls.set(id, {resolve, reject}));
  }

  // Opens a page and collects what must not occur.
  async open(url, {width, height, dark = false, scale = 1}) {
    const {targetId} = await this.call("Target.createTarget", {url: "about:blank"});
    const {sessionId} = await this.call("Target.attachToTarget", {targetId, flatten: true});
    const page = new Page(this, sessionId, targetId);
    this.listeners.push((message) => page.hear(message));
    for (const domain of ["Page", "Runtime", "Network", "Log"]) await page.call(`${domain}.enable`);
    await page.call("Emulation.setDeviceMetricsOverride",
      {width, height, deviceScaleFactor: scale, mobile: width < 600});
    await page.media(dark ? "dark" : "light");
    const loaded = page.once("Page.loadEventFired");
    await page.call("Page.navigate", {url});
    await loaded;
    await page.settle();
    return page;
  }

  async close() {
    this.call("Browser.close").catch(() => {});
    await this.ended;
    rmSync(this.home, {recursive: true, force: true});
  }
}

class Page {
  constructor(browser, sessionId, targetId) {
    Object.assign(this, {browser, sessionId, targetId, faults: [], requests: [], waiting: []});
  }

  call(method, params = {}) { return this.browser.call(method, params, this.sessionId); }

  once(method) { return new Promise((resolve) => this.waiting.push({method, resolve})); }

  hear({method, params, sessionId}) {
    if (sessionId !== this.sessionId) return;
    this.waiting = this.waiting.filter((wait) => {
      if (wait.method === method) wait.resolve(params);
      return wait.method !== method;
    });
    if (method === "Runtime.exceptionThrown")
      this.faults.push(params.exceptionDetails.exception?.description ||
        params.exceptionDetails.text);
    if (method === "Runtime.consoleAPICalled" && ["error", "warning"].includes(params.type))
      this.faults.push(params.args.map((a) => a.value ?? a.description).join(" "));
    if (method === "Log.entryAdded" && params.entry.level !== "verbose" &&
        params.entry.level !== "info")
      this.faults.push(params.entry.text);
    if (method === "Network.requestWillBeSent" && !params.request.url.startsWith("data:"))
      this.requests.push(params.request.url);
  }

  media(scheme, type = "") {
    return this.call("Emulation.setEmulatedMedia",
      {media: type, features: [{name: "prefers-color-scheme", value: scheme}]});
  }

  // The value of an expression, which may be a promise.
  async evaluate(expression) {
    const {result, exceptionDetails} = await this.call("Runtime.evaluate",
      {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails)
      throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
    return result.value;
  }

  // Two frames later: what was to be drawn is.
  settle() {
    return this.evaluate(
      "new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => r(0))))");
  }

  async press(key, code = key, text = undefined) {
    const params = {key, code, text, windowsVirtualKeyCode: {Enter: 13, " ": 32, ArrowRight: 39,
      ArrowLeft: 37, Tab: 9}[key] ?? 0};
    await this.call("Input.dispatchKeyEvent", {type: "keyDown", ...params});
    await this.call("Input.dispatchKeyEvent", {type: "keyUp", ...params});
    await this.settle();
  }

  async screenshot(options = {}) {
    const {data} = await this.call("Page.captureScreenshot", {format: "png", ...options});
    return Buffer.from(data, "base64");
  }

  // The whole page, which may be longer than the window.
  async fullScreenshot() {
    const {cssContentSize: {width, height}} = await this.call("Page.getLayoutMetrics");
    return this.screenshot({captureBeyondViewport: true,
                            clip: {x: 0, y: 0, width, height, scale: 1}});
  }

  close() { return this.browser.call("Target.closeTarget", {targetId: this.targetId}); }
}
