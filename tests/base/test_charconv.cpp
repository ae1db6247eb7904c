#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include <calligraphy/base/random.hpp>

#include "../catch.hpp"
#include "base/charconv.hpp"
#include "base/charconv_by_libc.hpp"

namespace {

template <typename Number>
struct Parsed {
  Number value = -7;
  std::size_t size = 0;
  std::errc error = {};
};

enum class By { library, libc };

template <typename Number = double>
Parsed<Number> parse(By by, const std::string& text) {
  Parsed<Number> parsed;
  const char *const begin = text.data(), *const end = begin + text.size();
  const auto [rest, error] = by == By::library ? calligraphy::from_chars(begin, end, parsed.value)
                                               : calligraphy::by_libc::from_chars(begin, end, parsed.value);
  parsed.size = static_cast<std::size_t>(rest - begin);
  parsed.error = error;
  return parsed;
}

template <typename Number>
std::string text_of(By by, Number value) {
  char text[64];
  const auto [end, error] = by == By::library ? calligraphy::to_chars(text, text + sizeof text, value)
                                              : calligraphy::by_libc::to_chars(text, text + sizeof text, value);
  return error == std::errc() ? std::string(text, end) : "too long";
}

}  // namespace

// Expected values: the C++ standard, [charconv.from.chars] and [charconv.to.chars].

TEST_CASE("numbers are read to the last bit, as far as they go", "[base]") {
  const By by = GENERATE(By::library, By::libc);
  CHECK(parse(by, "0.1").value == 0.1);
  CHECK(parse(by, "-12.5e-3mm").value == -0.0125);
  CHECK(parse(by, "-12.5e-3mm").size == 8);
  CHECK(parse(by, ".5").value == 0.5);
  CHECK(parse(by, "5.").value == 5.0);
  CHECK(parse(by, "0").value == 0.0);
  CHECK(std::signbit(parse(by, "-0.0").value));
  CHECK(parse(by, "1e").size == 1);
  CHECK(parse(by, "1e+").size == 1);
  CHECK(parse(by, "1-2").size == 1);
  CHECK(parse(by, "1,5").value == 1.0);
  CHECK(parse(by, "1.7976931348623157e308").value == std::numeric_limits<double>::max());
  CHECK(parse(by, "5e-324").value == std::numeric_limits<double>::denorm_min());
  CHECK(parse(by, "9007199254740993").value == 9007199254740992.0);  // a tie: to even
  CHECK(parse<float>(by, "0.1").value == 0.1f);
  CHECK(parse<float>(by, "16777217.00000000001").value == 16777218.0f);  // rounded once
}

TEST_CASE("what from_chars does not take is no number", "[base]") {
  const By by = GENERATE(By::library, By::libc);
  for (const char* text : {"", "-", "+1", " 1", "--1", ".", "-.", "e5", "x", "abc", "\t1", "-+1"}) {
    CAPTURE(text);
    CHECK(parse(by, text).error == std::errc::invalid_argument);
    CHECK(parse(by, text).size == 0);
    CHECK(parse(by, text).value == -7.0);
  }
  CHECK(parse(by, "0x10").value == 0.0);
  CHECK(parse(by, "0x10").size == 1);
}

TEST_CASE("numbers that do not fit are told, and infinities are numbers", "[base]") {
  const By by = GENERATE(By::library, By::libc);
  for (const char* text : {"1e999", "-1e999", "1e-999"}) {
    CAPTURE(text);
    CHECK(parse(by, text).error == std::errc::result_out_of_range);
    CHECK(parse(by, text).value == -7.0);
    CHECK(parse(by, text).size == std::string(text).size());
  }
  CHECK(parse(by, "0e999").value == 0.0);
  CHECK(parse<float>(by, "1e39").error == std::errc::result_out_of_range);
  CHECK(parse(by, "-inf").value == -std::numeric_limits<double>::infinity());
  CHECK(parse(by, "infinity").size == 8);
  CHECK(std::isnan(parse(by, "nan").value));
}

TEST_CASE("numbers are written as short as they read back, in the shorter notation", "[base]") {
  const By by = GENERATE(By::library, By::libc);
  CHECK(text_of(by, 0.1) == "0.1");
  CHECK(text_of(by, -0.0) == "-0");
  CHECK(text_of(by, 12.0) == "12");
  CHECK(text_of(by, 1000.0) == "1000");
  CHECK(text_of(by, 100000.0) == "1e+05");
  CHECK(text_of(by, 123456.0) == "123456");
  CHECK(text_of(by, 0.0001) == "1e-04");
  CHECK(text_of(by, 0.00012) == "0.00012");
  CHECK(text_of(by, 1.0 / 3.0) == "0.3333333333333333");
  CHECK(text_of(by, 0.1f) == "0.1");
  CHECK(text_of(by, 5e-324) == "5e-324");
  CHECK(text_of(by, 1.7976931348623157e308) == "1.7976931348623157e+308");
  CHECK(text_of(by, std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("libc's conversions are those of the standard library", "[base]") {
  calligraphy::Random random(7);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t bits = random.bits();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    if (i % 2 == 0) value = std::ldexp(std::round(random.between(-1e5, 1e5)), static_cast<int>(random.index(20)) - 10);
    const std::string text = text_of(By::library, value);
    REQUIRE(text_of(By::libc, value) == text);
    REQUIRE(parse(By::libc, text).value == value);
    REQUIRE(text_of(By::libc, static_cast<float>(i) / 7.0f) == text_of(By::library, static_cast<float>(i) / 7.0f));
    char fixed[2][400];
    const auto end = calligraphy::to_chars_fixed(fixed[0], fixed[0] + 400, value, 6).ptr;
    const auto end_by_libc = calligraphy::by_libc::to_chars_fixed(fixed[1], fixed[1] + 400, value, 6).ptr;
    REQUIRE(std::string(fixed[0], end) == std::string(fixed[1], end_by_libc));
  }
}
