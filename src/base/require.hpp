// Checks of arguments and options: every number out of its domain is reported in the same words.
#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <string_view>

namespace calligraphy {

inline constexpr double unlimited = std::numeric_limits<double>::max();

/// For messages: the fewest digits that read back as the same number.
std::string number_text(double value);

/// A message put together by <<, with numbers to six digits: as an ostringstream, without the locales that come with
/// one, which are a fifth of a WebAssembly module.
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

/// @throws ValueError "NAME = VALUE UNIT, must be DOMAIN" unless `in_domain`; the value has as many digits as it takes
/// to read it back. No unit: an empty one.
void require(bool in_domain, std::string_view name, double value, std::string_view unit, std::string_view domain);

/// The domains of most numbers, all of them finite. @throws ValueError as above
void require_above_zero(std::string_view name, double value, std::string_view unit, double most = unlimited);
void require_not_negative(std::string_view name, double value, std::string_view unit);
/// With a `reason`, that follows the domain.
void require_within(std::string_view name, double value, std::string_view unit, double least, double most,
                    std::string_view reason = {});

}  // namespace calligraphy
