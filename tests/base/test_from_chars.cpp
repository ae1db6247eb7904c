#include <cmath>
#include <limits>
#include <string>

#include "../catch.hpp"
#include "base/from_chars.hpp"

using calligraphy::from_chars;

namespace {

template <typename Number>
struct Parsed {
  Number value = -7;
  std::size_t size = 0;
  std::errc error = {};
};

template <typename Number = double>
Parsed<Number> parse(const std::string& text) {
  Parsed<Number> parsed;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), parsed.value);
  parsed.size = static_cast<std::size_t>(end - text.data());
  parsed.error = error;
  return parsed;
}

}  // namespace

// Expected values: the C++ standard, [charconv.from.chars].

TEST_CASE("numbers are read to the last bit, as far as they go", "[base]") {
  CHECK(parse("0.1").value == 0.1);
  CHECK(parse("-12.5e-3mm").value == -0.0125);
  CHECK(parse("-12.5e-3mm").size == 8);
  CHECK(parse(".5").value == 0.5);
  CHECK(parse("5.").value == 5.0);
  CHECK(parse("0").value == 0.0);
  CHECK(std::signbit(parse("-0.0").value));
  CHECK(parse("1e").size == 1);
  CHECK(parse("1e+").size == 1);
  CHECK(parse("1-2").size == 1);
  CHECK(parse("1,5").value == 1.0);
  CHECK(parse("1.7976931348623157e308").value == std::numeric_limits<double>::max());
  CHECK(parse("5e-324").value == std::numeric_limits<double>::denorm_min());
  CHECK(parse("9007199254740993").value == 9007199254740992.0);  // a tie: to even
  CHECK(parse<float>("0.1").value == 0.1f);
  CHECK(parse<float>("16777217.00000000001").value == 16777218.0f);  // rounded once
  CHECK(parse<int>("-12x").value == -12);
}

TEST_CASE("what from_chars does not take is no number here, either", "[base]") {
  for (const char* text : {"", "-", "+1", " 1", "--1", ".", "-.", "e5", "x", "abc", "\t1", "-+1"}) {
    CAPTURE(text);
    CHECK(parse(text).error == std::errc::invalid_argument);
    CHECK(parse(text).size == 0);
    CHECK(parse(text).value == -7.0);
  }
  CHECK(parse("0x10").value == 0.0);
  CHECK(parse("0x10").size == 1);
}

TEST_CASE("numbers that do not fit are told, and infinities are numbers", "[base]") {
  for (const char* text : {"1e999", "-1e999", "1e-999"}) {
    CAPTURE(text);
    CHECK(parse(text).error == std::errc::result_out_of_range);
    CHECK(parse(text).value == -7.0);
    CHECK(parse(text).size == std::string(text).size());
  }
  CHECK(parse("0e999").value == 0.0);
  CHECK(parse<float>("1e39").error == std::errc::result_out_of_range);
  CHECK(parse("-inf").value == -std::numeric_limits<double>::infinity());
  CHECK(parse("infinity").size == 8);
  CHECK(std::isnan(parse("nan").value));
}
