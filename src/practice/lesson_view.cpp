#include <calligraphy/practice/lesson_view.hpp>

#include "base/enum_name.hpp"

namespace calligraphy {

const char* to_string(StrokeFate fate) noexcept {
  static constexpr const char* names[] = {"open", "accepted", "skipped", "refused", "ignored"};
  return name_of<StrokeFate::ignored>(fate, names, "");
}

}  // namespace calligraphy
