#include "writing_order.hpp"

#include <algorithm>

namespace calligraphy {
namespace {

class OrderFinder {
 public:
  explicit OrderFinder(std::span<const DrawnStroke> drawn) : drawn_(drawn) {
    for (std::size_t path = 0; path < drawn.size(); ++path) {
      if (drawn[path].stroke < 0 || drawn[path].continues) continue;
      paths_.push_back(static_cast<int>(path));
      strokes_.push_back(static_cast<std::size_t>(drawn[path].stroke));
    }
  }

  WritingOrder run() const {
    if (strokes_.size() > 2 && std::is_sorted(strokes_.rbegin(), strokes_.rend())) return reversed_order();
    WritingOrder shortest = order_with(separate_exchanges());
    WritingOrder other = order_with(all_exchanges());
    const bool is_shorter =
        other.exchanges.size() + other.moved.size() < shortest.exchanges.size() + shortest.moved.size();
    return is_shorter && out_of_turn(other) <= out_of_turn(shortest) ? other : shortest;
  }

 private:
  /// Places in the order of writing.
  struct Places {
    std::size_t first, last;
  };

  WritingOrder reversed_order() const {
    const int first = static_cast<int>(strokes_.back()), last = static_cast<int>(strokes_.front());
    const int count = last - first + drawn_[static_cast<std::size_t>(paths_.front())].stroke_count;
    return {{}, {{paths_.front(), paths_[paths_.size() - 2], first, count}}, true};
  }

  std::size_t out_of_turn(const WritingOrder& order) const {
    return static_cast<std::size_t>(std::count_if(paths_.begin(), paths_.end(), [&](int path) {
      return order.has_changed_places(path) || order.has_moved(path);
    }));
  }

  /// Pairs such that all that was written between the two belongs between them, and the rest before or after.
  std::vector<Places> separate_exchanges() const {
    std::vector<Places> exchanges;
    for (std::size_t first = 0; first + 2 < strokes_.size(); ++first) {
      for (std::size_t last = first + 2; last < strokes_.size(); ++last) {
        const std::size_t early = strokes_[first], late = strokes_[last];
        bool is_exchange = true;
        for (std::size_t place = 0; place < strokes_.size() && is_exchange; ++place) {
          const std::size_t stroke = strokes_[place];
          if (place < first) is_exchange = stroke < late;
          if (first < place && place < last) is_exchange = late < stroke && stroke < early;
          if (place > last) is_exchange = stroke > early;
        }
        if (is_exchange) exchanges.push_back({first, last});
      }
    }
    return exchanges;
  }

  /// Pairs each of which stands where the other belongs.
  std::vector<Places> all_exchanges() const {
    std::vector<std::size_t> sorted = strokes_;
    std::sort(sorted.begin(), sorted.end());
    std::vector<Places> exchanges;
    for (std::size_t first = 0; first < strokes_.size(); ++first) {
      for (std::size_t last = first + 2; last < strokes_.size(); ++last) {
        if (strokes_[first] == sorted[last] && strokes_[last] == sorted[first]) exchanges.push_back({first, last});
      }
    }
    return exchanges;
  }

  WritingOrder order_with(const std::vector<Places>& exchanges) const {
    WritingOrder order;
    std::vector<bool> is_settled(strokes_.size(), false);
    for (const Places& exchange : exchanges) {
      order.exchanges.push_back({paths_[exchange.first], paths_[exchange.last]});
      is_settled[exchange.first] = is_settled[exchange.last] = true;
    }
    std::vector<std::size_t> places, strokes;
    for (std::size_t place = 0; place < strokes_.size(); ++place) {
      if (is_settled[place]) continue;
      places.push_back(place);
      strokes.push_back(strokes_[place]);
    }
    for (const std::size_t i : longest_rise(strokes)) is_settled[places[i]] = true;
    for (std::size_t place = 0; place < strokes_.size(); ++place) {
      if (is_settled[place]) continue;
      const int path = paths_[place], stroke = static_cast<int>(strokes_[place]);
      const int count = drawn_[static_cast<std::size_t>(path)].stroke_count;
      const bool goes_on = !order.moved.empty() && order.moved.back().last_path == paths_[place - 1] &&
                           stroke == order.moved.back().stroke + order.moved.back().stroke_count;
      if (goes_on) {
        order.moved.back().last_path = path;
        order.moved.back().stroke_count += count;
      } else {
        order.moved.push_back({path, path, stroke, count});
      }
    }
    return order;
  }

  std::span<const DrawnStroke> drawn_;
  std::vector<int> paths_;            ///< pen-downs that wrote strokes, without second parts of broken ones
  std::vector<std::size_t> strokes_;  ///< the strokes that they wrote
};

}  // namespace

bool WritingOrder::has_changed_places(int path) const {
  return std::any_of(exchanges.begin(), exchanges.end(),
                     [path](const Exchange& exchange) { return path == exchange.path || path == exchange.other_path; });
}

bool WritingOrder::has_moved(int path) const {
  return std::any_of(moved.begin(), moved.end(),
                     [path](const MovedStrokes& each) { return each.path <= path && path <= each.last_path; });
}

std::vector<std::size_t> longest_rise(std::span<const std::size_t> numbers) {
  std::vector<std::size_t> lasts;   // the least number that ends a series of each length
  std::vector<std::size_t> length;  // length of the longest series that ends with each number
  for (const std::size_t number : numbers) {
    const auto at = std::lower_bound(lasts.begin(), lasts.end(), number);
    length.push_back(static_cast<std::size_t>(at - lasts.begin()) + 1);
    if (at == lasts.end()) {
      lasts.push_back(number);
    } else {
      *at = number;
    }
  }
  std::vector<std::size_t> places(lasts.size());
  std::size_t wanted = lasts.size();
  for (std::size_t i = numbers.size(); i-- > 0 && wanted > 0;) {
    // Among the earlier ones that end a series one shorter, the last is the least.
    if (length[i] == wanted) places[--wanted] = i;
  }
  return places;
}

WritingOrder find_order(std::span<const DrawnStroke> drawn) { return OrderFinder(drawn).run(); }

void set_in_turn(std::span<DrawnStroke> drawn) {
  const WritingOrder order = find_order(drawn);
  for (std::size_t path = 0; path < drawn.size(); ++path) {
    const auto index = static_cast<int>(path);
    const bool counts = drawn[path].stroke >= 0 && !drawn[path].continues;
    drawn[path].in_turn = !counts || (!order.has_changed_places(index) && !order.has_moved(index));
  }
}

}  // namespace calligraphy
