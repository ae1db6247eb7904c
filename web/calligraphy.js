// The C interface (include/calligraphy/c/calligraphy.h) for JavaScript, without the prefix calligraphy_; docs/c.md has
// an example.
//
// A function throws a CalligraphyError unless its status is OK. If its last parameter is where it writes a handle, a
// number or a text, it takes no argument for it, and returns that value. Arguments are checked against the header:
// numbers, handles, strings, structs, and arrays, of which those that are written must be typed arrays; null where the
// header permits a null pointer.
import createModule from "./calligraphy_module.js";
import { callers, constants, functions, structs } from "./calligraphy_layout.js";

export { constants };

/**
 * @typedef {import("./calligraphy_layout.js").Handle} Handle
 * @typedef {import("./calligraphy_layout.js").Functions} Functions
 * @typedef {import("./calligraphy_layout.js").Structs} Structs such as Structs["tick"]
 * @typedef {ReturnType<typeof bind>} Library what load() returns
 * @typedef {Values<Structs["drawn_stroke"]>} Drawn what a pen-down wrote
 * @typedef {Values<Structs["remark"]> & {text: (language?: string) => string}} Remark and what it says, "en" or "zh"
 * @typedef {{drawn: Drawn[], remarks: Remark[], accepted: number}} Match `accepted`: the index of the form
 * @typedef {Values<Structs["stroke_score"]>} StrokeScore
 * @typedef {Values<Structs["pen_down_score"]>} PenDownScore
 * @typedef {Values<Structs["character_score"]>} CharacterScore
 * @typedef {CharacterScore & {strokes: StrokeScore[], pen_downs: PenDownScore[]} & Match} Score
 * @typedef {(value: unknown, expected: string) => never} Refuse throws a TypeError
 * @typedef {[name: string, type: string]} Parameter
 * @typedef {{bytes: Uint8Array, address: number}} Copy of what is not in the library's memory
 */
/**
 * @template Kind
 * @typedef {import("./calligraphy_layout.js").Initial<Kind>} Initial
 */
/**
 * @template Kind
 * @typedef {import("./calligraphy_layout.js").Values<Kind>} Values
 */

/** What a function of the library refused, in its words. */
export class CalligraphyError extends Error {
  /**
   * @param {string} message
   * @param {number} status such as constants.INVALID_VALUE
   */
  constructor(message, status) {
    super(message);
    this.name = "CalligraphyError";
    this.status = status;
  }
}

/** Of which each struct of the interface is a class. */
class Struct {
  address = 0;
}

/** @type {Record<string, [least: number, most: number]>} */
const ranges = {
  Int32: [-(2 ** 31), 2 ** 31 - 1], Uint32: [0, 2 ** 32 - 1], BigUint64: [0, Number.MAX_SAFE_INTEGER],
  Uint8: [0, 255], handle: [0, 2 ** 32 - 1],
};

/**
 * What refuses a value that is no number of this type, and returns it; true and false are 1 and 0.
 * @param {string} type such as "Int32"
 * @param {Refuse} refuse
 * @returns {(value: unknown) => number}
 */
function checking(type, refuse) {
  if (type === "Float64") {
    return (value) =>
      (typeof value === "number" ? value : typeof value === "boolean" ? Number(value) : refuse(value, "a number"));
  }
  const [least, most] = ranges[type];
  const expected = type === "handle" ? "a handle" : `an integer from ${least} to ${most}`;
  return (value) => {
    const number = typeof value === "boolean" ? Number(value) : value;
    return typeof number === "number" && Number.isInteger(number) && number >= least && number <= most ? number
      : refuse(value, expected);
  };
}

/**
 * @param {BufferSource} [binary] the bytes of calligraphy_module.wasm; by default it is fetched from beside this file, which
 * node cannot do
 * @returns {Promise<Library>} the functions of the C interface, and struct(), discard(), text(), polyline(), hint(),
 * match() and score()
 */
export async function load(binary) {
  if (!(binary === undefined || ArrayBuffer.isView(binary) || binary instanceof ArrayBuffer)) {
    throw new TypeError("load: expected the bytes of calligraphy_module.wasm, or nothing");
  }
  return bind(await createModule(binary ? { wasmBinary: binary } : {}));
}

/**
 * The functions of a module.
 * @param {import("./calligraphy_module.js").Module} module
 */
function bind(module) {
  const classes = new Map(Object.keys(structs).map((name) => [name, structClass(name)]));
  /** @type {DataView | undefined} */
  let whole;  // see view()
  const result = allocate(4);  // to which a function writes by its last parameter
  /** @type {Functions} */
  const library = /** @type {any} */ (Object.fromEntries(
    Object.entries(functions).map(([name, { parameters, returns }]) => [name, bound(name, parameters, returns)])));
  return { ...library, struct, discard, text, polyline, hint, languages, match, score };

  /**
   * A function of the library. Whatever its parameters say is looked up here, once.
   * @param {string} name
   * @param {Parameter[]} parameters
   * @param {string | null} returns
   * @returns {(...values: any[]) => any}
   */
  function bound(name, parameters, returns) {
    const symbol = module[`_calligraphy_${name}`];
    const passes = parameters.map((_, i) => passing(name, parameters, i));
    /** @param {number} count of arguments */
    const expect = (count) => {
      if (count !== parameters.length) throw new TypeError(`${name}: ${count} arguments, not ${parameters.length}`);
    };
    /** @param {number} status */
    const returned = (status) => {
      if (status !== constants.OK) throw new CalligraphyError(`${name}: ${library.last_error()}`, status);
      if (!returns) return undefined;
      const written = view().getUint32(result, true);
      return returns === "text" ? text(written) : written;
    };
    if (name === "version" || name === "last_error") {
      return function () { expect(arguments.length); return text(symbol()); };
    }
    if (name in callers) return callers[name](expect, module, returned, result, ...passes);
    return (...values) => {
      expect(values.length);
      /** @type {Copy[]} */
      const copies = [];
      try {
        for (let i = 0; i < values.length; ++i) values[i] = passes[i](values[i], values, copies);
        const value = returned(symbol(...values, result));
        for (const { bytes, address } of copies) bytes.set(memory(address, bytes.length));
        return value;
      } finally {
        for (const { address } of copies) module._free(address);
      }
    };
  }

  /**
   * Creates a struct, whose members are zero unless given. Its members are those in the memory of the library; one that
   * is an array can be set from any array of its length, and must be read anew after each call.
   * @template {keyof Structs} Name
   * @param {Name} name such as "tick"
   * @param {Initial<Structs[Name]>} [values] of members, or another such struct
   * @returns {Structs[Name]} with a function values(), which copies all members; discard() frees it
   */
  function struct(name, values = {}) {
    const Kind = classes.get(name);
    if (!Kind) throw new TypeError(`no struct is named ${name}`);
    if (values instanceof Struct && !(values instanceof Kind)) {
      throw new TypeError(`a ${Kind.name} was given a ${values.constructor.name}`);
    }
    const made = /** @type {any} */ (Object.preventExtensions(new Kind()));
    try {
      return Object.assign(made, values instanceof Struct ? /** @type {any} */ (values).values() : values);
    } catch (error) {
      discard(made);
      throw error;
    }
  }

  /** @param {string} name */
  function structClass(name) {
    const { size, members } = structs[name];
    class Kind extends Struct {
      static name = `struct ${name}`;
      constructor() {
        super();
        Object.defineProperty(this, "address", { value: allocate(size), writable: true, enumerable: false });
        memory(this.address, size).fill(0);
        view().setUint32(this.address, size, true);
      }
      values() {
        return Object.fromEntries(Object.keys(members).map((member) => {
          const value = /** @type {any} */ (this)[member];
          return [member, typeof value === "object" ? value.slice() : value];
        }));
      }
    }
    for (const [member, [type, offset, count]] of Object.entries(members)) {
      Object.defineProperty(Kind.prototype, member, accessors(member, type, offset, count));
    }
    return Kind;
  }

  /**
   * Frees the memory of a struct, which must not be used any more.
   * @param {Structs[keyof Structs]} made
   */
  function discard(made) {
    if (!(made instanceof Struct && made.address > 0)) throw new TypeError("discard: no struct, or it was discarded");
    module._free(made.address);
    Object.assign(made, { address: 0 });
  }

  /**
   * The text that ends at the first zero.
   * @param {number | Uint8Array} from its address, or its bytes
   * @returns {string}
   */
  function text(from) {
    const bytes = typeof from === "number" ? module.HEAPU8.subarray(from) : from;
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  /**
   * @param {Handle} page
   * @param {number} character
   * @param {number} stroke
   * @param {number} shape constants.PATH or constants.OUTLINE
   * @param {number} [tolerance] [m]
   * @returns {Float64Array} x and y of each point of a stroke [m, page]
   */
  function polyline(page, character, stroke, shape, tolerance = 0) {
    const count = library.page_polyline(page, character, stroke, shape, tolerance, null, 0);
    const points = new Float64Array(2 * count);
    library.page_polyline(page, character, stroke, shape, tolerance, points, count);
    return points;
  }

  /**
   * The words for the hint of a tick; empty without one.
   * @param {Structs["tick"]} tick
   * @param {string} [language] its code, such as "zh"
   */
  function hint(tick, language = "en") {
    const words = new Uint8Array(128);
    library.hint_text(tick, language, words, words.length);
    return text(words);
  }

  /**
   * Which stroke each pen-down wrote.
   * @param {Handle} page
   * @param {number} character
   * @param {(number[][] | Float64Array)[]} paths of each pen-down: points [x, y], or x and y of each point [m, page]
   * @param {{tolerance?: number, forms?: Handle, others?: Handle}} [options] such as constants.TOLERANCE_LENIENT; a
   *   set, of which every form of the character is accepted; an index, of which other characters are remarked
   * @returns {Match}
   */
  function match(page, character, paths, options = {}) {
    const isPath = (/** @type {unknown} */ path) => path instanceof Float64Array
      || (Array.isArray(path) && path.every(Array.isArray));
    if (!(Array.isArray(paths) && paths.every(isPath))) {
      throw new TypeError("match: expected an array of pen-downs, each an array of points [x, y]");
    }
    if (typeof options !== "object" || !options) throw new TypeError("match: expected options { tolerance, forms, others }");
    const { tolerance = constants.TOLERANCE_NORMAL, forms = 0, others = 0 } = options;
    const coordinates = paths.map((path) => (Array.isArray(path) ? path.flatMap(([x, y]) => [x, y]) : [...path]));
    const points = coordinates.flat(), sizes = coordinates.map((path) => path.length / 2);
    const handle = library.match_strokes(page, character, points, sizes, paths.length, tolerance, forms, others);
    return readMatch(handle, paths.length);
  }

  /**
   * How well a character was written, up to now.
   * @param {Handle} recording
   * @param {number} character
   * @param {number} [tolerance] such as constants.TOLERANCE_LENIENT
   * @returns {Score} members of the structs, and what each pen-down wrote
   */
  function score(recording, character, tolerance = constants.TOLERANCE_NORMAL) {
    const handle = library.score_recording(recording, tolerance);
    try {
      const [whole] = readAll("character_score", 1, (_, each) => library.score_character(handle, character, each));
      const strokes = readAll("stroke_score", whole.stroke_count,
                              (i, each) => library.score_stroke(handle, character, i, each));
      const pen_downs = readAll("pen_down_score", whole.pen_down_count,
                                (i, each) => library.score_pen_down(handle, character, i, each));
      return { ...whole, strokes, pen_downs, ...readMatch(library.score_match(handle, character), pen_downs.length) };
    } finally {
      library.free(handle);
    }
  }

  /** The codes of the languages in which remarks and hints can be had: "en", "zh". */
  function languages() {
    const codes = /** @type {string[]} */ ([]);
    while (codes.length < library.language_count()) codes.push(library.language_code(codes.length));
    return codes;
  }

  /**
   * All that a match says of so many pen-downs; it is freed.
   * @param {Handle} handle
   * @param {number} count
   * @returns {Match}
   */
  function readMatch(handle, count) {
    try {
      const drawn = readAll("drawn_stroke", count, (i, each) => library.match_drawn(handle, i, each));
      const remarks = readAll("remark", library.match_remark_count(handle),
                              (i, each) => library.match_remark(handle, i, each));
      const codes = languages();
      return {
        drawn,
        accepted: library.match_accepted(handle),
        remarks: remarks.map((remark, i) => {
          const texts = new Map(codes.map((code) => [code, library.match_remark_text(handle, i, code)]));
          const text = (language = "en") => texts.get(language) ?? refuseLanguage(language, texts);
          return { ...remark, text };
        }),
      };
    } finally {
      library.free(handle);
    }
  }

  /** @param {string} language @param {Map<string, string>} texts @returns {never} */
  function refuseLanguage(language, texts) {
    throw new TypeError(`language: expected one of ${[...texts.keys()].join(", ")}, not ${language}`);
  }

  /**
   * Copies of so many structs, each as `read` has set it.
   * @template {keyof Structs} Name
   * @param {Name} name
   * @param {number} count
   * @param {(index: number, each: Structs[Name]) => unknown} read
   * @returns {Values<Structs[Name]>[]}
   */
  function readAll(name, count, read) {
    const each = struct(name);
    try {
      return Array.from({ length: count }, (_, i) => {
        read(i, each);
        return /** @type {any} */ (each.values());
      });
    } finally {
      discard(each);
    }
  }

  /**
   * How a member is read and written.
   * @param {string} name
   * @param {string} type such as "Int32"
   * @param {number} offset
   * @param {number} [count] of an array
   * @returns {PropertyDescriptor & ThisType<any>}
   */
  function accessors(name, type, offset, count) {
    /** @type {Refuse} */
    const refuse = (_, expected) => { throw new TypeError(`${name}: expected ${expected}`); };
    if (type === "char") {
      const length = count ?? 1;
      return {
        get() { return text(memory(place(this, offset), length)); },
        set(value) {
          const bytes = textBytes(value) ?? refuse(value, "a text without zeros");
          if (bytes.length > length) refuse(value, `at most ${length - 1} bytes of UTF-8`);
          memory(place(this, offset), length).set(bytes);
        },
      };
    }
    const check = checking(type, refuse);
    if (count) {
      const ArrayType = arrayOf(type);
      const values = (/** @type {Struct} */ made) => new ArrayType(module.HEAPU8.buffer, place(made, offset), count);
      return {
        get() { return values(this); },
        set(given) {
          if (given?.length !== count) refuse(given, `an array of ${count}`);
          values(this).set(Array.from(given, check));
        },
      };
    }
    const { read, write } = numbers[type];
    return {
      get() { return read(view(), place(this, offset)); },
      set(value) {
        const number = check(value);
        if (offset === 0 && number !== this.size) refuse(value, `${this.size}, which cannot be changed`);
        write(view(), place(this, offset), number);
      },
    };
  }

  /**
   * The address of a member.
   * @param {Struct} made
   * @param {number} offset
   */
  function place(made, offset) {
    if (!(made.address > 0)) throw new TypeError(`this ${made.constructor.name} was discarded`);
    return made.address + offset;
  }

  /**
   * What makes an argument a number: itself, or the address of what is in memory or of a copy.
   * @param {string} name of the function
   * @param {Parameter[]} parameters
   * @param {number} i index of this one
   * @returns {(value: any, values: any[], copies: Copy[]) => number} of the argument, and if that is copied, of all of
   * them and the copies, to which it adds
   */
  function passing(name, parameters, i) {
    const [parameter, type] = parameters[i];
    /** @type {Refuse} */
    const refuse = (value, expected) => {
      const given = Object(value) === value ? `of type ${/** @type {any} */ (value).constructor?.name}`
        : typeof value === "string" ? JSON.stringify(value) : String(value);
      throw new TypeError(`${name}: ${parameter} is ${given}, expected ${expected}`);
    };
    if (type in ranges || type === "Float64") {
      const check = checking(type, refuse);
      return type === "handle" ? (value) => (value === null ? 0 : check(value)) : check;
    }
    if (type.startsWith("struct ")) {
      const Kind = /** @type {any} */ (classes.get(type.slice(7)));
      return (value) => {
        if (value === null) return 0;
        if (!(value instanceof Kind)) refuse(value, `a ${type} of this library`);
        return value.address > 0 ? value.address : refuse(value, "one that was not discarded");
      };
    }
    if (type === "text") {
      return (value, _, copies) =>
        (value === null ? 0 : copy(textBytes(value) ?? refuse(value, "a text without zeros"), copies));
    }
    const [access, element] = type.split(" "), ArrayType = arrayOf(element);
    return (value, values, copies) => {
      if (value === null) return 0;
      const array = access === "read" && Array.isArray(value)
        ? ArrayType.from(value, checking(element, (_, expected) => refuse(value, expected))) : value;
      if (!(array instanceof ArrayType)) refuse(value, `a ${ArrayType.name}`);
      const least = leastLength(element, parameters, values, i);
      if (array.length < least) refuse(value, `at least ${least} elements, not ${array.length}`);
      if (array.buffer === module.HEAPU8.buffer) return array.byteOffset;
      return copy(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), copies);
    };
  }

  /**
   * @param {Uint8Array} bytes
   * @param {Copy[]} copies to which it is added
   */
  function copy(bytes, copies) {
    const address = allocate(bytes.length);
    memory(address, bytes.length).set(bytes);
    copies.push({ bytes, address });
    return address;
  }

  /** @param {number} size [bytes] */
  function allocate(size) {
    const address = module._malloc(size || 1);
    if (!address) throw new RangeError(`no memory for ${size} bytes`);
    return address;
  }

  /**
   * @param {number} address
   * @param {number} size [bytes]
   */
  function memory(address, size) {
    return module.HEAPU8.subarray(address, address + size);
  }

  /** All of the memory, which is another buffer once it has grown. */
  function view() {
    if (whole?.buffer !== module.HEAPU8.buffer) whole = new DataView(module.HEAPU8.buffer);
    return whole;
  }
}

/**
 * How each type of number is in memory.
 * @type {Record<string, {
 *   read: (view: DataView, address: number) => number, write: (view: DataView, address: number, value: number) => void,
 * }>}
 */
const numbers = {
  Int32: {
    read: (view, address) => view.getInt32(address, true),
    write: (view, address, value) => view.setInt32(address, value, true),
  },
  Uint32: {
    read: (view, address) => view.getUint32(address, true),
    write: (view, address, value) => view.setUint32(address, value, true),
  },
  BigUint64: {
    read: (view, address) => Number(view.getBigUint64(address, true)),
    write: (view, address, value) => view.setBigUint64(address, BigInt(value), true),
  },
  Float64: {
    read: (view, address) => view.getFloat64(address, true),
    write: (view, address, value) => view.setFloat64(address, value, true),
  },
};

/** @param {string} type such as "read Float64" */
const isArray = (type) => /^(read|write) /.test(type);

/**
 * @param {string} type such as "Int32"
 * @returns {any} such as Int32Array
 */
const arrayOf = (type) => (/** @type {any} */ (globalThis))[`${type}Array`];

/**
 * How many elements an array must have, by the names of its parameter and of the next one that is no array, and their
 * arguments.
 * @param {string} element its type
 * @param {Parameter[]} parameters
 * @param {any[]} values of all arguments
 * @param {number} i index of the array
 * @returns {number}
 */
function leastLength(element, parameters, values, i) {
  const [name] = parameters[i];
  if (parameters[i + 1]?.[0] === "path_sizes") {
    return 2 * Array.from(values[i + 1] ?? []).slice(0, values[i + 2]).reduce((sum, size) => sum + size, 0);
  }
  const next = parameters.findIndex(([, type], other) => other > i && !isArray(type));
  if (["capacity", "size", "path_count"].includes(parameters[next]?.[0])) {
    return values[next] * ({ points: 2, samples: 9, ink: 6 }[name] ?? 1);
  }
  return element === "Float64" ? 3 : 1;  // a position, a velocity or a force; or a number
}

/**
 * A text with its zero in UTF-8; undefined if it is none, or has a zero itself.
 * @param {unknown} text
 */
function textBytes(text) {
  return typeof text === "string" && !text.includes("\0") ? new TextEncoder().encode(`${text}\0`) : undefined;
}
