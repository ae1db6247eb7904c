#include <calligraphy/practice/feedback_mode.hpp>

namespace calligraphy {

const char* to_string(FeedbackMode mode) noexcept { return mode == FeedbackMode::vision ? "vision" : "force"; }

}  // namespace calligraphy
