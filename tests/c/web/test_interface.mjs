// The C interface in JavaScript: what web/calligraphy.js makes of it.
// usage: node test_interface.mjs DIRECTORY, where scripts/web.sh built it
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import test from "node:test";

const directory = resolve(process.argv[2]);
const { CalligraphyError, constants, load } = await import(`${directory}/calligraphy.js`);
const library = await load(readFileSync(`${directory}/calligraphy_module.wasm`));

/** Whether the function throws a CalligraphyError with this status, and a text that matches. */
function refuses(run, status, pattern) {
  assert.throws(run, (error) => error instanceof CalligraphyError && error.status === status && pattern.test(error));
}

const page = library.page_lay_out(library.set_built_in(), "永", null, null);
const profile = library.struct("capabilities");
library.device_profile("touch", profile);

const mappingOnDesk = library.struct("mapping");
library.page_mapping(page, constants.DESK, 1, mappingOnDesk);
const device = library.pointer_device_create(profile, null, null, mappingOnDesk);

test("what is loaded is bytes", () => assert.rejects(load("calligraphy_module.wasm"), /load: expected the bytes/));

test("the version is a text", () => assert.match(library.version(), /^\d+\.\d+\.\d+$/));

test("structs are written and read by member", () => {
  assert.equal(profile.name, "touch");
  const mapping = library.struct("mapping", { scale: 2, offset: [1, 2, 3] });
  assert.deepEqual({ ...mapping.values(), rotation: 0 },
                   { size: 112, rotation: 0, offset: Float64Array.of(1, 2, 3), scale: 2 });
  mapping.offset[1] = 5;
  assert.deepEqual([...mapping.offset], [1, 5, 3]);
  const renamed = library.struct("capabilities", { ...profile.values(), name: "筆" });
  assert.equal(renamed.name, "筆");
  assert.throws(() => { renamed.name = "n".repeat(44); }, /name: expected at most \d+ bytes/);
  assert.throws(() => { renamed.name = "a\0b"; }, /name: expected a text without zeros/);
  assert.throws(() => { mapping.offset = [1, 2]; }, /offset: expected an array of 3/);
  assert.throws(() => { mapping.scale = "2"; }, /scale: expected a number/);
  assert.throws(() => { mapping.size = 4096; }, /size: expected 112, which cannot be changed/);
  assert.throws(() => library.struct("mapping", profile), /a struct mapping was given a struct capabilities/);
  assert.throws(() => { mapping.offset = [1, undefined, 3]; }, /offset: expected a number/);
  assert.throws(() => library.struct("tick", { status: 2 ** 32 }), /status: expected an integer/);
  const another = library.struct("mapping", mapping);
  assert.deepEqual(another.values(), mapping.values());
  another.scale = 3;
  assert.equal(mapping.scale, 2);
  library.discard(another);
  assert.throws(() => { another.scale = 4; }, /this struct mapping was discarded/);
  assert.throws(() => another.offset, /this struct mapping was discarded/);
  const servo = library.struct("servo_state", { ticks: 5, fault: "unplugged" });
  assert.deepEqual(library.struct("servo_state", servo.values()).values(), servo.values());
  assert.equal(library.struct("device_state", { has_velocity: true }).has_velocity, 1);
  assert.deepEqual(Object.keys(servo), []);
  assert.throws(() => { mapping.ofset = 1; }, TypeError);
  assert.throws(() => library.struct("map"), /no struct is named map/);
  renamed.name = "n";
  assert.equal(renamed.name, "n");
  const copy = mapping.values();
  mapping.offset = [7, 8, 9];
  assert.deepEqual([...copy.offset], [1, 5, 3]);
  library.discard(mapping);
  library.discard(renamed);
});

test("an error is a status with its text", () => {
  refuses(() => library.device_profile("quill", profile), constants.INVALID_VALUE, /device_profile: .*"quill"/);
  refuses(() => library.page_stroke(page, 0, 5, library.struct("stroke")), constants.INVALID_VALUE, /stroke = 5/);
  refuses(() => library.page_lay_out(0, "永", null, null), constants.INVALID_HANDLE, /set is null/);
  refuses(() => library.page_lay_out(null, "永", null, null), constants.INVALID_HANDLE, /set is null/);
  refuses(() => library.set_stroke_count(library.set_built_in(), 0x41), constants.NOT_FOUND, /U\+0041/);
  refuses(() => library.set_open("missing.set"), constants.FILE_ERROR, /missing\.set/);
});

test("what no function could be given is refused before it is called", () => {
  assert.throws(() => library.page_lay_out(page, "永"), /page_lay_out: 2 arguments, not 4/);
  assert.throws(() => library.page_stroke(page, 0, 0), /page_stroke: 3 arguments, not 4/);
  assert.throws(() => library.set_built_in(0), /set_built_in: 1 arguments, not 0/);
  assert.throws(() => library.version(0), /version: 1 arguments, not 0/);
  const stroke = library.struct("stroke"), info = library.struct("page_info");
  const refused = [
    [() => library.device_profile("touch", undefined), /device_profile: \w+ is undefined, expected a struct capabil/],
    [() => library.device_profile(7, profile), /device_profile: name is 7, expected a text/],
    [() => library.page_stroke(page, 0, 0, info), /result is of type struct page_info, expected a struct stroke/],
    [() => library.page_stroke(page, 0, 0.5, stroke), /page_stroke: stroke is 0.5, expected an integer from -21474836/],
    [() => library.page_stroke(page, 0, 2 ** 31, stroke), /stroke is 2147483648, expected an integer/],
    [() => library.set_stroke_count(page, -1), /expected an integer from 0/],
    [() => library.page_stroke("page", 0, 0, stroke), /expected a handle/],
    [() => library.page_polyline(page, 0, 0, constants.PATH, 0, new Float32Array(8), 4), /expected a Float64Array/],
    [() => library.page_polyline(page, 0, 0, constants.PATH, 0, [0, 0], 1), /expected a Float64Array/],
    [() => library.page_polyline(page, 0, 0, constants.PATH, 0, new Float64Array(7), 4), /at least 8 elements, not 7/],
    [() => library.device_write(device, [0, 0]), /force is of type Array, expected at least 3 elements, not 2/],
    [() => library.set_from_memory(new Uint8Array(4), 5, null), /at least 5 elements, not 4/],
    [() => library.match_strokes(page, 0, [0, 0, 1, 1], [2, 1], 2, 0, null, null), /points .* at least 6 elements, not 4/],
    [() => library.match_strokes(page, 0, [0, 0, 1, 1], [2], 2, 0, null, null), /path_sizes .* at least 2 elements, not 1/],
    [() => library.match_strokes(page, 0, [0, 0, 1, 1], [3, -1], 2, 0, null, null), /path_sizes .* an integer from 0/],
    [() => library.match_strokes(page, 0, [0, 0, 1, 1], [3], 1, 0, null, null), /points .* at least 6 elements/],
    [() => library.match_strokes(page, 0, [0, 0, 1, 1], [-1], 1, 0, null, null), /path_sizes .* an integer from 0/],
    [() => library.match_strokes(page, 0, [0, 0, 1, 1], [1.5], 1, 0, null, null), /path_sizes .* an integer from 0/],
    [() => library.match_strokes(page, 0, [0, "1", 1, 1], [2], 1, 0, null, null), /points .* a number/],
    [() => library.match(page, 0, [[0.1, 0.1], [0.1, 0.2]]), /match: expected an array of pen-downs/],
    [() => library.match(page, 0), /match: expected an array of pen-downs/],
    [() => library.page_mapping(page, constants.DESK, "1", mappingOnDesk), /scale is "1", expected a number/],
    [() => library.page_lay_out(page, "永", null, new Int32Array(0)), /placed .* at least 1 elements/],
    [() => library.set_open("永\0"), /path is .*expected a text without zeros/],
    [() => library.page_mapping(page, constants.DESK, null, mappingOnDesk), /scale is null, expected a number/],
    [() => library.page_stroke(page, 0, null, stroke), /stroke is null, expected an integer/],
    [() => library.discard({ address: profile.address }), /discard: no struct/],
    [() => library.discard(null), /discard: no struct/],
    [() => { library.discard(info); library.discard(info); }, /it was discarded/],
    [() => library.page_read_info(page, info), /info is of type struct page_info, expected one that was not discarded/],
    [() => library.struct("constructor"), /no struct is named constructor/],
  ];
  for (const [call, pattern] of refused) {
    assert.throws(call, (error) => error instanceof TypeError && pattern.test(error), `${call}`);
  }
});

test("what does not fit on a page is told", () => {
  const placed = new Int32Array(1);
  const small = library.struct("layout", { width: 0.1, height: 0.05, em: 0.03 });
  library.free(library.page_lay_out(library.set_built_in(), "永十永十", small, placed));
  assert.equal(placed[0], 2);
});

test("a set from memory with broken bytes is refused", () => {
  const broken = new TextEncoder().encode("not a set of characters");
  refuses(() => library.set_from_memory(broken, broken.length, "broken.set"), constants.FORMAT_ERROR, /broken\.set/);
});

test("the characters of a set are listed", () => {
  const set = library.set_built_in();
  const codes = [];
  const list = () => {
    while (codes.length < 1000) codes.push(library.set_next(set, (codes.at(-1) ?? -1) + 1));
  };
  refuses(list, constants.NOT_FOUND, /no character at or after/);
  assert.ok(codes.includes("永".codePointAt(0)) && codes.length > 20);
  assert.equal(library.set_stroke_count(set, "永".codePointAt(0)), 5);
  library.free(set);
});

test("an outline is read", () => {
  const points = library.polyline(page, 0, 0, constants.OUTLINE);
  assert.ok(points.length > 20 && points.every((value) => value > 0 && value < 0.16));
  assert.ok(library.polyline(page, 0, 4, constants.PATH, 1e-3).length
            < library.polyline(page, 0, 4, constants.PATH).length);
  const short = new Float64Array(2);
  refuses(() => library.page_polyline(page, 0, 0, constants.OUTLINE, 0, short, 1), constants.TOO_SMALL, /./);
});

test("results are written to a part of an array", () => {
  const all = new Float64Array(8);
  library.page_polyline(page, 0, 0, constants.PATH, 0.1, all.subarray(2, 6), 2);  // the chord of a dot
  assert.deepEqual([...all.subarray(0, 2), ...all.subarray(6)], [0, 0, 0, 0]);
  assert.ok(all.subarray(2, 6).every((value) => value > 0));
});

test("the hint of a tick is a text", () => {
  const renderer = library.renderer_create(page, null, profile, null);
  const corner = library.struct("device_state", { position: [-0.05, -0.03, -0.002], has_velocity: 1 });
  const tick = library.struct("tick");
  for (let i = 0; i < 2000 && tick.hint === constants.HINT_NONE; ++i) {
    corner.time = i * 1e-3;
    library.renderer_update(renderer, corner, tick);
  }
  assert.match(library.hint(tick), /^too far from the start: \d+ mm to the upper/);
  assert.equal(library.hint(library.struct("tick")), "");
  assert.equal(library.renderer_clipped(renderer), "");
});

test("a force may be any array of three", () => {
  library.device_write(device, [0, 0, 1]);
  library.device_write(device, Float64Array.of(0, 0, 1));
  library.device_write(device, library.struct("tick").force);
});

test("strokes are matched", () => {
  const cross = library.page_lay_out(library.set_built_in(), "十", null, null);
  const down = [[0.08, 0.078], [0.08, 0.042]], across = [[0.062, 0.062], [0.098, 0.062]];
  const { drawn, remarks } = library.match(cross, 0, [down, across]);
  assert.deepEqual(drawn.map(({ stroke }) => stroke), [1, 0]);
  assert.equal(remarks.length, 1);
  assert.equal(remarks[0].text(), "Stroke 2 (shù) came too early: write stroke 1 (héng) first.");
  assert.equal(remarks[0].text("zh"), "第2笔（竖）写早了，先写第1笔（横）。");
  assert.throws(() => remarks[0].text("tlh"), /language: expected one of .*en.*, not tlh/);
  for (const code of ["en", "zh"]) assert.ok(library.languages().includes(code), code);
  assert.equal(remarks[0].kind, constants.REMARK_ORDER);
  const asPolylines = [across, down].map((path) => Float64Array.from(path.flat()));
  assert.deepEqual(library.match(cross, 0, asPolylines).remarks, []);
  const withPressure = [across, down].map((path) => path.map(([x, y]) => [x, y, 0.5]));
  assert.deepEqual(library.match(cross, 0, withPressure).remarks, []);
  const first = library.match_strokes(cross, 0, across.flat(), [2, 2], 1, constants.TOLERANCE_NORMAL, null, null);
  assert.equal(library.match_remark_count(first), 1);
  const nothing = library.match_strokes(cross, 0, [], null, 0, constants.TOLERANCE_NORMAL, null, null);
  assert.equal(library.match_remark_count(nothing), 2);  // both strokes are missing
  refuses(() => library.match(cross, 3, [down]), constants.INVALID_VALUE, /character = 3/);
  assert.throws(() => library.match(cross, 0, [down], constants.TOLERANCE_LENIENT), /expected options/);
  const set = library.set_built_in(), others = library.index_create(set);
  const two = [[[0.068, 0.07], [0.092, 0.07]], [[0.062, 0.045], [0.098, 0.045]]];
  const other = library.match(cross, 0, two, { tolerance: constants.TOLERANCE_STRICT, forms: set, others });
  assert.equal(other.accepted, 0);
  assert.deepEqual(other.remarks.map((remark) => String.fromCodePoint(remark.other_character)), ["二"]);
  const codes = new Uint32Array(2), distances = new Float64Array(2);
  assert.equal(library.index_recognise(others, two.flat(2), [2, 2], 2, codes, distances, 2), 2);
  assert.equal(String.fromCodePoint(codes[0]), "二");
});

/** A recording of a page on which a pen goes along some of the strokes, from their start or from their end. */
function recordingOf(page, strokes) {
  const recording = library.recording_create(page, 0), renderer = library.renderer_create(page, null, profile, null);
  const sample = library.struct("device_state", { has_velocity: true }), tick = library.struct("tick");
  const mapping = library.struct("mapping"), position = new Float64Array(3);
  library.page_mapping(page, constants.UPRIGHT, 1, mapping);
  const go = (x, y, z) => {
    library.mapping_to_device(mapping, [x, y, z], position);
    sample.position = position;
    sample.time += 1e-3;
    library.renderer_update(renderer, sample, tick);
    library.recording_add(recording, tick);
  };
  for (const { stroke, isBackwards } of strokes) {
    const path = library.polyline(page, 0, stroke, constants.PATH);
    const ends = [[...path.slice(0, 2)], [...path.slice(-2)]];
    const [from, to] = isBackwards ? ends.reverse() : ends;
    for (let i = 0; i < 100; ++i) go(...from, 0.008);
    for (let i = 0; i <= 300; ++i) go(...[0, 1].map((axis) => from[axis] + (to[axis] - from[axis]) * i / 300), -2e-3);
    for (let i = 0; i < 100; ++i) go(...to, 0.008);
  }
  [sample, tick, mapping].forEach(library.discard);
  library.free(renderer);
  return recording;
}

test("what was written is scored", () => {
  const cross = library.page_lay_out(library.set_built_in(), "十", null, null);
  const score = library.score(recordingOf(cross, [{ stroke: 0 }, { stroke: 1 }]), 0);
  assert.equal(String.fromCodePoint(score.code), "十");
  assert.ok(score.fidelity > 0.95 && score.rms_error < 2e-4 && Math.abs(score.time - 0.8) < 0.05, score);
  assert.deepEqual(score.strokes.map(({ pen_down, completed }) => [pen_down, completed]), [[0, 1], [1, 1]]);
  assert.deepEqual(score.drawn.map(({ stroke }) => stroke), [0, 1]);
  assert.deepEqual(score.remarks, []);
  assert.ok(score.pen_downs[0].end < score.pen_downs[1].begin && score.pen_downs[1].smoothness < 0);
  const swapped = library.score(recordingOf(cross, [{ stroke: 1, isBackwards: true }]), 0, constants.TOLERANCE_LENIENT);
  assert.equal(swapped.direction_mistakes, 1);
  assert.deepEqual(swapped.strokes.map(({ pen_down, completed }) => [pen_down, completed]), [[-1, 0], [0, 0]]);
  assert.ok(Number.isNaN(swapped.time) && Number.isNaN(swapped.strokes[0].rms_error));
  assert.match(swapped.remarks[0].text(), /Stroke/);
  refuses(() => library.score(recordingOf(cross, []), 1), constants.INVALID_VALUE, /character = 1/);
  refuses(() => library.score(cross, 0), constants.INVALID_HANDLE, /a handle of a page/);
});

test("a stroke is skipped", () => {
  const cross = library.page_lay_out(library.set_built_in(), "十", null, null);
  const renderer = library.renderer_create(cross, null, profile, null);
  assert.deepEqual([0, 1, 2].map(() => library.renderer_skip_stroke(renderer)), [1, 1, 0]);
});

test("pen traces go through their text with what the pen senses", () => {
  const traces = library.traces_create();
  const stylus = library.struct("stylus", { known: constants.STYLUS_PRESSURE, pressure: 1 / 3 });
  library.traces_begin(traces, "一".codePointAt(0), "pupil", 0);
  library.traces_begin_path(traces, constants.PEN_DOWN);
  library.traces_add(traces, 0.25, 0.5, 0, stylus, constants.BUTTON_TIP);
  library.traces_add(traces, 0.75, 0.5, 0.5, null, -1);
  const bytes = new TextEncoder().encode(library.traces_text(traces, "made here"));
  const back = library.traces_from_memory(bytes, bytes.length, "back");
  const info = library.struct("trace_info");
  library.traces_read_info(back, 0, info);
  assert.deepEqual([info.path_count, info.has_air, library.text(info.set)], [1, 0, "pupil"]);
  const count = library.traces_read_path(back, 0, constants.PEN_DOWN, 0, null, null, 0);
  const samples = new Float64Array(9 * count), buttons = new Int32Array(count);
  assert.throws(() => library.traces_read_path(back, 0, constants.PEN_DOWN, 0, new Float64Array(17), buttons, 2),
                /samples .* at least 18 elements, not 17/);
  assert.throws(() => library.traces_read_path(back, 0, constants.PEN_DOWN, 0, samples, new Int32Array(1), 2),
                /buttons .* at least 2 elements, not 1/);
  library.traces_read_path(back, 0, constants.PEN_DOWN, 0, samples, buttons, count);
  assert.deepEqual([...samples.slice(0, 5)], [0.25, 0.5, 0, 1 / 3, NaN]);
  assert.deepEqual([...samples.slice(9, 13)], [0.75, 0.5, 0.5, NaN]);
  assert.deepEqual([...buttons], [1, -1]);
  library.free(back);
  library.free(traces);
  library.discard(stylus);
  library.discard(info);
});

test("a pen of a tablet is sensed by its device", () => {
  const stylus = library.struct("stylus", { known: constants.STYLUS_FORCE, force: 0.7 });
  const sample = library.struct("device_state");
  library.device_move_pen(device, 0.08, 0.06, 0.5, 0, stylus);
  library.device_read(device, sample);
  assert.deepEqual([sample.stylus_known, sample.stylus_force], [constants.STYLUS_FORCE, 0.7]);
  assert.ok(Number.isNaN(sample.stylus_pressure));
  library.device_move_pointer(device, 0.08, 0.06, 0, 0);
  library.discard(stylus);
  library.discard(sample);
});

test("what a call needed is freed", () => {
  const path = [[0.05, 0.05], [0.05, 0.06]];
  const recording = recordingOf(page, [{ stroke: 0 }]);
  /** Calls, then the address of the next struct: one of few, depending on which gaps in memory are filled. */
  const round = () => {
    for (let i = 0; i < 5; ++i) library.score(recording, 0);
    for (let i = 0; i < 200; ++i) library.match(page, 0, [path]);
    for (let i = 0; i < 200; ++i) assert.throws(() => library.struct("tick", { nothing: 1 }), TypeError);
    for (let i = 0; i < 10; ++i) library.device_write(device, [0, 0, 0]);
    const made = library.struct("tick"), { address } = made;
    library.discard(made);
    return address;
  };
  const before = Array.from({ length: 5 }, round), address = round();
  assert.ok(before.includes(address), `${address} after ${before}`);
});

test("memory may grow", () => {
  const tick = library.struct("tick", { distance: 1.5 });
  const broken = new Uint8Array(1 << 26);
  refuses(() => library.set_from_memory(broken, broken.length, null), constants.FORMAT_ERROR, /memory/);
  assert.equal(tick.distance, 1.5);
  assert.equal(library.set_stroke_count(library.set_built_in(), "永".codePointAt(0)), 5);
});

test("the block of docs/c.md guides a pen that begins where the first stroke does", async () => {
  const blocks = readFileSync(new URL("../../../docs/c.md", import.meta.url), "utf8").match(/```js\n.*?```/gs);
  assert.equal(blocks.length, 1);
  const bytes = 'load((await import("node:fs")).readFileSync(new URL("calligraphy_module.wasm", import.meta.url)))';
  const source = blocks[0].slice(6, -3).replace("load()", bytes);
  writeFileSync(`${directory}/block.mjs`, source);
  const block = await import(`${directory}/block.mjs`);
  assert.equal(block.inks.length, 5);
  assert.ok(block.inks.every((ink) => ink.length > 20));

  const path = library.polyline(page, 0, 0, constants.PATH);
  block.move(path[0], path[1], 0);
  for (let i = 0; i < 60; ++i) block.advance(16.7);
  const start = block.advance(0);
  assert.ok(Math.hypot(start.pen[0] - path[0], start.pen[1] - path[1]) < 1e-3);
  assert.ok(start.pen[2] > 0 && !start.writes);
  const pictures = [];
  for (let i = 0; i < path.length; i += 2) {
    block.move(path[i], path[i + 1], 0.5);
    for (let j = 0; j < 2; ++j) pictures.push(block.advance(1e6));
  }
  assert.ok(pictures.some(({ writes }) => writes));
  block.move(...path.slice(-2), 0);  // a dot is finished where the pen leaves it
  for (let i = 0; i < 20; ++i) pictures.push(block.advance(16.7));
  assert.equal(pictures.filter(({ isFinished }) => isFinished).length, 1);
});
