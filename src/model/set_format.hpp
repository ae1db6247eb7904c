// Constants of the set file format, shared by writer and reader (docs/set-file.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy::set_format {

/// No text begins like this, and a transfer that converts line ends corrupts it detectably.
inline constexpr std::string_view magic =
    "\x89"
    "CGS\r\n\x1A\n";
inline constexpr std::uint32_t version = 1;

// The header: offset of each field [byte].
inline constexpr std::size_t version_at = 8;
inline constexpr std::size_t checksum_at = 12;  ///< over everything from the next field to the first group
inline constexpr std::size_t size_at = 16;
inline constexpr std::size_t first_group_at = 20;
inline constexpr std::size_t group_count_at = 24;
inline constexpr std::size_t error_at = 28;
inline constexpr std::size_t coding_at = 36;
inline constexpr std::size_t coding_size = 14;
inline constexpr std::size_t ranked_ids_at = 50;  ///< all typical stroke ids, most frequent first
inline constexpr std::size_t header_size = ranked_ids_at + typical_stroke_count;

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
inline constexpr unsigned special = 128;
inline constexpr unsigned known_flags = more_forms | named | quartic | factors | own_coding | special;
inline constexpr std::size_t max_plain_strokes = 127;
inline constexpr std::size_t max_strokes = 4096;          ///< of a form
inline constexpr std::size_t max_forms = 255;             ///< of a character
inline constexpr std::size_t max_order_name_bytes = 255;  // [byte]

// A stroke id is stored as its rank in a Rice code of parameter 1: rank / 2 ones, a zero, and the lowest bit.
inline constexpr int min_id_bits = 2;
inline constexpr int max_id_bits = (typical_stroke_count - 1) / 2 + 2;

using RankedIds = std::array<std::uint8_t, typical_stroke_count>;

inline constexpr std::uint32_t max_steps_per_em = 1U << 26;
inline constexpr std::uint8_t max_coordinate_bits = 32;
inline constexpr double max_coordinate = 16.0;  // [em]

/// Control points and feature points of each typical stroke: counts[degree - 3][id].
struct StrokeCounts {
  std::uint8_t points = 0;
  std::uint8_t features = 0;
};
using CountTable = std::array<std::array<StrokeCounts, typical_stroke_count + 1>, 2>;

inline const CountTable& stroke_counts() noexcept {
  static const CountTable counts = [] {
    CountTable table;
    for (const TypicalStroke& stroke : typical_strokes()) {
      for (const int degree : {3, 4}) {
        table[static_cast<std::size_t>(degree - 3)][static_cast<std::size_t>(stroke.id)] = {
            static_cast<std::uint8_t>(stroke.control_point_count(degree)),
            static_cast<std::uint8_t>(stroke.feature_point_count())};
      }
    }
    return table;
  }();
  return counts;
}

}  // namespace calligraphy::set_format
