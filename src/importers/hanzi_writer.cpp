#include "hanzi_writer.hpp"

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/stroke_fit.hpp>

namespace calligraphy {
namespace {

using Json = nlohmann::json;

constexpr std::size_t max_file_bytes = 1 << 20;  // [byte]; the largest of the package has 15 thousand
constexpr std::size_t max_strokes = 256;
constexpr std::size_t max_points = 10000;  // of one median
constexpr double units_per_em = 1024.0;
constexpr double baseline = -124.0;                    // [unit]
constexpr double max_coordinate = 8.0 * units_per_em;  // [unit]

/// Parses the JSON text of one character, with messages that name the file and the place.
class Reader {
 public:
  Reader(std::string_view text, std::string name) : name_(std::move(name)) {
    if (text.size() > max_file_bytes) fail("", "larger than 1 MB");
    try {
      root_ = Json::parse(text);
    } catch (const Json::exception& error) {
      fail("", std::string("not JSON: ") + error.what());
    }
  }

  std::vector<std::vector<Point>> medians() const {
    if (!root_.is_object()) fail("", "expected an object");
    const auto found = root_.find("medians");
    if (found == root_.end()) fail("medians", "missing");
    if (!found->is_array() || found->empty()) fail("medians", "expected a non-empty array");
    if (found->size() > max_strokes) fail("medians", "more than " + std::to_string(max_strokes) + " strokes");
    std::vector<std::vector<Point>> result;
    for (std::size_t i = 0; i < found->size(); ++i) {
      result.push_back(median((*found)[i], "medians[" + std::to_string(i) + "]"));
    }
    return result;
  }

  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw FormatError(name_ + ": " + (place.empty() ? what : place + ": " + what));
  }

 private:
  std::vector<Point> median(const Json& value, const std::string& place) const {
    if (!value.is_array() || value.empty()) fail(place, "expected a non-empty array of points");
    if (value.size() > max_points) fail(place, "more than " + std::to_string(max_points) + " points");
    std::vector<Point> points;
    for (std::size_t i = 0; i < value.size(); ++i) {
      points.push_back(point(value[i], place + "[" + std::to_string(i) + "]"));
    }
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
    return Point(units.x(), units.y() - baseline) / units_per_em;
  }

  std::string name_;
  Json root_;
};

}  // namespace

std::vector<std::vector<Point>> parse_hanzi_writer(std::string_view json, const std::string& name) {
  return Reader(json, name).medians();
}

Character read_hanzi_writer(const std::string& directory, char32_t code) {
  const bool is_character = code > 0 && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  if (!is_character) throw FileError(directory + ": invalid code point " + std::to_string(static_cast<unsigned>(code)));
  const std::string name = encode_utf8(code);
  const std::filesystem::path path = std::filesystem::path(directory) / (name + ".json");
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure)) {
    throw FileError(path.string() +
                    ": no such file; is this the unpacked npm package hanzi-writer-data, and does it contain " + name +
                    "?");
  }
  const auto medians = parse_hanzi_writer(read_file(path, max_file_bytes), path.filename().string());
  std::vector<StrokeInput> strokes;
  for (const std::vector<Point>& median : medians) strokes.push_back(fit_stroke(median).stroke);
  return make_character(code, strokes);
}

}  // namespace calligraphy
