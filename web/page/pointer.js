// What a mouse, a finger or the pen of a tablet does on the paper, at the times at which it did it.

/**
 * @typedef {object} PointerSample
 * @property {number} time [ms], as performance.now()
 * @property {number} x [m, page]
 * @property {number} y [m, page]
 * @property {boolean} isDown whether it writes
 * @property {boolean} [isPalm] whether what it did since it was put down was no writing
 * @property {number | undefined} pressure from 0 to 1; undefined: it does not measure it
 */

const restOfHand = 1500;  // for so long after a pen was seen, a touch is the hand that holds it [ms]

export class Pointer {
  /**
   * @param {HTMLElement} element
   * @param {import("./paper.js").Paper} paper
   * @param {() => void} wake is called at each event
   */
  constructor(element, paper, wake) {
    this.samples = /** @type {PointerSample[]} */ ([]);  // that were not taken yet
    this.paper = paper;
    this.wake = wake;
    this.id = /** @type {number | undefined} */ (undefined);  // of the pointer that is down
    this.type = "";            // its kind
    this.last = /** @type {PointerSample} */ ({ time: 0, x: 0, y: 0, isDown: false, pressure: undefined });
    this.penTime = -Infinity;  // when a pen was last seen [ms]
    element.addEventListener("pointerdown", (event) => this.#begin(event));
    element.addEventListener("pointermove", (event) => this.#move(event));
    for (const type of /** @type {const} */ (["pointerup", "pointercancel", "lostpointercapture"])) {
      element.addEventListener(type, (event) => this.#end(event));
    }
    element.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });  // no scrolling
    element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  /** The next sample, unless it is later than this [ms]. @param {number} time */
  take(time) {
    return this.samples.length > 0 && this.samples[0].time <= time ? this.samples.shift() : undefined;
  }

  /** Whether a pointer is down. */
  get isDown() {
    return this.id !== undefined;
  }

  /** @param {PointerEvent} event */
  #begin(event) {
    const { pointerType, timeStamp, isPrimary } = event, isTouch = pointerType === "touch";
    if (pointerType === "pen") this.penTime = timeStamp;
    const isPalm = isTouch && timeStamp - this.penTime < restOfHand;
    if (event.button !== 0 || isPalm || (isTouch && !isPrimary)) return;
    if (this.isDown) {
      const wasPalm = this.type === "touch" && pointerType === "pen";
      if (!wasPalm && this.type !== pointerType) return;
      this.#lift(timeStamp, wasPalm);  // otherwise its end was lost
    }
    this.id = event.pointerId;
    this.type = pointerType;
    /** @type {HTMLElement} */ (event.currentTarget).setPointerCapture(event.pointerId);
    this.#add([event], true);
  }

  /** @param {PointerEvent} event */
  #move(event) {
    if (event.pointerType === "pen") this.penTime = event.timeStamp;
    if (this.isDown ? event.pointerId !== this.id : !event.isPrimary) return;
    if (this.isDown && event.buttons === 0) return this.#lift(event.timeStamp);  // its end was lost
    const coalesced = event.getCoalescedEvents?.() ?? [];
    this.#add(coalesced.length > 0 ? coalesced : [event], this.isDown);
    return undefined;
  }

  /** @param {PointerEvent} event */
  #end(event) {
    if (event.pointerId === this.id) this.#lift(event.timeStamp);
  }

  /** The pointer that is down leaves the paper, where it was last. @param {number} time @param {boolean} [isPalm] */
  #lift(time, isPalm = false) {
    this.id = undefined;
    this.samples.push({ ...this.last, time, isDown: false, isPalm });
    this.wake();
  }

  /** @param {PointerEvent[]} events @param {boolean} isDown */
  #add(events, isDown) {
    const box = this.paper.element.getBoundingClientRect();
    for (const event of events) {
      const pressure = event.pointerType === "pen" && event.pressure > 0 ? event.pressure : undefined;
      this.last = { time: event.timeStamp, ...this.paper.place(event, box), isDown, pressure };
      this.samples.push(this.last);
    }
    this.wake();
  }
}
