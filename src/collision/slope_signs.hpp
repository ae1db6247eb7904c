// Signs of the slope's Bernstein ordinates for one query: the processor-specific part of the nearest point.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <calligraphy/collision/detail/curve_element.hpp>

#include "pair.hpp"
#include "slope_cells.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace calligraphy {

using detail::SlopeOrdinates;

template <std::size_t Count>
struct SlopeSigns {
  std::uint64_t negative = 0;  ///< bit i: ordinate i is below zero
  bool certain = false;        ///< rounding cannot flip any sign, and the query fits in single precision

  bool first_negative() const { return negative & 1U; }
  bool last_negative() const { return (negative >> (Count - 1)) & 1U; }
  /// Bit i: ordinates i and i + 1 have different signs.
  std::uint64_t changes() const { return (negative ^ (negative >> 1)) & ((std::uint64_t{1} << (Count - 1)) - 1); }
  /// Those changes from - to +: a minimum lies there.
  std::uint64_t minima() const { return changes() & negative; }
  /// Number of ordinates below zero before the first one that is not.
  int first_negatives() const { return std::countr_zero(~negative | (std::uint64_t{1} << Count)); }
  /// No + comes before a -.
  bool ascending() const { return (negative & (negative + 1)) == 0; }
  /// There are both - and +.
  bool differ() const { return negative - 1 < (std::uint64_t{1} << Count) - 2; }
  /// The signs are - up to one ordinate and + from the next one on.
  bool one_minimum() const { return ascending() & differ(); }
};

/// Signs of the ordinates, without those that rounding could flip.
struct CertainSigns {
  std::uint64_t negative = 0, positive = 0;
};

/// Bound on the error of an ordinate; infinite for a query so far away that ordinates may overflow.
template <std::size_t Count>
[[gnu::always_inline]] inline float slope_noise(const SlopeOrdinates<Count>& ordinates, float x, float y) {
  const float noise = std::fabs(x) * ordinates.noise_x + std::fabs(y) * ordinates.noise_y + ordinates.noise_constant;
  return noise < 1e28F ? noise : std::numeric_limits<float>::infinity();
}

template <std::size_t Count>
inline float slope_ordinate(const SlopeOrdinates<Count>& ordinates, std::size_t i, float x, float y) {
  const std::size_t at = place_of_ordinate<Count>(i);
  return (x * ordinates.x[at] + y * ordinates.y[at]) + ordinates.constant[at];
}

/// Plain C++ for any processor; the other versions give the same bits.
template <std::size_t Count>
inline SlopeSigns<Count> slope_signs_portable(const SlopeOrdinates<Count>& ordinates, Pair query) {
  const float x = static_cast<float>(query[0]), y = static_cast<float>(query[1]);
  const float noise = slope_noise(ordinates, x, y);
  SlopeSigns<Count> signs;
  signs.certain = true;
  for (std::size_t i = 0; i < Count; ++i) {
    const float value = slope_ordinate(ordinates, i, x, y);
    signs.negative |= static_cast<std::uint64_t>(value < 0.0F) << i;
    signs.certain = signs.certain && std::fabs(value) > noise;
  }
  return signs;
}

#if defined(__SSE2__)

/// The four ordinates from number i on.
template <std::size_t Count>
[[gnu::always_inline]] inline __m128 slope_ordinates_sse2(const SlopeOrdinates<Count>& ordinates, std::size_t i,
                                                          __m128 x, __m128 y) {
  const std::size_t at = place_of_ordinate<Count>(i);
  return _mm_add_ps(
      _mm_add_ps(_mm_mul_ps(x, _mm_load_ps(&ordinates.x[at])), _mm_mul_ps(y, _mm_load_ps(&ordinates.y[at]))),
      _mm_load_ps(&ordinates.constant[at]));
}

/// The signs of sixteen values: bit i is that of the i-th.
[[gnu::always_inline]] inline std::uint64_t sixteen_signs(const __m128* values) {
  const __m128i low = _mm_packs_epi32(_mm_castps_si128(values[0]), _mm_castps_si128(values[1]));
  const __m128i high = _mm_packs_epi32(_mm_castps_si128(values[2]), _mm_castps_si128(values[3]));
  return static_cast<std::uint64_t>(static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(low, high))));
}

template <std::size_t Count>
[[gnu::always_inline]] inline SlopeSigns<Count> slope_signs_sse2(const SlopeOrdinates<Count>& ordinates, Pair query) {
  const float x = static_cast<float>(query[0]), y = static_cast<float>(query[1]);
  const __m128 all_x = _mm_set1_ps(x), all_y = _mm_set1_ps(y);
  const __m128 magnitude = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
  __m128 least = _mm_set1_ps(3e38F);
  SlopeSigns<Count> signs;
  for (std::size_t i = 0; i < Count; i += 16) {
    __m128 values[4];
    for (std::size_t k = 0; k < 4; ++k) {
      // An incomplete group repeats its first four.
      values[k] = slope_ordinates_sse2(ordinates, i + 4 * k < Count ? i + 4 * k : i, all_x, all_y);
      least = _mm_min_ps(least, _mm_and_ps(values[k], magnitude));
    }
    signs.negative |= sixteen_signs(values) << i;
  }
  if constexpr (Count < 64) signs.negative &= (std::uint64_t{1} << Count) - 1;
  signs.certain = _mm_movemask_ps(_mm_cmpgt_ps(least, _mm_set1_ps(slope_noise(ordinates, x, y)))) == 0xf;
  return signs;
}

[[gnu::target("avx2"), gnu::always_inline]] inline SlopeSigns<CurveElement::max_ordinates> slope_signs_avx2(
    const SlopeOrdinates<CurveElement::max_ordinates>& ordinates, Pair query) {
  const __m128 single = _mm_cvtpd_ps(query), second = _mm_movehdup_ps(single);
  const float x = _mm_cvtss_f32(single), y = _mm_cvtss_f32(second);
  const __m256 all_x = _mm256_broadcastss_ps(single), all_y = _mm256_broadcastss_ps(second);
  const __m256 magnitude = _mm256_castsi256_ps(_mm256_set1_epi32(0x7fffffff));
  const auto eight = [&](std::size_t i) __attribute__((target("avx2"), always_inline)) {
    return _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(all_x, _mm256_loadu_ps(&ordinates.x[i])),
                                       _mm256_mul_ps(all_y, _mm256_loadu_ps(&ordinates.y[i]))),
                         _mm256_loadu_ps(&ordinates.constant[i]));
  };
  const __m256 a = eight(0), b = eight(8), c = eight(16), d = eight(24), e = eight(32), f = eight(40);
  const __m256 least = _mm256_min_ps(
      _mm256_min_ps(_mm256_min_ps(_mm256_and_ps(a, magnitude), _mm256_and_ps(b, magnitude)),
                    _mm256_min_ps(_mm256_and_ps(c, magnitude), _mm256_and_ps(d, magnitude))),
      _mm256_min_ps(_mm256_and_ps(e, magnitude), _mm256_and_ps(f, magnitude)));
  const __m256i first =
      _mm256_packs_epi16(_mm256_packs_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)),
                         _mm256_packs_epi32(_mm256_castps_si256(c), _mm256_castps_si256(d)));
  const __m256i rest = _mm256_packs_epi32(_mm256_castps_si256(e), _mm256_castps_si256(f));
  const __m128i last = _mm_packs_epi16(_mm256_castsi256_si128(rest), _mm256_extracti128_si256(rest, 1));
  const __m256 noise = _mm256_set1_ps(slope_noise(ordinates, x, y));
  SlopeSigns<CurveElement::max_ordinates> signs;
  signs.negative = static_cast<std::uint64_t>(static_cast<unsigned>(_mm256_movemask_epi8(first))) |
                   static_cast<std::uint64_t>(static_cast<unsigned>(_mm_movemask_epi8(last))) << 32;
  signs.certain = _mm256_movemask_ps(_mm256_cmp_ps(least, noise, _CMP_GT_OQ)) == 0xff;
  return signs;
}

/// Those of the whole curve fit in one register.
[[gnu::target("avx2"), gnu::always_inline]] inline SlopeSigns<CurveElement::whole_ordinates> slope_signs_avx2(
    const SlopeOrdinates<CurveElement::whole_ordinates>& ordinates, Pair query) {
  const float x = static_cast<float>(query[0]), y = static_cast<float>(query[1]);
  const __m256 values =
      _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(_mm256_set1_ps(x), _mm256_loadu_ps(ordinates.x.data())),
                                  _mm256_mul_ps(_mm256_set1_ps(y), _mm256_loadu_ps(ordinates.y.data()))),
                    _mm256_loadu_ps(ordinates.constant.data()));
  const __m256 magnitudes = _mm256_and_ps(values, _mm256_castsi256_ps(_mm256_set1_epi32(0x7fffffff)));
  const __m256 noise = _mm256_set1_ps(slope_noise(ordinates, x, y));
  SlopeSigns<CurveElement::whole_ordinates> signs;
  signs.negative = static_cast<unsigned>(_mm256_movemask_ps(values));
  signs.certain = _mm256_movemask_ps(_mm256_cmp_ps(magnitudes, noise, _CMP_GT_OQ)) == 0xff;
  return signs;
}

#endif

template <std::size_t Count>
inline CertainSigns certain_signs(const SlopeOrdinates<Count>& ordinates, Pair query) {
  static_assert(Count % 16 == 0);
  const float x = static_cast<float>(query[0]), y = static_cast<float>(query[1]);
  const float noise = slope_noise(ordinates, x, y);
  CertainSigns signs;
#if defined(__SSE2__)
  for (std::size_t i = 0; i < Count; i += 16) {
    __m128 negative[4], positive[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const __m128 values = slope_ordinates_sse2(ordinates, i + 4 * k, _mm_set1_ps(x), _mm_set1_ps(y));
      negative[k] = _mm_cmplt_ps(values, _mm_set1_ps(-noise));
      positive[k] = _mm_cmpgt_ps(values, _mm_set1_ps(noise));
    }
    signs.negative |= sixteen_signs(negative) << i;
    signs.positive |= sixteen_signs(positive) << i;
  }
#else
  for (std::size_t i = 0; i < Count; ++i) {
    const float value = slope_ordinate(ordinates, i, x, y);
    signs.negative |= static_cast<std::uint64_t>(value < -noise) << i;
    signs.positive |= static_cast<std::uint64_t>(value > noise) << i;
  }
#endif
  return signs;
}

/// Uses only what every processor of the target architecture supports.
template <std::size_t Count>
[[gnu::always_inline]] inline SlopeSigns<Count> slope_signs(const SlopeOrdinates<Count>& ordinates, Pair query) {
#if defined(__SSE2__)
  return slope_signs_sse2(ordinates, query);
#else
  return slope_signs_portable(ordinates, query);
#endif
}

}  // namespace calligraphy
