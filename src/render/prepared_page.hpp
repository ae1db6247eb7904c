// A page with what the servo loop needs to know about its characters, worked out in advance.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "stroke_capture.hpp"
#include "stroke_follower.hpp"
#include "stroke_shape.hpp"

namespace calligraphy {

/// A stroke with its own progress, which starts again with each attempt.
struct PreparedStroke {
  ActiveStroke geometry;
  StrokeFollower follower;
  StrokeShape shape;
};

struct PreparedCharacter {
  double em = 0.0;  ///< [m]
  std::vector<PreparedStroke> strokes;
  std::vector<StrokeStart> starts;
  Eigen::AlignedBox2d box;  ///< including the margin [m]
};

class PreparedPage {
 public:
  /// The characters and the options must be valid.
  PreparedPage(std::vector<PlacedCharacter> characters, const RendererOptions& options);

  PreparedPage(PreparedPage&&) noexcept = default;
  PreparedPage& operator=(PreparedPage&&) noexcept = default;

  int size() const noexcept { return static_cast<int>(prepared_.size()); }
  const PreparedCharacter& operator[](int index) const noexcept { return prepared_[static_cast<std::size_t>(index)]; }
  PreparedCharacter& operator[](int index) noexcept { return prepared_[static_cast<std::size_t>(index)]; }
  const std::vector<PlacedCharacter>& characters() const noexcept { return characters_; }

 private:
  std::vector<PlacedCharacter> characters_;
  std::vector<PreparedCharacter> prepared_;
};

}  // namespace calligraphy
