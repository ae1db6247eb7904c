#include "require.hpp"

#include <cmath>
#include <cstdio>

#include <calligraphy/base/error.hpp>

#include "charconv.hpp"

namespace calligraphy {

std::string number_text(double value) {
  char buffer[40];
  char* const end = buffer + sizeof buffer;
  const bool is_round = std::abs(value) < 1e7 && value == std::floor(value);  // 100000, not 1e+05
  return {buffer, (is_round ? to_chars_fixed(buffer, end, value, 0) : to_chars(buffer, end, value)).ptr};
}

Message& Message::operator<<(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%g", value);
  return *this << std::string_view(digits);
}

void require(bool in_domain, std::string_view name, double value, std::string_view unit, std::string_view domain) {
  if (in_domain) return;
  std::string message(name);
  message.append(" = ").append(number_text(value));
  if (!unit.empty()) message.append(" ").append(unit);
  throw ValueError(message.append(", must be ").append(domain));
}

void require_above_zero(std::string_view name, double value, std::string_view unit, double most) {
  if (value > 0.0 && value <= most) return;
  require(false, name, value, unit,
          most == unlimited ? "finite and above 0" : "above 0 and at most " + number_text(most));
}

void require_not_negative(std::string_view name, double value, std::string_view unit) {
  require(std::isfinite(value) && value >= 0.0, name, value, unit, "finite and at least 0");
}

void require_within(std::string_view name, double value, std::string_view unit, double least, double most,
                    std::string_view reason) {
  if (value >= least && value <= most) return;
  std::string domain = "from " + number_text(least) + " to " + number_text(most);
  if (!reason.empty()) domain.append(": ").append(reason);
  require(false, name, value, unit, domain);
}

}  // namespace calligraphy
