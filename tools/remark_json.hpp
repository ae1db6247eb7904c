// A remark on a pen-down in JSON, the same in summary.json and in replay.json.
#pragma once

#include <nlohmann/json.hpp>

#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy::tools {

inline nlohmann::ordered_json remark_json(const StrokeRemark& remark) {
  using Json = nlohmann::ordered_json;
  return {{"kind", calligraphy::to_string(remark.kind)},
          {"pen_down", remark.path >= 0 ? Json(remark.path + 1) : Json()},
          {"stroke", remark.stroke >= 0 ? Json(remark.stroke + 1) : Json()},
          {"reason", remark.reason}};
}

}  // namespace calligraphy::tools
