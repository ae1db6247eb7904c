#include "written_path.hpp"

namespace calligraphy {

void WrittenPath::begin(const Point& tip, double em, double hidden) noexcept {
  points_[0] = points_[1] = chord_from_ = step_from_ = tip;
  count_ = 1;
  arcs_[0] = 0.0;
  apart_ = spacing * em;
  step_ = std::max(apart_, hidden);
  chord_ = chord * em;
  way_ = chords_ = 0.0;
}

void WrittenPath::add_chord() noexcept {
  chords_ += (points_[count_] - chord_from_).norm();
  chord_from_ = points_[count_];
}

/// Keeps the last point.
void WrittenPath::keep() noexcept {
  const Point tip = points_[count_];
  const double step = (tip - step_from_).norm();
  if (step >= step_) {
    way_ += step;
    step_from_ = tip;
  }
  if (count_ == capacity) {
    count_ = capacity / 2;
    apart_ *= 2.0;
    for (std::size_t i = 1; i < count_; ++i) {
      points_[i] = points_[2 * i];
      arcs_[i] = arcs_[i - 1] + (points_[i] - points_[i - 1]).norm();
    }
  }
  points_[count_] = tip;
  arcs_[count_] = arcs_[count_ - 1] + (tip - points_[count_ - 1]).norm();
  points_[++count_] = tip;
}

}  // namespace calligraphy
