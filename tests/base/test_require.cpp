// Claims about require: a number out of its domain is reported in one grammar, NAME = VALUE UNIT, must be DOMAIN.
#include "../catch.hpp"

#include <cstdlib>
#include <limits>
#include <string>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"

using namespace calligraphy;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The message of the ValueError that `check` throws; "" if it throws none.
template <typename Check>
std::string error_of_require(const Check& check) {
  try {
    check();
  } catch (const ValueError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a number out of its domain is named with value, unit and domain", "[base]") {
  CHECK(error_of_require([] { require(true, "rate", 0.0, "Hz", "above 0"); }).empty());
  CHECK(error_of_require([] { require(false, "rate", 0.0, "Hz", "above 0"); }) == "rate = 0 Hz, must be above 0");
  CHECK(error_of_require([] { require(false, "scale", -2, "", "above 0"); }) == "scale = -2, must be above 0");
}

TEST_CASE("the value of a message reads back as the number that was refused", "[base]") {
  const auto text = [](double value) {
    const std::string found = error_of_require([=] { require(false, "x", value, "", "y"); });
    return found.substr(4, found.find(',') - 4);
  };
  CHECK(text(100000.0) == "100000");
  CHECK(text(0.1) == "0.1");
  CHECK(text(-0.0) == "-0");
  CHECK(text(2147483654.0) == "2147483654");
  CHECK(text(1e12) == "1e+12");
  CHECK(text(infinity) == "inf");
  CHECK(text(not_a_number) == "nan");
  for (const double value : {1.0 / 3.0, 600.0 + 1e-13, 5e-324, 1.7976931348623157e308, 123456789.125, 9999999.0}) {
    CHECK(std::strtod(text(value).c_str(), nullptr) == value);
    CHECK(std::strtod(text(-value).c_str(), nullptr) == -value);
  }
}

TEST_CASE("each domain has its bounds, holds no infinity and takes no NaN for a number", "[base]") {
  const auto above = [](double value, double most) {
    return error_of_require([=] { require_above_zero("x", value, "m", most); });
  };
  const auto not_negative = [](double value) { return error_of_require([=] { require_not_negative("x", value, "m"); }); };
  const auto within = [](double value) { return error_of_require([=] { require_within("x", value, "m", -0.5, 2.0); }); };
  for (const double good : {5e-324, 1.0, 1.7976931348623157e308}) {
    CHECK(above(good, unlimited).empty());
    CHECK(not_negative(good).empty());
  }
  CHECK(above(3.0, 3.0).empty());
  CHECK(not_negative(0.0).empty());
  CHECK(within(-0.5).empty());
  CHECK(within(2.0).empty());

  CHECK(above(0.0, unlimited) == "x = 0 m, must be finite and above 0");
  CHECK(above(3.5, 3.0) == "x = 3.5 m, must be above 0 and at most 3");
  CHECK(not_negative(-5e-324) == "x = -5e-324 m, must be finite and at least 0");
  CHECK(within(2.25) == "x = 2.25 m, must be from -0.5 to 2");
  CHECK(within(-0.75) == "x = -0.75 m, must be from -0.5 to 2");
  for (const double bad : {infinity, -infinity, not_a_number}) {
    CHECK_FALSE(above(bad, unlimited).empty());
    CHECK_FALSE(not_negative(bad).empty());
    CHECK_FALSE(within(bad).empty());
  }
}
