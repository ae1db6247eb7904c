// From a file's own units to em and seconds: what is not declared is seen from the whole file, and told.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include <calligraphy/base/text.hpp>

#include "base/require.hpp"
#include "ink_file.hpp"
#include "judge/pens/sample_fault.hpp"

namespace calligraphy {
namespace {

constexpr double writing_size = 0.8;    // larger side of a character in its square, if that is unknown [em]
constexpr double typical_speed = 0.82;  // of people's strokes [em/s]
constexpr double typical_pause = 0.49;  // between people's strokes [s]
constexpr double chained_pause = 0.5;   // between strokes whose own clocks begin anew [s]
constexpr double typical_interval = 0.01;  // between samples of a tablet [s]
constexpr double degree = std::numbers::pi / 180.0;

template <typename Use>
void each_sample(InkFile& file, const Use& use) {
  for (InkGroup& group : file.groups) {
    for (InkRun& run : group.runs) {
      for (TimedPoint& sample : run.samples) use(sample, run.in_air);
    }
  }
}

std::string place_of(const InkFile& file, const InkGroup& group, const InkRun& run) {
  const std::string place = file.groups.size() == 1
                                ? std::string()
                                : "character " + std::to_string(&group - file.groups.data() + 1) + ": ";
  std::ptrdiff_t number = 0;
  for (const InkRun* each = group.runs.data(); each <= &run; ++each) number += each->in_air == run.in_air ? 1 : 0;
  return place + (run.in_air ? "time in the air " : "stroke ") + std::to_string(number) + ": ";
}

/// Leaves only what has samples. @throws FormatError if nobody wrote
void drop_empty(InkFile& file, std::string_view name) {
  std::size_t unwritten = 0;
  for (InkGroup& group : file.groups) {
    std::erase_if(group.runs, [](const InkRun& run) { return run.samples.empty(); });
  }
  unwritten = std::erase_if(file.groups, [](const InkGroup& group) {
    return std::all_of(group.runs.begin(), group.runs.end(), [](const InkRun& run) { return run.in_air; });
  });
  if (file.groups.empty()) fail_ink(name, "the pen is never down");
  if (unwritten > 0) file.notes.push_back(std::to_string(unwritten) + " groups without a pen-down were left out");
}

// Pressure ------------------------------------------------------------------------------------------------------------

void scale_pressure(InkFile& file, std::string_view name) {
  double most = 0.0, least = unlimited;
  std::size_t count = 0;
  each_sample(file, [&](const TimedPoint& sample, bool in_air) {
    const double pressure = sample.stylus.pressure;
    if (std::isnan(pressure)) return;
    if (pressure < 0.0) fail_ink(name, "a pressure of " + number_text(pressure) + ": expected at least 0");
    most = std::max(most, pressure);
    if (in_air) return;
    least = std::min(least, pressure);
    ++count;
  });
  if (count == 0) return;
  const bool is_constant = least >= most && (most == 0.0 || most == 0.5 || most == 1.0) && count > 1;
  double full = 1.0;
  if (is_constant) {  // what a browser reports of a mouse, or a tablet without a sensor
    file.notes.push_back("the pressure is always " + number_text(most) + ": taken as not sensed");
    full = std::numeric_limits<double>::quiet_NaN();
  } else if (!file.pressure_is_scaled && most > 1.0) {
    while (full < most && full < 1e300) full = 2.0 * full + 1.0;
    file.notes.push_back("pressure is of " + number_text(full) + ", the least 2^n - 1 that holds its maximum of " +
                         number_text(most));
  }
  each_sample(file, [full](TimedPoint& sample, bool) { sample.stylus.pressure /= full; });
}

// Angles --------------------------------------------------------------------------------------------------------------

void scale_angles(InkFile& file, std::string_view name) {
  double altitude = 0.0, azimuth = 0.0;
  bool any = false;
  each_sample(file, [&](const TimedPoint& sample, bool) {
    any = any || !std::isnan(sample.stylus.altitude) || !std::isnan(sample.stylus.azimuth);
    altitude = std::fmax(altitude, std::abs(sample.stylus.altitude));
    azimuth = std::fmax(azimuth, std::abs(sample.stylus.azimuth));
  });
  if (!any) return;
  double unit = file.angle_unit;
  if (altitude == 0.0 && azimuth == 0.0) {  // a pen is never flat on the paper throughout
    unit = std::numeric_limits<double>::quiet_NaN();
    file.notes.emplace_back("azimuth and altitude are always 0: taken as not sensed");
  } else if (std::isnan(unit)) {
    const bool may_be_radians = file.format != InkFormat::svc;
    const char* words = "tenths of a degree";
    if (may_be_radians && altitude <= 1.6 && azimuth <= 6.3) {
      unit = 1.0, words = "rad";
    } else if (altitude <= 90.0 && azimuth <= 360.0) {
      unit = degree, words = "degrees";
    } else {
      unit = degree / 10.0;
      file.azimuth_from_north = true;  // Wintab's
    }
    file.notes.push_back(std::string("azimuth and altitude are in ") + words + ", by their range");
  }
  if (altitude * unit > std::numbers::pi / 2.0 * 1.01) {
    fail_ink(name, "an altitude of " + number_text(altitude) + ": expected at most a right angle");
  }
  if (azimuth * unit > 2.0 * std::numbers::pi * 1.01) {
    fail_ink(name, "an azimuth of " + number_text(azimuth) + ": expected at most a full circle");
  }
  each_sample(file, [&](TimedPoint& sample, bool) {
    StylusState& stylus = sample.stylus;
    stylus.altitude = std::isnan(stylus.altitude * unit)
                          ? std::numeric_limits<double>::quiet_NaN()
                          : std::clamp(stylus.altitude * unit, -std::numbers::pi / 2.0, std::numbers::pi / 2.0);
    stylus.azimuth *= unit;
    if (file.azimuth_from_north) stylus.azimuth = std::numbers::pi / 2.0 - stylus.azimuth;
    stylus.azimuth = std::remainder(stylus.azimuth, 2.0 * std::numbers::pi);
  });
}

// Time ----------------------------------------------------------------------------------------------------------------

/// Median interval between samples of a run whose times differ, in the file's units; 0 if there is none.
double median_interval(InkFile& file) {
  std::vector<double> intervals;
  constexpr std::size_t most = 1 << 20;
  for (const InkGroup& group : file.groups) {
    for (const InkRun& run : group.runs) {
      for (std::size_t i = 1; i < run.samples.size() && intervals.size() < most; ++i) {
        const double interval = run.samples[i].time - run.samples[i - 1].time;
        if (interval > 0.0) intervals.push_back(interval);
      }
    }
  }
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

void choose_time_unit(InkFile& file) {
  if (!std::isnan(file.time_unit)) return;
  const double interval = median_interval(file);
  constexpr std::pair<double, const char*> units[] = {{1.0, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}};
  const auto distance = [interval](double unit) { return std::abs(std::log(interval * unit / typical_interval)); };
  auto chosen = units[1];
  if (interval > 0.0) {
    for (const auto& unit : units) {
      if (distance(unit.first) < distance(chosen.first)) chosen = unit;
    }
  }
  file.time_unit = chosen.first;
  file.notes.push_back(std::string("times are taken to be in ") + chosen.second +
                       (interval > 0.0 ? ", by their intervals" : ""));
}

/// @throws FormatError if the time decreases within a run
void require_increasing(const InkFile& file, std::string_view name) {
  for (const InkGroup& group : file.groups) {
    for (const InkRun& run : group.runs) {
      for (std::size_t i = 1; i < run.samples.size(); ++i) {
        const double last = run.samples[i - 1].time, time = run.samples[i].time;
        if (time >= last) continue;
        fail_ink(name, place_of(file, group, run) + "sample " + std::to_string(i + 1) + ": the time decreases from " +
                           number_text(last) + " to " + number_text(time));
      }
    }
  }
}

/// Whether each run has a clock of its own. @throws FormatError if only a few do: something is wrong
bool are_chained(const InkFile& file, std::string_view name) {
  std::size_t pairs = 0, back = 0, starts = 0;
  const InkGroup* group_back = nullptr;
  const InkRun* run_back = nullptr;
  for (const InkGroup& group : file.groups) {
    for (std::size_t i = 1; i < group.runs.size(); ++i) {
      const double begin = group.runs[i].samples.front().time;
      ++pairs;
      starts += begin == group.runs[0].samples.front().time ? 1 : 0;
      if (begin >= group.runs[i - 1].samples.back().time) continue;
      if (back++ == 0) group_back = &group, run_back = &group.runs[i];
    }
  }
  if (back == 0) return false;
  if (2 * back >= pairs || starts == pairs) return true;
  fail_ink(name, place_of(file, *group_back, *run_back) + "the time decreases to " +
                     number_text(run_back->samples.front().time) + " from that of the stroke before");
}

void time_by_length(InkFile& file) {
  file.notes.push_back("there are no times: " + number_text(typical_speed) + " em/s and pauses of " +
                       number_text(typical_pause) + " s are assumed");
  for (InkGroup& group : file.groups) {
    double time = 0.0;
    const InkRun* last = nullptr;
    for (InkRun& run : group.runs) {
      if (last != nullptr && !last->in_air && !run.in_air) time += typical_pause;
      last = &run;
      for (std::size_t i = 0; i < run.samples.size(); ++i) {
        if (i > 0) time += (run.samples[i].point - run.samples[i - 1].point).norm() / typical_speed;
        run.samples[i].time = time;
      }
    }
  }
}

/// Times in seconds from 0; the points are in em already.
void set_times(InkFile& file, std::string_view name) {
  std::size_t known = 0, all = 0;
  each_sample(file, [&](const TimedPoint& sample, bool) {
    ++all;
    known += std::isnan(sample.time) ? 0 : 1;
  });
  if (known == 0) return time_by_length(file);
  if (known < all) fail_ink(name, std::to_string(all - known) + " of " + std::to_string(all) + " samples have no time");
  require_increasing(file, name);
  choose_time_unit(file);
  const bool chained = are_chained(file, name);
  if (chained) {
    file.notes.push_back("the clock begins anew in each stroke: they are strung together with pauses of " +
                         number_text(chained_pause) + " s");
  }
  for (InkGroup& group : file.groups) {
    double origin = group.runs.front().samples.front().time, begin = 0.0;
    for (InkRun& run : group.runs) {
      if (chained) origin = run.samples.front().time;
      for (TimedPoint& sample : run.samples) sample.time = begin + (sample.time - origin) * file.time_unit;
      if (chained) begin = run.samples.back().time + (run.in_air ? 0.0 : chained_pause);
    }
  }
}

// Places --------------------------------------------------------------------------------------------------------------

/// Places in em, with y up if that of the file points down.
void set_places(InkFile& file) {
  for (InkGroup& group : file.groups) {
    Point origin = Point::Zero();
    double side = group.square;
    if (std::isnan(side)) {
      Point low = Point::Constant(unlimited), high = -low;
      for (const InkRun& run : group.runs) {
        if (run.in_air) continue;
        for (const TimedPoint& sample : run.samples) {
          low = low.cwiseMin(sample.point);
          high = high.cwiseMax(sample.point);
        }
      }
      side = (high - low).maxCoeff() / writing_size;
      if (!(side > 0.0)) side = 1.0;  // a tap, of which only the place is known
      origin = (low + high) / 2.0 - Point::Constant(side / 2.0);
    }
    for (InkRun& run : group.runs) {
      for (TimedPoint& sample : run.samples) {
        sample.point = (sample.point - origin) / side;
        sample.point.y() = 1.0 - sample.point.y();
      }
    }
  }
}

void turn_as_needed(InkFile& file, std::vector<PenTrace>& traces, const InkOptions& options) {
  YAxis axis = file.usual;
  if (options.y_axis) {
    axis = *options.y_axis;
  } else if (file.declared) {
    axis = *file.declared;
  } else if (const std::optional<YAxis> seen = recognise_y_axis(traces)) {
    axis = *seen;
    file.notes.push_back(std::string("y points ") + to_string(axis) + ", as the writing shows");
  } else {
    file.notes.push_back(std::string("y is taken to point ") + to_string(axis) + ", as is usual of " +
                         to_string(file.format) + ": there is too little writing to tell; --y-axis decides");
  }
  if (axis == YAxis::up) std::for_each(traces.begin(), traces.end(), turn_over);
  if (file.azimuth_from_north || axis == YAxis::up) return;
  for (PenTrace& trace : traces) {  // from x towards y, which points down
    for (auto* const strokes : {&trace.strokes, &trace.air}) {
      for (PenStroke& stroke : *strokes) {
        for (TimedPoint& sample : stroke) {
          sample.stylus.azimuth = -sample.stylus.azimuth;
          sample.stylus.twist = -sample.stylus.twist;
        }
      }
    }
  }
}

// Characters ----------------------------------------------------------------------------------------------------------

bool is_han_or_kana(char32_t code) {
  return (code >= 0x2E80 && code <= 0x2FDF) || (code >= 0x3041 && code <= 0x9FFF) ||
         (code >= 0xF900 && code <= 0xFAFF) || (code >= 0x20000 && code <= 0x3FFFF);
}

/// U+6C38, u6c38 or 6c38; without a prefix only Chinese and Japanese characters, since other numbers are common.
char32_t code_in_word(std::string_view word) {
  const bool has_prefix = word.starts_with("U+") || word.starts_with("u+");
  if (has_prefix) word.remove_prefix(2);
  else if (word.starts_with('U') || word.starts_with('u')) word.remove_prefix(1);
  std::uint32_t code = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = from_chars(word.data(), end, code, 16);
  if (word.size() < 4 || word.size() > 6 || error != std::errc() || rest != end) return 0;
  if (has_prefix && code > 0x20 && code <= 0x10FFFF && !(code >= 0xD800 && code <= 0xDFFF)) return code;
  return is_han_or_kana(code) ? code : 0;
}

/// Empty if the label is not one character, itself or as U+6C38.
std::optional<TextCharacter> character_of_label(std::string_view label) {
  label = label.substr(0, 64);
  if (!is_utf8(label)) return std::nullopt;
  const bool may_be_code = label.starts_with('U') || label.starts_with('u');
  const char32_t code = may_be_code ? code_in_word(label) : 0;
  const std::vector<TextCharacter> characters = text_characters(code != 0 ? encode_utf8(code) : std::string(label));
  if (characters.size() != 1 || characters[0].written < 0x20 || characters[0].written == 0x7F) return std::nullopt;
  return characters[0];
}

/// Two bytes of GBK or Shift JIS may look like a letter of UTF-8 before those of Chinese and Japanese.
void note_foreign_label(char32_t code, std::vector<std::string>& notes) {
  constexpr char32_t last_ascii = 0x7F, first_radical = 0x2E80;
  if (code <= last_ascii || code >= first_radical) return;
  char number[16];
  std::snprintf(number, sizeof number, "U+%04X", static_cast<unsigned>(code));
  const std::string note =
      "the label '" + encode_utf8(code) + "' (" + number + ") is no Chinese character: is the file in UTF-8?";
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

std::size_t set_characters(InkFile& file, std::vector<PenTrace>& traces, std::string_view name,
                           const InkOptions& options) {
  std::size_t used = 0;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const std::string& label = file.groups[i].label;
    std::optional<TextCharacter> character = character_of_label(label);
    if (character) note_foreign_label(character->written, file.notes);
    if (!character && used < options.text.size()) character = options.text[used++];
    if (character) {
      traces[i].character = character->written;
      traces[i].selector = character->selector;
      continue;
    }
    if (traces.size() == 1) traces[i].character = character_in_name(name);
    if (traces[i].character != 0) continue;
    const std::string which =
        traces.size() == 1 ? "what was written" : "which its character " + std::to_string(i + 1) + " is";
    if (used > 0) {
      fail_ink(name, "--text has " + std::to_string(used) + (used == 1 ? " character" : " characters") +
                         " for this file, and more are needed: it does not say which its character " +
                         std::to_string(i + 1) + " is");
    }
    fail_ink(name, (label.empty() ? "does not say " + which
                                  : "the label '" + printable(label.substr(0, 40)) + "' is not one character") +
                       ": give the text that was written (--text), a character for each that no file names");
  }
  return used;
}

PenTrace trace_of_group(InkGroup& group, const std::string& set) {
  PenTrace trace;
  trace.set = set;
  const bool has_air =
      std::any_of(group.runs.begin(), group.runs.end(), [](const InkRun& run) { return run.in_air; });
  if (has_air) trace.air.emplace_back();
  for (InkRun& run : group.runs) {
    if (run.in_air) {
      PenStroke& air = trace.air.back();
      if (air.empty()) air = std::move(run.samples);
      else air.insert(air.end(), run.samples.begin(), run.samples.end());
    } else {
      trace.strokes.push_back(std::move(run.samples));
      if (has_air) trace.air.emplace_back();
    }
  }
  return trace;
}

void require_valid(const std::vector<PenTrace>& traces, std::string_view name) {
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const PenTrace& trace = traces[i];
    double last = 0.0;
    const auto check = [&](const PenStroke& stroke, const std::string& place) {
      for (const TimedPoint& sample : stroke) {
        const std::string fault = sample_fault(sample, last);
        if (!fault.empty()) fail_ink(name, "character " + std::to_string(i + 1) + ": " + place + " " + fault);
        last = sample.time;
      }
    };
    for (std::size_t stroke = 0; stroke < trace.strokes.size(); ++stroke) {
      const std::string number = std::to_string(stroke + 1);
      if (!trace.air.empty()) check(trace.air[stroke], "the air before stroke " + number);
      check(trace.strokes[stroke], "stroke " + number);
    }
    if (!trace.air.empty()) check(trace.air.back(), "the air after the last stroke");
  }
}

std::string_view stem_of(std::string_view name) {
  name.remove_prefix(name.find_last_of("/\\") + 1);
  return name.substr(0, std::max<std::size_t>(1, name.find('.', 1)));
}

}  // namespace

InkRun& add_run(InkGroup& group, bool in_air, std::string_view name) {
  if (group.runs.size() >= 2 * max_ink_strokes + 1) fail_ink(name, "a character has more than 1000 strokes");
  group.runs.push_back({{}, in_air});
  return group.runs.back();
}

void add_sample(InkRun& run, const TimedPoint& sample, std::string_view name) {
  if (run.samples.size() >= max_ink_points) fail_ink(name, "a stroke has more than 1000000 samples");
  run.samples.push_back(sample);
}

char32_t character_in_name(std::string_view name) {
  const std::string_view stem = stem_of(name);
  if (!is_utf8(stem)) return 0;
  std::u32string found = decode_utf8(stem);
  std::erase_if(found, [](char32_t code) { return !is_han_or_kana(code); });
  if (!found.empty()) return found.size() == 1 ? found[0] : 0;
  for (std::size_t at = 0; at < stem.size();) {
    const std::size_t end = std::min(stem.find_first_of("-_ ()", at), stem.size());
    if (const char32_t code = code_in_word(stem.substr(at, end - at)); code != 0) return code;
    at = end + 1;
  }
  return 0;
}

std::string word_of_name(std::string_view name) {
  std::string word = printable(stem_of(name));
  std::replace_if(word.begin(), word.end(), [](char c) { return static_cast<unsigned char>(c) <= 0x20; }, '-');
  return word.empty() ? "ink" : word;
}

InkImport traces_of(InkFile file, std::string_view name, const InkOptions& options) {
  drop_empty(file, name);
  scale_pressure(file, name);
  scale_angles(file, name);
  set_places(file);
  set_times(file, name);
  InkImport import{file.format, {}, {}, 0};
  const std::string set = options.set.empty() ? word_of_name(name) : options.set;
  for (InkGroup& group : file.groups) {
    import.traces.push_back(trace_of_group(group, set));
    if (import.traces.back().strokes.size() > max_ink_strokes) fail_ink(name, "a character has more than 1000 strokes");
  }
  import.text_used = set_characters(file, import.traces, name, options);
  turn_as_needed(file, import.traces, options);
  require_valid(import.traces, name);
  import.notes = std::move(file.notes);
  return import;
}

}  // namespace calligraphy
