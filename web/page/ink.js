// Ink: what a brush leaves on the paper, as wide as it is pressed, or as slowly as it moves.
import { em } from "./desk.js";

const thin = 0.012 * em, wide = 0.085 * em;  // [m]
const settling = 0.025;                      // of the width [s]
const quick = 6 * em;                        // a pen this fast writes half as wide as one that rests [m/s]

/** @typedef {{x: number, y: number, width: number}} InkPoint [m, page] */

/** The width of the ink, which follows the pressure of the pen, or its speed where it has none. */
export class Brush {
  constructor() {
    this.width = thin;
  }

  /**
   * @param {number | undefined} pressure from 0 to 1; undefined: the pointer does not measure it
   * @param {number} speed along the paper [m/s]
   * @param {number} seconds since the last call
   * @returns {number} width of the ink [m]
   */
  press(pressure, speed, seconds) {
    const share = pressure ?? 0.8 / (1 + speed / quick);
    const wanted = thin + (wide - thin) * Math.min(1, share);
    this.width += (wanted - this.width) * (1 - Math.exp(-seconds / settling));
    return this.width;
  }
}

/** The ink of one pen-down, drawn as it grows. */
export class InkLine {
  constructor() {
    this.points = /** @type {InkPoint[]} */ ([]);
    this.drawn = 0;  // of `points`
  }

  /** Of its path [m]. */
  get length() {
    return this.points.reduce((sum, { x, y }, i) => {
      const last = this.points[Math.max(0, i - 1)];
      return sum + Math.hypot(x - last.x, y - last.y);
    }, 0);
  }

  /**
   * @param {number} x @param {number} y @param {number} width
   * @param {number} step what is nearer to the last point is left out [m]
   */
  add(x, y, width, step) {
    const last = this.points.at(-1);
    if (last && Math.hypot(x - last.x, y - last.y) < step && Math.abs(width - last.width) < step) return;
    this.points.push({ x, y, width });
  }

  /** Draws what was added since the last time, this share of its width. @param {CanvasRenderingContext2D} context
   * @param {string} colour @param {number} [share] */
  drawOn(context, colour, share) {
    this.#draw(context, colour, share, this.drawn);
    this.drawn = this.points.length;
  }

  /** Draws all of it. @param {CanvasRenderingContext2D} context @param {string} colour @param {number} [share] */
  drawAll(context, colour, share) {
    this.#draw(context, colour, share, 0);
  }

  /** @param {CanvasRenderingContext2D} context @param {string} colour @param {number | undefined} share
   * @param {number} from */
  #draw(context, colour, share = 1, from) {
    const { points } = this;
    context.strokeStyle = colour;
    context.lineCap = "round";
    for (let i = from; i < points.length; ++i) {
      const { x, y, width } = points[i], last = points[Math.max(0, i - 1)];
      context.lineWidth = 0.5 * share * (width + last.width);
      context.beginPath();
      context.moveTo(last.x, last.y);
      context.lineTo(x, y);
      context.stroke();
    }
  }
}
