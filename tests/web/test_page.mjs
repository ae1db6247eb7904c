// Writes on the page in Chromium, as people would, and looks at what becomes of it.
// usage: node test_page.mjs DIST PLAYWRIGHT_DIRECTORY [SCREENSHOT_DIRECTORY]
//   DIST                  the page, as scripts/web.sh built it
//   PLAYWRIGHT_DIRECTORY  where npm installed playwright-core
//
// CALLIGRAPHY_PROGRAM and CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL: with which a character of 48 strokes is made; without
// them its test is skipped. CALLIGRAPHY_FORCES: file to which the forces in Chromium are written.
// CALLIGRAPHY_PRINT_FORCES: the program print_forces (tests/portability), whose ticks are compared.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { gunzipSync } from "node:zlib";
import { Tab, beginningOf, partsOf, resampled, serve, start } from "./browser.mjs";

const [dist, playwright, screenshots] = process.argv.slice(2);
const parts = await partsOf(dist);
const { em, colours } = parts;
const yong = parts.strokesOf("永");
const mostBytes = 500e3;  // of the first load, compressed

/** @type {import("playwright-core").Browser} */
let browser;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;
before(async () => {
  browser = await start(playwright);
  server = await serve(dist, { "/scripted_forces.mjs": readFileSync(
    new URL("../portability/scripted_forces.mjs", import.meta.url)) });
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** Has a page reported no error, and asked no other host? */
function isQuiet(tab, origin) {
  assert.deepEqual(tab.problems, []);
  const others = tab.requests.filter((address) => !/^(data|blob):/.test(address) && !address.startsWith(`${origin}/`));
  assert.deepEqual(others, []);
}

/** A test with a page of its own, which must be quiet. */
function testPage(name, options, check) {
  test(name, async (context) => {
    const tab = await Tab.open(browser, server.origin, parts, options);
    try {
      await check(tab, context);
      isQuiet(tab, server.origin);
    } finally {
      await tab.close();
    }
  });
}

const progress = (tab) => tab.text("#progress");
const dueIs = async (tab, stroke) => assert.equal(await progress(tab), `Stroke ${stroke} of 5`);
const isWritten = async (tab) => assert.equal(await progress(tab), "Written");
const backwards = (path) => [...path].reverse();
const off = (share) => [share * em, 0];  // to the right by a share of the square

/** How far the strokes were from their templates, in % of the square. */
const percentIn = (text) => Number(/([\d.]+) % of the square/.exec(text)[1]);

testPage("永 is written with a pen, and is wider where it was pressed harder", {}, async (tab) => {
  for (const [i, path] of yong.slice(0, 4).entries()) {
    await dueIs(tab, i + 1);
    await tab.write(path);
  }
  // The last one goes from the middle to the lower right.
  const middle = (yong[4][0][0] + yong[4].at(-1)[0]) / 2;
  const halves = () => Promise.all([[0, middle], [middle, tab.sheet]].map((from) => tab.countPixels("ink", { from })));
  const [left, right] = await halves();
  await tab.write(yong[4], { force: (share) => (share < 0.45 ? 0.05 : 0.9) });
  const [leftNow, rightNow] = await halves();
  assert.ok(rightNow - right > 1.6 * (leftNow - left), `${rightNow - right} and ${leftNow - left} pixels`);
  await isWritten(tab);
  const { score, remarks, praise } = await tab.result();
  assert.ok(score >= 80, `a score of ${score}`);
  assert.deepEqual([remarks.length, praise.length], [0, 1]);
});

testPage("the guide brings the pen nearer to the strokes than the hand is", {}, async (tab) => {
  const offTheStrokes = async (percent) => {
    await tab.setStrength(percent);
    await tab.writeAll(yong, { beside: off(0.03) });
    const cell = (await tab.result()).rows["Off the strokes"];
    await tab.click("#again");
    return cell;
  };
  const guided = await offTheStrokes(60), [hand, pen] = guided.split("with the guide:").map(percentIn);
  assert.ok(pen < 0.8 * hand, guided);
  const alone = await offTheStrokes(0);
  assert.ok(!alone.includes("with the guide"), alone);
  assert.ok(Math.abs(percentIn(alone) - hand) < 0.4, `${alone}, with the guide ${guided}`);
});

testPage("strokes backwards, out of order and lifted midway are refused, and remarked on", {}, async (tab) => {
  const isRefused = async (path, stroke, hint) => {
    await tab.write(path);
    await dueIs(tab, stroke);
    assert.match(await tab.text("#hint"), hint);
  };
  await isRefused(backwards(yong[0]), 1, /^backwards/);
  await isRefused(yong[3], 1, /another stroke's start/);
  await tab.write(yong[0]);
  await isRefused(beginningOf(yong[1], 0.5), 2, /^lifted before its end/);
  await tab.writeAll(yong.slice(1));
  await isWritten(tab);
  const { rows, remarks } = await tab.result();
  assert.equal(rows["Right at once"], "3 of 5");
  assert.equal(remarks.length, 3, remarks.join("; "));
  assert.match(remarks[0], /backwards.*反了方向/s);
  const numbers = await tab.countPixels("marks"), marks = new Set();
  for (let i = 0; i < remarks.length; ++i) {
    await tab.page.locator("#result .remarks button").nth(i).hover();
    await tab.pass(50);
    marks.add(await tab.fingerprint("marks"));
    assert.ok(await tab.countPixels("marks") > numbers, `"${remarks[i]}" points at nothing`);
  }
  assert.equal(marks.size, remarks.length, "each points at something else");
});

testPage("a stroke lifted early is ink once the next is begun or the page is over, and fades when it is written again",
         { character: "三" }, async (tab) => {
  await tab.setStrength(0);
  const [first, second, third] = parts.strokesOf("三");
  const early = [beginningOf(first, 0.59), beginningOf(third, 0.7)];  // of a longer stroke, more is wanted
  const inkOf = async (colour) => await tab.countPixels("ink", { colour }) > 0;
  const isDoubted = async (stroke) => {
    assert.equal(await progress(tab), `Stroke ${stroke} of 3`);
    await tab.pass(300);
    assert.match(await tab.text("#hint"), /^lifted early\?/);
    assert.ok(await inkOf(colours.skipped), "it is paler");
  };
  const wasInk = await tab.countPixels("ink");
  await tab.write(early[0]);
  await isDoubted(1);
  if (screenshots) await tab.page.screenshot({ path: join(screenshots, "doubt.png") });
  await tab.setStrength(60);
  await tab.pass(5000);
  await tab.write(backwards(second));
  await tab.pass(300);
  assert.match(await tab.text("#hint"), /^(?!lifted early)./, "why the second one was refused");
  assert.ok(await inkOf(colours.skipped), "the first one still waits");
  await tab.write(second);
  assert.equal(await progress(tab), "Stroke 3 of 3");
  assert.ok(await inkOf(colours.ink) && !await inkOf(colours.skipped), "both are ink");
  const before = await tab.countPixels("ink");
  await tab.write(early[1]);
  await isDoubted(3);
  const once = await tab.countPixels("ink");
  await tab.write(early[1], { midway: async () => {
    assert.equal(await tab.countPixels("ink"), before, "the one before has faded");
    assert.ok(await tab.page.locator("#hint").isHidden());
  } });
  await isDoubted(3);
  assert.ok(wasInk === 0 && Math.abs(await tab.countPixels("ink") - once) < 0.05 * once);
  await tab.pass(700);
  assert.ok(!await inkOf(colours.skipped));
  const isScored = async () => {
    await isWritten(tab);
    const { rows } = await tab.result();
    assert.match(rows.Strokes, /^3 of 3/);
    assert.equal(rows["Right at once"], "1 of 3");
  };
  await isScored();
  const { name, bytes } = await tab.save();
  await tab.openFile(name, bytes);
  await tab.pass(1500);
  await isScored();
});

testPage("a stroke in doubt can be skipped", { character: "二" }, async (tab) => {
  const skipped = async () => {
    await tab.click("#skip");
    assert.equal(await progress(tab), "Stroke 2 of 2");
    return tab.fingerprint("ink");
  };
  const bare = await skipped(), [first] = parts.strokesOf("二");
  await tab.click("#again");
  await tab.write(beginningOf(first, 0.6));
  assert.ok(await tab.countPixels("ink", { colour: colours.skipped }) > 0);
  assert.equal(await skipped(), bare);
});

testPage("the time in which the last stroke was in doubt is not counted", { character: "一" }, async (tab) => {
  await tab.write(beginningOf(parts.strokesOf("一")[0], 0.7), { pause: 20 });
  await tab.page.locator("#paper").hover({ position: { x: 9, y: 9 } });  // and the pen is elsewhere
  await tab.pass(1200);
  await isWritten(tab);
  assert.ok(Number.parseFloat((await tab.result()).rows.Time) < 0.8);
});

for (const as of ["mouse", "touch"]) {
  testPage(`永 is written with ${as === "mouse" ? "a mouse" : "a finger"}`, {}, async (tab) => {
    for (const [i, path] of yong.entries()) {
      await dueIs(tab, i + 1);
      await tab.write(path, { as });
    }
    await isWritten(tab);
    const { score, rows, remarks } = await tab.result();
    assert.ok(score >= 80, `a score of ${score}`);
    assert.deepEqual(remarks, []);
    // A finger is not seen coming: the pen must not draw its way from where it was.
    assert.ok(percentIn(rows["Off the strokes"]) < 1, rows["Off the strokes"]);
  });
}

testPage("strokes that follow each other at once are judged", {}, async (tab) => {
  for (const path of yong) await tab.write(path, { as: "touch", pause: 10 });
  await tab.pass(200);
  await isWritten(tab);
  assert.ok((await tab.result()).score > 0);
});

testPage("a finger that bounces writes on", { character: "一" }, async (tab) => {
  const points = beginningOf(parts.strokesOf("一")[0], 1), half = points.length / 2;
  await tab.write(points.slice(0, half), { as: "touch", pause: 0, rest: 0 });
  await tab.write(points.slice(half), { as: "touch", pause: 4 });
  await tab.pass(200);
  await isWritten(tab);
});

testPage("the time of a character includes what the pupil thought about", { character: "二" }, async (tab) => {
  const [first, second] = parts.strokesOf("二");
  await tab.write(first);
  await tab.pass(8000);
  await tab.write(second);
  const { rows } = await tab.result();
  assert.ok(Number.parseFloat(rows.Time) > 8, rows.Time);
});

testPage("a mouse writes wider when it is slow; a pen does not", { character: "一" }, async (tab) => {
  const [path] = parts.strokesOf("一");
  const pixels = async (how) => {
    await tab.write(path, { force: () => 0.5, ...how });
    const count = await tab.countPixels("ink");
    await tab.click("#again");
    return count;
  };
  const [slow, quick] = [await pixels({ as: "mouse", speed: 0.03 }), await pixels({ as: "mouse", speed: 0.15 })];
  assert.ok(slow > 1.2 * quick, `${slow} and ${quick} pixels`);
  const [slowPen, quickPen] = [await pixels({ speed: 0.03 }), await pixels({ speed: 0.15 })];
  assert.ok(slowPen < 1.1 * quickPen, `${slowPen} and ${quickPen} pixels with a pen`);
});

testPage("ink that goes on after the end of a stroke belongs to none", { character: "三" }, async (tab) => {
  await tab.choose("modes", "vision");
  const [first, second] = parts.strokesOf("三");
  await tab.write(first);
  const count = await tab.countPixels("ink");
  await tab.click("#again");
  await tab.write([...first, ...second]);
  assert.equal(await progress(tab), "Stroke 2 of 3");
  assert.ok(await tab.countPixels("ink") < 1.3 * count);
});

testPage("a stroke written from start to end on another way is told so", { character: "口" }, async (tab) => {
  const [first, second] = parts.strokesOf("口");
  await tab.write(first);
  await tab.write([second[0], second.at(-1)]);
  assert.equal(await tab.text("#hint"), "not along the stroke");
});

testPage("a finger writes some time after a pen, and not beside it", { character: "一" }, async (tab) => {
  const [path] = parts.strokesOf("一");
  await tab.write(path);
  await tab.click("#again");
  await tab.write(path, { as: "touch" });
  assert.equal(await progress(tab), "Stroke 1 of 1");
  await tab.pass(2000);
  await tab.write(path, { as: "touch" });
  await isWritten(tab);
});

testPage("a palm that is put down before the pen is no writing", { character: "一" }, async (tab) => {
  const paper = await tab.page.locator("#paper").boundingBox();
  for (const [type, share] of [["touchStart", 0.8], ["touchMove", 0.75], ["touchMove", 0.6]]) {
    const touchPoints = [{ x: paper.x + share * paper.width, y: paper.y + 0.9 * paper.height }];
    await tab.devtools.send("Input.dispatchTouchEvent", { type, touchPoints });
    await tab.pass(100);
  }
  await tab.write(parts.strokesOf("一")[0]);
  await isWritten(tab);
  const { rows, remarks } = await tab.result();
  assert.deepEqual(remarks, []);
  assert.equal(rows["Right at once"], "1 of 1");
  const { paths } = parsed(gunzipSync((await tab.save()).bytes).toString());
  assert.deepEqual(paths.map(({ kind }) => kind), ["S", "A"], "the palm is not saved");
});

/** A file of one pen trace, read as docs/pen-traces.md says. */
function parsed(text) {
  const lines = text.trimEnd().split("\n"), statements = lines.filter((line) => !line.startsWith("#"));
  const [version, [, ...trace], [, ...fields], ...paths] = statements.map((line) => line.split(" "));
  const names = ["x", "y", "time", ...fields];
  return {
    version, trace, fields,
    notice: lines.filter((line) => line.startsWith("#")).join("\n"),
    paths: paths.map(([kind, count, ...values]) => ({
      kind,
      points: Array.from({ length: Number(count) }, (_, i) => Object.fromEntries(
        names.map((name, k) => [name, Number(values[i * names.length + k])]))),
    })),
  };
}

/** What a pen senses that is turned and tilted while it writes. */
const turned = (share) => ({
  tiltX: 20 - Math.round(50 * share), tiltY: 10 + Math.round(30 * share), twist: 5 + Math.round(340 * share),
});
const dyadic = (share) => Math.round(16 + 40 * Math.sin(Math.PI * share)) / 64;  // a pressure that a float has exactly

/** Has each event of a pen that was sent been saved, and nothing else? */
function isAsSent(tab, { paths }) {
  const points = paths.flatMap(({ kind, points }) => points.map((point) => ({ kind, ...point })));
  assert.equal(points.length, tab.sent.length);
  const degree = Math.PI / 180, begin = tab.sent[0].time, margin = (tab.sheet - em) / 2;
  for (const [i, { at, time, force, buttons, tiltX, tiltY, twist }] of tab.sent.entries()) {
    const saved = points[i], [across, down] = [tiltX, tiltY].map((angle) => Math.tan(angle * degree));
    const isNear = (name, value, off = 1e-9) =>
      assert.ok(Math.abs(saved[name] - value) < off, `${name} of ${i} is ${saved[name]}, not ${value}`);
    isNear("x", (1000 * (at[0] - margin)) / em, 0.01);
    isNear("y", 1000 - (1000 * (at[1] - margin)) / em, 0.01);
    isNear("altitude", Math.atan(1 / Math.hypot(across, down)));
    isNear("azimuth", -((Math.atan2(down, across) + 2 * Math.PI) % (2 * Math.PI)));
    isNear("twist", -twist * degree);
    assert.deepEqual([saved.kind, saved.time, saved.pressure, saved.buttons],
                     [buttons & 1 ? "S" : "A", time - begin, force, buttons]);
  }
}

testPage("what a pen did is saved as it came, and is written again once it is opened", { character: "二" },
         async (tab, context) => {
  const [first, second] = parts.strokesOf("二"), how = { force: dyadic, sensed: turned };
  await tab.write(backwards(first), how);
  await tab.write(first, how);
  await tab.pass(5000);
  await tab.write(second, { ...how, sensed: (share) => ({ ...turned(share), buttons: 2 }) });
  const written = async (tab) => {
    await isWritten(tab);
    const result = await tab.result(), guided = await tab.countPixels("ink");
    await tab.choose("ink", "own");
    return { result, guided, own: await tab.countPixels("ink") };
  };
  const there = await written(tab), { name, bytes } = await tab.save(), text = gunzipSync(bytes).toString();
  assert.match(name, /^二-1970-01-01T\d\d-\d\d\.pens\.gz$/);
  const saved = parsed(text);
  assert.deepEqual([saved.version, saved.trace], [["V", "2"], ["二", "4E8C", "page", "1000", "3", "4"]]);
  for (const said of ["二", "Guided", "60 %", "lenient", "none", "pen"]) assert.ok(saved.notice.includes(said), said);
  isAsSent(tab, saved);

  const other = await Tab.open(browser, server.origin, parts);
  try {
    await other.choose("modes", "watch");  // in which nothing is written
    await other.openFile(name, bytes);
    const again = await written(other);
    assert.deepEqual(again.result, there.result);
    for (const ink of ["guided", "own"]) {  // a sample may be taken a tick earlier than it was
      assert.ok(Math.abs(again[ink] / there[ink] - 1) < 0.005, `${again[ink]} and ${there[ink]} pixels`);
    }
    assert.equal(gunzipSync((await other.save()).bytes).toString(), text, "saved again, it is the same file");
    await other.openFile("without.txt", text.replace("F pressure ", "F force "));
    await isWritten(other);
    const unpressed = await other.countPixels("ink");
    assert.ok(Math.abs(unpressed / there.own - 1) > 0.02, `${unpressed} pixels: the ink is as wide as it was pressed`);
    isQuiet(other, server.origin);
  } finally {
    await other.close();
  }
  if (!process.env.CALLIGRAPHY_PROGRAM) return void context.diagnostic("CALLIGRAPHY_PROGRAM is not set");
  const directory = mkdtempSync(join(tmpdir(), "calligraphy-page-")), file = join(directory, name);
  writeFileSync(file, bytes);
  const said = execFileSync(process.env.CALLIGRAPHY_PROGRAM, ["replay", file], { encoding: "utf8" });
  rmSync(directory, { recursive: true });
  assert.match(said, /二/);
});

testPage("a browser that has only the tilts of a pen, and cannot compress, saves the same as text", {
  character: "一", before: () => {
    for (const name of ["altitudeAngle", "azimuthAngle"]) delete PointerEvent.prototype[name];
    delete globalThis.CompressionStream;
  },
}, async (tab) => {
  await tab.write(parts.strokesOf("一")[0], { force: dyadic, sensed: turned });
  const { name, bytes } = await tab.save();
  assert.match(name, /\.pens\.txt$/);
  isAsSent(tab, parsed(bytes.toString()));
});

testPage("what a mouse does not sense is not saved; what is opened is written on, and saved with what follows", {},
         async (tab) => {
  await tab.write(yong[0], { as: "mouse" });
  const { name, bytes } = await tab.save(), before = parsed(gunzipSync(bytes).toString());
  assert.deepEqual([before.fields, before.paths.map(({ kind }) => kind)], [["buttons"], ["A", "S", "A"]]);
  await tab.click("#again");
  assert.ok(await tab.page.locator("#save").isDisabled());
  await tab.openFile(name, bytes);
  await dueIs(tab, 2);
  await tab.page.locator("#paper").hover();
  await tab.pass(50);
  assert.equal(gunzipSync((await tab.save()).bytes).toString(), gunzipSync(bytes).toString(), "nothing was written");
  await tab.write(yong[1]);
  await tab.page.evaluate(() => document.getElementById("paper").dispatchEvent(new PointerEvent("pointermove", {
    pointerType: "pen", isPrimary: true, buttons: 32, pressure: 0.5, clientX: 99, clientY: 99 })));
  await tab.pass(50);
  const { fields, paths, notice } = parsed(gunzipSync((await tab.save()).bytes).toString());
  assert.deepEqual([fields, paths.map(({ kind }) => kind)], [["pressure", "buttons"], ["A", "S", "A", "S", "A"]]);
  const places = ({ points }) => points.map(({ x, y, time, buttons }) => [x, y, time, buttons]);
  assert.deepEqual(paths.slice(0, 2).map(places), before.paths.slice(0, 2).map(places));
  const { pressure, buttons } = paths.at(-1).points.at(-1);
  assert.deepEqual([pressure, buttons], [0.5, 32], "the eraser");
  assert.match(notice, /pointer: mouse.*pointer: pen/s);
});

testPage("a file that cannot be written again is refused, and why is said", {}, async (tab) => {
  const says = async (text, why) => {
    await tab.openFile("a.txt", text);
    assert.match(await progress(tab), why);
  };
  await says("C 永 6C38 me 1000 1\nS 1 0 0 zero\n", /^It cannot be opened\. a\.txt:2: .*'zero'/);
  await says("C ض 636 me 1000 1\nS 1 0 0 0\n", /^It cannot be opened\. a\.txt: none of its characters.*ض/);
  await says(Buffer.from([0x1f, 0x8b, 1, 2]), /^It cannot be opened\. a\.txt: /);
  await tab.page.evaluate(() => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File(["C 一 4E00 me 1000 1\nS 1 0 0 0\n"], "dropped.txt"));
    dispatchEvent(new DragEvent("drop", { dataTransfer }));
  });
  await tab.page.waitForFunction(() => document.getElementById("character").textContent === "一");
});

testPage("minutes of scribbling are written again without blocking the page", { hasClock: false },
         async (tab, context) => {
  const scribbles = Array.from({ length: 400 }, (_, i) => Array.from({ length: 100 }, (_, k) => [
    200 + 6 * k, 900 - i, 1500 * i + 10 * k].join(" ")));
  const margin = (tab.sheet - em) / 2, stroke = resampled(yong[0], 1e-3).map(([x, y], i) => [
    (1000 * (x - margin)) / em, 1000 - (1000 * (y - margin)) / em, 600e3 + 20 * i].join(" "));
  const lines = ["C 永 6C38 me 1000 401", ...[...scribbles, stroke].map((points) => (
    `S ${points.length} ${points.join(" ")}`)), ""];
  const ready = await tab.page.evaluate(() => performance.now());
  await tab.openFile("long.txt", lines.join("\n"));
  await tab.page.waitForFunction(() => document.getElementById("progress").textContent === "Stroke 2 of 5");
  const tasks = (await tab.page.evaluate(() => globalThis.longTasks)).filter(({ startTime }) => startTime > ready);
  context.diagnostic(`longest task while ten minutes are written again: ${longest(tasks)}`);
  assert.ok(tasks.every(({ duration }) => duration < 500), longest(tasks));
});

test("the ink of a pen is as wide as it is pressed", async () => {
  const { LessonHandle } = await import(pathToFileURL(join(dist, "page/desk.js")));
  const { library, constants } = parts;
  const held = { mode: constants.LESSON_GUIDED, strength: 0.6, tolerance: constants.TOLERANCE_NORMAL };
  const desk = new LessonHandle(library, library.set_built_in(), "永", held);
  for (let time = 0; time < 200; time += 10) {
    desk.move({ time, x: 0.02, y: 0.02, isDown: time > 20, stylus: { pressure: 0.25 }, buttons: 1, kind: "pen" });
  }
  desk.advance(200);
  desk.look();
  assert.equal(desk.view.ink_count, 1);
  assert.ok(desk.inkPoints(0, 50).every((value, i) => i % 6 !== 5 || value === 0.25));
});

test("of a mouse that hovers for an hour, its last way is kept, and where it was first", async () => {
  const { Trace } = await import(pathToFileURL(join(dist, "page/trace.js")));
  const trace = new Trace();
  for (let i = 0; i < 400e3; ++i) trace.add({ time: 9 * i, x: 0, y: 0, isDown: false, stylus: {}, buttons: 0 });
  const [{ samples }] = trace.paths;
  assert.ok(samples.length > 5000 && samples.length <= 10001, `${samples.length} samples`);
  assert.deepEqual([samples[0].time, samples.at(-1).time], [0, 9 * (400e3 - 1)]);
});

for (const [width, height] of [[320, 640], [768, 1024], [1024, 768]]) {
  testPage(`at ${width} by ${height}, paper and hints fit`, { size: { width, height } }, async (tab) => {
    const paper = await tab.page.locator("#paper").boundingBox();
    assert.ok(paper.width >= 0.6 * Math.min(width, height), `the paper is ${paper.width} wide`);
    const corner = parts.sheet - 1e-3;
    for (const place of [[1e-3, 1e-3], [corner, corner]]) {
      await tab.write([place, [place[0], parts.sheet / 2], place]);
      const hint = await tab.page.locator("#hint").boundingBox();
      assert.ok(hint.x >= paper.x && hint.x + hint.width <= paper.x + paper.width, "across");
      assert.ok(hint.y >= paper.y && hint.y + hint.height <= paper.y + paper.height, "down");
    }
  });
}

testPage("a stroke that was missed twice is shown, and can be skipped", {}, async (tab) => {
  await tab.choose("modes", "memory");
  const shown = () => tab.countPixels("sheet", { colour: colours.due });
  await tab.write(yong[3]);
  assert.equal(await shown(), 0);
  await tab.write(yong[3]);
  assert.ok(await shown() > 0);
  await dueIs(tab, 1);
  await tab.click("#skip");
  await dueIs(tab, 2);
  assert.equal(await shown(), 0);
  assert.ok(await tab.countPixels("ink", { colour: colours.skipped }) > 0);
  await tab.writeAll(yong.slice(1));
  assert.equal(await progress(tab), "4 of 5 strokes written");
  const { remarks } = await tab.result();
  assert.match(remarks[0], /^Stroke 1 was skipped/);
});

testPage("each mode shows as much of the template as it says", {}, async (tab) => {
  const shown = async (mode) => {
    await tab.choose("modes", mode);
    const [due, others] = await Promise.all([colours.due, colours.template].map(
      (colour) => tab.countPixels("sheet", { colour })));
    return [due > 0, others > 0];
  };
  assert.deepEqual(await shown("guided"), [true, true]);
  assert.deepEqual(await shown("vision"), [true, true]);
  assert.deepEqual(await shown("next"), [true, false]);
  const first = await tab.fingerprint("sheet");
  await tab.write(yong[0]);
  assert.notEqual(await tab.fingerprint("sheet"), first, "the next stroke is shown instead");
  assert.deepEqual(await shown("next"), [true, false]);
  await tab.pass(300);  // until the guide has let go of the pen
  assert.deepEqual(await shown("memory"), [false, false]);
  await tab.writeAll(yong);
  await isWritten(tab);
});

testPage("strokes are shown one after the other to who watches, and no ink is taken", {}, async (tab) => {
  await tab.choose("modes", "watch");
  const inks = [0];
  for (let waited = 0; waited < 100 && inks.slice(-10).some((ink) => ink !== inks.at(-1) || ink === 0); ++waited) {
    await tab.pass(100);
    inks.push(await tab.countPixels("ink"));
  }
  const steps = inks.filter((ink, i) => i > 0 && ink !== inks[i - 1]);
  assert.equal(steps.length, yong.length, inks.join());
  const ink = await tab.fingerprint("ink");
  await tab.writeAll(yong.slice(0, 2));
  assert.equal(await tab.fingerprint("ink"), ink);
  assert.equal(await tab.countPixels("pen"), 0);
  assert.equal(await progress(tab), "5 strokes");
});

testPage("a typical stroke is written and judged alone, by its number", { character: "6" }, async (tab) => {
  assert.equal(await tab.text("#character"), "⑥");
  await tab.write(parts.strokesOf("⑥", parts.library.set_typical_strokes())[0]);
  await isWritten(tab);
  assert.deepEqual((await tab.result()).remarks, []);
});

testPage("a radical in the address is read as its ideograph, and that is said", { character: "⼀" }, async (tab) => {
  assert.equal(await tab.text("#character"), "一");
  assert.match(await progress(tab), /U\+2F00\) is read as 一/);
});

testPage("other ink and another strength leave what was written", {}, async (tab) => {
  await tab.writeAll(yong.slice(0, 2), { beside: off(0.03) });
  const inks = [];
  for (const kind of ["own", "both", "guided"]) {
    await tab.choose("ink", kind);
    inks.push(await tab.fingerprint("ink"));
  }
  assert.equal(new Set(inks).size, 3);
  await tab.setStrength(20);
  await dueIs(tab, 3);
  assert.equal(await tab.fingerprint("ink"), inks[2]);
  await tab.write(yong[2], { midway: () => tab.setStrength(70) });
  await dueIs(tab, 4);
  await tab.choose("ink", "both");
  await tab.writeAll(yong.slice(3), { midway: () => tab.choose("ink", "guided") });
  await isWritten(tab);
  assert.deepEqual((await tab.result()).remarks, []);
});

for (const [tolerance, accepts] of [["strict", false], ["lenient", true]]) {
  testPage(`a stroke begun 12 % beside is ${accepts ? "accepted" : "refused"} where the page is ${tolerance}`, {},
           async (tab) => {
    await tab.setStrength(0);
    await tab.page.locator("#tolerance").selectOption({ label: tolerance });
    await tab.write(yong[0], { beside: off(0.12) });
    await dueIs(tab, accepts ? 2 : 1);
  });
}

test("the built-in characters are written where the others are missing", async () => {
  const bare = await serve(dist, { "/characters.set": null, "/characters.txt": null });
  const tab = await Tab.open(browser, bare.origin, parts);
  try {
    await tab.writeAll(parts.strokesOf("永", parts.library.set_built_in()));
    await isWritten(tab);
    assert.deepEqual((await tab.result()).remarks, []);
    assert.ok(await tab.page.locator("#characters button").count() > 1);
    assert.deepEqual(tab.problems.filter((problem) => !problem.includes("404")), []);
  } finally {
    await tab.close();
    bare.close();
  }
});

test("the first load, until a character has been judged, is small", async (context) => {
  const counting = await serve(dist);
  const tab = await Tab.open(browser, counting.origin, parts, { character: "一" });
  try {
    await tab.write(parts.strokesOf("一")[0]);
    await tab.result();
    const bytes = counting.sent.reduce((sum, { size }) => sum + size, 0);
    const characters = await tab.page.locator("#characters button").count();
    context.diagnostic(`first load: ${bytes} bytes in ${counting.sent.length} files, with ${characters} characters`);
    assert.ok(characters >= 300);
    assert.ok(bytes <= mostBytes, counting.sent.map(({ path, size }) => `${path} ${size}`).join());
    assert.ok(tab.requests.includes(`${counting.origin}/page/score_worker.js`), "a worker's requests are seen too");
    isQuiet(tab, counting.origin);
  } finally {
    await tab.close();
    counting.close();
  }
});

const longest = (tasks) => `${Math.round(Math.max(0, ...tasks.map(({ duration }) => duration)))} ms`;

/** Set file with 龘, three 龍 of half the size: one above, two below. */
function dragons(directory) {
  const program = process.env.CALLIGRAPHY_PROGRAM, single = join(directory, "single.txt");
  const text = join(directory, "three.txt"), set = join(directory, "three.set");
  const tell = (...given) => execFileSync(program, given, { stdio: ["ignore", "ignore", "inherit"] });
  tell("import", process.env.CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL, "--only", "龍", "--ink", "none", "--format", "text",
       "-o", single);
  const strokes = readFileSync(single, "utf8").split("\n").filter((line) => line.startsWith("stroke "));
  const moved = ([x, y]) => strokes.map((line) => line.replace(/([-\d.e]+),([-\d.e]+)/g,
                                                              (_, u, v) => `${x + u / 2},${y + v / 2}`));
  const places = [[0.25, 0.5], [0, 0], [0.5, 0]];
  writeFileSync(text, ["calligraphy characters 2", "character 龘", ...places.flatMap(moved), ""].join("\n"));
  tell("import", text, "-o", set);
  return readFileSync(set);
}

const canMakeDragons = process.env.CALLIGRAPHY_PROGRAM && process.env.CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL;
test("龘 is written in real time, all 48 strokes", {
  skip: canMakeDragons ? false : "CALLIGRAPHY_PROGRAM and CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL are not set",
}, async (context) => {
  const directory = mkdtempSync(join(tmpdir(), "calligraphy-page-"));
  const set = dragons(directory);
  rmSync(directory, { recursive: true });
  const dragonServer = await serve(dist, { "/characters.set": set, "/characters.txt": "龘" });
  const tab = await Tab.open(browser, dragonServer.origin, parts, { character: "龘", hasClock: false });
  try {
    const strokes = parts.strokesOf("龘", set);
    assert.equal(strokes.length, 48);
    const ready = await tab.page.evaluate(() => performance.now());
    for (const [i, path] of strokes.entries()) {
      assert.equal(await progress(tab), `Stroke ${i + 1} of 48`);
      await tab.write(path);
      await tab.page.waitForFunction((next) => document.getElementById("progress").textContent === next,
                                     i < 47 ? `Stroke ${i + 2} of 48` : "Written");
    }
    const { score, remarks } = await tab.result();
    assert.ok(score >= 80, `a score of ${score}: ${remarks.join("; ")}`);
    const tasks = await tab.page.evaluate(() => globalThis.longTasks);
    context.diagnostic(`longest task: ${longest(tasks.filter(({ startTime }) => startTime < ready))} until ready, `
      + `${longest(tasks.filter(({ startTime }) => startTime >= ready))} from then until 龘 is judged`);
    isQuiet(tab, dragonServer.origin);
  } finally {
    await tab.close();
    dragonServer.close();
  }
});

testPage("it says when it is ready", { hasClock: false }, async (tab, context) => {
  const { own, whole } = await tab.page.evaluate(() => ({
    own: Number(document.body.dataset.ready), whole: performance.getEntriesByName("ready")[0].duration,
  }));
  assert.ok(own > 0 && whole >= own);
  context.diagnostic(`ready after ${Math.round(whole)} ms, ${own} ms of them in the page's script`);
});

/** What a tick takes with this system's compiler [ns]. */
function nativeNanoseconds() {
  const { stderr } = spawnSync(process.env.CALLIGRAPHY_PRINT_FORCES, { encoding: "utf8", maxBuffer: 1e9 });
  return parseInt(stderr);
}

testPage("the forces of a scripted pen are computed", { hasClock: false }, async (tab, context) => {
  const numbers = await tab.page.evaluate(async () => {
    const [{ constants, load }, { nanosecondsPerTick, scriptedForces }] =
      await Promise.all(["/calligraphy.js", "/scripted_forces.mjs"].map((path) => import(path)));
    const library = await load(), written = scriptedForces(library, constants);
    globalThis.measure = () => nanosecondsPerTick(library, written);
    return written.numbers;
  });
  assert.ok(numbers.length > 0 && numbers.every(Number.isFinite));
  if (process.env.CALLIGRAPHY_FORCES) writeFileSync(process.env.CALLIGRAPHY_FORCES, `${numbers.join("\n")}\n`);
  if (!process.env.CALLIGRAPHY_PRINT_FORCES) return;
  // In turns, because other load comes and goes.
  const rounds = [];
  while (rounds.length < 21) {
    const native = nativeNanoseconds(), chromium = await tab.page.evaluate(() => globalThis.measure());
    rounds.push({ native, chromium, ratio: chromium / native });
  }
  rounds.sort((a, b) => a.ratio - b.ratio);
  const [least, lower, { native, chromium, ratio }, upper, most] = [0, 5, 10, 15, 20].map((i) => rounds[i]);
  context.diagnostic(`${chromium} ns per tick in Chromium, ${native} natively: ${ratio.toFixed(2)} times as long, the `
    + `median of ${rounds.length} rounds from ${least.ratio.toFixed(2)} to ${most.ratio.toFixed(2)}, half of them from `
    + `${lower.ratio.toFixed(2)} to ${upper.ratio.toFixed(2)}`);
});

for (const [width, height] of [[360, 740], [1280, 800], [3840, 2160]]) {
  testPage(`half of 永 fits into ${width} x ${height}`, { size: { width, height } }, async (tab) => {
    await tab.writeAll(yong.slice(0, 3));
    await dueIs(tab, 4);
    const { paper, over } = await tab.page.evaluate(() => ({
      paper: document.getElementById("paper").getBoundingClientRect().toJSON(),
      over: document.documentElement.scrollWidth - document.documentElement.clientWidth,
    }));
    assert.equal(over, 0, "it is not wider than the window");
    assert.ok(paper.left >= 0 && paper.right <= width && paper.top >= 0 && paper.bottom <= height, "the paper is seen");
    if (screenshots) await tab.page.screenshot({ path: join(screenshots, `${width}x${height}.png`) });
  });
}
