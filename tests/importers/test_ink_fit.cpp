// Ink fitted to outlines: outlines of known ink, areas known from geometry, and a sample of hanzi-writer-data.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/stroke_polyline.hpp>

#include "../catch.hpp"
#include "../package_data.hpp"
#include "../sanitized.hpp"
#include "../temporary_directory.hpp"
#include "importers/check/bitmap.hpp"
#include "importers/check/import_measures.hpp"
#include "importers/fit/ink_fit.hpp"

namespace ink_fit_tests {

using namespace calligraphy;
using namespace calligraphy::recognition;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::vector<Point> box(const Point& low, const Point& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

/// Ink that a brush may leave on a line: an entry, a waist, a press.
StrokeInk brushed() {
  return {0.01, 0.012, {}, {0.012, 0.03, 0.034, 0.026, 0.024, 0.034, 0.044, 0.014},
          {0.004, 0.006, 0.004, 0.0, -0.002, 0.0, 0.006, 0.002}};
}

/// The same on a stroke of any kind, which presses outwards at its corners.
StrokeInk brushed(const TypicalStroke& type) {
  const auto [knots, corners] = ink_size(type, type.elements);
  const StrokeInk line = brushed();
  StrokeInk ink{line.start, line.end, {}, {}, {}};
  for (std::size_t k = 0; k < knots; ++k) {
    ink.half_widths[k] = line.half_widths[7 * k / (knots - 1)];
    ink.offsets[k] = line.offsets[7 * k / (knots - 1)];
  }
  for (std::size_t k = 0; k < corners; ++k) ink.shifts[k] = 0.01;
  return ink;
}

StrokeInput with_ink(StrokeInput stroke, const StrokeInk& ink) {
  stroke.ink = ink;
  return stroke;
}

StrokeInput line_from(const Point& start, const Point& end) { return {1, {start, end}}; }

Stroke inked_view(const StrokeInput& stroke) {
  Stroke view = view_of(stroke);
  view.ink = &*stroke.ink;
  return view;
}

std::vector<Point> outline_of(const StrokeInput& stroke, const StrokeInk& ink) {
  return ink_outline(inked_view(with_ink(stroke, ink)), 1e-4);
}

double covered(const std::vector<Point>& outline, const StrokeInput& stroke, const StrokeInk& ink) {
  Bitmap wanted(512), drawn(512);
  wanted.fill(outline);
  for (const InkDisc& disc : ink_discs(inked_view(with_ink(stroke, ink)), 0.002)) drawn.fill(disc);
  return intersection_over_union(wanted, drawn);
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Three characters of one stroke, as hanzi-writer-data writes them: a horizontal bar of 0.1 em.
void write_bar(const TemporaryDirectory& directory, bool with_outline) {
  const std::string outline = R"("strokes":["M 100 250 L 900 250 L 900 350 L 100 350 Z"],)";
  directory.write("一.json", "{" + (with_outline ? outline : "") + R"("medians":[[[110,300],[890,300]]]})");
}

}  // namespace

TEST_CASE("a bitmap has the area of what fills it, of any winding, and counts an overlap once", "[ink]") {
  constexpr int pixels = 400;
  Bitmap bitmap(pixels);
  CHECK(bitmap.area() == 0);
  bitmap.fill(box({0.2, 0.3}, {0.7, 0.5}));
  CHECK(bitmap.area() == 200 * 80);
  bitmap.fill(box({0.6, 0.3}, {0.8, 0.5}));
  CHECK(bitmap.area() == 240 * 80);
  bitmap.clear();
  std::vector<Point> clockwise = box({0.2, 0.3}, {0.7, 0.5});
  std::reverse(clockwise.begin(), clockwise.end());
  bitmap.fill(clockwise);
  CHECK(bitmap.area() == 200 * 80);
  bitmap.clear();
  bitmap.fill(InkDisc{{0.5, 0.5}, 0.25});
  CHECK(static_cast<double>(bitmap.area()) / (pixels * pixels) == Approx(std::numbers::pi / 16.0).epsilon(2e-3));
}

TEST_CASE("what lies beyond a bitmap is left out", "[ink]") {
  Bitmap bitmap(100);
  bitmap.fill(box({-9.0, -9.0}, {9.0, 9.0}));
  CHECK(bitmap.area() >= 150 * 150);
  CHECK(bitmap.area() <= 150 * 192);  // to the end of a word
  bitmap.fill(InkDisc{{7.0, -8.0}, 0.5});
  bitmap.clear();
  CHECK(bitmap.area() == 0);
}

TEST_CASE("two squares that share a third of their union have an intersection over union of a third", "[ink]") {
  Bitmap one(200), other(200);
  one.fill(box({0.0, 0.0}, {0.5, 0.5}));
  other.fill(box({0.25, 0.0}, {0.75, 0.5}));
  CHECK(intersection_over_union(one, other) == Approx(1.0 / 3.0));
  CHECK(intersection_over_union(one, one) == 1.0);
  CHECK(intersection_over_union(one, Bitmap(200)) == 0.0);
}

TEST_CASE("the ink of an outline is found again, along every typical stroke", "[ink]") {
  for (const TypicalStroke& type : typical_strokes()) {
    INFO("typical stroke " << type.id);
    StrokeInput stroke{type.id, {}};
    for (const std::array<double, 2>& point : type.shape) stroke.control_points.emplace_back(point[0], point[1]);
    const Path path = flattened(stroke);
    const std::vector<Point> outline = outline_of(stroke, brushed(type));
    const StrokeInk found = fit_ink(view_of(stroke), path, outline, InkDetail::full);
    CHECK(covered(outline, stroke, found) >= (path_length(path) < 0.6 ? 0.93 : 0.96));
  }
}

TEST_CASE("along a line the half-widths and offsets themselves are found again", "[ink]") {
  const StrokeInput line = line_from({0.1, 0.5}, {0.9, 0.52});
  const StrokeInk found = fit_ink(view_of(line), line.control_points, outline_of(line, brushed()), InkDetail::full);
  for (std::size_t k = 1; k < 7; ++k) {
    CHECK(found.half_widths[k] == Approx(brushed().half_widths[k]).margin(0.0045));
    CHECK(found.offsets[k] == Approx(brushed().offsets[k]).margin(0.003));
  }
}

TEST_CASE("half-widths alone leave the ink on the path", "[ink]") {
  const StrokeInput line = line_from({0.1, 0.5}, {0.9, 0.5});
  const std::vector<Point> outline = outline_of(line, brushed());
  const StrokeInk found = fit_ink(view_of(line), line.control_points, outline, InkDetail::half_widths);
  CHECK(found.offsets == StrokeInk{}.offsets);
  CHECK(covered(outline, line, found) >= 0.85);
}

TEST_CASE("ink of any outline, however unlike its path, is valid", "[ink]") {
  const StrokeInput path{16, {{0.1, 0.1}, {0.9, 0.9}, {0.2, 0.85}}};
  const StrokeInput point = line_from({0.5, 0.5}, {0.5, 0.5});
  std::vector<Point> spiral;
  for (int i = 0; i < 200; ++i) {
    spiral.push_back(Point(0.5, 0.5) + 0.002 * i * Point(std::cos(20.0 * i * degree), std::sin(20.0 * i * degree)));
  }
  for (const std::vector<Point>& outline :
       {box({0.4, 0.4}, {0.6, 0.6}), box({5.0, 5.0}, {6.0, 6.0}), box({0.5, 0.5}, {0.5, 0.5}), spiral}) {
    for (const InkDetail detail : {InkDetail::half_widths, InkDetail::full}) {
      for (const StrokeInput& each : {path, point}) {
        const StrokeInk ink = fit_ink(view_of(each), each.control_points, outline, detail);
        CHECK_NOTHROW(make_character(U'一', std::vector{with_ink(each, ink)}));
      }
    }
  }
}

TEST_CASE("parts that touch, overlap or nearly do are one outline, whatever lies apart from them", "[ink]") {
  const StrokeInput stroke = line_from({0.1, 0.5}, {0.9, 0.5});
  const Path& path = stroke.control_points;
  const auto reversed = [](Path polygon) { return Path(polygon.rbegin(), polygon.rend()); };
  const Path left = box({0.1, 0.46}, {0.5, 0.54}), right = box({0.5, 0.46}, {0.9, 0.54});
  const Outline whole(box({0.1, 0.46}, {0.9, 0.54}));
  const StrokeInk expected = fit_ink(view_of(stroke), path, whole, InkDetail::full);
  for (const std::vector<Path>& parts : std::vector<std::vector<Path>>{
           {left, right},
           {left, box({0.4, 0.46}, {0.9, 0.54})},
           {left, box({0.5005, 0.46}, {0.9, 0.54})},
           {box({0.1, 0.46}, {0.9, 0.5}), box({0.3, 0.5}, {0.9, 0.54}), box({0.1, 0.5}, {0.3, 0.54})},
           {left, box({0.7, 0.8}, {0.8, 0.9}), right},
           {left, reversed(box({0.2, 0.1}, {0.3, 0.2})), right}}) {
    const Outline outline{std::span(parts)};
    CHECK(inscribed_radius(outline, {0.5, 0.5}) == Approx(0.04));
    CHECK(half_width(path, outline) == Approx(0.04));
    const StrokeInk ink = fit_ink(view_of(stroke), path, outline, InkDetail::full);
    for (std::size_t k = 0; k < 8; ++k) {
      CHECK(ink.half_widths[k] == Approx(expected.half_widths[k]).margin(1e-3));
      CHECK(ink.offsets[k] == Approx(expected.offsets[k]).margin(1e-3));
    }
  }
  const std::vector<Path> ring{box({0.1, 0.1}, {0.9, 0.9}), reversed(box({0.2, 0.2}, {0.8, 0.8}))};
  CHECK(inscribed_radius(Outline(std::span(ring)), {0.15, 0.5}) == Approx(0.05));
  CHECK(inscribed_radius(Outline(std::span(ring)), {0.5, 0.5}) == 0.0);
}

TEST_CASE("contacts are counted between outlines, and kept or new by the gap of the inks", "[ink]") {
  // A bar, one that overlaps it, and one that is 0.02 em above.
  const std::vector<Outline> outlines{box({0.1, 0.4}, {0.9, 0.5}), box({0.4, 0.1}, {0.5, 0.45}),
                                                 box({0.1, 0.52}, {0.9, 0.6})};
  const InkDisc bar{{0.5, 0.45}, 0.05};
  const auto measured = [&](const InkDisc& second, const InkDisc& third) {
    return measure_ink(outlines, std::vector<Point>{{0.9, 0.45}, {0.45, 0.1}, {0.9, 0.56}},
                       std::vector<std::vector<InkDisc>>{{bar}, {second}, {third}});
  };
  const InkMeasures near = measured({{0.5, 0.36}, 0.036}, {{0.5, 0.56}, 0.03});  // gaps of 0.004 and 0.03 em
  CHECK(near.contacts == 1);
  CHECK(near.contacts_kept == 1);
  CHECK(near.apart == 1);
  CHECK(near.new_contacts == 0);
  const InkMeasures far = measured({{0.5, 0.36}, 0.03}, {{0.5, 0.56}, 0.07});  // a gap of 0.01 em, and an overlap
  CHECK(far.contacts_kept == 0);
  CHECK(far.new_contacts == 1);
  CHECK(far.strokes.size() == 3);
  CHECK(far.characters.size() == 1);
  CHECK(far.strokes[0] == Approx(std::numbers::pi * 0.05 * 0.05 / 0.08).epsilon(0.01));
}

TEST_CASE("what the ink misses and adds is measured to the farthest point, and notches near the tip", "[ink]") {
  // A bar, and an angle with a notch of 90 degrees into it at (0.5, 0.5).
  const std::vector<Outline> outlines{
      box({0.1, 0.4}, {0.9, 0.5}),
      Path{{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.5}, {0.5, 0.5}, {0.5, 0.9}, {0.1, 0.9}}};
  const InkMeasures measures = measure_ink(outlines, std::vector<Point>{{0.9, 0.5}, {0.55, 0.55}},
                                           std::vector<std::vector<InkDisc>>{{{{0.5, 0.45}, 0.08}}, {{{0.5, 0.5}, 0.1}}});
  CHECK(measures.uncovered[0] == Approx(std::hypot(0.4, 0.05) - 0.08));
  CHECK(measures.beyond[0] == Approx(0.03).margin(5e-4));
  CHECK(measures.source_notches[0] == Approx(0.0).margin(1e-6));
  CHECK(measures.uncovered[1] == Approx(std::hypot(0.4, 0.4) - 0.1));
  CHECK(measures.beyond[1] == Approx(0.1 * std::numbers::sqrt2 / 2.0).margin(2e-3));
  CHECK(measures.source_notches[1] == Approx(90.0).margin(10.0));
  CHECK(measures.notches[1] == Approx(0.0).margin(1e-6));
}

TEST_CASE("strokes are imported with ink if the source has outlines and it is asked for", "[ink]") {
  const TemporaryDirectory directory;
  write_bar(directory, true);
  const Character bar = import_characters(directory.path()).list.characters[0];
  REQUIRE(bar.physics.ink.size() == 1);
  CHECK(bar.physics.ink[0].half_widths[3] == Approx(50.0 / 1024.0).margin(1e-3));
  ImportOptions options;
  options.ink = InkDetail::none;
  CHECK(import_characters(directory.path(), options).list.characters[0].physics.ink.empty());
  const TemporaryDirectory stored;
  stored.write("bar.txt",
               "calligraphy characters 4\ncharacter 一\nstroke 1 0.1,0.5 0.9,0.5\nink 0 0 1 1 1 1 1 1 1 1\n");
  CHECK(import_characters(stored.path() / "bar.txt").list.characters[0].physics.ink.size() == 1);
  CHECK(import_characters(stored.path() / "bar.txt", options).list.characters[0].physics.ink.empty());
  options.ink = InkDetail::half_widths;
  CHECK_THROWS_WITH(import_characters(stored.path() / "bar.txt", options),
                    Catch::Matchers::StartsWith("ink half-widths: applies only to hanzi-writer-data"));
  write_bar(directory, false);
  CHECK(import_characters(directory.path()).list.characters[0].physics.ink.empty());
}

TEST_CASE("the ink of a sample of hanzi-writer-data covers its outlines and keeps its contacts", "[ink][corpus]") {
  const auto package = package_data("CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL");
  if (package.empty()) return;
  ImportOptions options;
  for (char32_t code = 0x4E00; code < 0x9FFF; code += calligraphy_test::sanitized ? 1600 : 40) options.only += code;
  options.only += U'窮';  // whose hook has no foot where it is looked for
  options.report = true;
  InkMeasures ink = import_characters(package, options).report.ink;
  CHECK(mean(ink.strokes) >= 0.945);
  std::sort(ink.strokes.begin(), ink.strokes.end());
  CHECK(ink.strokes[ink.strokes.size() / 20] >= 0.89);
  CHECK(mean(ink.characters) >= 0.93);
  const auto share_off = [](const std::vector<double>& distances) {
    const auto off = std::count_if(distances.begin(), distances.end(), [](double each) { return each > 0.02; });
    return static_cast<double>(off) / static_cast<double>(distances.size());
  };
  CHECK(share_off(ink.uncovered) <= 0.03);
  CHECK(share_off(ink.beyond) <= 0.02);
  CHECK(*std::max_element(ink.beyond.begin(), ink.beyond.end()) <= 0.04);
  CHECK(ink.contacts_kept >= 0.985 * ink.contacts);
  CHECK(ink.new_contacts <= 0.005 * ink.apart);
}

}  // namespace ink_fit_tests
