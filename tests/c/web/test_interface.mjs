// The C interface in JavaScript: what web/calligraphy.js makes of it.
// usage: node test_interface.mjs DIRECTORY, where scripts/web.sh built it
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import test from "node:test";

const directory = resolve(process.argv[2]);
const { CalligraphyError, constants, load } = await import(`${directory}/calligraphy.js`);
const library = await load(readFileSync(`${directory}/calligraphy.wasm`));

/** Whether the function throws a CalligraphyError with this status, and a text that matches. */
function refuses(run, status, pattern) {
  assert.throws(run, (error) => error instanceof CalligraphyError && error.status === status && pattern.test(error));
}

const page = library.page_lay_out(library.set_built_in(), "永", null, null);
const profile = library.struct("capabilities");
library.device_profile("touch", profile);

test("the version is a text", () => assert.match(library.version(), /^\d+\.\d+\.\d+$/));

test("structs are written and read by member", () => {
  assert.equal(profile.name, "touch");
  const mapping = library.struct("mapping", { scale: 2, offset: [1, 2, 3] });
  assert.deepEqual({ ...mapping, rotation: 0 },
                   { size: 112, rotation: 0, offset: Float64Array.of(1, 2, 3), scale: 2 });
  mapping.offset[1] = 5;
  assert.deepEqual([...mapping.offset], [1, 5, 3]);
  const renamed = library.struct("capabilities", { ...profile, name: "筆" });
  assert.equal(renamed.name, "筆");
  assert.throws(() => { renamed.name = "n".repeat(44); }, RangeError);
  assert.throws(() => { mapping.ofset = 1; }, TypeError);
  assert.throws(() => library.struct("map"), /no struct is named map/);
  library.discard(mapping);
  library.discard(renamed);
});

test("an error is a status with its text", () => {
  refuses(() => library.device_profile("quill", profile), constants.INVALID_VALUE, /device_profile: .*"quill"/);
  refuses(() => library.page_stroke(page, 0, 5, library.struct("stroke")), constants.INVALID_VALUE, /stroke = 5/);
  refuses(() => library.page_lay_out(0, "永", null, null), constants.INVALID_HANDLE, /set is null/);
  refuses(() => library.set_stroke_count(library.set_built_in(), 0x41), constants.NOT_FOUND, /U\+0041/);
  refuses(() => library.set_open("missing.set"), constants.FILE_ERROR, /missing\.set/);
});

test("what no function could be given is refused before it is called", () => {
  assert.throws(() => library.page_lay_out(page, "永"), /page_lay_out: 2 arguments, not 4/);
  assert.throws(() => library.device_profile("touch", undefined), /neither a number.*: undefined/);
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
  const count = library.page_polyline(page, 0, 0, constants.OUTLINE, 0, null, 0);
  const points = new Float64Array(2 * count);
  assert.equal(library.page_polyline(page, 0, 0, constants.OUTLINE, 0, points, count), count);
  assert.ok(count > 10 && points.every((value) => value > 0 && value < 0.16));
  refuses(() => library.page_polyline(page, 0, 0, constants.OUTLINE, 0, points, count - 1), constants.TOO_SMALL, /./);
});

test("the hint of a tick is a text", () => {
  const renderer = library.renderer_create(page, null, profile, null);
  const corner = library.struct("device_state", { position: [-0.05, -0.03, -0.002], has_velocity: 1 });
  const tick = library.struct("tick");
  for (let i = 0; i < 2000 && tick.hint === constants.HINT_NONE; ++i) {
    corner.time = i * 1e-3;
    library.renderer_update(renderer, corner, tick);
  }
  const words = new Uint8Array(128);
  library.hint_text(tick, words, words.length);
  assert.match(library.text(words), /^too far from the start: \d+ mm to the upper/);
  assert.equal(library.renderer_clipped(renderer), "");
});

test("remarks are read", () => {
  const tap = Float64Array.of(0.05, 0.05, 0.05, 0.05);
  const match = library.match_strokes(page, 0, tap, Uint32Array.of(2), 1, constants.TOLERANCE_NORMAL);
  assert.ok(library.match_remark_count(match) > 0);
  const remark = library.struct("remark");
  assert.match(library.match_remark(match, 0, remark), /stroke/);
  assert.ok(remark.kind >= constants.REMARK_ORDER && remark.kind <= constants.REMARK_EXTRA);
});

test("memory may grow", () => {
  const tick = library.struct("tick", { distance: 1.5 });
  const broken = new Uint8Array(1 << 26);
  refuses(() => library.set_from_memory(broken, broken.length, null), constants.FORMAT_ERROR, /memory/);
  assert.equal(tick.distance, 1.5);
  assert.equal(library.set_stroke_count(library.set_built_in(), "永".codePointAt(0)), 5);
});
