// Types of what Emscripten makes of the library (calligraphy_module.js), as far as calligraphy.js uses it.

export interface Module {
  /** All of the memory, anew once it has grown. */
  readonly HEAPU8: Uint8Array<ArrayBuffer>;
  /** The address of that many bytes; 0 if there are none. */
  _malloc(size: number): number;
  _free(address: number): void;
  /** A function of the C interface; pointers are addresses. */
  readonly [symbol: `_calligraphy_${string}`]: (...values: number[]) => number;
}

/** Compiles the library, whose bytes it fetches unless they are given. */
export default function createModule(options?: { wasmBinary?: BufferSource }): Promise<Module>;
