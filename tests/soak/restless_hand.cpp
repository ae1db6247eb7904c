#include "restless_hand.hpp"

#include <algorithm>
#include <cmath>

#include <calligraphy/model/character_list.hpp>

#include "pen_path.hpp"

namespace calligraphy_test {
namespace {

using calligraphy::HapticTick;
using calligraphy::PlacedCharacter;
using Eigen::Vector3d;

constexpr double point_distance = 0.0005;  // [m]
constexpr double raised = 0.01;            // [m]

}  // namespace

std::vector<PlacedCharacter> soak_page(int count) {
  const auto& all = calligraphy::built_in_characters().characters;
  std::vector<PlacedCharacter> page;
  for (int i = 0; i < count; ++i) {
    const int which = i % soak_characters;
    page.push_back({all[static_cast<std::size_t>(which * 5)], {{0.01 + 0.045 * (which % 3), 0.02}, 0.04}});
  }
  return page;
}

RestlessHand::RestlessHand(const calligraphy::HapticRenderer& renderer, std::uint64_t seed)
    : renderer_(renderer), random_(seed) {
  const std::size_t count = std::min<std::size_t>(soak_characters, renderer.page().size());
  for (std::size_t i = 0; i < count; ++i) {
    const PlacedCharacter& placed = renderer.page()[i];
    Drawn drawn{placed.placement.origin, {}};
    for (const Stroke& stroke : calligraphy::strokes(placed.character)) {
      drawn.strokes.push_back(path_of(stroke, placed.placement, point_distance));
    }
    drawn_.push_back(std::move(drawn));
  }
}

/// Selects what to write next, and how.
void RestlessHand::choose(const HapticTick& tick) {
  const auto& strokes = drawn_[static_cast<std::size_t>(tick.character) % drawn_.size()].strokes;
  const std::size_t due = std::min(static_cast<std::size_t>(std::max(0, tick.stroke)), strokes.size() - 1);
  const double kind = random_.next();
  // Out of order at times.
  path_ = &strokes[kind < 0.03 ? static_cast<std::size_t>(random_.next() * static_cast<double>(strokes.size())) : due];
  const double last = static_cast<double>(path_->size() - 1);
  const bool backwards = kind > 0.98;
  way_ = backwards ? last : 0.0;
  end_ = backwards ? 0.0 : last;
  if (kind > 0.95 && !backwards) end_ = last * random_.next();  // lifts before the end
  const double miss = random_.next() < 0.05 ? 0.012 : 0.003;    // at times 30 % of the square
  error_ = random_.point(-miss, miss);
  speed_ = random_.between(0.03, 0.15);
  depth_ = random_.between(0.0005, 0.003);
}

calligraphy::Point RestlessHand::on_stroke(double way) const {
  const double last = static_cast<double>(path_->size() - 1);
  const double at = std::clamp(way, 0.0, last);
  const auto i = static_cast<std::size_t>(at);
  const Point& from = (*path_)[i];
  const Point& to = (*path_)[std::min(i + 1, path_->size() - 1)];
  return from + (at - std::floor(at)) * (to - from) + error_;
}

Vector3d RestlessHand::goal() const {
  if (phase_ == Phase::rest) return place_;
  const Point tip = on_stroke(way_);
  const bool down = phase_ == Phase::lower || phase_ == Phase::write;
  return {tip.x(), tip.y(), down ? -depth_ : raised};
}

calligraphy::Intention RestlessHand::next(const HapticTick& tick, double seconds) {
  if (phase_ == Phase::rest) {
    left_ -= seconds;
    if (left_ <= 0.0) {
      choose(tick);
      phase_ = Phase::approach;
    }
  } else if (phase_ == Phase::write) {
    const double points = speed_ * seconds / point_distance;
    way_ += std::clamp(end_ - way_, -points, points);
    error_ += random_.point(-1.0, 1.0) * 0.002 * std::sqrt(seconds);  // random walk
    if (way_ == end_) phase_ = Phase::raise;
  }
  const Vector3d before = place_;
  const Vector3d way = goal() - place_;
  const double reach = (phase_ == Phase::lower ? 0.1 : 0.25) * seconds;
  const double distance = way.norm();
  place_ += distance > reach ? Vector3d(way * (reach / distance)) : way;
  if (distance <= reach) {
    if (phase_ == Phase::raise) {
      phase_ = Phase::rest;
      left_ = random_.next() < 0.01 ? random_.between(1.0, 20.0) : random_.between(0.02, 0.2);
    } else if (phase_ == Phase::approach) {
      phase_ = Phase::lower;
    } else if (phase_ == Phase::lower) {
      phase_ = Phase::write;
    }
  }
  const auto& mapping = renderer_.mapping();
  return {mapping.to_device(before), mapping.rotation.transpose() * (place_ - before) / (seconds * mapping.scale)};
}

}  // namespace calligraphy_test
