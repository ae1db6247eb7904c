// A table whose first line names its columns, of any order; what it has besides is left alone.
#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include <calligraphy/base/text.hpp>

#include "base/line_reader.hpp"
#include "ink_file.hpp"

namespace calligraphy {
namespace {

constexpr double right_angle = std::numbers::pi / 2.0;
constexpr double per_table_degree = std::numbers::pi / 180.0;

enum class Role { x, y, time, stroke, pen, pressure, altitude, azimuth, tilt_x, tilt_y, character, trace };
constexpr std::size_t roles = 12;

constexpr std::pair<std::string_view, Role> role_names[] = {
    {"x", Role::x},                {"posx", Role::x},             {"xpos", Role::x},
    {"xcoordinate", Role::x},      {"xcoord", Role::x},           {"positionx", Role::x},
    {"y", Role::y},                {"posy", Role::y},             {"ypos", Role::y},
    {"ycoordinate", Role::y},      {"ycoord", Role::y},           {"positiony", Role::y},
    {"t", Role::time},             {"time", Role::time},          {"timestamp", Role::time},
    {"stroke", Role::stroke},      {"strokeid", Role::stroke},    {"strokeindex", Role::stroke},
    {"strokeno", Role::stroke},    {"strokenumber", Role::stroke}, {"pen", Role::pen},
    {"pendown", Role::pen},        {"penstatus", Role::pen},      {"penstate", Role::pen},
    {"button", Role::pen},         {"buttonstatus", Role::pen},   {"tip", Role::pen},
    {"contact", Role::pen},        {"p", Role::pressure},         {"pressure", Role::pressure},
    {"altitude", Role::altitude},  {"altitudeangle", Role::altitude}, {"elevation", Role::altitude},
    {"azimuth", Role::azimuth},    {"azimuthangle", Role::azimuth}, {"tiltx", Role::tilt_x},
    {"xtilt", Role::tilt_x},       {"tilty", Role::tilt_y},       {"ytilt", Role::tilt_y},
    {"character", Role::character}, {"char", Role::character},    {"label", Role::character},
    {"hanzi", Role::character},    {"kanji", Role::character},    {"glyph", Role::character},
    {"trace", Role::trace},        {"traceid", Role::trace},      {"sample", Role::trace},
    {"sampleid", Role::trace},     {"trial", Role::trace},        {"trialid", Role::trace},
    {"id", Role::trace},
};

constexpr std::pair<std::string_view, double> table_units[] = {
    {"s", 1.0},    {"sec", 1.0},  {"seconds", 1.0},   {"ms", 1e-3},     {"msec", 1e-3}, {"milliseconds", 1e-3},
    {"us", 1e-6},  {"µs", 1e-6}, {"microseconds", 1e-6}, {"ns", 1e-9}, {"nanoseconds", 1e-9},
    {"rad", 1.0},  {"radians", 1.0}, {"deg", per_table_degree}, {"degree", per_table_degree},
    {"degrees", per_table_degree},
    {"°", per_table_degree},
};

/// A heading as "t [ms]", "time_ms", "Pen Down" or "pressure(0-1)": its words, without case, and the unit.
struct Heading {
  std::string word;
  double unit = std::numeric_limits<double>::quiet_NaN();
};

double table_unit(std::string_view word) {
  for (const auto& [name, unit] : table_units) {
    if (name == word) return unit;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Heading heading_of(std::string_view text) {
  std::string word(trimmed(text));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  Heading heading;
  if (const std::size_t bracket = word.find_first_of("[("); bracket != std::string::npos) {
    const std::size_t end = std::min(word.find_first_of("])", bracket), word.size());
    heading.unit = table_unit(trimmed(std::string_view(word).substr(bracket + 1, end - bracket - 1)));
    word.resize(bracket);
  } else if (const std::size_t last = word.find_last_of("_ "); last != std::string::npos) {
    heading.unit = table_unit(std::string_view(word).substr(last + 1));
    if (!std::isnan(heading.unit)) word.resize(last);
  }
  std::erase_if(word, [](char c) { return c == '_' || c == ' ' || c == '-' || c == '.'; });
  heading.word = word;
  return heading;
}

std::optional<Role> role_of(const std::string& word) {
  for (const auto& [name, role] : role_names) {
    if (name == word) return role;
  }
  return std::nullopt;
}

/// The separator that occurs most often in a heading; 0 if none does.
char separator_of(std::string_view line) {
  char best = 0;
  std::ptrdiff_t most = 0;
  for (const char each : {'\t', ';', ','}) {
    const auto count = std::count(line.begin(), line.end(), each);
    if (count > most) most = count, best = each;
  }
  return best;
}

/// The fields of a line; those in quotes may contain the separator, and two quotes for one.
void split_fields(std::string_view line, char separator, std::vector<std::string>& fields) {
  fields.clear();
  fields.emplace_back();
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"' && (is_quoted || trimmed(fields.back()).empty())) {
      is_quoted = !is_quoted;
    } else if (c == separator && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
}

class TableReader {
 public:
  TableReader(std::string_view text, std::string_view name) : in_(bytes_of(text), name), name_(name) {
    file_.format = InkFormat::csv;
    columns_.fill(no_column);
    units_.fill(std::numeric_limits<double>::quiet_NaN());
  }

  InkFile read() {
    read_heading();
    while (in_.next()) {
      if (trimmed(in_.line()).empty()) continue;
      split_fields(in_.line(), separator_, fields_);
      const auto is_blank = [](const std::string& each) { return trimmed(each).empty(); };
      if (std::all_of(fields_.begin(), fields_.end(), is_blank)) continue;
      if (fields_.size() != width_) {
        in_.fail("has " + std::to_string(fields_.size()) + " fields: the first line has " + std::to_string(width_));
      }
      read_row();
    }
    if (lifts_by_pressure_ && !is_ever_lifted_) {
      fail_ink(name_, "there is no column stroke or pen_down, which tells pen-downs apart, and the pressure is never "
                      "0");
    }
    if (lifts_by_pressure_) file_.notes.emplace_back("the pen is on the paper where the pressure is above 0");
    return std::move(file_);
  }

 private:
  static constexpr std::size_t no_column = static_cast<std::size_t>(-1);

  std::size_t column(Role role) const { return columns_[static_cast<std::size_t>(role)]; }
  bool has(Role role) const { return column(role) != no_column; }
  std::string_view field(Role role) const { return trimmed(fields_[column(role)]); }

  void read_heading() {
    do {
      if (!in_.next()) fail_ink(name_, "has no columns");
    } while (trimmed(in_.line()).empty());
    separator_ = separator_of(in_.line());
    split_fields(in_.line(), separator_, fields_);
    width_ = fields_.size();
    std::string found;
    for (std::size_t i = 0; i < width_; ++i) {
      if (i < 40) found += (found.empty() ? "" : ", ") + in_quotes(trimmed(fields_[i]));
    }
    const std::vector<std::string> names = fields_;
    for (std::size_t i = 0; i < width_; ++i) {
      const Heading heading = heading_of(names[i]);
      const std::optional<Role> role = role_of(heading.word);
      if (!role) continue;
      std::size_t& to = columns_[static_cast<std::size_t>(*role)];
      if (to != no_column && trimmed(names[to]) == trimmed(names[i])) {
        in_.fail("there are two columns " + in_quotes(trimmed(names[i])) + "; the columns are " + found);
      }
      if (to != no_column) {
        in_.fail("the columns " + in_quotes(names[to]) + " and " + in_quotes(names[i]) + " may both be " +
                 std::string(names_of_place(*role)) + "; the columns are " + found);
      }
      to = i;
      units_[static_cast<std::size_t>(*role)] = heading.unit;
    }
    const auto require = [&](bool good, const char* what) {
      if (!good) in_.fail(std::string("there is no column ") + what + "; the columns are " + found);
    };
    require(has(Role::x), "x");
    require(has(Role::y), "y");
    lifts_by_pressure_ = !has(Role::stroke) && !has(Role::pen) && has(Role::pressure);
    require(has(Role::stroke) || has(Role::pen) || lifts_by_pressure_,
            "stroke or pen_down, which tells pen-downs apart");
    require(has(Role::tilt_x) == has(Role::tilt_y), "of the other tilt");
    if (has(Role::time)) file_.time_unit = units_[static_cast<std::size_t>(Role::time)];
    const double altitude_unit = units_[static_cast<std::size_t>(Role::altitude)];
    const double azimuth_unit = units_[static_cast<std::size_t>(Role::azimuth)];
    file_.angle_unit = std::isnan(altitude_unit) ? azimuth_unit : altitude_unit;
    if (altitude_unit != azimuth_unit && !std::isnan(altitude_unit) && !std::isnan(azimuth_unit)) {
      in_.fail("altitude and azimuth have different units");
    }
    has_tilts_ = has(Role::tilt_x) && !has(Role::altitude) && !has(Role::azimuth);
    if (has_tilts_) file_.angle_unit = 1.0;
  }

  static std::string_view names_of_role(Role role) {
    for (const auto& [name, each] : role_names) {
      if (each == role && name.size() > 1) return name;
    }
    return "the same";
  }

  void read_row() {
    const std::string trace(has(Role::trace) ? field(Role::trace) : std::string_view());
    const std::string label(has(Role::character) ? field(Role::character) : std::string_view());
    const std::string stroke(has(Role::stroke) ? field(Role::stroke) : std::string_view());
    const bool is_new = file_.groups.empty() || trace != trace_ || label != file_.groups.back().label;
    if (is_new) {
      if (file_.groups.size() >= max_ink_groups) in_.fail("too many characters");
      file_.groups.emplace_back().label = label;
      trace_ = trace;
    }
    InkGroup& group = file_.groups.back();
    const bool in_air = lifts_by_pressure_ ? !(number_or_nan(Role::pressure) > 0.0)
                                           : has(Role::pen) && !is_down(field(Role::pen));
    is_ever_lifted_ = is_ever_lifted_ || in_air;
    const bool begins = group.runs.empty() || group.runs.back().in_air != in_air || (!in_air && stroke != stroke_);
    if (begins) add_run(group, in_air, name_);
    stroke_ = stroke;
    add_sample(group.runs.back(), sample(), name_);
  }

  TimedPoint sample() {
    TimedPoint sample = sample_at(number(Role::x), number(Role::y));
    if (has(Role::time)) sample.time = number(Role::time);
    if (has(Role::pressure)) sample.stylus.pressure = number_or_nan(Role::pressure);
    if (has(Role::altitude)) sample.stylus.altitude = number_or_nan(Role::altitude);
    if (has(Role::azimuth)) sample.stylus.azimuth = number_or_nan(Role::azimuth);
    if (has_tilts_) {  // towards y of the file; as turn_as_needed() has it, that may point down
      set_tilt(sample.stylus, tilt(Role::tilt_x), tilt(Role::tilt_y));
    }
    return sample;
  }

  double tilt(Role role) {
    const double unit = units_[static_cast<std::size_t>(role)];
    const double value = number_or_nan(role) * (std::isnan(unit) ? per_table_degree : unit);
    if (std::abs(value) > right_angle * 1.001) {
      in_.fail("a tilt of " + in_quotes(field(role)) + ": expected at most a right angle");
    }
    return std::isnan(value) ? value : std::clamp(value, -right_angle, right_angle);
  }

  bool is_down(std::string_view text) {
    if (text == "1" || text == "true" || text == "True" || text == "TRUE" || text == "down") return true;
    if (text == "0" || text == "false" || text == "False" || text == "FALSE" || text == "up") return false;
    const std::optional<double> value = finite_number(text);
    if (!value || *value < 0.0) in_.fail("the pen is " + in_quotes(text) + ": expected 1 on the paper, 0 in the air");
    return *value > 0.0;
  }

  double number(Role role) {
    const std::optional<double> value = finite_number(field(role));
    if (value) return *value;
    std::string text(field(role));
    std::replace(text.begin(), text.end(), ',', '.');
    in_.fail("the " + std::string(names_of_place(role)) + " is " + in_quotes(field(role)) + ": expected a number" +
             (finite_number(text) ? " with a decimal point" : ""));
  }

  static std::string_view names_of_place(Role role) {
    return role == Role::x ? "x" : role == Role::y ? "y" : names_of_role(role);
  }

  double number_or_nan(Role role) {
    const std::string_view text = field(role);
    const bool is_absent = text.empty() || text == "-" || text == "nan" || text == "NaN" || text == "NA" ||
                           text == "null";
    return is_absent ? std::numeric_limits<double>::quiet_NaN() : number(role);
  }

  LineReader in_;
  std::string_view name_;
  InkFile file_;
  char separator_ = ',';
  std::size_t width_ = 0;
  std::array<std::size_t, roles> columns_{};
  std::array<double, roles> units_{};
  std::vector<std::string> fields_;
  std::string trace_, stroke_;
  bool has_tilts_ = false;
  bool lifts_by_pressure_ = false, is_ever_lifted_ = false;
};

}  // namespace

bool is_ink_table(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const char separator = separator_of(line);
  return separator != 0 && line.size() < 10000 && !finite_number(trimmed(line.substr(0, line.find(separator))));
}

InkFile read_ink_table(std::string_view text, std::string_view name) { return TableReader(text, name).read(); }

}  // namespace calligraphy
