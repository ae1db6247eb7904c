// What the pen did from one touch of the paper to the next lift.
import { constants } from "../calligraphy.js";
import { em } from "./desk.js";
import { InkLine } from "./ink.js";

const tail = 0.12 * em;  // ink farther from where a stroke was finished is no part of it [m]

export class PenDown {
  guided = new InkLine();  // where the guided pen was
  /** @type {InkLine[]} */
  own = [];                // where the pointer was
  stray = new InkLine();   // of the guided pen, after it had finished a stroke, of no stroke
  /** @type {[number, number] | undefined} */
  finish;                  // where it finished a stroke; undefined: it did not [m]
  /** @type {[number, number]} */
  end = [0, 0];            // where it was lifted [m]
  lifted = 0;              // index of the recorded tick in which it was
  isBegun = false;         // it began a stroke, and whether it wrote it is not known yet
  isDoubted = false;       // once it was over, that was left to the next one
  isPassed = false;        // its stroke was skipped
  isPalm = false;          // it was no writing
  isBroken = false;        // it began a stroke, and did not write it
  hint = constants.HINT_NONE;  // why it was not guided

  /** @param {number} begin [s] @param {number} recorded number of ticks that had been recorded */
  constructor(begin, recorded) {
    this.begin = begin;
    this.recorded = recorded;
  }

  /** Whether ink here belongs to no stroke, because its own was finished elsewhere. @param {number} x
   * @param {number} y */
  isStray(x, y) {
    return this.finish !== undefined && Math.hypot(x - this.finish[0], y - this.finish[1]) > tail;
  }

  /** Takes what became of its stroke, or that it began one. @param {number} events
   * @param {[number, number]} tip of the pen [m] */
  takeEvents(events, tip) {
    if (events === 0) return;
    if (events & constants.STROKE_FINISHED) this.finish ??= tip;
    if (events & constants.STROKE_ABANDONED) this.isBroken = true;
    this.isBegun = (events & constants.STROKE_STARTED) !== 0;
  }

  /**
   * Takes a hint. The first one says where the pen was put down; that it was another stroke's start is seen later.
   * @param {number} kind
   */
  takeHint(kind) {
    const isReason = this.hint === constants.HINT_NONE || kind === constants.HINT_ANOTHER_STROKE;
    if (isReason && kind !== constants.HINT_LIFT_FIRST) this.hint = kind;
  }

  /**
   * Why it did not write a stroke; without words where its hint says it.
   * @param {import("./desk.js").Stroke} stroke
   * @returns {string | undefined}
   */
  whyNot({ start, path, length }) {
    const [x, y] = this.end;
    const toStart = Math.hypot(x - start[0], y - start[1]);
    const toEnd = Math.hypot(x - path[path.length - 2], y - path[path.length - 1]);
    if (this.isBroken) {
      return toEnd < 0.2 * em || this.guided.length > 0.8 * length ? "not along the stroke" : "lifted before its end";
    }
    if (this.hint === constants.HINT_AT_END && toStart < toEnd) return "backwards: the stroke begins here";
    return this.hint === constants.HINT_NONE ? "too short: write on" : undefined;
  }
}
