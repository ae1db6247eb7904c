#include "writing_order.hpp"

#include <algorithm>
#include <cstddef>

#include "longest_rise.hpp"

namespace calligraphy {
namespace {

/// Pen-downs that wrote something, without the second parts of broken strokes.
std::vector<int> written_paths(std::span<const DrawnStroke> drawn) {
  std::vector<int> paths;
  for (std::size_t path = 0; path < drawn.size(); ++path) {
    if (drawn[path].stroke >= 0 && !drawn[path].continues) paths.push_back(static_cast<int>(path));
  }
  return paths;
}

}  // namespace

std::vector<Exchange> find_exchanges(std::span<const DrawnStroke> drawn) {
  const std::vector<int> paths = written_paths(drawn);
  const auto stroke = [&](std::size_t place) { return drawn[static_cast<std::size_t>(paths[place])].stroke; };
  std::vector<Exchange> exchanges;
  for (std::size_t first = 0; first + 2 < paths.size(); ++first) {
    for (std::size_t last = first + 2; last < paths.size(); ++last) {
      bool is_exchange = true;
      for (std::size_t place = 0; place < paths.size() && is_exchange; ++place) {
        if (place < first) is_exchange = stroke(place) < stroke(last);
        if (first < place && place < last) {
          is_exchange = stroke(last) < stroke(place) && stroke(place) < stroke(first);
        }
        if (place > last) is_exchange = stroke(place) > stroke(first);
      }
      if (is_exchange) exchanges.push_back({paths[first], paths[last]});
    }
  }
  return exchanges;
}

void find_in_turn(std::span<DrawnStroke> drawn) {
  std::vector<bool> has_changed(drawn.size(), false);
  for (const Exchange& exchange : find_exchanges(drawn)) {
    has_changed[static_cast<std::size_t>(exchange.path)] = true;
    has_changed[static_cast<std::size_t>(exchange.other_path)] = true;
  }
  std::vector<DrawnStroke*> others;
  std::vector<std::size_t> strokes;
  for (const int path : written_paths(drawn)) {
    DrawnStroke& each = drawn[static_cast<std::size_t>(path)];
    each.in_turn = false;
    if (has_changed[static_cast<std::size_t>(path)]) continue;
    others.push_back(&each);
    strokes.push_back(static_cast<std::size_t>(each.stroke));
  }
  for (const std::size_t place : longest_rise(strokes)) others[place]->in_turn = true;
}

}  // namespace calligraphy
