// Tells on standard error what the person who holds a device has to do, whenever that changes.
#pragma once

#include <string>

#include <spdlog/spdlog.h>

namespace calligraphy::tools {

class AdviceTeller {
 public:
  /// Whether the advice is another one than before, and there is one.
  bool look(const std::string& advice) {
    if (advice == told_) return false;
    if (advice.empty()) {
      spdlog::info("no longer: {}", told_.substr(0, told_.find(':')));
    } else {
      spdlog::warn("{}", advice);
    }
    told_ = advice;
    return !advice.empty();
  }

 private:
  std::string told_;
};

}  // namespace calligraphy::tools
