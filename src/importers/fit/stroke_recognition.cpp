#include "stroke_recognition.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <calligraphy/model/typical_stroke.hpp>

#include "simple_stroke.hpp"
#include "stroke_division.hpp"
#include "stroke_piece.hpp"
#include "stroke_rules.hpp"

namespace calligraphy::recognition {
namespace {

/// The path as a compound stroke.
Recognition as_compound(const CompoundRule& rule, const PieceTable& table, std::span<const std::size_t> corners,
                        double length) {
  const std::string_view kinds = typical_stroke(rule.id).elements;
  const auto cost = [&](std::size_t element, std::size_t from, std::size_t to, double before, double) {
    return before + cost_of(rule.elements[element], kinds[element], table.between(from, to), length);
  };
  Recognition recognition{rule.id, {}, 0.0};
  recognition.cost = divide_at_least_cost(rule.elements.size(), table.count(), recognition.splits, cost);
  // Of the strokes that turn this far, only a circle closes.
  if (rule.id == 39) recognition.cost += 0.6 * table.whole().length;
  for (std::size_t& split : recognition.splits) split = corners[split];
  return recognition;
}

}  // namespace

std::vector<Recognition> recognise(const Path& path, std::span<const std::size_t> corners, const CleanPath& clean,
                                   bool brush) {
  const PieceTable table(path, corners);
  const SimpleShape shape = simple_shape(path, table.whole(), clean);
  const int simple = brush ? brush_stroke(shape) : pen_stroke(shape);
  const double simple_price = simple_cost(table.whole(), typical_stroke(simple).elements[0], shape.length);
  std::vector<Recognition> found{{simple, {0, path.size() - 1}, simple_price}};
  for (const CompoundRule& rule : compound_rules()) {
    Recognition compound = as_compound(rule, table, corners, shape.length);
    if (compound.cost < std::numeric_limits<double>::infinity()) found.push_back(std::move(compound));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Recognition& a, const Recognition& b) { return a.cost < b.cost; });
  const int sibling = sibling_of(found[0].id, path, found[0].splits, brush);
  const auto at = std::find_if(found.begin(), found.end(), [&](const Recognition& one) { return one.id == sibling; });
  if (at != found.end()) std::rotate(found.begin(), at, at + 1);
  return found;
}

}  // namespace calligraphy::recognition
