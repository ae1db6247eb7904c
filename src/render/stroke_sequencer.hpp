// Follows a writer through the strokes of a page: which stroke is due, what the pen is doing to it, and how far it is.
#pragma once

#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/render/interaction_state.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "pen_state.hpp"
#include "prepared_page.hpp"
#include "stroke_capture.hpp"
#include "writer_state.hpp"

namespace calligraphy {

/// update() never allocates, throws or logs.
class StrokeSequencer {
 public:
  /// The page, the options and the mapping must be valid. `lets_go`: GuidanceTraits.
  StrokeSequencer(std::vector<PlacedCharacter> page, const RendererOptions& options, const Capabilities& capabilities,
                  const MotionMapping& mapping, bool lets_go);

  const WriterState& update(const PenState& pen) noexcept;
  /// Starts the page again, with nothing written.
  void restart() noexcept;
  /// HapticRenderer::skip_stroke().
  bool skip() noexcept;

  const std::vector<PlacedCharacter>& page() const noexcept { return page_.characters(); }

 private:
  bool all_written() const noexcept { return character_ == nullptr; }
  /// True until the pen is lifted from it. Requires !all_written().
  bool is_character_written() const noexcept { return writer_.stroke == static_cast<int>(character_->strokes.size()); }

  TransitionInput advance(const PenState& pen) noexcept;
  void put_down(const Point& tip) noexcept;
  void set_out(const Point& tip) noexcept;
  bool begins(const PenState& pen) noexcept;
  void write_on(const PenState& pen) noexcept;
  bool is_finished(bool leaves) const noexcept;

  void start_stroke(const PenState& pen) noexcept;
  void finish_stroke(const Point& tip) noexcept;
  void abandon_stroke(const Point& tip) noexcept;
  void lift() noexcept;
  void activate(int character, int stroke) noexcept;

  WritingPhase phase(const Point& tip) const noexcept;
  WritingPhase phase_before_stroke(const Point& tip) const noexcept;
  Point hand(const PenState& pen) const noexcept;
  bool keeps_hold() const noexcept;
  bool is_guided() const noexcept;

  PreparedPage page_;
  StrokeOptions stroke_;
  StrokeTolerances tolerances_;
  double box_hysteresis_;      ///< [em]
  bool lift_between_strokes_;  ///< ContactOptions
  bool leads_to_start_;        ///< guidance leads to the start
  bool lets_go_;               ///< guidance lets go of a pen that is astray
  MotionMapping mapping_;
  double hidden_way_;  ///< how far dry friction keeps the pen short of where a usual hand means to be [m, page]
  double compliance_;  ///< of a usual grip [m/N, page]
  PreparedCharacter* character_ = nullptr;  ///< the one of `page_` to be written; null once all are
  PreparedStroke* due_ = nullptr;           ///< its stroke that is due; the last once all are written
  Point hand_ = Point::Zero();              ///< where the hand means to be, in the writing state [m, page]
  StrokeCapture capture_;
  bool inside_box_ = false;
  WriterState writer_;
};

}  // namespace calligraphy
