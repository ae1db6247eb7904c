#include "stroke_recognition.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <calligraphy/model/typical_stroke.hpp>

#include "simple_stroke.hpp"
#include "stroke_piece.hpp"
#include "stroke_rules.hpp"

namespace calligraphy::recognition {
namespace {

constexpr double impossible = std::numeric_limits<double>::infinity();

struct Choice {
  double cost = impossible;
  std::vector<std::size_t> corners;
};

/// Minimum-cost division of the path into the elements of a compound stroke, by dynamic programming over the corners.
Choice divide(const CompoundRule& rule, std::string_view kinds, const PieceTable& table, double length) {
  const std::size_t corners = table.count();
  const std::size_t elements = rule.elements.size();
  if (corners <= elements) return {};
  std::vector<double> cost((elements + 1) * corners, impossible);
  std::vector<std::size_t> previous((elements + 1) * corners, 0);
  cost[0] = 0.0;
  for (std::size_t element = 0; element < elements; ++element) {
    for (std::size_t from = element; from + 1 < corners; ++from) {
      const double before = cost[element * corners + from];
      if (before == impossible) continue;
      const std::size_t first_end = element + 1 == elements ? corners - 1 : from + 1;
      for (std::size_t to = first_end; to < corners; ++to) {
        const double total = before + cost_of(rule.elements[element], kinds[element], table.between(from, to), length);
        if (total >= cost[(element + 1) * corners + to]) continue;
        cost[(element + 1) * corners + to] = total;
        previous[(element + 1) * corners + to] = from;
      }
    }
  }
  Choice choice;
  choice.cost = cost[elements * corners + corners - 1];
  choice.corners.assign(elements + 1, corners - 1);
  for (std::size_t element = elements; element > 0; --element) {
    choice.corners[element - 1] = previous[element * corners + choice.corners[element]];
  }
  return choice;
}

/// The path as a compound stroke.
Recognition as_compound(const CompoundRule& rule, const PieceTable& table, std::span<const std::size_t> corners,
                        double length) {
  const Choice choice = divide(rule, typical_stroke(rule.id).elements, table, length);
  Recognition recognition{rule.id, {}, choice.cost};
  // Of the strokes that turn this far, only a circle closes.
  if (rule.id == 39) recognition.cost += 0.6 * table.whole().length;
  for (const std::size_t corner : choice.corners) recognition.splits.push_back(corners[corner]);
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
    if (compound.cost < impossible) found.push_back(std::move(compound));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Recognition& a, const Recognition& b) { return a.cost < b.cost; });
  const int sibling = sibling_of(found[0].id, path, found[0].splits, brush);
  const auto at = std::find_if(found.begin(), found.end(), [&](const Recognition& one) { return one.id == sibling; });
  if (at != found.end()) std::rotate(found.begin(), at, at + 1);
  return found;
}

}  // namespace calligraphy::recognition
