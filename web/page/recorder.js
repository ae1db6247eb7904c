// What the pen did, tick by tick, as numbers that another thread can be given at once.
import { constants } from "../calligraphy.js";

const perTick = 14;  // time, status, state, events, character, stroke, pen tip, force, and where the pointer was

/** Events that say what became of a stroke. */
export const verdicts = constants.STROKE_FINISHED | constants.STROKE_ABANDONED | constants.CHARACTER_FINISHED |
                        constants.PAGE_FINISHED;

/** @typedef {import("../calligraphy_layout.js").Structs["tick"]} Tick */

export class Recorder {
  numbers = new Float64Array(perTick * 4096);
  count = 0;  // of ticks

  /**
   * @param {Tick} tick
   * @param {number} time of it [s]
   * @param {[number, number]} own where the pointer was last on the paper [m]
   */
  add(tick, time, own) {
    if (perTick * (this.count + 1) > this.numbers.length) {
      const larger = new Float64Array(2 * this.numbers.length);
      larger.set(this.numbers);
      this.numbers = larger;
    }
    const { status, state, events, character, stroke } = tick;
    this.numbers.set([time, status, state, events, character, stroke, ...tick.pen_tip, ...tick.page_force, ...own],
                     perTick * this.count);
    this.count += 1;
  }

  /**
   * Moves the verdict of a tick to the earlier one in which the pen was lifted: a score takes the place, the time and
   * the pen-down from there.
   * @param {number} lifted index of that tick
   * @param {Tick} tick
   */
  judge(lifted, tick) {
    const events = perTick * lifted + 3;
    this.numbers.set([this.numbers[events] | (tick.events & verdicts), tick.character, tick.stroke], events);
    tick.events &= ~verdicts;
  }

  /** A copy of what was recorded. */
  copy() {
    return this.numbers.slice(0, perTick * this.count);
  }
}

/**
 * Calls a function with each tick of a copy.
 * @param {Float64Array} numbers
 * @param {Tick} tick in which they are put
 * @param {boolean} isOwn whether the pen tip is to be where the pointer was
 * @param {() => void} use
 */
export function replay(numbers, tick, isOwn, use) {
  for (let i = 0; i < numbers.length; i += perTick) {
    [tick.time, tick.status, tick.state, tick.events, tick.character, tick.stroke] = numbers.subarray(i, i + 6);
    tick.pen_tip = numbers.subarray(i + 6, i + 9);
    tick.page_force = numbers.subarray(i + 9, i + 12);
    if (isOwn) tick.pen_tip.set(numbers.subarray(i + 12, i + 14));
    use();
  }
}
