// Every option of a renderer has a name, by which it can be written down and set again.
#include "../catch.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/render/option_values.hpp>

using namespace calligraphy;

namespace {

/// The value of an option, or "" if there is none of this name.
std::string value_of(const RendererOptions& options, const std::string& name) {
  for (const OptionValue& option : option_values(options)) {
    if (option.name == name) return option.value;
  }
  return "";
}

/// Options that agree in nothing with the defaults that are to be set again.
RendererOptions all_different() {
  RendererOptions options;
  int i = 0;
  for (const auto& [name, value] : option_values(RendererOptions())) {
    ++i;
    for (const char* other : {"false", "true", "wang2006", "off", "saturating"}) {
      try {
        set_option(options, name, other);
        if (value_of(options, name) != value) break;
      } catch (const ValueError&) {  // not of this kind
      }
    }
    if (value_of(options, name) == value) set_option(options, name, std::to_string(100 + i));
    // A number with as many digits as there can be, if it is no integer.
    try {
      if (value_of(options, name) == std::to_string(100 + i)) {
        set_option(options, name, std::to_string(i) + ".1234567890123456");
      }
    } catch (const ValueError&) {
    }
  }
  return options;
}

RendererOptions restored(const RendererOptions& options) {
  RendererOptions result = all_different();
  for (const auto& [name, value] : option_values(options)) set_option(result, name, value);
  return result;
}

std::string complaint(const std::string& name, const std::string& value) {
  RendererOptions options;
  try {
    set_option(options, name, value);
  } catch (const ValueError& error) {
    CHECK(option_values(options) == option_values(RendererOptions()));
    return error.what();
  }
  return "";
}

/// Every number that is read from its name in C++, by the name.
struct Named {
  const char* name;
  double& (*of)(RendererOptions&);
};

#define NAMED(path) \
  { #path, [](RendererOptions& options) -> double& { return options.path; } }

constexpr Named numbers[] = {NAMED(servo_rate),
                             NAMED(nearest.tolerance),
                             NAMED(velocity_cutoff),
                             NAMED(grip_stiffness),
                             NAMED(paper.stiffness),
                             NAMED(paper.damping),
                             NAMED(paper.onset),
                             NAMED(paper.friction.coefficient),
                             NAMED(paper.friction.stiffness),
                             NAMED(paper.friction.damping),
                             NAMED(guidance.stiffness),
                             NAMED(guidance.damping),
                             NAMED(guidance.limit),
                             NAMED(guidance.space.radius),
                             NAMED(guidance.space.fade_width),
                             NAMED(guidance.fade_in),
                             NAMED(guidance.fade_out),
                             NAMED(guidance.wrong_way_stiffness),
                             NAMED(guidance.wrong_way_limit),
                             NAMED(guidance.wrong_way_slack),
                             NAMED(guidance.assist.retention),
                             NAMED(guidance.assist.full_assistance_error),
                             NAMED(guidance.assist.min_assistance),
                             NAMED(contact.lift_time),
                             NAMED(contact.lift_clearance),
                             NAMED(contact.box_margin),
                             NAMED(tolerances.start_distance),
                             NAMED(tolerances.direction),
                             NAMED(tolerances.first_stretch),
                             NAMED(tolerances.distinction),
                             NAMED(tolerances.corridor),
                             NAMED(tolerances.coverage),
                             NAMED(tolerances.slack),
                             NAMED(limits.in_plane_rate),
                             NAMED(limits.normal_rate),
                             NAMED(limits.thermal_time_constant),
                             NAMED(limits.max_speed),
                             NAMED(limits.max_acceleration),
                             NAMED(limits.max_standstill),
                             NAMED(energy.budget),
                             NAMED(energy.max_gap)};
#undef NAMED

}  // namespace

TEST_CASE("every number among the options is called as in C++ and read back to the last bit") {
  int number_options = 0;
  for (const auto& [name, value] : option_values(RendererOptions())) {
    number_options += value == "inf" || (value.find_first_not_of("0123456789.e+-") == std::string::npos);
  }
  CHECK(number_options == static_cast<int>(std::size(numbers)) + 2);  // the two integers of `nearest`
  for (const Named& number : numbers) {
    CAPTURE(number.name);
    for (const double value : {0.1 + 0.2, -1.0 / 3.0, 5e-324, 1.7976931348623157e308, 1e22, 123456789012345680.0, -0.0,
                               std::numeric_limits<double>::infinity()}) {
      RendererOptions options, again;
      number.of(options) = value;
      set_option(again, number.name, value_of(options, number.name));
      CHECK(number.of(again) == value);
      CHECK(std::signbit(number.of(again)) == std::signbit(value));
      CHECK(option_values(again) == option_values(options));
    }
  }
}

TEST_CASE("options differ from the defaults in every value once every value was set to another") {
  const std::vector<OptionValue> plain = option_values(RendererOptions()), other = option_values(all_different());
  REQUIRE(plain.size() == other.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    CAPTURE(plain[i].name);
    CHECK(plain[i].name == other[i].name);
    CHECK(plain[i].value != other[i].value);
  }
}

TEST_CASE("every set of options is restored from its words") {
  std::vector<RendererOptions> all = {RendererOptions(), RendererOptions::wang2006(), all_different()};
  for (const Capabilities& profile : device_profiles()) {
    for (const double scale : {1.0, 1.0 / 3.0}) {
      all.push_back(RendererOptions::for_device(profile, scale));
      all.push_back(RendererOptions::everything(profile, scale));
    }
  }
  for (RendererOptions& options : all) {
    RendererOptions again = restored(options);
    CHECK(option_values(again) == option_values(options));
    for (const Named& number : numbers) CHECK(number.of(again) == number.of(options));
    CHECK(again.rules == options.rules);
    CHECK(again.stiffness_check == options.stiffness_check);
    CHECK(again.nearest.method == options.nearest.method);
    CHECK(again.nearest.samples == options.nearest.samples);
    CHECK(again.nearest.refinements == options.nearest.refinements);
    CHECK(again.guidance.to_start == options.guidance.to_start);
    CHECK(again.guidance.assist.enabled == options.guidance.assist.enabled);
    CHECK(again.contact.lift_between_strokes == options.contact.lift_between_strokes);
    for (const auto law : {linear_guidance, saturating_guidance, printed_guidance}) {
      CHECK(again.guidance.force.is(law) == options.guidance.force.is(law));
    }
  }
}

TEST_CASE("options are words that a person can read") {
  const RendererOptions options;
  CHECK(value_of(options, "guidance.stiffness") == "600");
  CHECK(value_of(options, "guidance.force") == "linear");
  CHECK(value_of(RendererOptions::wang2006(), "guidance.force") == "wang2006");
  CHECK(value_of(RendererOptions::wang2006(), "stiffness_check") == "off");
  CHECK(value_of(options, "nearest.method") == "tracked");
  CHECK(value_of(options, "nearest.tolerance") == "1e-09");
  CHECK(value_of(options, "contact.lift_between_strokes") == "true");
  CHECK(value_of(options, "energy.budget") == "inf");
  CHECK(option_values(options).front().name == "servo_rate");
  CHECK(option_values(options).back().name == "energy.max_gap");
}

TEST_CASE("a law of the program's own is said to be that, and cannot be set by its name") {
  RendererOptions options;
  options.guidance.force = [](const GuidanceInput& input) -> Point { return input.way; };
  CHECK(value_of(options, "guidance.force") == "own");
  CHECK(complaint("guidance.force", "own") ==
        "guidance.force = 'own': expected one of linear, saturating, wang2006; that law is the program's own, and "
        "only that program can set it");
}

TEST_CASE("an unknown option and a wrong value are named") {
  CHECK(complaint("guidance.strength", "1") == "no option of the renderer is called 'guidance.strength'");
  CHECK(complaint("guidance", "1") == "no option of the renderer is called 'guidance'");
  CHECK(complaint("", "1") == "no option of the renderer is called ''");
  for (const char* wrong : {"", " 1", "1 ", "1,5", "0x10", "+1", "1e999", "stiff", "1\n"}) {
    CAPTURE(wrong);
    CHECK(complaint("guidance.stiffness", wrong).find("guidance.stiffness = ") == 0);
  }
  CHECK(complaint("guidance.stiffness", "1,5") == "guidance.stiffness = '1,5': expected a number");
  CHECK(complaint("nearest.samples", "1.5") == "nearest.samples = '1.5': expected an integer");
  CHECK(complaint("guidance.to_start", "1") == "guidance.to_start = '1': expected true or false");
  CHECK(complaint("stiffness_check", "Off") == "stiffness_check = 'Off': expected one of reject, clip, off");
  CHECK(complaint("rules", "") == "rules = '': expected one of revised, wang2006");
  CHECK(complaint("guidance.force", "quadratic") ==
        "guidance.force = 'quadratic': expected one of linear, saturating, wang2006");
}
