// print_forces.cpp in JavaScript: the same numbers, from the same calls, in node as in a browser.

/** Where the pen means to be, tick by tick [m, page]: 1.5 mm beside each stroke, lifted before and after it. */
function intendedPath(library, constants, page) {
  const path = [];
  const go = (x, y, z) => {
    const [x0, y0, z0] = path.at(-1) ?? [0.08, 0.06, 0.02];
    const length = Math.sqrt((x - x0) * (x - x0) + (y - y0) * (y - y0) + (z - z0) * (z - z0));
    const count = Math.floor(length / 1e-4) + 1;
    for (let i = 1; i <= count; ++i) {
      path.push([x0 + ((x - x0) * i) / count, y0 + ((y - y0) * i) / count, z0 + ((z - z0) * i) / count]);
    }
  };
  for (let stroke = 0; stroke < 5; ++stroke) {
    const points = library.polyline(page, 0, stroke, constants.PATH);
    const count = points.length / 2;
    go(points[0] + 0.0015, points[1], 0.008);
    for (let i = 0; i < count; ++i) go(points[2 * i] + 0.0015, points[2 * i + 1], -0.003);
    go(points[2 * count - 2] + 0.0015, points[2 * count - 1], 0.008);
  }
  return path;
}

/**
 * A lesson written by pointers of every kind, with misses, a palm, a touch that the system takes, a bounce and commands.
 * @returns {number[]} its events, and the last point of each piece of ink
 */
function lessonNumbers(library, constants, page) {
  const profile = library.struct("capabilities"), sample = library.struct("pointer_sample");
  library.device_profile("ideal", profile);
  const held = library.struct("lesson_options", { has_strength: 1, strength: 0.6 });
  const lesson = library.lesson_create_for_pointer(page, profile, null, held);
  let now = 1;
  const move = (kind, id, x, y, isDown, isCancelled) => {
    now += 0.009;
    Object.assign(sample, { kind, id, is_down: isDown, is_cancelled: isCancelled, time: now, place: [x, y] });
    library.lesson_move_pointer(lesson, sample, null);
  };
  // A share of a stroke, in steps of at most 1 mm, the pointer lifted for one of them at `bounce`.
  const write = (kind, id, stroke, { backwards = false, share = 1, bounce = -1, isCancelled = false } = {}) => {
    const flat = library.polyline(page, 0, stroke, constants.PATH);
    const points = Array.from({ length: flat.length / 2 }, (_, i) => [flat[2 * i], flat[2 * i + 1]]);
    if (backwards) points.reverse();
    const line = [points[0]];
    for (let k = 1; k < points.length; ++k) {
      const [x0, y0] = points[k - 1], [x1, y1] = points[k];
      const steps = Math.floor(Math.sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)) / 1e-3) + 1;
      for (let i = 1; i <= steps; ++i) line.push([x0 + ((x1 - x0) * i) / steps, y0 + ((y1 - y0) * i) / steps]);
    }
    const last = Math.floor(share * (line.length - 1)), lifted = Math.floor(bounce * line.length);
    if (kind !== constants.POINTER_TOUCH) move(kind, id, ...line[0], false, false);
    for (let i = 0; i <= last; ++i) move(kind, id, ...line[i], i !== lifted, false);
    move(kind, id, ...line[last], false, isCancelled);
    now += 0.5;
    library.lesson_advance(lesson, now);
  };
  const { POINTER_MOUSE: mouse, POINTER_TOUCH: touch, POINTER_PEN: pen } = constants;
  write(mouse, 1, 0);
  write(touch, 2, 1, { backwards: true });
  write(touch, 3, 1, { share: 0.6, isCancelled: true });
  move(touch, 4, 0.1, 0.03, true, false);  // a palm: a pen comes
  write(pen, 5, 1);
  write(touch, 6, 2);  // too soon after the pen
  write(pen, 5, 2, { share: 0.3 });
  write(pen, 5, 2, { bounce: 0.5 });
  library.lesson_send(lesson, constants.LESSON_UNDO);
  write(pen, 5, 2);
  library.lesson_send(lesson, constants.LESSON_SKIP);
  write(mouse, 1, 4);
  library.lesson_advance(lesson, now + 2);

  const numbers = [], view = library.struct("lesson_view"), event = library.struct("lesson_event");
  library.lesson_look(lesson, view);
  while (library.lesson_take_event(lesson, event)) {
    const { kind, reason, hint, stroke, misses, pen_down, tick, place } = event;
    numbers.push(kind, reason, hint, stroke, misses, pen_down, tick, ...place);
  }
  const ink = library.struct("lesson_ink"), point = new Float64Array(6);
  for (let i = 0; i < view.ink_count; ++i) {
    library.lesson_read_ink(lesson, i, ink);
    library.lesson_ink_points(lesson, ink.end - 1, point, 1);
    numbers.push(ink.begin, ink.end, ink.fate, point[0], point[1], point[4]);
  }
  library.free(lesson);
  return numbers;
}

/**
 * Writes a character by a hand that holds a simulated device and by one that follows a pointer.
 * @returns {{numbers: number[], renderer: number, states: object[]}} forces and more of each tick; and the renderer of
 * the former with its samples, for nanosecondsPerTick()
 */
export function scriptedForces(library, constants) {
  const page = library.page_lay_out(library.set_built_in(), "永", null, null);
  const tick = library.struct("tick");
  const numbers = [];
  let events = 0;
  const record = () => {
    numbers.push(...tick.force, ...tick.pen_tip, ...tick.attraction, tick.energy_given, tick.state, tick.hint);
    events |= tick.events;
  };
  const path = intendedPath(library, constants, page);
  const profile = library.struct("capabilities");
  const mapping = library.struct("mapping");
  const options = library.struct("renderer_options");

  // A hand that holds a simulated device.
  library.device_profile("touch", profile);
  library.page_mapping(page, constants.UPRIGHT, 1, mapping);
  library.renderer_options_for(profile, constants.PRESET_EVERYTHING, 1, constants.TOLERANCE_NORMAL, options);
  const renderer = library.renderer_create(page, mapping, profile, options);
  const onDevice = path.map((point) => point.map((value, axis) => value - mapping.offset[axis]));  // upright, scale 1
  const device = library.simulated_device_create(profile, null, onDevice[0]);
  const states = [];
  for (const position of onDevice) {
    const state = library.struct("device_state");
    library.device_intend(device, position, null);
    library.device_read(device, state);
    library.renderer_update(renderer, state, tick);
    library.device_write(device, tick.force);
    library.device_advance(device, 1e-3);
    record();
    states.push(state);
  }

  // A servo, and a hand that follows a pointer on the desk.
  library.device_profile("ideal", profile);
  library.page_mapping(page, constants.DESK, 1.5, mapping);
  const pointer = library.pointer_device_create(profile, null, null, mapping);
  const servo = library.servo_create(pointer, library.renderer_create(page, mapping, profile, null));
  path.forEach(([x, y, z], i) => {
    library.device_move_pointer(pointer, x, y, z < 0 ? 0.6 : 0, 0);
    library.servo_step(servo, i * 1e-3, tick);
    record();
  });
  if ((events & constants.PAGE_FINISHED) === 0) throw new Error("the page was not finished");
  numbers.push(...lessonNumbers(library, constants, page));
  return { numbers, renderer, states };
}

/**
 * What a tick takes, the median of several rounds of the samples of scriptedForces(). A round replays them so often
 * that a browser's clock, whose steps are 0.1 ms, tells its length to 2 %.
 */
export function nanosecondsPerTick(library, { renderer, states }) {
  const tick = library.struct("tick"), rounds = [], passes = 20;
  for (let round = 0; round < 21; ++round) {
    const start = performance.now();
    for (let pass = 0; pass < passes; ++pass) {
      library.renderer_restart(renderer);
      for (const state of states) library.renderer_update(renderer, state, tick);
    }
    rounds.push((performance.now() - start) / (passes * states.length));
  }
  return Math.round(1e6 * rounds.sort((a, b) => a - b)[10]);
}
