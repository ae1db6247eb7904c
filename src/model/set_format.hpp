// Constants of the set file format, shared by writer and reader (docs/set-file.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/stroke_ink.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy::set_format {

/// No text begins like this, and a transfer that converts line ends damages it detectably.
inline constexpr std::string_view magic =
    "\x89"
    "CGS\r\n\x1A\n";
inline constexpr std::uint32_t version = 4;
inline constexpr std::uint32_t version_without_ink = 2;  ///< readable by any reader of version 2
inline constexpr std::uint32_t oldest_version = 1;       ///< that is still readable
inline constexpr std::uint32_t unreleased_version = 3;   ///< whose ink had 8 knots on every stroke

// The header: offset of each field [byte].
inline constexpr std::size_t version_at = 8;
inline constexpr std::size_t checksum_at = 12;  ///< over everything from the next field to the first group
inline constexpr std::size_t size_at = 16;
inline constexpr std::size_t first_group_at = 20;
inline constexpr std::size_t group_count_at = 24;
inline constexpr std::size_t error_at = 28;
inline constexpr std::size_t coding_at = 36;
inline constexpr std::size_t coding_size = 14;
inline constexpr std::size_t kinds_at = 50;  ///< the kinds of strokes, most frequent first
inline constexpr std::size_t kind_size = 2;  ///< u8 id, u8 which elements are curves, first element in the lowest bit
inline constexpr std::size_t ink_head_size = 5;  ///< follows the kinds if there is ink: u32 steps, u8 values per knot

/// A group holds the characters of 64 neighbouring code points.
inline constexpr int group_shift = 6;
inline constexpr std::uint32_t last_block = 0x10FFFF >> group_shift;

// The directory: one number per group, then one entry per group.
inline constexpr std::size_t block_size = 2;
inline constexpr std::size_t entry_size = 16;  ///< u64 which of the 64 exist, u32 offset of the group, u32 checksum

/// Size of an offset in a group of this size [byte].
constexpr std::size_t offset_size(std::size_t group_size) { return group_size <= 0xFFFF ? 2 : 4; }

// The first byte of a form: its number of strokes, or these flags if anything is special.
inline constexpr unsigned more_forms = 1;
inline constexpr unsigned named = 2;
inline constexpr unsigned quartic = 4;
inline constexpr unsigned factors = 8;
inline constexpr unsigned own_coding = 16;
inline constexpr unsigned no_ink = 32;  ///< in a file that has ink
inline constexpr unsigned special = 128;
inline constexpr unsigned known_flags = more_forms | named | quartic | factors | own_coding | special;
inline constexpr std::size_t max_plain_strokes = 127;
inline constexpr std::size_t max_strokes = 4096;          ///< of a form
inline constexpr std::size_t max_forms = 255;             ///< of a character

// A stroke is stored as the rank of its kind, in a Rice code of parameter 1: rank / 2 ones, a zero, and the lowest bit.
// A rank too high for version 1 follows an escape: more ones than its ranks need.
inline constexpr int escape_ones = 20;
inline constexpr std::size_t max_short_ranks = 2 * escape_ones;
inline constexpr int escaped_rank_bits = 10;
inline constexpr std::size_t max_kinds = std::size_t{1} << escaped_rank_bits;
inline constexpr int min_rank_bits = 2;
inline constexpr int max_rank_bits = escape_ones + escaped_rank_bits;
static_assert(max_short_ranks >= typical_stroke_count && max_rank_bits <= 32);

inline constexpr std::uint32_t max_steps_per_em = 1U << 26;
inline constexpr std::uint8_t max_coordinate_bits = 32;
inline constexpr double max_coordinate = 16.0;  // [em]

// The values of a stroke's ink: start, end, half-widths and, unless they are zero throughout the file, shifts of corners
// and offsets. As many are stored as the stroke has knots and corners; their places are the same whatever the number.
inline constexpr std::size_t first_shift = 2;
inline constexpr std::size_t first_half_width = first_shift + max_ink_corners;
inline constexpr std::size_t first_offset = first_half_width + max_ink_knots;
inline constexpr std::size_t max_ink_values = first_offset + max_ink_knots;

/// Places of the values that are stored for a stroke of this size, in order.
template <typename Use>
constexpr void for_ink_places(const InkSize& size, bool has_offsets, Use use) {
  for (std::size_t i = 0; i < first_shift; ++i) use(i);
  for (std::size_t i = 0; i < size.knots; ++i) use(first_half_width + i);
  for (std::size_t i = 0; i < size.corners && has_offsets; ++i) use(first_shift + i);
  for (std::size_t i = 0; i < size.knots && has_offsets; ++i) use(first_offset + i);
}

/// A stroke's ink in steps.
using InkSteps = std::array<std::int32_t, max_ink_values>;

// The difference of a value from the expected one, numbered 0, -1, 1, -2, ..., is stored in a Rice code. This many ones
// escape to the plain number.
inline constexpr int ink_escape_ones = 20;
inline constexpr int ink_escaped_bits = 17;
inline constexpr std::uint8_t max_ink_parameter = 15;
inline constexpr std::uint32_t max_ink_steps_per_em = 16384;  ///< so that a difference fits in the escaped bits

/// How the ink of some strokes is stored.
struct InkRow {
  InkSteps usual{};                                       ///< value expected
  std::array<std::uint8_t, max_ink_values> parameters{};  ///< of the Rice code of each value
};

/// How the ink of a file is stored.
struct InkCode {
  std::uint32_t steps_per_em = 0;   ///< 0: values are doubles
  bool is_present = false;
  bool has_offsets = false;         ///< and shifts
  std::vector<InkRow> rows;         ///< one per frequent kind of stroke, then one for all others

  const InkRow& row_of(std::size_t kind) const noexcept { return rows[std::min(kind, rows.size() - 1)]; }
};

/// The value expected after one that was `off` from the usual one: a brush that presses harder does so for a while.
constexpr std::int32_t expected_ink(const InkSteps& usual, std::size_t value, std::int32_t off) {
  const bool follows = value > first_half_width && value < first_offset;
  return usual[value] + (follows ? off >> 1 : 0);
}

/// Strokes of one type with the same composition.
struct StrokeKind {
  std::uint8_t id = 0;
  ElementList elements;
  std::array<std::uint8_t, 2> points{};  ///< of cubic and of quartic curves
  InkSize ink{};                         ///< size of its ink
};

}  // namespace calligraphy::set_format
