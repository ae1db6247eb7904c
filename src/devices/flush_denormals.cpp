#include <calligraphy/devices/detail/flush_denormals.hpp>

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace calligraphy::detail {
namespace {

// The floating-point control register, and its bits that flush denormal operands and results.
#if defined(__SSE2__) || defined(_M_X64)
constexpr std::uint64_t flush = 0x8040;  // FTZ and DAZ of MXCSR
std::uint64_t control() noexcept { return _mm_getcsr(); }
void set_control(std::uint64_t word) noexcept { _mm_setcsr(static_cast<unsigned>(word)); }
#elif defined(__aarch64__)
constexpr std::uint64_t flush = 1u << 24;  // FZ of FPCR
std::uint64_t control() noexcept {
  std::uint64_t word;
  asm volatile("mrs %0, fpcr" : "=r"(word));
  return word;
}
void set_control(std::uint64_t word) noexcept { asm volatile("msr fpcr, %0" : : "r"(word)); }
#else
constexpr std::uint64_t flush = 0;
std::uint64_t control() noexcept { return 0; }
void set_control(std::uint64_t) noexcept {}
#endif

}  // namespace

FlushDenormals::FlushDenormals() noexcept : before_(control()) { set_control(before_ | flush); }

FlushDenormals::~FlushDenormals() { set_control(before_); }

bool FlushDenormals::available() noexcept { return flush != 0; }

}  // namespace calligraphy::detail
