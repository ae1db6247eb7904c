// Which way the y axis points, told from how people write.
#include <algorithm>
#include <optional>
#include <vector>

#include <calligraphy/judge/y_axis.hpp>
#include <calligraphy/model/character_list.hpp>

#include "pen_traces.hpp"

namespace y_axis_tests {

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

const std::vector<PenTrace>& built_in_traces() {
  static const std::vector<PenTrace> traces = [] {
    std::vector<PenTrace> all;
    for (const Character& each : built_in_characters().characters) all.push_back(trace_of(each.code, copy_of(each)));
    return all;
  }();
  return traces;
}

PenTrace trace_named(char32_t code) {
  const auto& all = built_in_traces();
  return *std::find_if(all.begin(), all.end(), [code](const PenTrace& each) { return each.character == code; });
}

std::vector<PenTrace> turned(std::vector<PenTrace> traces) {
  std::for_each(traces.begin(), traces.end(), turn_over);
  return traces;
}

}  // namespace

TEST_CASE("several characters tell which way y points, and one heng does not", "[judge]") {
  CHECK(recognise_y_axis(built_in_traces()) == YAxis::down);
  CHECK(recognise_y_axis(turned(built_in_traces())) == YAxis::up);
  const std::vector<PenTrace> heng = {trace_of(U'一', {{Point(0.1, 0.5), Point(0.9, 0.55)}})};
  CHECK_FALSE(recognise_y_axis(heng));
  CHECK_FALSE(recognise_y_axis({}));
}

TEST_CASE("a page turned by a quarter, upside down, strokes backwards or in reverse order are no y axis that points up", "[judge]") {
  const auto changed = [](auto change) {
    std::vector<PenTrace> traces = built_in_traces();
    for (PenTrace& trace : traces) change(trace);
    return traces;
  };
  const auto backwards = [](PenTrace& trace) {
    for (PenStroke& stroke : trace.strokes) std::reverse(stroke.begin(), stroke.end());
  };
  const auto in_reverse = [](PenTrace& trace) { std::reverse(trace.strokes.begin(), trace.strokes.end()); };
  const auto upside_down = [](PenTrace& trace) {
    turn_over(trace);
    for (PenStroke& stroke : trace.strokes) {
      for (TimedPoint& point : stroke) point.point.x() = 1.0 - point.point.x();
    }
  };
  const auto turned_by_a_quarter = [](PenTrace& trace) {
    for (PenStroke& stroke : trace.strokes) {
      for (TimedPoint& point : stroke) point.point = Point(1.0 - point.point.y(), point.point.x());
    }
  };
  CHECK_FALSE(recognise_y_axis(changed(turned_by_a_quarter)));  // counterclockwise: strokes go up and to the right
  CHECK_FALSE(recognise_y_axis(turned(changed(turned_by_a_quarter))));
  CHECK_FALSE(recognise_y_axis(changed(backwards)));
  CHECK_FALSE(recognise_y_axis(changed(in_reverse)));
  CHECK_FALSE(recognise_y_axis(changed(upside_down)));
}

TEST_CASE("forty pupils who write one character backwards say no more than one", "[judge]") {
  const PenTrace ten = trace_named(U'十');
  CHECK_FALSE(recognise_y_axis(turned(std::vector<PenTrace>(40, ten))));
}

TEST_CASE("people's traces are claimed to be turned over only where they are", "[judge]") {
  const std::vector<PenTrace> people = traces_of_people();
  for (const std::size_t size : {1, 3, 10}) {
    for (std::size_t i = 0; i + size <= people.size(); ++i) {
      const std::vector<PenTrace> file(people.begin() + static_cast<std::ptrdiff_t>(i),
                                       people.begin() + static_cast<std::ptrdiff_t>(i + size));
      const std::optional<YAxis> as_written = recognise_y_axis(file), mirrored = recognise_y_axis(turned(file));
      CHECK(as_written != YAxis::up);
      CHECK(mirrored != YAxis::down);
      if (size == 10) CHECK((as_written == YAxis::down && mirrored == YAxis::up));
    }
  }
}

}  // namespace y_axis_tests
