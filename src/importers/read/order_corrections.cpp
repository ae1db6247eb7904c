#include "order_corrections.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string_view>

#include <calligraphy/base/text.hpp>

#include "base/charconv.hpp"
#include "hanzi_writer.hpp"
#include "importers/built_in.hpp"

namespace calligraphy {
namespace {

/// Strokes of a character that are to be written in another order.
struct OrderCorrection {
  std::size_t first = 0;             ///< index of the first of them
  Point start = Point::Zero();       ///< where that begins at the source [unit]
  std::vector<std::size_t> strokes;  ///< their indices in the right order
  std::string reason;
};

/// The text up to a separator, which is taken off with it.
std::string_view taken(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

template <class Number>
Number number_of(std::string_view word) {
  Number value{};
  from_chars(word.data(), word.data() + word.size(), value);
  return value;
}

/// Rows of the character, the number of the first stroke, where that begins, the order and the reason; the first row has
/// the names of the columns.
std::map<char32_t, OrderCorrection> parse_corrections(std::string_view table) {
  std::map<char32_t, OrderCorrection> corrections;
  for (taken(table, '\n'); !table.empty();) {
    std::string_view row = taken(table, '\n');
    OrderCorrection& correction = corrections[decode_utf8(taken(row, '\t')).front()];
    correction.first = number_of<std::size_t>(taken(row, '\t')) - 1;
    std::string_view start = taken(row, '\t'), order = taken(row, '\t');
    const double x = number_of<double>(taken(start, ','));
    correction.start = Point(x, number_of<double>(start));
    while (!order.empty()) correction.strokes.push_back(number_of<std::size_t>(taken(order, ' ')) - 1);
    correction.reason = row;
  }
  return corrections;
}

}  // namespace

std::string correct_order(char32_t code, std::vector<SourceStroke>& strokes) {
  static const std::map<char32_t, OrderCorrection> corrections = parse_corrections(built_in::order_corrections);
  constexpr double same_place = 0.01;  // [em]; at the source another stroke begins farther away
  const auto found = corrections.find(code);
  if (found == corrections.end()) return {};
  const OrderCorrection& correction = found->second;
  if (strokes.size() < correction.first + correction.strokes.size()) return {};
  const Point begins = strokes[correction.first].path.front();
  if ((begins - hanzi_writer_em(correction.start)).norm() > same_place) return {};  // the source was mended
  const std::vector<SourceStroke> drawn = strokes;
  for (std::size_t i = 0; i < correction.strokes.size(); ++i) {
    strokes[correction.first + i] = drawn[correction.strokes[i]];
  }
  return correction.reason;
}

}  // namespace calligraphy
