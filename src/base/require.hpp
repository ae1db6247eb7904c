// Checks arguments and options, and reports every number outside its domain in the same words.
#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <string_view>

namespace calligraphy {

inline constexpr double unlimited = std::numeric_limits<double>::max();

/// The number in the fewest digits that read back as the same number, for messages.
std::string number_text(double value);

/// A message composed with <<, numbers to six digits. Replaces ostringstream, whose locales make up a fifth of a
/// WebAssembly module.
class Message {
 public:
  Message& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  Message& operator<<(double value);
  template <std::integral Integer>
  Message& operator<<(Integer value) {
    return *this << std::string_view(std::to_string(value));
  }
  const std::string& str() const noexcept { return text_; }

 private:
  std::string text_;
};

/// @throws ValueError "NAME = VALUE UNIT, must be DOMAIN" unless `in_domain`; the value is printed with enough digits
/// to read it back. An empty unit is omitted.
void require(bool in_domain, std::string_view name, double value, std::string_view unit, std::string_view domain);

/// Checks for the most common domains, all of finite numbers. @throws ValueError as above
void require_above_zero(std::string_view name, double value, std::string_view unit, double most = unlimited);
void require_not_negative(std::string_view name, double value, std::string_view unit);
/// The `reason`, if any, follows the domain.
void require_within(std::string_view name, double value, std::string_view unit, double least, double most,
                    std::string_view reason = {});

}  // namespace calligraphy
