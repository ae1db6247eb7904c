// Lessons through the C interface.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <calligraphy/practice/pointer_lesson.hpp>

#include "../catch.hpp"
#include "c_interface.hpp"

namespace lesson_tests_in_c {

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

struct Written {
  Owned<calligraphy_page> page;
  Owned<calligraphy_lesson> lesson_handle;
  calligraphy_lesson* lesson = nullptr;
  double time = 0.0;

  explicit Written(const char* text) : page(page_of(text)) {
    const calligraphy_capabilities device = profile("ideal");
    auto held = sized<calligraphy_lesson_options>();
    held.has_strength = 1;
    held.strength = 0.5;
    REQUIRE(calligraphy_lesson_create_for_pointer(page.get(), &device, nullptr, &held, &lesson) == CALLIGRAPHY_OK);
    lesson_handle.reset(lesson);
  }

  void event(double x, double y, bool is_down) {
    auto sample = sized<calligraphy_pointer_sample>();
    sample.time = time += 0.008;
    sample.place[0] = x;
    sample.place[1] = y;
    sample.is_down = is_down;
    CHECK(calligraphy_lesson_move_pointer(lesson, &sample, nullptr) == CALLIGRAPHY_OK);
  }

  void write(std::int32_t stroke, bool backwards = false) {
    std::size_t count = 0;
    CHECK(calligraphy_page_polyline(page.get(), 0, stroke, CALLIGRAPHY_PATH, 1e-5, nullptr, 0, &count) == CALLIGRAPHY_OK);
    std::vector<double> line(2 * count);
    CHECK(calligraphy_page_polyline(page.get(), 0, stroke, CALLIGRAPHY_PATH, 1e-5, line.data(), count, &count) ==
          CALLIGRAPHY_OK);
    for (int i = 0; i <= 60; ++i) {  // evenly along the points, from one end to the other
      const double share = (backwards ? 60 - i : i) / 60.0 * static_cast<double>(count - 1);
      const auto k = std::min(static_cast<std::size_t>(share), count - 2);
      const double part = share - static_cast<double>(k);
      const double x = line[2 * k] + part * (line[2 * k + 2] - line[2 * k]);
      const double y = line[2 * k + 1] + part * (line[2 * k + 3] - line[2 * k + 1]);
      if (i == 0) event(x, y, false);
      event(x, y, true);
      if (i == 60) event(x, y, false);
    }
    CHECK(calligraphy_lesson_advance(lesson, time += 0.5, nullptr) == CALLIGRAPHY_OK);
  }

  std::string events() const {
    auto view = sized<calligraphy_lesson_view>();
    CHECK(calligraphy_lesson_look(lesson, &view) == CALLIGRAPHY_OK);
    auto event = sized<calligraphy_lesson_event>();
    std::string text;
    std::int32_t found = 0;
    while (calligraphy_lesson_take_event(lesson, &event, &found) == CALLIGRAPHY_OK && found) {
      text += std::to_string(event.kind) + " ";
    }
    return text;
  }

  std::vector<double> numbers() const {
    std::size_t count = 0;
    CHECK(calligraphy_lesson_writing(lesson, nullptr, 0, &count) == CALLIGRAPHY_OK);
    std::vector<double> result(count);
    CHECK(calligraphy_lesson_writing(lesson, result.data(), count, &count) == CALLIGRAPHY_OK);
    return result;
  }
};

}  // namespace

TEST_CASE("a lesson is written, told and scored through C") {
  Written written("三");
  written.write(0, true);
  CHECK(written.events() == "9 2 ");
  const char* words = nullptr;
  CHECK(calligraphy_lesson_hint_text(written.lesson, "en", &words) == CALLIGRAPHY_OK);
  CHECK(std::string(words) == "backwards: the stroke begins here");
  written.write(0);
  written.write(1);
  CHECK(calligraphy_lesson_send(written.lesson, CALLIGRAPHY_LESSON_SKIP) == CALLIGRAPHY_OK);
  CHECK(calligraphy_lesson_advance(written.lesson, written.time + 0.1, nullptr) == CALLIGRAPHY_OK);
  CHECK(written.events() == "0 1 0 1 6 10 ");
  auto view = sized<calligraphy_lesson_view>();
  CHECK(calligraphy_lesson_look(written.lesson, &view) == CALLIGRAPHY_OK);
  CHECK(view.accepted == 2);
  CHECK(view.skipped == 1);
  CHECK(view.ink_count == 3);
  auto ink = sized<calligraphy_lesson_ink>();
  CHECK(calligraphy_lesson_read_ink(written.lesson, 0, &ink) == CALLIGRAPHY_OK);
  CHECK(ink.fate == CALLIGRAPHY_FATE_REFUSED);
  std::vector<double> points(6 * 16);
  std::size_t count = 0;
  CHECK(calligraphy_lesson_ink_points(written.lesson, ink.begin, points.data(), 16, &count) == CALLIGRAPHY_OK);
  CHECK(count == 16);
  CHECK(std::isfinite(points[2]));

  const std::vector<double> numbers = written.numbers();
  calligraphy_score* score = nullptr;
  CHECK(calligraphy_score_writing(written.page.get(), numbers.data(), numbers.size(), CALLIGRAPHY_TOLERANCE_NORMAL, &score) ==
        CALLIGRAPHY_OK);
  auto lesson = sized<calligraphy_lesson_score>();
  CHECK(calligraphy_score_lesson(score, 0, &lesson) == CALLIGRAPHY_OK);
  CHECK(lesson.right_at_once == 1);
  CHECK(lesson.has_hand == 1);
  CHECK(lesson.guided_error >= 0.0);
  std::string said;
  auto remark = sized<calligraphy_lesson_remark>();
  std::int32_t strokes[4] = {-1, -1, -1, -1};
  for (std::int32_t i = 0; i < lesson.remark_count; ++i) {
    CHECK(calligraphy_score_lesson_remark(score, 0, i, &remark, strokes, 4) == CALLIGRAPHY_OK);
    CHECK(calligraphy_score_lesson_remark_text(score, 0, i, nullptr, &words) == CALLIGRAPHY_OK);
    said += std::string(words) + " ";
  }
  CHECK(said == "Stroke 3 was skipped. Stroke 1: 1 try backwards. ");
  CHECK(strokes[0] == 0);
  CHECK(calligraphy_free(score) == CALLIGRAPHY_OK);
}

TEST_CASE("numbers that are not of a lesson are refused") {
  Written written("十");
  written.write(0);
  written.write(1);
  written.events();
  const std::vector<double> whole = written.numbers();
  calligraphy_score* score = nullptr;
  const auto status_of = [&](const std::vector<double>& numbers) {
    return calligraphy_score_writing(written.page.get(), numbers.data(), numbers.size(), CALLIGRAPHY_TOLERANCE_NORMAL, &score);
  };
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 8) {
    CHECK(status_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}) == CALLIGRAPHY_INVALID_VALUE);
  }
  for (std::size_t i = 0; i < 24; ++i) {
    for (const double wrong : {-2.0, 1e18, 0.5, std::nan("")}) {
      std::vector<double> numbers = whole;
      numbers[i] = wrong;
      if (status_of(numbers) == CALLIGRAPHY_OK) calligraphy_free(score);  // a place or a time may be any number
    }
  }
}

TEST_CASE("the names of lessons in C are the values of C++") {
  CHECK(CALLIGRAPHY_LESSON_WATCH == static_cast<int>(LessonMode::watch));
  CHECK(CALLIGRAPHY_LESSON_IGNORE == static_cast<int>(LessonCommandKind::ignore));
  CHECK(CALLIGRAPHY_LESSON_SHOW == static_cast<int>(LessonCommandKind::show));
  CHECK(CALLIGRAPHY_LESSON_FINISHED == static_cast<int>(LessonEventKind::finished));
  CHECK(CALLIGRAPHY_LESSON_SKIPPED == static_cast<int>(LessonEventKind::skipped));
  CHECK(CALLIGRAPHY_REFUSAL_ANOTHER_STROKE == static_cast<int>(RefusalReason::another_stroke));
  CHECK(CALLIGRAPHY_REFUSAL_NOT_ALONG == static_cast<int>(RefusalReason::not_along));
  CHECK(CALLIGRAPHY_FATE_IGNORED == static_cast<int>(StrokeFate::ignored));
  CHECK(CALLIGRAPHY_FATE_SKIPPED == static_cast<int>(StrokeFate::skipped));
  CHECK(CALLIGRAPHY_POINTER_PEN == static_cast<int>(PointerKind::pen));
  CHECK(CALLIGRAPHY_LESSON_REMARK_ATTEMPTS == static_cast<int>(LessonRemarkKind::attempts));
}

}  // namespace lesson_tests_in_c
