// Encoding of the ink of a set (docs/set-file.md); private to the model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <calligraphy/model/stroke_ink.hpp>

#include "little_endian.hpp"
#include "set_format.hpp"

namespace calligraphy {

/// The ink of a stroke, the rank of its kind and its size.
struct RankedInk {
  const StrokeInk* ink;
  std::size_t kind;
  InkSize size;
};

/// The usual ink of each kind, and the parameters that make the code shortest. Has no values if there is no ink.
set_format::InkCode ink_code_of(const std::vector<RankedInk>& inks, std::size_t kinds, std::uint32_t steps_per_em);

/// `sizes`: of the ink of each kind.
void append_ink_code(std::vector<std::byte>& bytes, const set_format::InkCode& code,
                     std::span<const InkSize> sizes);

void write_ink(BitWriter& bits, const RankedInk& ink, const set_format::InkCode& code);

}  // namespace calligraphy
