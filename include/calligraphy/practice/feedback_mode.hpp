// What a writer feels in a session.
#pragma once

namespace calligraphy {

/// The two modes of the paper's experiment (sec. 7.1).
enum class FeedbackMode {
  vision,  ///< vision alone: the device receives zero instead of the renderer's force
  force    ///< vision and force
};

/// "vision", "force".
const char* to_string(FeedbackMode mode) noexcept;

}  // namespace calligraphy
