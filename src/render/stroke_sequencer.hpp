// Follows a writer through the strokes of a page: which stroke is due, what the pen is doing to it, and how far it is.
#pragma once

#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/render/interaction_state.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "pen_state.hpp"
#include "prepared_page.hpp"
#include "shape_fit.hpp"
#include "stroke_capture.hpp"
#include "writer_state.hpp"
#include "written_path.hpp"

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
  /// HapticRenderer::set_due().
  bool set_due(int character, int stroke) noexcept;

  const std::vector<PlacedCharacter>& page() const noexcept { return page_.characters(); }

 private:
  bool all_written() const noexcept { return character_ == nullptr; }
  /// True until the pen is lifted from it. Requires !all_written().
  bool is_character_written() const noexcept { return writer_.stroke == stroke_count(); }
  int stroke_count() const noexcept { return static_cast<int>(character_->strokes.size()); }
  PreparedStroke& stroke(int index) const noexcept { return character_->strokes[static_cast<std::size_t>(index)]; }
  const StrokeStart& start(int index) const noexcept { return character_->starts[static_cast<std::size_t>(index)]; }
  /// The stroke after the due one, while the pen may begin it and so finish the due one; -1 if there is none.
  int next_in_doubt() const noexcept {
    const int next = writer_.stroke + 1;
    return in_doubt_ && next < stroke_count() ? next : -1;
  }

  /// A pen-down, taken for one of the strokes.
  struct Attempt {
    StrokeCapture capture;
    WrittenPath path;
  };
  /// What the shape that the pen has written is looked at for.
  enum class Look {
    none,
    at_end,   ///< the pen is about to finish the stroke
    at_lift,  ///< it has left the paper, but may be bouncing
    decides   ///< it has left the stroke
  };

  TransitionInput advance(const PenState& pen) noexcept;
  void put_down(const Point& tip) noexcept;
  void set_out(const Point& tip) noexcept;
  bool begins(const PenState& pen) noexcept;
  CaptureVerdict try_to_begin(Attempt& attempt, int stroke, const PenState& pen) noexcept;
  bool begins_next(const PenState& pen) noexcept;
  void begin_following(Attempt& attempt, int stroke) noexcept;
  void follow(Attempt& attempt, int stroke, const PenState& pen) noexcept;
  void write_on(const PenState& pen) noexcept;
  bool is_finished(const PenState& pen) noexcept;
  void look_for(Look purpose) noexcept;
  void step_fit() noexcept;

  void start_stroke(const PenState& pen) noexcept;
  void leave_stroke(const PenState& pen) noexcept;
  void decide(const PenState& pen) noexcept;
  void finish_stroke(const Point& tip) noexcept;
  void abandon_stroke(const Point& tip) noexcept;
  void settle_doubt(const PenState& pen) noexcept;
  void confirm_stroke() noexcept;
  void lift() noexcept;
  void activate(int character, int stroke) noexcept;

  WritingPhase phase(const Point& tip) const noexcept;
  WritingPhase phase_before_stroke(const Point& tip) const noexcept;
  Point hand(const PenState& pen) const noexcept;
  bool keeps_hold() const noexcept;
  bool is_guided() const noexcept;

  // First what every tick reads, in few cache lines.
  StrokeOptions stroke_;
  StrokeTolerances tolerances_;
  double box_hysteresis_;      ///< [em]
  bool lift_between_strokes_;  ///< ContactOptions
  bool leads_to_start_;        ///< guidance leads to the start
  bool lets_go_;               ///< guidance lets go of a pen that is astray
  bool in_doubt_ = false;      ///< perhaps the due stroke was written
  bool passed_end_ = false;    ///< the pen was at the end, having written enough
  bool inside_box_ = false;
  Look look_ = Look::none;
  int fit_steps_;         ///< a tick: one at 1 kHz, more at lower rates
  MotionMapping mapping_;
  double hidden_way_;     ///< how far dry friction keeps the pen short of where a usual hand means to be [m, page]
  double hidden_motion_;  ///< smaller ones need not be the hand's [m, page]
  double compliance_;     ///< of a usual grip [m/N, page]
  PreparedCharacter* character_ = nullptr;  ///< the one of `page_` to be written; null once all are
  PreparedStroke* due_ = nullptr;           ///< its stroke that is due; the last once all are written
  Point hand_ = Point::Zero();              ///< where the hand means to be, in the writing state [m, page]
  WriterState writer_;
  double passed_end_at_ = 0.0;          ///< since when `passed_end_` [s]
  double lifted_at_ = 0.0;              ///< since when `in_doubt_` [s]
  Point doubted_down_ = Point::Zero();  ///< where the pen was put down for the stroke in doubt [m, page]
  StrokeStart rest_;                    ///< of it, where the pen left it
  PreparedPage page_;
  // Last what is large and seldom read.
  Attempt attempt_;  ///< to write the due stroke
  Attempt next_;     ///< the same pen-down, were the next one meant
  ShapeFit fit_;
};

}  // namespace calligraphy
