#include <calligraphy/base/random.hpp>

#include <cmath>

namespace calligraphy {

Random::Random(std::uint64_t seed, std::initializer_list<int> keys) : state_(seed) {
  for (const int key : keys) state_ = bits() ^ static_cast<std::uint32_t>(key);
}

double Random::between(double low, double high) { return low + (high - low) * next(); }

std::uint64_t Random::index(std::uint64_t count) {
  if (count == 0) return 0;
  const std::uint64_t surplus = (0 - count) % count;  // 2^64 mod count: accepting these values would bias the result
  for (;;) {
    const std::uint64_t draw = bits();
    if (draw >= surplus) return draw % count;
  }
}

double Random::normal() {
  constexpr double half_height = 0.8577638849607068;  // sqrt(2 / e)
  for (;;) {
    const double u = 1.0 - next();  // (0, 1]
    const double v = half_height * (2.0 * next() - 1.0);
    if (v * v <= -4.0 * u * u * std::log(u)) return v / u;
  }
}

}  // namespace calligraphy
