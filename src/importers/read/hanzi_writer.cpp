#include "hanzi_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <nlohmann/json.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "outline_area.hpp"
#include "path_data.hpp"

namespace calligraphy {
namespace {

using Json = nlohmann::json;

constexpr std::size_t max_file_bytes = 1 << 20;  // [byte]; the largest of the package has 15 thousand
constexpr std::size_t max_strokes = 256;
constexpr std::size_t max_points = 10000;  // of one median
constexpr double units_per_em = 1024.0;
constexpr double baseline = -124.0;                    // [unit]
constexpr double max_coordinate = 8.0 * units_per_em;  // [unit]
constexpr double outline_tolerance = 5e-4;             // [em]

/// Parses the JSON text of one character, with messages that name the file and the place.
class Reader {
 public:
  Reader(std::string_view text, std::string name) : name_(std::move(name)) {
    if (text.size() > max_file_bytes) fail("", "larger than 1 MB");
    try {
      root_ = Json::parse(text);
    } catch (const Json::parse_error& error) {
      check_utf8(text);
      fail("", "not JSON at byte " + std::to_string(error.byte) + (error.byte > text.size() ? ", its end" : ""));
    } catch (const Json::exception&) {
      fail("", "not JSON: a number is too large");
    }
  }

  std::vector<SourceStroke> strokes() const {
    constexpr const char* expected =
        ": expected one character, {\"strokes\": [...], \"medians\": [...]}, a file or, as in graphics.txt, a line";
    if (!root_.is_object()) fail("", (root_.is_array() ? "is an array" : "is no object") + std::string(expected));
    const auto medians = root_.find("medians");
    if (medians == root_.end()) {
      const auto is_object = [](const Json& each) { return each.is_object(); };
      const bool has_objects = std::any_of(root_.begin(), root_.end(), is_object);
      if (has_objects) fail("", "is an object of objects" + std::string(expected));
      fail("medians", "missing");
    }
    if (!medians->is_array() || medians->empty()) fail("medians", "expected a non-empty array");
    if (medians->size() > max_strokes) fail("medians", "more than " + std::to_string(max_strokes) + " strokes");
    std::vector<SourceStroke> result;
    for (std::size_t i = 0; i < medians->size(); ++i) {
      result.push_back({median((*medians)[i], place_in("medians", i)), {}, {}, {}});
    }
    std::size_t points = 0;
    const auto outlines = root_.find("strokes");
    if (outlines == root_.end()) return result;
    if (!outlines->is_array() || outlines->size() != result.size()) {
      fail("strokes", "expected an array of " + std::to_string(result.size()) + " outlines, as many as medians");
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i].outline = outline((*outlines)[i], place_in("strokes", i));
      if ((points += result[i].point_count()) > max_drawing_points) fail(place_in("strokes", i), too_many_points());
    }
    return result;
  }

  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw FormatError(name_ + ": " + (place.empty() ? what : place + ": " + what));
  }

 private:
  void check_utf8(std::string_view text) const {
    try {
      decode_utf8(text);
    } catch (const FormatError& error) {
      fail("", error.what());
    }
  }

  static std::string place_in(const char* array, std::size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
  }

  std::vector<std::vector<Point>> outline(const Json& value, const std::string& place) const {
    if (!value.is_string()) fail(place, "expected the path data of an outline");
    std::vector<std::vector<Point>> polygons;
    try {
      polygons = flattened_outline(value.get_ref<const std::string&>(), outline_tolerance * units_per_em);
    } catch (const FormatError& error) {
      fail(place, std::string("path data ") + error.what());
    }
    for (std::vector<Point>& polygon : polygons) {
      for (Point& point : polygon) point = hanzi_writer_em(point);
    }
    if (area_of(polygons) < least_outline_area) fail(place, "the outline has no area");
    return polygons;
  }

  std::vector<Point> median(const Json& value, const std::string& place) const {
    if (!value.is_array() || value.empty()) fail(place, "expected a non-empty array of points");
    if (value.size() > max_points) fail(place, "more than " + std::to_string(max_points) + " points");
    std::vector<Point> points;
    for (std::size_t i = 0; i < value.size(); ++i) {
      points.push_back(point(value[i], place + "[" + std::to_string(i) + "]"));
    }
    const auto is_first = [&points](const Point& each) { return each == points.front(); };
    if (std::all_of(points.begin(), points.end(), is_first)) fail(place, "has no length");
    return points;
  }

  Point point(const Json& value, const std::string& place) const {
    const bool two_numbers = value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
    if (!two_numbers) fail(place, "expected two finite numbers");
    const Point units(value[0].get<double>(), value[1].get<double>());
    if (!units.allFinite()) fail(place, "expected two finite numbers");
    if (units.cwiseAbs().maxCoeff() > max_coordinate) {
      fail(place, "(" + value[0].dump() + ", " + value[1].dump() + ") is more than 8 em from the origin");
    }
    return hanzi_writer_em(units);
  }

  std::string name_;
  Json root_;
};

/// Finds the member "character" of the outermost object, and then stops.
struct MemberSearch : nlohmann::json_sax<Json> {
  std::optional<std::string> found;
  int depth = 0;
  bool is_wanted = false;  ///< the next value

  bool key(std::string& name) override {
    is_wanted = depth == 1 && name == "character";
    return true;
  }
  bool string(std::string& value) override {
    if (is_wanted) found = value;
    return !is_wanted;
  }
  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool null() override { return !is_wanted; }
  bool boolean(bool) override { return !is_wanted; }
  bool number_integer(std::int64_t) override { return !is_wanted; }
  bool number_unsigned(std::uint64_t) override { return !is_wanted; }
  bool number_float(double, const std::string&) override { return !is_wanted; }
  bool binary(Json::binary_t&) override { return !is_wanted; }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }

 private:
  bool open() {
    ++depth;
    return !is_wanted;
  }
  bool close() {
    --depth;
    return true;
  }
};

}  // namespace

Point hanzi_writer_em(const Point& units) { return Point(units.x(), units.y() - baseline) / units_per_em; }

std::vector<SourceStroke> parse_hanzi_writer(std::string_view json, const std::string& name) {
  return Reader(json, name).strokes();
}

std::optional<std::string> character_member(std::string_view json) {
  MemberSearch search;
  Json::sax_parse(json, &search);
  return search.found;
}

}  // namespace calligraphy
