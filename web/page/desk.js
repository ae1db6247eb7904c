// A character on a sheet of paper, and the simulated pen that writes it: its hand follows the pointer, and feels the
// guide.
import { constants } from "../calligraphy.js";

/** Edge of the character's square, and the margin around it [m]. */
export const em = 0.04, margin = 0.1 * em, sheet = em + 2 * margin;

// A light and well damped hand, which follows the pointer closely round corners, too.
const grip = { mass: 0.01, damping: 12, stiffness: 300 };  // [kg, N s/m, N/m]
const settling = 0.03;  // of the guide: no real hand is thrown by it [s]
// A pointer that is put down or lifted takes the pen along within some 20 ms.
const following = { smoothing_time: 0.01, max_speed: 2, lifting_speed: 0.6, hover_height: 0.0045 };
const pressed = 0.5;  // pressure of a pen on the paper, whatever its own: it must touch the paper

/**
 * @typedef {import("../calligraphy.js").Library} Library
 * @typedef {object} Stroke
 * @property {Float64Array} outline of its ink: x and y of each point [m, page]
 * @property {Float64Array} path of the pen, likewise
 * @property {[number, number]} start where it begins
 * @property {number} length of its path [m]
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

export class Desk {
  /**
   * @param {Library} library
   * @param {number} set handle of the set of characters
   * @param {string} character
   */
  constructor(library, set, character) {
    this.library = library;
    this.handles = /** @type {number[]} */ ([]);
    this.page = this.#kept(layOut(library, set, character));
    this.mapping = library.struct("mapping");
    library.page_mapping(this.page, constants.UPRIGHT, 1, this.mapping);
    this.profile = library.struct("capabilities");
    library.device_profile("ideal", this.profile);
    const hand = library.struct("grip", grip), pointer = library.struct("pointer_options", following);
    this.device = this.#kept(library.pointer_device_create(this.profile, hand, pointer, this.mapping));
    this.options = library.struct("renderer_options");
    this.sample = library.struct("device_state");
    this.tick = library.struct("tick");
    this.stylus = library.struct("stylus");
    [hand, pointer].forEach((made) => library.discard(made));
    this.strokes = this.#readStrokes();
    this.due = 0;  // index of the stroke to be written next; the number of strokes once all are
    this.renderer = 0;
    this.guide(0, constants.TOLERANCE_NORMAL);
    this.move(sheet / 2, sheet / 2, false);
  }

  /**
   * Sets how strong the guide is, and how exactly strokes must be written, from the stroke that is due on.
   * @param {number} strength share of the way to the stroke over which a hand is pulled, from 0 to below 1
   * @param {number} tolerance such as constants.TOLERANCE_NORMAL
   */
  guide(strength, tolerance) {
    const { library, options } = this;
    library.renderer_options_for(this.profile, constants.PRESET_DEVICE, 1, tolerance, options);
    options.grip_stiffness = grip.stiffness;
    options.guidance_stiffness = (grip.stiffness * strength) / (1 - strength);
    options.guidance_wrong_way_stiffness *= Math.min(1, 2 * strength);
    options.guidance_damping *= Math.min(1, 2 * strength);
    options.guidance_fade_in = settling;
    options.guidance_to_start = Number(strength > 0);
    const renderer = library.renderer_create(this.page, this.mapping, this.profile, options);
    for (let stroke = 0; stroke < this.due; ++stroke) library.renderer_skip_stroke(renderer);
    if (this.renderer) library.free(this.renderer);
    this.renderer = renderer;
  }

  /**
   * Moves the pointer that the hand follows.
   * @param {number} x [m, page]
   * @param {number} y [m, page]
   * @param {boolean} isDown
   * @param {import("./pointer.js").Stylus} [stylus]
   * @param {number} [buttons]
   */
  move(x, y, isDown, stylus = {}, buttons = 0) {
    setStylus(this.stylus, stylus);
    this.library.device_move_pen(this.device, x, y, isDown ? pressed : 0, Math.max(0, buttons), this.stylus);
  }

  /** Whether the lifted pen is not where a pointer is that was not seen coming, such as a finger. @param {number} x
   * @param {number} y */
  isAwayFrom(x, y) {
    const { pen_tip } = this.tick;
    return Math.hypot(pen_tip[0] - x, pen_tip[1] - y) > 0.01 * em;
  }

  /** One millisecond; its result is in `tick`. */
  advance() {
    const { library, device, sample, tick } = this;
    library.device_read(device, sample);
    library.renderer_update(this.renderer, sample, tick);
    library.device_write(device, tick.force);
    this.due = tick.character > 0 ? this.strokes.length : tick.stroke;
    return tick;
  }

  /** Passes over the stroke that is due, unless it is being written; whether it did. */
  skip() {
    const skipped = this.library.renderer_skip_stroke(this.renderer) !== 0;
    if (skipped) ++this.due;
    return skipped;
  }

  free() {
    const { library } = this;
    for (const made of [this.mapping, this.profile, this.options, this.sample, this.tick, this.stylus]) {
      library.discard(made);
    }
    [...this.handles, this.renderer].forEach((handle) => library.free(handle));
  }

  /** @param {number} handle */
  #kept(handle) {
    this.handles.push(handle);
    return handle;
  }

  /** @returns {Stroke[]} */
  #readStrokes() {
    const { library, page } = this;
    const placed = library.struct("placed_character"), stroke = library.struct("stroke");
    library.page_character(page, 0, placed);
    const strokes = Array.from({ length: placed.stroke_count }, (_, i) => {
      library.page_stroke(page, 0, i, stroke);
      return {
        outline: library.polyline(page, 0, i, constants.OUTLINE, em / 1000),
        path: library.polyline(page, 0, i, constants.PATH, em / 1000),
        start: /** @type {[number, number]} */ ([stroke.start[0], stroke.start[1]]),
        length: stroke.length,
      };
    });
    [placed, stroke].forEach((made) => library.discard(made));
    return strokes;
  }
}
