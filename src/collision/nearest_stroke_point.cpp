#include <calligraphy/collision/nearest_stroke_point.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "binomial.hpp"
#include "several_elements.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t queries_per_block = 64;

/// A box around an element, larger than that of its control points by more than the rounding errors of a distance.
struct ElementBox {
  Point low, high;

  explicit ElementBox(const StrokeElement& element) : low(element.origin()), high(low) {
    if (const auto* const curve = element.curve()) {
      const auto degree = static_cast<std::size_t>(curve->degree);
      for (std::size_t i = 1; i <= degree; ++i) {
        Point control_point = Point::Zero();
        for (std::size_t k = 1; k <= i; ++k) {
          control_point += binomial[i][k] / binomial[degree][k] * curve->coefficients[k - 1];
        }
        include(curve->origin + curve->size * control_point);
      }
    } else {
      include(element.point(1.0));
    }
    const double margin = 1e-12 * (element.size() + element.origin().cwiseAbs().maxCoeff());
    low.array() -= margin;
    high.array() += margin;
  }

  /// Square of the distance, at most that to the element; NaN if it is not finite.
  double squared_distance(const Point& query) const {
    const double x = std::max({low.x() - query.x(), query.x() - high.x(), 0.0});
    const double y = std::max({low.y() - query.y(), query.y() - high.y(), 0.0});
    return x * x + y * y;
  }

 private:
  void include(const Point& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

/// The nearest of several elements to at most `queries_per_block` queries. `Place` is StrokePoint or CharacterPoint.
template <typename Place>
class StrokeBlock {
 public:
  explicit StrokeBlock(const NearestPointOptions& options) : options_(options) {}

  void begin(std::span<const Point> queries, std::span<Place> results) {
    queries_ = queries;
    results_ = results;
    has_answers_ = false;
    size_ = 0.0;
    std::fill(results.begin(), results.end(), Place{.closest = no_point()});
  }

  /// Asks the next element, which is at this place.
  void ask(const StrokeElement& element, Place place) {
    size_ = std::max(size_, element.size());
    if (!std::exchange(has_answers_, true)) {
      nearest_points(element, queries_, found_, options_);
      for (std::size_t i = 0; i < queries_.size(); ++i) write(i, found_[i], place);
      return;
    }
    const std::size_t count = choose(ElementBox(element));
    nearest_points(element, std::span(asked_).first(count), found_, options_);
    for (std::size_t k = 0; k < count; ++k) {
      const NearestPoint& found = found_[k];
      const double gain = results_[index_[k]].closest.distance - found.distance;
      if (gain > distance_tie(size_, found.distance)) write(index_[k], found, place);
    }
  }

 private:
  /// The queries that may be nearer to what is in the box than to the elements before. Returns how many.
  std::size_t choose(const ElementBox& box) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      const double distance = results_[i].closest.distance;
      asked_[count] = queries_[i];
      index_[count] = i;
      const bool is_farther =
          distance > min_square_root && box.squared_distance(queries_[i]) > 1.000001 * distance * distance;
      count += is_farther ? 0 : 1;
    }
    return count;
  }
  void write(std::size_t i, const NearestPoint& found, Place& place) {
    place.closest = found;
    results_[i] = place;
  }

  const NearestPointOptions& options_;
  std::span<const Point> queries_;
  std::span<Place> results_;
  bool has_answers_ = false;
  double size_ = 0.0;  ///< of the largest element that has been asked
  std::array<Point, queries_per_block> asked_;
  std::array<std::size_t, queries_per_block> index_;  ///< of `asked_`, among all queries
  std::array<NearestPoint, queries_per_block> found_;
};

/// `each_element` calls its argument with each element and its place, in writing order.
template <typename Place, typename EachElement>
void answer_in_blocks(const EachElement& each_element, std::span<const Point> queries, std::span<Place> results,
                      const NearestPointOptions& options) {
  const std::size_t count = std::min(queries.size(), results.size());
  StrokeBlock<Place> block(options);
  for (std::size_t first = 0; first < count; first += queries_per_block) {
    const std::size_t size = std::min(queries_per_block, count - first);
    block.begin(queries.subspan(first, size), results.subspan(first, size));
    each_element([&](const StrokeElement& element, const Place& place) { block.ask(element, place); });
  }
}

}  // namespace

void nearest_points(std::span<const StrokeElement> stroke, std::span<const Point> queries,
                    std::span<StrokePoint> results, const NearestPointOptions& options) noexcept {
  const auto each_element = [&](const auto& ask) {
    for (std::size_t i = 0; i < stroke.size(); ++i) ask(stroke[i], {static_cast<int>(i), {}});
  };
  answer_in_blocks(each_element, queries, results, options);
}

void nearest_points(std::span<const std::vector<StrokeElement>> strokes, std::span<const Point> queries,
                    std::span<CharacterPoint> results, const NearestPointOptions& options) noexcept {
  const auto each_element = [&](const auto& ask) {
    for (std::size_t k = 0; k < strokes.size(); ++k) {
      for (std::size_t i = 0; i < strokes[k].size(); ++i) {
        ask(strokes[k][i], {static_cast<int>(k), static_cast<int>(i), {}});
      }
    }
  };
  answer_in_blocks(each_element, queries, results, options);
}

}  // namespace calligraphy
