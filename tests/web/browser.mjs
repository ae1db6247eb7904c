// The page in Chromium: served as by a host that compresses, and written on by a pen, a mouse or a finger.
import { readFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";

const types = {
  ".html": "text/html; charset=utf-8", ".css": "text/css; charset=utf-8", ".js": "text/javascript; charset=utf-8",
  ".mjs": "text/javascript; charset=utf-8", ".txt": "text/plain; charset=utf-8", ".wasm": "application/wasm",
};
const flags = ["--no-sandbox", "--headless=new", "--disable-gpu", "--disable-quic", "--no-first-run",
               "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const patience = 60e3;  // a limit only, for machines that are busy [ms]
const layers = ["sheet", "ink", "pen", "marks"];  // the canvases, the lowest first

/**
 * Serves a directory, with other bytes in place of some files; null makes one missing.
 * @param {string} directory
 * @param {Record<string, Buffer | string | null>} [instead] by path, such as "/characters.set"
 */
export async function serve(directory, instead = {}) {
  const sent = [];  // path and bytes of each answer, as compressed
  const server = createServer(async ({ url }, response) => {
    const path = decodeURIComponent(new URL(url, "http://localhost").pathname).replace(/\/$/, "/index.html");
    const bytes = path in instead ? instead[path] : await readFile(join(directory, path)).catch(() => null);
    const body = bytes === null ? Buffer.alloc(0) : gzipSync(bytes);
    sent.push({ path, size: body.length });
    if (bytes === null) return void response.writeHead(404).end();
    response.writeHead(200, { "content-type": types[extname(path)] ?? "application/octet-stream",
                              "content-encoding": "gzip", "cache-control": "max-age=600",
                              // A page that is isolated so has a finer clock, which the time of a tick needs.
                              "cross-origin-opener-policy": "same-origin",
                              "cross-origin-embedder-policy": "require-corp" });
    response.end(body);
  });
  await new Promise((listening) => server.listen(0, "localhost", listening));
  server.unref();  // a test that failed does not keep node alive
  return { sent, origin: `http://localhost:${server.address().port}`,
           close: () => { server.closeAllConnections(); server.close(); } };
}

/** Starts Chromium. @param {string} directory in which playwright-core is installed */
export function start(directory) {
  const { chromium } = createRequire(join(resolve(directory), "node_modules", "x.js"))("playwright-core");
  return chromium.launch({ executablePath: process.env.CALLIGRAPHY_CHROMIUM ?? "/usr/bin/chromium", args: flags });
}

/** What the page is made of, in node: its library, and the modules that lay characters out and colour them. */
export async function partsOf(directory) {
  const part = (name) => import(pathToFileURL(resolve(directory, name)));
  const [{ constants, load }, desk, { colours }] =
    await Promise.all(["calligraphy.js", "page/desk.js", "page/paper.js"].map(part));
  const library = await load(readFileSync(join(directory, "calligraphy_module.wasm")));
  const open = (bytes) => library.set_from_memory(bytes, bytes.length, "characters");
  /** The path of each stroke: points [x, y] [m, page]. */
  const strokesOf = (character, set = readFileSync(join(directory, "characters.set"))) => {
    const page = desk.layOut(library, typeof set === "number" ? set : open(set), character);
    const placed = library.struct("placed_character");
    library.page_character(page, 0, placed);
    return Array.from({ length: placed.stroke_count }, (_, i) => {
      const line = library.polyline(page, 0, i, constants.PATH, desk.em / 1000);
      return Array.from({ length: line.length / 2 }, (_, k) => [line[2 * k], line[2 * k + 1]]);
    });
  };
  return { library, constants, colours, em: desk.em, sheet: desk.sheet, strokesOf };
}

const distance = ([x0, y0], [x1, y1]) => Math.hypot(x1 - x0, y1 - y0);
const between = ([x0, y0], [x1, y1], share) => [x0 + (x1 - x0) * share, y0 + (y1 - y0) * share];

/** The points at equal distances along a path, its end included. */
export function resampled(path, step) {
  const points = [path[0]];
  let ahead = step;  // distance to the next point
  for (let i = 1; i < path.length; ++i) {
    const length = distance(path[i - 1], path[i]);
    for (; ahead <= length; ahead += step) points.push(between(path[i - 1], path[i], ahead / length));
    ahead -= length;
  }
  return [...points, path.at(-1)];
}

/** The beginning of a path, up to this share of its length. */
export function beginningOf(path, share) {
  const points = resampled(path, 1e-4);
  return points.slice(0, Math.ceil(share * points.length));
}

/** A page that is open in a tab of its own. */
export class Tab {
  problems = [];  // errors that the console or the page reported
  requests = [];  // addresses
  sent = [];      // events of a pen or a mouse, each with its time [ms]
  time = 0;       // that has passed, if the page has a clock [ms]

  /**
   * Opens the page. With a clock of its own, time passes only in pass(): what the page does then does not depend on how
   * busy the machine is.
   * @param {import("playwright-core").Browser} browser
   * @param {string} origin
   * @param {{sheet: number}} parts see partsOf()
   * @param {{character?: string, hasClock?: boolean, size?: {width: number, height: number},
   *          before?: () => void}} [options] `before` is run in the page before its scripts
   */
  static async open(browser, origin, parts, { character = "永", hasClock = true, size, before } = {}) {
    const tab = new Tab();
    tab.sheet = parts.sheet;
    tab.hasClock = hasClock;
    tab.context = await browser.newContext({ viewport: size ?? { width: 1280, height: 800 } });
    tab.context.on("request", (request) => tab.requests.push(request.url()));
    tab.page = await tab.context.newPage();
    tab.page.setDefaultTimeout(patience);
    tab.page.on("console", (message) => { if (message.type() === "error") tab.problems.push(message.text()); });
    tab.page.on("pageerror", (error) => tab.problems.push(String(error.stack)));
    if (hasClock) {
      await tab.page.clock.install({ time: 0 });
      await tab.page.clock.pauseAt(1000);
    }
    if (before) await tab.page.addInitScript(before);
    await tab.page.addInitScript(() => {
      globalThis.longTasks = [];
      new PerformanceObserver((list) => globalThis.longTasks.push(...list.getEntries().map(
        ({ startTime, duration }) => ({ startTime, duration })))).observe({ type: "longtask", buffered: true });
    });
    tab.devtools = await tab.context.newCDPSession(tab.page);
    await tab.page.goto(`${origin}/#${character}`);
    await tab.page.waitForFunction(() => document.body.dataset.ready).catch((error) => {
      throw new Error(`the page is not ready: ${tab.problems.join("; ")}`, { cause: error });
    });
    await tab.pass(50);
    return tab;
  }

  close() {
    return this.context.close();
  }

  /** Lets time pass: that of the page, or real time, in which at least two pictures are drawn unless it is short.
   * @param {number} milliseconds */
  async pass(milliseconds) {
    this.time += milliseconds;
    if (this.hasClock) return this.page.clock.runFor(milliseconds);
    await this.page.waitForTimeout(milliseconds);
    if (milliseconds < 50) return;
    await this.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  }

  text(selector) {
    return this.page.locator(selector).textContent();
  }

  /** Clicks on one of several choices. @param {"modes" | "ink"} id @param {string} value such as "memory" */
  async choose(id, value) {
    await this.page.locator(`#${id} label:has(input[value="${value}"])`).click();
    await this.pass(50);
  }

  async click(selector) {
    await this.page.locator(selector).click();
    await this.pass(50);
  }

  async setStrength(percent) {
    await this.page.locator("#strength").fill(String(percent));
    await this.pass(50);
  }

  /**
   * Writes one stroke.
   * @param {[number, number][]} path [m, page]
   * @param {object} [how]
   * @param {"pen" | "mouse" | "touch"} [how.as]
   * @param {[number, number]} [how.beside] added to each point [m]
   * @param {(share: number) => number} [how.force] pressure at a share of the way
   * @param {number} [how.speed] [m/s]
   * @param {number} [how.dwell] time from the first touch to the first movement, or 0: that between any two events [ms]
   * @param {number} [how.rest] time from the last movement to the lift [ms]
   * @param {number} [how.pause] time before the first touch and after the lift [ms]
   * @param {() => Promise<void>} [how.midway] called halfway
   * @param {(share: number) => object} [how.sensed] what else a pen senses there, as in Input.dispatchMouseEvent, with
   *   the buttons besides that of its tip
   */
  async write(path, { as = "pen", beside = [0, 0], force = (share) => 0.3 + 0.5 * Math.sin(Math.PI * share),
                      speed = 0.07, dwell = 0, pause = 150, rest = 60, midway,
                      sensed = () => ({}) } = {}) {
    const interval = 8;  // between two events [ms]
    const points = resampled(path, speed * interval * 1e-3), last = points.length - 1;
    const paper = await this.page.locator("#paper").boundingBox();
    const send = this.#sender(as, ([x, y]) => ({
      x: paper.x + ((x + beside[0]) / this.sheet) * paper.width,
      y: paper.y + (1 - (y + beside[1]) / this.sheet) * paper.height,
    }));
    await send.hover(points[0], sensed(0));
    await this.pass(pause);
    await send.press(points[0], force(0), sensed(0));
    await this.pass(dwell);
    for (let i = 1; i <= last; ++i) {
      await this.pass(interval);
      if (i === Math.ceil(last / 2)) await midway?.();
      await send.move(points[i], Math.max(0.02, force(i / last)), sensed(i / last));
    }
    await this.pass(rest);
    await send.release(points[last], sensed(1));
    await this.pass(pause);
  }

  #sender(as, place) {
    if (as === "touch") {
      const send = (type, touchPoints) => this.devtools.send("Input.dispatchTouchEvent", { type, touchPoints });
      return {
        hover: () => {},
        press: (at, force) => send("touchStart", [{ ...place(at), force }]),
        move: (at, force) => send("touchMove", [{ ...place(at), force }]),
        release: () => send("touchEnd", []),
      };
    }
    const send = (type, at, button, force, sensed) => {
      const isDown = type !== "mouseReleased" && button === "left";
      const event = {
        ...sensed, type, ...place(at), button, buttons: Number(isDown) + (sensed.buttons ?? 0), pointerType: as,
        force: as === "mouse" && force > 0 ? 0.5 : force,  // what browsers report of a mouse
        clickCount: type === "mouseMoved" ? 0 : 1,
      };
      this.sent.push({ ...event, at, time: this.time });
      return this.devtools.send("Input.dispatchMouseEvent", event);
    };
    return {
      hover: (at, sensed) => send("mouseMoved", at, "none", 0, sensed),
      press: (at, force, sensed) => send("mousePressed", at, "left", force, sensed),
      move: (at, force, sensed) => send("mouseMoved", at, "left", force, sensed),
      release: (at, sensed) => send("mouseReleased", at, "left", 0, sensed),
    };
  }

  /** Writes strokes, one after the other. */
  async writeAll(paths, how) {
    for (const path of paths) await this.write(path, how);
  }

  /**
   * The pixels of a layer that are of this colour, or that are not empty, and where they are.
   * @param {string} layer such as "ink"
   * @param {object} [which]
   * @param {string} [which.colour] such as "#1d1a18"
   * @param {[number, number]} [which.from] of the page's width, from the left [m]
   */
  countPixels(layer, { colour, from = [0, this.sheet] } = {}) {
    return this.page.evaluate(([index, colour, begin, end]) => {
      const { width, height } = document.querySelectorAll("#paper canvas")[index];
      const context = document.querySelectorAll("#paper canvas")[index].getContext("2d");
      const left = Math.round(begin * width), right = Math.round(end * width);
      const { data } = context.getImageData(left, 0, right - left, height);
      const wanted = colour && [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        const isOpaque = data[i + 3] === 255;
        if (wanted ? isOpaque && wanted.every((value, k) => data[i + k] === value) : data[i + 3] > 127) ++count;
      }
      return count;
    }, [layers.indexOf(layer), colour, from[0] / this.sheet, from[1] / this.sheet]);
  }

  /** A number that differs if a layer does. @param {string} layer */
  fingerprint(layer) {
    return this.page.evaluate((index) => {
      const canvas = document.querySelectorAll("#paper canvas")[index];
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return new Uint32Array(data.buffer).reduce((hash, pixel) => Math.imul(hash ^ pixel, 16777619), 0);
    }, layers.indexOf(layer));
  }

  /** Saves what was written: the name of the file, and its bytes. */
  async save() {
    const [download] = await Promise.all([this.page.waitForEvent("download"), this.page.locator("#save").click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }

  /** Opens a file, and waits until the page says something else. @param {string} name @param {Buffer | string} bytes */
  async openFile(name, bytes) {
    await this.page.evaluate(() => { document.getElementById("progress").textContent = ""; });
    await this.page.locator("#file").setInputFiles({ name, mimeType: "", buffer: Buffer.from(bytes) });
    await this.page.waitForFunction(() => document.getElementById("progress").textContent !== "");
    await this.pass(100);
  }

  /** Waits for the result, which a worker computes in real time. */
  async result() {
    await this.page.waitForFunction(() => !document.getElementById("result").hidden);
    await this.pass(50);
    return this.page.evaluate(() => {
      const result = document.getElementById("result");
      const all = (selector) => [...result.querySelectorAll(selector)], texts = (selector) =>
        all(selector).map((each) => each.textContent);
      return {
        score: parseInt(texts(".score")[0]),
        rows: Object.fromEntries(all("tr").map((row) => [...row.children].map((cell) => cell.textContent))),
        remarks: texts(".remarks button"),
        praise: texts(".praise"),
      };
    });
  }
}
