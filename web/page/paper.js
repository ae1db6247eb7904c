// The sheet of paper on the screen: four canvases on top of each other, so that only what changes is drawn anew.
import { em, margin, sheet } from "./desk.js";

/**
 * @typedef {import("./desk.js").Stroke} Stroke
 * @typedef {"sheet" | "ink" | "pen" | "marks"} Layer what is printed, ink that stays, ink of this pen-down, marks
 */

export const colours = {
  paper: "#fffdf7", grid: "#d9a39a", template: "#dfe3ea", due: "#b9c7de", start: "#d3372c", flash: "#f0a23c",
  ink: "#1d1a18", own: "#2f7fb8", skipped: "#b9b4ac", wrong: "#d3372c",
};

const corner = Math.cos(0.6);  // an outline turns by more only where it has a corner

/** A polyline. @param {Float64Array} points */
function line(points) {
  const path = new Path2D();
  for (let i = 0; i < points.length; i += 2) path.lineTo(points[i], points[i + 1]);
  return path;
}

/** The points of a path as far as a length. @param {Float64Array} path @param {number} length [m] */
function beginning(path, length) {
  const points = [path[0], path[1]];
  for (let i = 2, rest = length; i < path.length && rest > 0; i += 2) {
    const x = path[i] - path[i - 2], y = path[i + 1] - path[i - 1], step = Math.hypot(x, y);
    const share = Math.min(1, rest / (step || 1));
    points.push(path[i - 2] + share * x, path[i - 1] + share * y);
    rest -= step;
  }
  return Float64Array.from(points);
}

/** A smooth curve through the points of an outline, but for its corners. @param {Float64Array} points */
function outline(points) {
  const count = points.length / 2, path = new Path2D();
  const sides = Array.from({ length: count }, (_, i) => {  // from each point to the next: unit vector and length
    const next = (i + 1) % count, x = points[2 * next] - points[2 * i], y = points[2 * next + 1] - points[2 * i + 1];
    const length = Math.hypot(x, y) || 1;
    return { x: x / length, y: y / length, length };
  });
  const tangents = sides.map((side, i) => {
    const before = sides.at(i - 1) ?? side, x = before.x + side.x, y = before.y + side.y, sum = Math.hypot(x, y);
    const isSmooth = before.x * side.x + before.y * side.y > corner;
    return isSmooth ? { x: x / sum, y: y / sum } : undefined;
  });
  path.moveTo(points[0], points[1]);
  sides.forEach((side, i) => {
    const next = (i + 1) % count, third = side.length / 3, from = tangents[i] ?? side, to = tangents[next] ?? side;
    const [x, y] = points.subarray(2 * next, 2 * next + 2);
    path.bezierCurveTo(points[2 * i] + third * from.x, points[2 * i + 1] + third * from.y, x - third * to.x,
                       y - third * to.y, x, y);
  });
  path.closePath();
  return path;
}

export class Paper {
  /**
   * @param {HTMLElement} element in which the canvases are put
   * @param {() => void} redraw draws all layers anew, when the size has changed
   */
  constructor(element, redraw) {
    this.element = element;
    this.contexts = /** @type {Record<Layer, CanvasRenderingContext2D>} */ ({});
    for (const layer of /** @type {Layer[]} */ (["sheet", "ink", "pen", "marks"])) {
      const canvas = document.createElement("canvas");
      element.append(canvas);
      this.contexts[layer] = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    }
    this.shapes = /** @type {WeakMap<Stroke, Path2D>} */ (new WeakMap());
    this.pixels = 0;  // of the width and the height
    this.#resize();
    new ResizeObserver(() => { if (this.#resize()) redraw(); }).observe(element);
  }

  /** Width of a pixel of the screen [m, page]. */
  get pixel() {
    return sheet / this.pixels;
  }

  /** Where an event is on the page [m]. @param {PointerEvent} event @param {DOMRect} box of the element */
  place(event, box) {
    const across = (event.clientX - box.left) / box.width, down = (event.clientY - box.top) / box.height;
    return { x: sheet * across, y: sheet * (1 - down) };
  }

  /** Where a place on the page is in the element [CSS pixels]. @param {number} x @param {number} y */
  onScreen(x, y) {
    const width = this.element.clientWidth;
    return [(width * x) / sheet, width * (1 - y / sheet)];
  }

  /** @param {Layer} layer */
  clear(layer) {
    this.contexts[layer].clearRect(0, 0, sheet, sheet);
  }

  /** 米字格: the square of the character, divided in eight. */
  drawGrid() {
    const context = this.contexts.sheet;
    context.fillStyle = colours.paper;
    context.fillRect(0, 0, sheet, sheet);
    context.strokeStyle = colours.grid;
    context.lineWidth = em / 160;
    context.strokeRect(margin, margin, em, em);
    context.lineWidth = em / 320;
    context.setLineDash([em / 60, em / 80]);
    const near = margin, far = margin + em, middle = sheet / 2;
    context.beginPath();
    for (const [x0, y0, x1, y1] of [[near, near, far, far], [near, far, far, near], [near, middle, far, middle],
                                    [middle, near, middle, far]]) {
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
    }
    context.stroke();
    context.setLineDash([]);
  }

  /** @param {Layer} layer @param {Stroke} stroke @param {string} colour */
  fillStroke(layer, stroke, colour) {
    const context = this.contexts[layer];
    context.fillStyle = colour;
    context.fill(this.#shape(stroke));
  }

  /** The beginning of a stroke, as far as `share` of its length. @param {Layer} layer @param {Stroke} stroke
   * @param {string} colour @param {number} share */
  fillBeginning(layer, stroke, colour, share) {
    const context = this.contexts[layer], { path } = stroke;
    context.save();
    context.clip(this.#shape(stroke));
    context.strokeStyle = colour;
    context.lineJoin = context.lineCap = "round";
    context.lineWidth = em / 4;  // wider than any ink
    context.setLineDash([Math.max(share * stroke.length, 1e-9), 2 * stroke.length + em]);
    context.stroke(line(path));
    context.restore();
  }

  /** Where a stroke begins, and the way it takes from there. @param {Stroke} stroke */
  markStart({ start: [x, y], path, length }) {
    const context = this.contexts.marks, way = beginning(path, Math.min(em / 6, 0.8 * length));
    const [tipX, tipY] = way.slice(-2), [lastX, lastY] = way.slice(-6);
    context.strokeStyle = context.fillStyle = colours.start;
    context.lineWidth = em / 150;
    context.lineJoin = "round";
    context.beginPath();
    context.ellipse(x, y, em / 22, em / 34, Math.atan2(tipY - y, tipX - x), 0, 2 * Math.PI);
    context.globalAlpha = 0.25;
    context.fill();
    context.globalAlpha = 1;
    context.stroke();
    context.stroke(line(way));
    const direction = Math.atan2(tipY - lastY, tipX - lastX), side = em / 32;
    context.beginPath();
    for (const turn of [-2.5, 0, 2.5]) {
      const reach = turn === 0 ? 0 : side;
      context.lineTo(tipX + reach * Math.cos(direction + turn), tipY + reach * Math.sin(direction + turn));
    }
    context.stroke();
  }

  /** The pen above the paper or on it. @param {number} x @param {number} y @param {boolean} isDown */
  markPen(x, y, isDown) {
    const context = this.contexts.marks;
    context.fillStyle = colours.ink;
    context.globalAlpha = isDown ? 0.9 : 0.35;
    context.beginPath();
    context.arc(x, y, em / (isDown ? 110 : 80), 0, 2 * Math.PI);
    context.fill();
    context.globalAlpha = 1;
  }

  /** A number in a circle. @param {number} x @param {number} y @param {number} number @param {string} colour */
  markNumber(x, y, number, colour) {
    const context = this.contexts.marks, radius = em / 32;
    context.fillStyle = colour;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
    context.save();
    context.translate(x, y);
    context.scale(radius / 100, -radius / 100);  // text is upright where y points down
    context.fillStyle = "white";
    context.font = "bold 130px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(String(number), 0, 6);
    context.restore();
  }

  /** A ring round a place. @param {number} x @param {number} y @param {string} colour */
  markPlace(x, y, colour) {
    const context = this.contexts.marks;
    context.strokeStyle = colour;
    context.lineWidth = em / 150;
    context.beginPath();
    context.arc(x, y, em / 36, 0, 2 * Math.PI);
    context.stroke();
  }

  /** The outline of a stroke's ink. @param {Stroke} stroke */
  #shape(stroke) {
    let shape = this.shapes.get(stroke);
    if (!shape) this.shapes.set(stroke, shape = outline(stroke.outline));
    return shape;
  }

  /** @returns {boolean} whether it changed */
  #resize() {
    const wanted = Math.max(1, Math.round(this.element.clientWidth * Math.min(window.devicePixelRatio || 1, 2)));
    if (wanted === this.pixels) return false;
    this.pixels = wanted;
    for (const context of Object.values(this.contexts)) {
      context.canvas.width = context.canvas.height = wanted;
      context.setTransform(wanted / sheet, 0, 0, -wanted / sheet, 0, wanted);  // metres on the page, y upwards
    }
    return true;
  }
}
