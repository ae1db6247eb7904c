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

/** A piece of ink: where the guided pen was, and where the pointer was. */
export class Ink {
  guided = new InkLine();
  own = new InkLine();
  penDown = -1;
  fate = 0;  // such as constants.FATE_OPEN
  isDoubted = false;
  taken = 0;  // index behind the last point that was taken

  /** Takes what is new. @param {import("./desk.js").LessonHandle} desk @param {number} index @param {number} pixel
   * its size [m] */
  take(desk, index, pixel) {
    const { library } = desk, read = library.struct("lesson_ink");
    library.lesson_read_ink(desk.handle, index, read);
    const begin = Math.max(this.taken, read.begin), points = desk.inkPoints(begin, read.end);
    Object.assign(this, { penDown: read.pen_down, fate: read.fate, isDoubted: read.is_doubted !== 0, taken: read.end });
    library.discard(read);
    for (let i = 0; i < points.length; i += 6) {
      const [x, y, ownX, ownY, time, pressure] = points.subarray(i, i + 6);
      this.guided.write(x, y, time, pressure, pixel);
      this.own.write(ownX, ownY, time, pressure, pixel);
    }
  }
}

/** A line of ink, drawn as it grows. */
class InkLine {
  brush = new Brush();
  points = /** @type {InkPoint[]} */ ([]);
  drawn = 0;  // of `points`
  last = { x: NaN, y: NaN, time: NaN };

  /** The pen is at a place. @param {number} x @param {number} y @param {number} time [s] @param {number} pressure NaN: not
   * measured @param {number} pixel its size [m] */
  write(x, y, time, pressure, pixel) {
    const { last } = this, seconds = time - last.time || 0, way = Math.hypot(x - last.x, y - last.y);
    const speed = seconds > 0 ? way / seconds : 0;
    const width = this.brush.press(Number.isNaN(pressure) ? undefined : pressure, speed, seconds);
    this.last = { x, y, time };
    this.add(x, y, width, 0.7 * pixel);
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

  /** Draws all of it, or what was added since the last time, this share of its width.
   * @param {CanvasRenderingContext2D} context @param {string} colour @param {number} [share] @param {boolean} [isWhole] */
  draw(context, colour, share = 1, isWhole = true) {
    const { points } = this, from = isWhole ? 0 : this.drawn;
    this.drawn = points.length;
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
