// Denormal numbers as zero, for the thread of a servo loop.
#pragma once

#include <cstdint>

namespace calligraphy {

/// While it lives, this thread takes and gives denormal numbers (below 2.2e-308) as zero: processors are up to a
/// hundred times slower on them, and decaying filters end there. Needs x86 with SSE2 or 64-bit ARM; elsewhere it does
/// nothing.
class FlushDenormals {
 public:
  FlushDenormals() noexcept;
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

  /// Whether this processor can do it.
  static bool available() noexcept;

 private:
  std::uint64_t before_;
};

}  // namespace calligraphy
