// Parts of a large object, for WebAssembly.
#pragma once

namespace calligraphy {

/// A part of an object of more than a kilobyte, by an address that tells the compiler nothing of the whole. For
/// WebAssembly, LLVM 14 puts the place of a nested member into a load or store only up to 1024 bytes from an address
/// that it knows; for one further away it computes an address each time, and keeps it for later in memory.
template <class Part>
[[gnu::always_inline]] inline Part& apart(Part& part) noexcept {
#if defined(__wasm__)
  Part* address = &part;
  asm("" : "+r"(address));
  return *address;
#else
  return part;
#endif
}

}  // namespace calligraphy
