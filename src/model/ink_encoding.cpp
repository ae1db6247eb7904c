#include "ink_encoding.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace calligraphy {
namespace {

using namespace set_format;

constexpr std::size_t min_strokes_per_row = 24;  // fewer save less than the row costs

std::array<double, max_ink_values> values_of(const StrokeInk& ink) {
  std::array<double, max_ink_values> values{ink.start, ink.end};
  std::copy(ink.shifts.begin(), ink.shifts.end(), values.begin() + first_shift);
  std::copy(ink.half_widths.begin(), ink.half_widths.end(), values.begin() + first_half_width);
  std::copy(ink.offsets.begin(), ink.offsets.end(), values.begin() + first_offset);
  return values;
}

InkSteps steps_of(const StrokeInk& ink, std::uint32_t steps_per_em) {
  InkSteps steps{};
  const std::array<double, max_ink_values> values = values_of(ink);
  std::transform(values.begin(), values.end(), steps.begin(),
                 [&](double value) { return static_cast<std::int32_t>(std::lround(value * steps_per_em)); });
  return steps;
}

/// The ink of a stroke in steps.
struct SizedSteps {
  InkSteps steps;
  InkSize size;
};

/// The median of each value, among the strokes that have it; 0 if none has.
InkSteps medians_of(const std::vector<SizedSteps>& inks) {
  std::array<std::vector<std::int32_t>, max_ink_values> of_places;
  for (const SizedSteps& ink : inks) {
    for_ink_places(ink.size, true, [&](std::size_t place) { of_places[place].push_back(ink.steps[place]); });
  }
  InkSteps medians{};
  for (std::size_t place = 0; place < max_ink_values; ++place) {
    std::vector<std::int32_t>& steps = of_places[place];
    if (steps.empty()) continue;
    const auto middle = steps.begin() + std::ssize(steps) / 2;
    std::nth_element(steps.begin(), middle, steps.end());
    medians[place] = *middle;
  }
  return medians;
}

/// Uses the place of each stored value, and its difference from the expected one as a number: 0, -1, 1, -2, ... become
/// 0, 1, 2, 3, ...
template <typename Use>
void for_numbers(const SizedSteps& ink, const InkSteps& usual, bool has_offsets, Use use) {
  std::int32_t off = 0;
  for_ink_places(ink.size, has_offsets, [&](std::size_t place) {
    const std::int32_t difference = ink.steps[place] - expected_ink(usual, place, off);
    use(place, static_cast<std::uint32_t>(difference < 0 ? -2 * difference - 1 : 2 * difference));
    off = ink.steps[place] - usual[place];
  });
}

std::uint64_t bits_of(std::uint32_t number, std::uint8_t parameter) {
  const std::uint32_t ones = number >> parameter;
  return ones < ink_escape_ones ? ones + 1 + parameter : ink_escape_ones + ink_escaped_bits;
}

void write_number(BitWriter& bits, std::uint32_t number, std::uint8_t parameter) {
  const std::uint32_t ones = number >> parameter;
  if (ones >= ink_escape_ones) {
    bits.write((std::uint64_t{1} << ink_escape_ones) - 1, ink_escape_ones);
    bits.write(number, ink_escaped_bits);
    return;
  }
  bits.write((std::uint64_t{1} << ones) - 1, static_cast<int>(ones) + 1);
  bits.write(number & ((1U << parameter) - 1), parameter);
}

/// What is usual of these strokes, and the parameters that make their code shortest.
InkRow row_of(const std::vector<SizedSteps>& inks, bool has_offsets) {
  InkRow row{medians_of(inks), {}};
  std::array<std::array<std::uint64_t, max_ink_parameter + 1>, max_ink_values> lengths{};  // [bit]
  for (const SizedSteps& ink : inks) {
    for_numbers(ink, row.usual, has_offsets, [&](std::size_t place, std::uint32_t number) {
      for (std::uint8_t k = 0; k <= max_ink_parameter; ++k) lengths[place][k] += bits_of(number, k);
    });
  }
  for (std::size_t place = 0; place < max_ink_values; ++place) {
    const auto& own = lengths[place];
    row.parameters[place] = static_cast<std::uint8_t>(std::min_element(own.begin(), own.end()) - own.begin());
  }
  return row;
}

}  // namespace

InkCode ink_code_of(const std::vector<RankedInk>& inks, std::size_t kinds, std::uint32_t steps_per_em) {
  InkCode code;
  if (inks.empty()) return code;
  code.steps_per_em = steps_per_em;
  const auto is_straight = [&](const RankedInk& each) {
    const auto is_zero = [&](double offset) {
      return steps_per_em == 0 ? offset == 0.0 : std::lround(offset * steps_per_em) == 0;
    };
    return std::all_of(each.ink->offsets.begin(), each.ink->offsets.end(), is_zero) &&
           std::all_of(each.ink->shifts.begin(), each.ink->shifts.end(), is_zero);
  };
  code.is_present = true;
  code.has_offsets = !std::all_of(inks.begin(), inks.end(), is_straight);
  if (steps_per_em == 0) return code;

  std::vector<std::vector<SizedSteps>> of_kinds(kinds);
  for (const RankedInk& each : inks) of_kinds[each.kind].push_back({steps_of(*each.ink, steps_per_em), each.size});
  // Kinds are in order of frequency: the first rare one ends the list of kinds with a row of their own.
  const auto is_rare = [](const std::vector<SizedSteps>& strokes) { return strokes.size() < min_strokes_per_row; };
  const auto rare = std::find_if(of_kinds.begin(), of_kinds.end(), is_rare);
  std::vector<SizedSteps> others;
  for (auto kind = rare; kind != of_kinds.end(); ++kind) others.insert(others.end(), kind->begin(), kind->end());
  for (auto kind = of_kinds.begin(); kind != rare; ++kind) code.rows.push_back(row_of(*kind, code.has_offsets));
  code.rows.push_back(row_of(others, code.has_offsets));
  return code;
}

void append_ink_code(std::vector<std::byte>& bytes, const InkCode& code, std::span<const InkSize> sizes) {
  append(bytes, code.steps_per_em);
  append(bytes, static_cast<std::uint8_t>(code.has_offsets ? 2 : 1));
  if (code.steps_per_em == 0) return;
  append(bytes, static_cast<std::uint16_t>(code.rows.size()));
  for (std::size_t i = 0; i < code.rows.size(); ++i) {
    const InkSize size = i + 1 < code.rows.size() ? sizes[i] : InkSize{max_ink_knots, max_ink_corners};
    for_ink_places(size, code.has_offsets, [&](std::size_t place) {
      append(bytes, code.rows[i].parameters[place]);
      append(bytes, static_cast<std::uint16_t>(code.rows[i].usual[place]));
    });
  }
}

void write_ink(BitWriter& bits, const RankedInk& ink, const InkCode& code) {
  if (code.steps_per_em == 0) {
    const std::array<double, max_ink_values> values = values_of(*ink.ink);
    for_ink_places(ink.size, code.has_offsets, [&](std::size_t place) { bits.write_double(values[place]); });
    return;
  }
  const InkRow& row = code.row_of(ink.kind);
  for_numbers({steps_of(*ink.ink, code.steps_per_em), ink.size}, row.usual, code.has_offsets,
              [&](std::size_t place, std::uint32_t number) { write_number(bits, number, row.parameters[place]); });
}

}  // namespace calligraphy
