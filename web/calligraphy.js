// The C interface (include/calligraphy/c/calligraphy.h) for JavaScript, without the prefix calligraphy_:
//
//   const library = await load();
//   const page = library.page_lay_out(library.set_built_in(), "永", null, null);
//   const profile = library.struct("capabilities");
//   library.device_profile("touch", profile);
//   const renderer = library.renderer_create(page, null, profile, null);
//
// A function throws a CalligraphyError unless its status is OK. If its last parameter is where it writes a handle, a
// number or a text, it takes no argument for it, and returns that value. Arguments are numbers, handles, strings,
// structs, null, arrays, which are passed as doubles, and typed arrays, to which the function may write.
import createModule from "./calligraphy.mjs";
import { constants, functions, structs } from "./calligraphy_layout.mjs";

export { constants };

/** What a function of the library refused, in its words. */
export class CalligraphyError extends Error {
  /**
   * @param {string} message
   * @param {number} status such as constants.INVALID_VALUE
   */
  constructor(message, status) {
    super(message);
    this.status = status;
  }
}

/**
 * @param {BufferSource} [binary] the bytes of calligraphy.wasm; by default it is fetched from beside this file
 * @returns {Promise<object>} the functions of the C interface, and struct(), discard() and text()
 */
export async function load(binary) {
  const module = await createModule(binary ? { wasmBinary: binary } : {});
  let whole;  // see view()
  const result = allocate(4);  // to which a function writes by its last parameter
  const library = { struct, discard, text };
  for (const [name, { parameters, returns, writes }] of Object.entries(functions)) {
    const symbol = `_calligraphy_${name}`;
    library[name] = (...values) => {
      if (values.length !== parameters) throw new TypeError(`${name}: ${values.length} arguments, not ${parameters}`);
      const copies = [];
      try {
        const status = module[symbol](...values.map((value) => pass(value, copies)), result);
        if (returns) return text(status);
        if (status !== constants.OK) throw new CalligraphyError(`${name}: ${library.last_error()}`, status);
        for (const { bytes, address } of copies) bytes.set(memory(address, bytes.length));
        const written = writes && view().getUint32(result, true);
        return writes === "text" ? text(written) : written;
      } finally {
        for (const { address } of copies) module._free(address);
      }
    };
  }
  return library;

  /**
   * A struct with its size, and all else zero unless in `values`. Its members are those in the memory of the library.
   * One that is an array can be set from any array; read it anew after each call.
   * @param {string} name such as "tick"
   * @param {object} [values] of members
   * @returns {object}
   */
  function struct(name, values = {}) {
    if (!structs[name]) throw new TypeError(`no struct is named ${name}`);
    const { size, members } = structs[name];
    const made = Object.defineProperty({}, "address", { value: allocate(size) });
    memory(made.address, size).fill(0);
    for (const [member, [type, offset, count]] of Object.entries(members)) {
      Object.defineProperty(made, member, { enumerable: true, ...accessors(type, made.address + offset, count) });
    }
    return Object.assign(Object.preventExtensions(made), { size }, values);
  }

  /** Frees the memory of a struct, which must not be used any more. */
  function discard(made) {
    module._free(made.address);
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

  /** How a member is read and written. */
  function accessors(type, address, count) {
    if (type === "char") {
      return {
        get: () => text(memory(address, count)),
        set: (value) => memory(address, count).fill(0).set(new TextEncoder().encode(`${value}\0`)),
      };
    }
    if (count) {
      const values = () => new globalThis[`${type}Array`](module.HEAPU8.buffer, address, count);
      return { get: values, set: (given) => values().set(given) };
    }
    const [get, set] = [`get${type}`, `set${type}`];
    return { get: () => Number(view()[get](address, true)), set: (value) => view()[set](address, value, true) };
  }

  /** An argument as a number: the address of what is in memory, or of a copy. */
  function pass(value, copies) {
    if (value === null) return 0;
    if (typeof value === "number") return value;
    if (value?.address) return value.address;
    if (value?.buffer === module.HEAPU8.buffer) return value.byteOffset;
    const bytes = bytesOf(value);
    const address = allocate(bytes.length);
    memory(address, bytes.length).set(bytes);
    copies.push({ bytes, address });
    return address;
  }

  function allocate(size) {
    const address = module._malloc(size);
    if (!address) throw new RangeError(`no memory for ${size} bytes`);
    return address;
  }

  function memory(address, size) {
    return module.HEAPU8.subarray(address, address + size);
  }

  /** All of the memory, which is another buffer once it has grown. */
  function view() {
    if (whole?.buffer !== module.HEAPU8.buffer) whole = new DataView(module.HEAPU8.buffer);
    return whole;
  }
}

/** The bytes of an argument that is not in the memory of the library. */
function bytesOf(value) {
  if (typeof value === "string") return new TextEncoder().encode(`${value}\0`);
  if (Array.isArray(value)) return new Uint8Array(Float64Array.from(value).buffer);
  if (ArrayBuffer.isView(value)) return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  throw new TypeError(`neither a number, text, struct, array nor null: ${value}`);
}
