#include <calligraphy/render/option_values.hpp>

#include <system_error>
#include <type_traits>

#include <calligraphy/base/error.hpp>

#include "base/charconv.hpp"
#include "base/enum_name.hpp"
#include "base/line_reader.hpp"
#include "base/require.hpp"

namespace calligraphy {
namespace {

// each_field() calls `visit(name, field)` for every field of a struct. Its first line compiles only with as many names
// as the struct has fields, so that none is forgotten here when one is added there.

template <class Visit>
void each_field(NearestPointOptions& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c, d] = o;
  visit("method", o.method);
  visit("tolerance", o.tolerance);
  visit("samples", o.samples);
  visit("refinements", o.refinements);
}

template <class Visit>
void each_field(FrictionOptions& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c] = o;
  visit("coefficient", o.coefficient);
  visit("stiffness", o.stiffness);
  visit("damping", o.damping);
}

template <class Visit>
void each_field(PaperOptions& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c, d] = o;
  visit("stiffness", o.stiffness);
  visit("damping", o.damping);
  visit("onset", o.onset);
  visit("friction", o.friction);
}

template <class Visit>
void each_field(ConstraintSpace& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b] = o;
  visit("radius", o.radius);
  visit("fade_width", o.fade_width);
}

template <class Visit>
void each_field(AssistPolicy& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c, d] = o;
  visit("enabled", o.enabled);
  visit("retention", o.retention);
  visit("full_assistance_error", o.full_assistance_error);
  visit("min_assistance", o.min_assistance);
}

template <class Visit>
void each_field(GuidanceOptions& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = o;
  visit("stiffness", o.stiffness);
  visit("damping", o.damping);
  visit("force", o.force);
  visit("limit", o.limit);
  visit("to_start", o.to_start);
  visit("space", o.space);
  visit("fade_in", o.fade_in);
  visit("fade_out", o.fade_out);
  visit("wrong_way_stiffness", o.wrong_way_stiffness);
  visit("wrong_way_limit", o.wrong_way_limit);
  visit("wrong_way_slack", o.wrong_way_slack);
  visit("assist", o.assist);
}

template <class Visit>
void each_field(ContactOptions& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c, d] = o;
  visit("lift_time", o.lift_time);
  visit("lift_clearance", o.lift_clearance);
  visit("lift_between_strokes", o.lift_between_strokes);
  visit("box_margin", o.box_margin);
}

template <class Visit>
void each_field(StrokeTolerances& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h] = o;
  visit("start_distance", o.start_distance);
  visit("direction", o.direction);
  visit("first_stretch", o.first_stretch);
  visit("distinction", o.distinction);
  visit("corridor", o.corridor);
  visit("coverage", o.coverage);
  visit("slack", o.slack);
  visit("next_decides", o.next_decides);
}

template <class Visit>
void each_field(ForceLimits& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c, d, e, f] = o;
  visit("in_plane_rate", o.in_plane_rate);
  visit("normal_rate", o.normal_rate);
  visit("thermal_time_constant", o.thermal_time_constant);
  visit("max_speed", o.max_speed);
  visit("max_acceleration", o.max_acceleration);
  visit("max_standstill", o.max_standstill);
}

template <class Visit>
void each_field(EnergyOptions& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b] = o;
  visit("budget", o.budget);
  visit("max_gap", o.max_gap);
}

template <class Visit>
void each_field(RendererOptions& o, const Visit& visit) {
  [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = o;
  visit("servo_rate", o.servo_rate);
  visit("rules", o.rules);
  visit("stiffness_check", o.stiffness_check);
  visit("nearest", o.nearest);
  visit("velocity_cutoff", o.velocity_cutoff);
  visit("grip_stiffness", o.grip_stiffness);
  visit("paper", o.paper);
  visit("guidance", o.guidance);
  visit("contact", o.contact);
  visit("tolerances", o.tolerances);
  visit("limits", o.limits);
  visit("energy", o.energy);
}

/// Calls `visit(name, option)` for every option of the struct and of those in it.
template <class Options, class Visit>
void each_option(const std::string& prefix, Options& options, const Visit& visit) {
  each_field(options, [&](const char* name, auto& field) {
    using Field = std::remove_reference_t<decltype(field)>;
    if constexpr (std::is_arithmetic_v<Field> || std::is_enum_v<Field> || std::is_same_v<Field, GuidanceFactory>) {
      visit(prefix + name, field);
    } else {
      each_option(prefix + name + ".", field, visit);
    }
  });
}

const char* word_for(Rules rules) noexcept {
  static constexpr const char* names[] = {"revised", "wang2006"};
  return name_of<Rules::wang2006>(rules, names, "");
}

const char* word_for(StiffnessCheck check) noexcept {
  static constexpr const char* names[] = {"reject", "clip", "off"};
  return name_of<StiffnessCheck::off>(check, names, "");
}

const char* word_for(NearestPointMethod method) noexcept { return to_string(method); }

const char* word_for(bool value) noexcept { return value ? "true" : "false"; }

std::string word_for(double value) { return number_text(value); }

std::string word_for(int value) {
  char text[16];
  return {text, to_chars(text, text + sizeof text, value).ptr};
}

struct Law {
  const char* name;
  GuidanceFactory::Make* make;
};

/// Every built-in law.
constexpr Law built_in_laws[] = {
    {"linear", linear_guidance}, {"saturating", saturating_guidance}, {"wang2006", printed_guidance}};

constexpr const char* own_law = "own";

const char* word_for(const GuidanceFactory& factory) noexcept {
  for (const Law& law : built_in_laws) {
    if (factory.is(law.make)) return law.name;
  }
  return own_law;
}

// read() sets an option and returns what else the word should have been, "" if it was right.

template <class Number>
requires(std::is_same_v<Number, double> || std::is_same_v<Number, int>)
std::string read(std::string_view word, Number& option) {
  Number value = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = from_chars(word.data(), end, value);
  if (error != std::errc() || rest != end) return std::is_same_v<Number, int> ? "an integer" : "a number";
  option = value;
  return "";
}

std::string read(std::string_view word, bool& option) {
  if (word != word_for(true) && word != word_for(false)) return "true or false";
  option = word == word_for(true);
  return "";
}

template <class Enumeration>
requires std::is_enum_v<Enumeration>
std::string read(std::string_view word, Enumeration& option) {
  std::string others = "one of";
  for (int i = 0;; ++i) {
    const auto value = static_cast<Enumeration>(i);
    const std::string name = word_for(value);
    if (name.empty()) return others;  // after the last one
    if (word == name) {
      option = value;
      return "";
    }
    others += (i > 0 ? ", " : " ") + name;
  }
}

std::string read(std::string_view word, GuidanceFactory& option) {
  std::string others = "one of";
  for (const Law& law : built_in_laws) {
    if (word == law.name) {
      option = law.make;
      return "";
    }
    others += (&law != built_in_laws ? ", " : " ") + std::string(law.name);
  }
  if (word == own_law) others += "; that law is the program's own, and only that program can set it";
  return others;
}

}  // namespace

std::vector<OptionValue> option_values(const RendererOptions& options) {
  std::vector<OptionValue> values;
  RendererOptions copy = options;
  each_option("", copy,
              [&](const std::string& name, const auto& option) { values.push_back({name, word_for(option)}); });
  return values;
}

void set_option(RendererOptions& options, std::string_view name, std::string_view value) {
  bool found = false;
  each_option("", options, [&](const std::string& own_name, auto& option) {
    if (own_name != name) return;
    found = true;
    const std::string expected = read(value, option);
    if (!expected.empty()) throw ValueError(own_name + " = " + in_quotes(value) + ": expected " + expected);
  });
  if (!found) throw ValueError("no option of the renderer is called " + in_quotes(name));
}

}  // namespace calligraphy
