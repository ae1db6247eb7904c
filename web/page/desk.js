// A character on a sheet of paper, and the library's lesson on it.
import { constants } from "../calligraphy.js";

/** Edge of the character's square, and the margin around it [m]. */
export const em = 0.04, margin = 0.1 * em, sheet = em + 2 * margin;

/**
 * @typedef {import("../calligraphy.js").Library} Library
 * @typedef {object} Stroke
 * @property {Float64Array} outline of its ink: x and y of each point [m, page]
 * @property {Float64Array} path of the pen, likewise
 * @property {[number, number]} start where it begins
 * @property {number} length of its path [m]
 * @property {number} fate such as constants.FATE_ACCEPTED
 * @property {boolean} isShown its template is to be seen
 * @property {number} misses pen-downs that were to write it, and did not
 * @property {number} penDown number of the pen-down that wrote it; -1: none
 */

/** The members of a stylus that the library has, in its order, and the bit of each. */
export const quantities = /** @type {const} */ ([
  ["pressure", constants.STYLUS_PRESSURE], ["force", constants.STYLUS_FORCE],
  ["altitude", constants.STYLUS_ALTITUDE], ["azimuth", constants.STYLUS_AZIMUTH],
  ["twist", constants.STYLUS_TWIST], ["height", constants.STYLUS_HEIGHT],
]);

/** @param {import("../calligraphy_layout.js").Structs["stylus"]} made @param {import("./pointer.js").Stylus} stylus */
export function setStylus(made, stylus) {
  made.known = 0;
  for (const [name, bit] of quantities) {
    const value = stylus[name];
    if (value === undefined) continue;
    made.known |= bit;
    made[name] = value;
  }
}

/** A sheet with one character. @param {Library} library @param {number} set @param {string} character
 * @returns {number} handle of the page */
export function layOut(library, set, character) {
  const layout = library.struct("layout", { width: sheet, height: sheet, em, gap: margin });
  const page = library.page_lay_out(set, character, layout, null);
  library.discard(layout);
  return page;
}

/** @typedef {{mode: number, strength: number, tolerance: number}} Held how a lesson is held: see the library */

export class LessonHandle {
  /** @type {Stroke[]} */
  strokes = [];
  /** @type {number[]} */
  pages = [];  // handles: of the page that is written, and of those that are to be begun
  numbers = new Float64Array(6 * 1024);  // of points of ink

  /** @param {Library} library @param {number} set handle of the set of characters @param {string} character
   * @param {Held} held */
  constructor(library, set, character, held) {
    this.library = library;
    this.view = library.struct("lesson_view");
    this.event = library.struct("lesson_event");
    this.sample = library.struct("pointer_sample");
    this.stylus = library.struct("stylus");
    this.profile = library.struct("capabilities");
    this.renderer = library.struct("renderer_options");
    this.held = library.struct("lesson_options", { has_strength: 1 });
    library.device_profile("ideal", this.profile);
    this.pages.push(layOut(library, set, character));
    this.#set(held);
    this.handle = library.lesson_create_for_pointer(this.pages[0], this.profile, this.renderer, this.held);
  }

  /** Begins with a character. @param {number} set @param {string} character */
  begin(set, character) {
    const page = layOut(this.library, set, character);
    this.library.lesson_begin(this.handle, page);
    this.pages.push(page);
  }

  again() {
    this.library.lesson_again(this.handle);
  }

  /** @param {Held} held */
  change(held) {
    this.#set(held);
    this.library.lesson_change(this.handle, this.renderer, this.held);
  }

  /** @param {Held} held */
  #set({ mode, strength, tolerance }) {
    this.library.renderer_options_for(this.profile, constants.PRESET_DEVICE, 1, tolerance, this.renderer);
    this.renderer.guidance_to_start = 1;
    this.held.mode = mode;
    this.held.strength = strength;
  }

  /** @param {import("./pointer.js").PointerSample} sample */
  move({ time, x, y, isDown, isPalm, stylus, buttons, kind }) {
    const { sample, library } = this;
    sample.time = time * 1e-3;
    sample.place = [x, y];
    sample.is_down = Number(isDown);
    sample.is_cancelled = Number(isPalm ?? false);
    sample.kind = { touch: constants.POINTER_TOUCH, pen: constants.POINTER_PEN }[kind ?? ""] ?? constants.POINTER_MOUSE;
    sample.buttons = Math.max(0, buttons);
    setStylus(this.stylus, stylus);
    library.lesson_move_pointer(this.handle, sample, this.stylus);
  }

  /** Whether time matters then. @param {number} time [ms] */
  advance(time) {
    return this.library.lesson_advance(this.handle, time * 1e-3) !== 0;
  }

  /** Sets the view and the strokes, and returns what has happened. */
  look() {
    const { library, handle, view, event } = this, events = [];
    library.lesson_look(handle, view);
    while (library.lesson_take_event(handle, event)) {
      events.push(event.values());
      if (event.kind === constants.LESSON_RESTARTED) this.#readStrokes();
    }
    const read = library.struct("lesson_stroke");
    this.strokes.forEach((stroke, i) => {
      library.lesson_read_stroke(handle, i, read);
      const { fate, misses, pen_down: penDown } = read;
      Object.assign(stroke, { fate, misses, penDown, isShown: read.is_shown !== 0 });
    });
    library.discard(read);
    return events;
  }

  /** The words for the hint, or for the reason of a refusal. */
  hint() {
    return this.library.lesson_hint_text(this.handle, "en");
  }

  /** Points of ink, 6 numbers each, valid until the next call. @param {number} begin @param {number} end */
  inkPoints(begin, end) {
    const count = end - begin;
    if (6 * count > this.numbers.length) this.numbers = new Float64Array(12 * count);
    this.library.lesson_ink_points(this.handle, begin, this.numbers, count);
    return this.numbers.subarray(0, 6 * count);
  }

  /** What is to be judged, for another thread. */
  writing() {
    const numbers = new Float64Array(this.library.lesson_writing(this.handle, null, 0));
    this.library.lesson_writing(this.handle, numbers, numbers.length);
    return numbers;
  }

  /** Of the page that was begun. */
  #readStrokes() {
    const { library } = this;
    while (this.pages.length > 1) library.free(this.pages.shift() ?? 0);
    this.strokes = strokesOf(library, this.pages[0]);
  }
}

/** The strokes of a page with one character. @param {Library} library @param {number} page @returns {Stroke[]} */
function strokesOf(library, page) {
  const placed = library.struct("placed_character"), stroke = library.struct("stroke");
  library.page_character(page, 0, placed);
  const strokes = Array.from({ length: placed.stroke_count }, (_, i) => {
    library.page_stroke(page, 0, i, stroke);
    return {
      outline: library.polyline(page, 0, i, constants.OUTLINE, em / 1000),
      path: library.polyline(page, 0, i, constants.PATH, em / 1000),
      start: /** @type {[number, number]} */ ([stroke.start[0], stroke.start[1]]),
      length: stroke.length,
      fate: constants.FATE_OPEN, misses: 0, penDown: -1, isShown: false,
    };
  });
  [placed, stroke].forEach((made) => library.discard(made));
  return strokes;
}
