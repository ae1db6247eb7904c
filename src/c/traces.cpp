#include <algorithm>
#include <string>
#include <utility>

#include "base/stylus_fields.hpp"
#include "judge/pens/sample_fault.hpp"
#include "conversions.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

/// The list of a trace for a calligraphy_pen_place. @throws Refusal if there is no such value
std::vector<PenStroke> PenTrace::*list_of(std::int32_t place) {
  return enumeration("place", place, CALLIGRAPHY_PEN_IN_AIR) == CALLIGRAPHY_PEN_DOWN ? &PenTrace::strokes
                                                                                     : &PenTrace::air;
}

/// Of the last sample of a trace [s].
double last_time(const PenTrace& trace) {
  double last = 0.0;
  for (const auto* strokes : {&trace.strokes, &trace.air}) {
    for (const PenStroke& stroke : *strokes) {
      if (!stroke.empty()) last = std::max(last, stroke.back().time);
    }
  }
  return last;
}

}  // namespace
}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_traces_create(calligraphy_traces** traces) {
  return guarded([&] {
    target(traces, "traces");
    hand_out(traces, std::make_shared<TracesObject>());
  });
}

calligraphy_status calligraphy_traces_from_memory(const void* bytes, size_t size, const char* name,
                                                  calligraphy_traces** traces) {
  return guarded([&] {
    target(traces, "traces");
    if (!bytes) throw_null("bytes");
    auto made = std::make_shared<TracesObject>();
    made->traces = parse_pen_traces({static_cast<const char*>(bytes), size}, name ? name : "memory");
    if (!made->traces.empty()) made->last_time = last_time(made->traces.back());
    hand_out(traces, std::move(made));
  });
}

calligraphy_status calligraphy_traces_begin(calligraphy_traces* traces, uint32_t code, const char* set, double em) {
  return guarded([&] {
    auto& into = object<TracesObject>(traces);
    PenTrace trace;
    trace.character = code;
    trace.set = &target(set, "set");
    set_if_given(trace.em, em, "em", "1");
    into.traces.push_back(std::move(trace));
    into.begun = nullptr;
    into.last_time = 0.0;
  });
}

calligraphy_status calligraphy_traces_begin_path(calligraphy_traces* traces, int32_t place) {
  return guarded([&] {
    auto& into = object<TracesObject>(traces);
    const auto list = list_of(place);
    if (into.traces.empty()) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "no trace was begun");
    PenTrace& trace = into.traces.back();
    if (list == &PenTrace::strokes) {
      trace.strokes.emplace_back();
      if (!trace.air.empty()) trace.air.emplace_back();
    } else {
      trace.air.resize(trace.strokes.size() + 1);
      if (!trace.air.back().empty()) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "the pen is in the air twice in a row");
    }
    into.begun = list;
  });
}

calligraphy_status calligraphy_traces_add(calligraphy_traces* traces, double x, double y, double time,
                                          const calligraphy_stylus* stylus, int32_t buttons) {
  return guarded([&] {
    auto& into = object<TracesObject>(traces);
    TimedPoint point{{x, y}, time, {}, buttons};
    if (const calligraphy_status status = read_stylus(stylus, point.stylus)) throw_refused(status);
    if (!into.begun) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "no pen-down and no time in the air was begun");
    const std::string fault = sample_fault(point, into.last_time);
    if (!fault.empty()) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "the sample " + fault);
    into.last_time = point.time;
    (into.traces.back().*into.begun).back().push_back(point);
  });
}

calligraphy_status calligraphy_traces_text(calligraphy_traces* traces, const char* notice, const char** text) {
  return guarded([&] {
    auto& from = object<TracesObject>(traces);
    target(text, "text");
    from.text = pen_traces_text(from.traces, notice ? notice : "");
    *text = from.text.c_str();
  });
}

calligraphy_status calligraphy_traces_count(const calligraphy_traces* traces, int32_t* count) {
  return guarded(
      [&] { target(count, "count") = static_cast<std::int32_t>(object<TracesObject>(traces).traces.size()); });
}

calligraphy_status calligraphy_traces_read_info(const calligraphy_traces* traces, int32_t trace,
                                                calligraphy_trace_info* info) {
  return guarded([&] {
    const PenTrace& found = item("trace", object<TracesObject>(traces).traces, trace);
    write_struct(info, "calligraphy_trace_info",
                 {.size = 0,
                  .code = found.character,
                  .path_count = static_cast<std::int32_t>(found.strokes.size()),
                  .has_air = !found.air.empty(),
                  .set = found.set.c_str(),
                  .em = found.em});
  });
}

calligraphy_status calligraphy_traces_read_path(const calligraphy_traces* traces, int32_t trace, int32_t place,
                                                int32_t path, double* samples, int32_t* buttons, size_t capacity,
                                                size_t* count) {
  return guarded([&] {
    const PenTrace& found = item("trace", object<TracesObject>(traces).traces, trace);
    const PenStroke& points = item("path", found.*list_of(place), path);
    target(count, "count") = points.size();
    if (!samples && !buttons) return;
    if (capacity < points.size()) {
      throw Refusal(CALLIGRAPHY_TOO_SMALL, "capacity = " + std::to_string(capacity) + ", but the path has " +
                                               std::to_string(points.size()) + " samples");
    }
    for (const TimedPoint& point : points) {
      if (buttons) *buttons++ = point.buttons;
      if (!samples) continue;
      for (const double value : {point.point.x(), point.point.y(), point.time}) *samples++ = value;
      for (const StylusField& field : stylus_fields) *samples++ = point.stylus.*field.member;
    }
  });
}
