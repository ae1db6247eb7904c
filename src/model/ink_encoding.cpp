#include "ink_encoding.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace calligraphy {
namespace {

using namespace set_format;

constexpr std::size_t min_strokes_per_row = 24;  // fewer save less than the row costs

std::array<double, values_per_ink> values_of(const StrokeInk& ink) {
  std::array<double, values_per_ink> values{ink.start, ink.end};
  std::copy(ink.half_widths.begin(), ink.half_widths.end(), values.begin() + first_half_width);
  std::copy(ink.offsets.begin(), ink.offsets.end(), values.begin() + first_offset);
  return values;
}

InkSteps steps_of(const StrokeInk& ink, std::uint32_t steps_per_em) {
  InkSteps steps{};
  const std::array<double, values_per_ink> values = values_of(ink);
  std::transform(values.begin(), values.end(), steps.begin(),
                 [&](double value) { return static_cast<std::int32_t>(std::lround(value * steps_per_em)); });
  return steps;
}

/// The median of each value; zeros if there are no inks.
InkSteps medians_of(const std::vector<InkSteps>& inks) {
  InkSteps medians{};
  std::vector<std::int32_t> sorted(inks.size());
  for (std::size_t value = 0; value < values_per_ink && !inks.empty(); ++value) {
    std::transform(inks.begin(), inks.end(), sorted.begin(), [&](const InkSteps& steps) { return steps[value]; });
    const auto median = sorted.begin() + std::ssize(sorted) / 2;
    std::nth_element(sorted.begin(), median, sorted.end());
    medians[value] = *median;
  }
  return medians;
}

/// The difference of each value from the expected one, as a number: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
std::array<std::uint32_t, values_per_ink> numbers_of(const InkSteps& steps, const InkSteps& usual) {
  std::array<std::uint32_t, values_per_ink> numbers{};
  std::int32_t off = 0;
  for (std::size_t i = 0; i < values_per_ink; ++i) {
    const std::int32_t difference = steps[i] - expected_ink(usual, i, off);
    numbers[i] = static_cast<std::uint32_t>(difference < 0 ? -2 * difference - 1 : 2 * difference);
    off = steps[i] - usual[i];
  }
  return numbers;
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

}  // namespace

InkCode ink_code_of(const std::vector<RankedInk>& inks, std::size_t kinds, std::uint32_t steps_per_em) {
  InkCode code;
  if (inks.empty()) return code;
  code.steps_per_em = steps_per_em;
  const auto is_straight = [&](const RankedInk& each) {
    return std::all_of(each.ink->offsets.begin(), each.ink->offsets.end(), [&](double offset) {
      return steps_per_em == 0 ? offset == 0.0 : std::lround(offset * steps_per_em) == 0;
    });
  };
  code.values = std::all_of(inks.begin(), inks.end(), is_straight) ? first_offset : values_per_ink;
  if (steps_per_em == 0) return code;

  std::vector<std::vector<InkSteps>> of_kinds(kinds);
  for (const RankedInk& each : inks) of_kinds[each.kind].push_back(steps_of(*each.ink, steps_per_em));
  // Kinds are in order of frequency: the first rare one ends the list of kinds with a row of their own.
  const auto is_rare = [](const std::vector<InkSteps>& strokes) { return strokes.size() < min_strokes_per_row; };
  const auto rare = std::find_if(of_kinds.begin(), of_kinds.end(), is_rare);
  std::vector<InkSteps> others;
  for (auto kind = rare; kind != of_kinds.end(); ++kind) others.insert(others.end(), kind->begin(), kind->end());
  for (auto kind = of_kinds.begin(); kind != rare; ++kind) code.usual.push_back(medians_of(*kind));
  code.usual.push_back(medians_of(others));

  std::array<std::array<std::uint64_t, max_ink_parameter + 1>, values_per_ink> lengths{};  // [bit]
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    for (const InkSteps& steps : of_kinds[kind]) {
      const std::array<std::uint32_t, values_per_ink> numbers = numbers_of(steps, code.usual_of(kind));
      for (std::size_t value = 0; value < code.values; ++value) {
        for (std::uint8_t k = 0; k <= max_ink_parameter; ++k) lengths[value][k] += bits_of(numbers[value], k);
      }
    }
  }
  for (std::size_t value = 0; value < code.values; ++value) {
    const auto& own = lengths[value];
    code.parameters[value] = static_cast<std::uint8_t>(std::min_element(own.begin(), own.end()) - own.begin());
  }
  return code;
}

void append_ink_code(std::vector<std::byte>& bytes, const InkCode& code) {
  append(bytes, code.steps_per_em);
  append(bytes, static_cast<std::uint8_t>(code.values));
  if (code.steps_per_em == 0) return;
  for (std::size_t value = 0; value < code.values; ++value) append(bytes, code.parameters[value]);
  append(bytes, static_cast<std::uint16_t>(code.usual.size()));
  for (const InkSteps& usual : code.usual) {
    for (std::size_t value = 0; value < code.values; ++value) append(bytes, static_cast<std::uint16_t>(usual[value]));
  }
}

void write_ink(BitWriter& bits, const RankedInk& ink, const InkCode& code) {
  if (code.steps_per_em == 0) {
    const std::array<double, values_per_ink> values = values_of(*ink.ink);
    for (std::size_t value = 0; value < code.values; ++value) bits.write_double(values[value]);
    return;
  }
  const InkSteps steps = steps_of(*ink.ink, code.steps_per_em);
  const std::array<std::uint32_t, values_per_ink> numbers = numbers_of(steps, code.usual_of(ink.kind));
  for (std::size_t value = 0; value < code.values; ++value) write_number(bits, numbers[value], code.parameters[value]);
}

}  // namespace calligraphy
