// Flushes denormal numbers to zero in the calling thread.
#pragma once

#include <cstdint>

namespace calligraphy::detail {

/// RAII guard: during its lifetime, denormal operands and results (below 2.2e-308) in this thread are treated as zero.
/// Processors are up to a hundred times slower on denormals, and decaying filters end in them. Supports x86 with SSE2
/// and 64-bit ARM; elsewhere it does nothing.
class FlushDenormals {
 public:
  FlushDenormals() noexcept;
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

  /// Whether this processor is supported.
  static bool available() noexcept;

 private:
  std::uint64_t before_;
};

}  // namespace calligraphy::detail
