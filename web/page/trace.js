// How a person moved the pointer during a lesson, to be kept in a file and written again: a pen trace of the library.
import { constants } from "../calligraphy.js";
import { em, margin, quantities, setStylus } from "./desk.js";

/**
 * @typedef {import("../calligraphy.js").Library} Library
 * @typedef {import("./pointer.js").PointerSample} PointerSample
 * @typedef {{isDown: boolean, samples: PointerSample[]}} Path
 */

const mostInAir = 5000;      // of the samples between two pen-downs, at least as many of the last are kept
const farthest = 9;          // from the square: the format takes no sample beyond 10 of its edges [em]
const mostBytes = 64 << 20;  // of a file, once it is unpacked
const shortestRest = 8;      // of a pen on the paper, after its last sample, if nothing says when it was lifted [ms]

export class Trace {
  /** @type {Path[]} */
  paths = [];
  /** @type {number | undefined} */
  begin;        // the time that is 0 in a file [ms]
  set = "page";
  notice = "";  // of the file that was opened
  opened = 0;   // number of paths that were in it

  /** Whether there is a pen-down. */
  get hasPenDown() {
    return this.paths.some(({ isDown }) => isDown);
  }

  /** Whether there is a pen-down that was in no file. */
  get isContinued() {
    return this.paths.slice(this.opened).some(({ isDown }) => isDown);
  }

  /** Which pointers wrote, but for those of a file. */
  get kinds() {
    const written = this.paths.slice(this.opened).filter(({ isDown }) => isDown);
    return [...new Set(written.map(({ samples }) => samples[0].kind))];
  }

  /** @param {PointerSample} sample */
  add(sample) {
    const isNear = (/** @type {number} */ place) => Math.abs((place - margin) / em) < farthest;
    if (!isNear(sample.x) || !isNear(sample.y)) return;
    const last = this.paths.at(-1), time = Math.max(sample.time, last?.samples.at(-1)?.time ?? -Infinity);
    const isNew = this.paths.length === this.opened || last?.isDown !== sample.isDown;
    const path = isNew || !last ? { isDown: sample.isDown, samples: [] } : last;
    if (path !== last) this.paths.push(path);
    this.begin ??= time;
    path.samples.push({ ...sample, time });
    // The first one is where and when the pen was lifted.
    if (!path.isDown && path.samples.length > 2 * mostInAir) path.samples.splice(1, mostInAir);
  }

  /** Forgets the pen-down that is going on. */
  dropPenDown() {
    if (this.paths.length > this.opened && this.paths.at(-1)?.isDown) this.paths.pop();
  }

  /** Moves it to another time. @param {number} begin that of what is 0 in its file [ms] */
  moveTo(begin) {
    const by = begin - (this.begin ?? 0);
    for (const { samples } of this.paths) for (const sample of samples) sample.time += by;
    this.begin = begin;
  }

  /** Its samples, and where nothing says when the pen was lifted, a sample that does. */
  played() {
    return this.paths.flatMap(({ isDown, samples }, i) => {
      const last = samples[samples.length - 1], next = this.paths[i + 1];
      if (!isDown || next?.isDown === false) return samples;
      const time = Math.min(last.time + shortestRest, next?.samples[0].time ?? Infinity);
      return [...samples, { ...last, time, isDown: false, stylus: {}, buttons: -1 }];
    });
  }

  /**
   * The text of a file. Where the pointer was after a file was opened is left out unless it wrote.
   * @param {Library} library @param {string} character @param {string} notice
   */
  text(library, character, notice) {
    const traces = library.traces_create(), stylus = library.struct("stylus");
    try {
      library.traces_begin(traces, character.codePointAt(0) ?? 0, this.set, 0);
      let wasDown = true;
      for (const { isDown, samples } of this.isContinued ? this.paths : this.paths.slice(0, this.opened)) {
        if (isDown) library.traces_begin_path(traces, constants.PEN_DOWN);
        else if (wasDown) library.traces_begin_path(traces, constants.PEN_IN_AIR);
        wasDown = isDown;
        for (const sample of samples) {
          setStylus(stylus, sample.stylus);
          library.traces_add(traces, (sample.x - margin) / em, (sample.y - margin) / em,
                             (sample.time - (this.begin ?? 0)) * 1e-3, stylus, sample.buttons);
        }
      }
      return library.traces_text(traces, notice);
    } finally {
      library.discard(stylus);
      library.free(traces);
    }
  }
}

/**
 * The first trace of a file of a character that is known: `known` returns it as it is known, empty if it is not.
 * @param {Library} library
 * @param {File} file
 * @param {(character: string) => string} known
 * @returns {Promise<{character: string, trace: Trace}>}
 */
export async function openTrace(library, file, known) {
  const bytes = await unpacked(file), traces = library.traces_from_memory(bytes, bytes.length, file.name);
  const info = library.struct("trace_info");
  try {
    const others = new Set();
    for (let i = 0; i < library.traces_count(traces); ++i) {
      library.traces_read_info(traces, i, info);
      const written = String.fromCodePoint(info.code), character = known(written);
      if (character) return { character, trace: read(library, traces, i, info, noticeOf(bytes)) };
      others.add(written);
    }
    throw new Error(others.size === 0 ? "there is no pen trace in it"
      : `none of its characters is on this page: ${[...others].slice(0, 10).join(" ")}`);
  } finally {
    library.discard(info);
    library.free(traces);
  }
}

/** @param {Library} library @param {number} traces @param {number} index
 * @param {import("../calligraphy_layout.js").Structs["trace_info"]} info of it @param {string} notice */
function read(library, traces, index, { path_count, has_air, set }, notice) {
  const trace = Object.assign(new Trace(), { begin: 0, set: library.text(set), notice });
  const take = (/** @type {number} */ place, /** @type {number} */ path) => {
    const count = library.traces_read_path(traces, index, place, path, null, null, 0);
    if (count === 0) return;
    const numbers = new Float64Array(9 * count), buttons = new Int32Array(count);
    library.traces_read_path(traces, index, place, path, numbers, buttons, count);
    const isDown = place === constants.PEN_DOWN;
    const samples = Array.from(buttons, (buttons, i) => {
      const [x, y, seconds, ...sensed] = numbers.subarray(9 * i, 9 * i + 9);
      const stylus = Object.fromEntries(quantities.flatMap(([name], k) => (
        Number.isNaN(sensed[k]) ? [] : [[name, sensed[k]]])));
      const time = Math.round(seconds * 1e9) / 1e6;  // as it is in the file [ms]
      return { x: margin + em * x, y: margin + em * y, time, isDown, stylus, buttons };
    });
    trace.paths.push({ isDown, samples });
  };
  for (let path = 0; path <= path_count; ++path) {
    if (has_air) take(constants.PEN_IN_AIR, path);
    if (path < path_count) take(constants.PEN_DOWN, path);
  }
  trace.opened = trace.paths.length;
  return trace;
}

/** The comments at the top of a file. @param {Uint8Array} bytes */
function noticeOf(bytes) {
  const lines = new TextDecoder().decode(bytes.subarray(0, 1 << 16)).split(/\r?\n/);
  const end = lines.findIndex((line) => line !== "" && !line.startsWith("#"));
  return lines.slice(0, end).map((line) => line.replace(/^# ?/, "")).join("\n");
}

/** The bytes of a file, unpacked if it is compressed by gzip. @param {File} file */
async function unpacked(file) {
  const [first, second] = new Uint8Array(await file.slice(0, 2).arrayBuffer());
  let size = 0;
  const limit = new TransformStream({
    transform(chunk, to) {
      size += chunk.length;
      if (size > mostBytes) throw new RangeError(`it is of more than ${mostBytes >> 20} MB`);
      to.enqueue(chunk);
    },
  });
  const isPacked = first === 0x1f && second === 0x8b;
  const stream = isPacked ? file.stream().pipeThrough(new DecompressionStream("gzip")) : file.stream();
  return new Uint8Array(await new Response(stream.pipeThrough(limit)).arrayBuffer());
}

/** A text as a file, compressed where the browser can, and the end of its name. @param {string} text */
export async function packed(text) {
  if (typeof CompressionStream === "undefined") return { blob: new Blob([text]), ending: ".pens.txt" };
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("gzip"));
  return { blob: await new Response(stream).blob(), ending: ".pens.gz" };
}
