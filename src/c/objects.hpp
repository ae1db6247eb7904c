// What the handles of the C interface stand for.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/pointer_device.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/practice/lesson.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/pointer_lesson.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "handles.hpp"

namespace calligraphy::c {

/// A device of one of three kinds.
struct DeviceObject {
  std::unique_ptr<HapticDevice> device;
  double scale = 1.0;  ///< of the mapping of a pointer device

  /// The force at work [N].
  const Eigen::Vector3d& force() const noexcept;
};

/// Where a stroke begins, and in which direction [page].
struct Beginning {
  Point start = Point::Zero();
  Point direction = Point::Zero();
};

/// A renderer, and what its ticks say beyond HapticTick. @throws ValueError as HapticRenderer
struct RendererObject {
  RendererObject(const PracticePage& page, const MotionMapping& mapping, const Capabilities& capabilities,
                 const RendererOptions& options);

  HapticRenderer renderer;
  std::string clipped;             ///< one line per value
  std::vector<Beginning> starts;   ///< of all strokes, and none after the last one of each character
  std::vector<std::size_t> first;  ///< by character: of its first stroke in `starts`; one more once all are written

  /// Start of the stroke that is due in a tick; zero if there is none.
  const Beginning& next(const HapticTick& tick) const noexcept {
    return starts[first[static_cast<std::size_t>(tick.character)] + static_cast<std::size_t>(tick.stroke)];
  }
};

/// A servo, and what it uses. @throws ValueError as Servo
struct ServoObject {
  ServoObject(std::shared_ptr<DeviceObject> of, std::shared_ptr<RendererObject> law);
  /// The device keeps no force of it.
  ~ServoObject() { device->device->write(Eigen::Vector3d::Zero()); }
  ServoObject(const ServoObject&) = delete;
  ServoObject& operator=(const ServoObject&) = delete;

  std::shared_ptr<DeviceObject> device;
  std::shared_ptr<RendererObject> renderer;
  bool has_updated = false;  ///< the renderer, since this was cleared
  Servo servo;
};

/// A recording, and its page.
struct RecordingObject {
  std::shared_ptr<PracticePage> page;
  Recording recording;
};

/// The stroke that the last call of a guidance law's begin() named.
struct StrokeObject {
  const ActiveStroke* stroke = nullptr;  ///< of the law's renderer
};

/// A match, and what its remarks say, each once it was asked for.
struct MatchObject {
  explicit MatchObject(MatchResult of) : result(std::move(of)) {}

  const MatchResult result;
  std::mutex mutex;                                                   ///< guards `texts`
  std::map<std::pair<std::int32_t, std::string>, std::string> texts;  ///< by remark and language
};

/// Pen traces, and the text last made of them.
struct TracesObject {
  std::vector<PenTrace> traces;
  std::vector<PenStroke> PenTrace::*begun = nullptr;  ///< which of the last trace's lists was added to last, if any
  double last_time = 0.0;  ///< of the last sample of the last trace [s]
  std::string text;
};

/// A score by character, and what the remarks of a lesson say, each once it was asked for.
struct ScoreObject {
  std::vector<CharacterScore> characters;
  std::vector<LessonScore> lessons;  ///< empty: it is not of a lesson
  bool has_hand = false;
  std::mutex mutex;                                                       ///< guards `texts`
  std::map<std::tuple<std::int32_t, std::int32_t, std::string>, std::string> texts;  ///< by character, remark, language
};

/// A lesson, either for a device of the caller's or with one that follows a pointer.
struct LessonObject {
  Capabilities device;
  double scale = 1.0;  ///< of the mapping
  std::optional<Lesson> own;
  std::optional<PointerLesson> pointer;
  LessonView view;   ///< as of the last look
  std::string text;  ///< of the last hint

  Lesson& lesson() noexcept { return pointer ? pointer->lesson() : *own; }
};

template <>
inline constexpr Kind kind_of<CharacterSet> = Kind::set;
template <>
inline constexpr Kind kind_of<PracticePage> = Kind::page;
template <>
inline constexpr Kind kind_of<DeviceObject> = Kind::device;
template <>
inline constexpr Kind kind_of<RendererObject> = Kind::renderer;
template <>
inline constexpr Kind kind_of<ServoObject> = Kind::servo;
template <>
inline constexpr Kind kind_of<MatchObject> = Kind::match;
template <>
inline constexpr Kind kind_of<RecordingObject> = Kind::recording;
template <>
inline constexpr Kind kind_of<ScoreObject> = Kind::score;
template <>
inline constexpr Kind kind_of<LessonObject> = Kind::lesson;
template <>
inline constexpr Kind kind_of<StrokeObject> = Kind::stroke;
template <>
inline constexpr Kind kind_of<CharacterIndex> = Kind::index;
template <>
inline constexpr Kind kind_of<TracesObject> = Kind::traces;

/// A character of a set in its standard order. @throws Refusal if the set does not have it, FormatError if it is
/// damaged
Character find_character(const CharacterSet& set, char32_t code);

/// A lesson with a device that follows a pointer. @throws Refusal
PointerLesson& pointer_lesson(const calligraphy_lesson* lesson);

/// Where a stroke begins. The direction of a point is zero.
Beginning start_of(const Stroke& stroke, const Placement& placement);

}  // namespace calligraphy::c
