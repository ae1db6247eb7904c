// What a mouse, a finger or the pen of a tablet does on the paper, at the times at which it did it.

/**
 * @typedef {object} PointerSample
 * @property {number} time [ms], as performance.now()
 * @property {number} x [m, page]
 * @property {number} y [m, page]
 * @property {boolean} isDown whether it writes
 * @property {boolean} [isPalm] whether what it did since it was put down was no writing, as of a palm, or of a touch
 *   that the system took over
 * @property {Stylus} stylus
 * @property {number} buttons sum of the bits of constants.BUTTON_TIP and the like; -1: unknown
 * @property {string} [kind] of the pointer, as in Pointer Events
 *
 * @typedef {object} Stylus what a pen senses besides its place; what is missing or undefined, it does not sense
 * @property {number} [pressure] from 0 to 1
 * @property {number} [force] [N]
 * @property {number} [altitude] of the barrel above the paper [rad]
 * @property {number} [azimuth] of the barrel: from x towards y, which points up [rad]
 * @property {number} [twist] about the barrel, counterclockwise from above [rad]
 * @property {number} [height] above the paper [m]
 */

const degree = Math.PI / 180;
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
    this.last = /** @type {PointerSample} */ ({ time: 0, x: 0, y: 0, isDown: false, stylus: {}, buttons: -1 });
    this.penTime = -Infinity;  // when a pen was last seen [ms]
    this.leans = false;        // whether a pen was seen that senses how it leans
    this.twists = false;       // whether one was seen that senses how it is turned
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
    const isDown = (event.buttons & 1) !== 0, changes = event.button === 0 && isDown !== this.isDown;
    if (changes) return isDown ? this.#begin(event) : this.#end(event);  // while another button is held
    if (this.isDown && !isDown) return this.#lift(event.timeStamp);  // its end was lost
    const coalesced = event.getCoalescedEvents?.() ?? [];
    this.#add(coalesced.length > 0 ? coalesced : [event], this.isDown);
    return undefined;
  }

  /** @param {PointerEvent} event */
  #end(event) {
    if (event.pointerId !== this.id) return;
    if (event.type === "pointercancel") return this.#lift(event.timeStamp, true);
    if (event.type === "lostpointercapture") return this.#lift(event.timeStamp);
    this.id = undefined;
    this.#add([event], false);
    return undefined;
  }

  /** The pointer that is down leaves the paper, where it was last. @param {number} time @param {boolean} [isPalm] */
  #lift(time, isPalm = false) {
    this.id = undefined;
    this.samples.push({ ...this.last, time, isDown: false, isPalm, stylus: {}, buttons: -1 });
    this.wake();
  }

  /** @param {PointerEvent[]} events @param {boolean} isDown */
  #add(events, isDown) {
    const box = this.paper.element.getBoundingClientRect();
    for (const event of events) {
      const { timeStamp: time, buttons, pointerType: kind } = event;
      const stylus = kind === "pen" ? this.#sensed(event) : {};  // browsers make up the pressure of a mouse
      this.last = { time, ...this.paper.place(event, box), isDown, stylus, buttons, kind };
      this.samples.push(this.last);
    }
    this.wake();
  }

  /** What a pen senses. One that senses neither tilt nor twist is always upright and at 0 for a browser.
   * @param {PointerEvent} event @returns {Stylus} */
  #sensed(event) {
    const [altitude, azimuth] = leaning(event), { pressure, twist } = event;
    this.leans ||= altitude < Math.PI / 2;
    this.twists ||= twist > 0;
    return { pressure, ...(this.leans && { altitude, azimuth }), ...(this.twists && { twist: 0 - twist * degree }) };
  }
}

/**
 * The altitude and the azimuth of a pen [rad], the latter from x towards y, which points up. Where a browser has only
 * tilts, the barrel is where the two planes that they turn meet.
 * @param {PointerEvent & {altitudeAngle?: number, azimuthAngle?: number}} event
 */
function leaning({ altitudeAngle, azimuthAngle, tiltX, tiltY }) {
  if (altitudeAngle !== undefined && azimuthAngle !== undefined) return [altitudeAngle, 0 - azimuthAngle];
  const across = tiltX * degree, down = tiltY * degree;
  const x = Math.sin(across) * Math.cos(down), y = -Math.sin(down) * Math.cos(across);
  return [Math.atan2(Math.cos(across) * Math.cos(down), Math.hypot(x, y)), Math.atan2(y, x)];
}
