#include <calligraphy/judge/stroke_remark.hpp>

#include <array>
#include <cstddef>

namespace calligraphy {

const char* to_string(WritingDirection direction) noexcept {
  constexpr std::array names = {"forwards", "backwards", "neither", "unknown"};
  return names[static_cast<std::size_t>(direction)];
}

const char* to_string(StrokeRemarkKind kind) noexcept {
  constexpr std::array names = {"order",       "direction", "shape",    "joined",     "broken",
                                "missing",     "extra",     "character", "lookalike", "unreadable",
                                "orientation", "several",   "parts",    "crossing",   "no crossing",
                                "gap",         "overlap",   "side",     "straight",   "bent",
                                "wavy",        "hook",      "place",    "length",     "proportion"};
  return names[static_cast<std::size_t>(kind)];
}

const char* to_string(WritingOrientation orientation) noexcept {
  constexpr std::array names = {"upright",     "mirrored",     "upside down",   "half turned",
                                "turned left", "turned right", "mirrored left", "mirrored right"};
  return names[static_cast<std::size_t>(orientation)];
}

const char* to_string(StrokeEnd end) noexcept {
  constexpr std::array names = {"none", "start", "end"};
  return names[static_cast<std::size_t>(end)];
}

}  // namespace calligraphy
