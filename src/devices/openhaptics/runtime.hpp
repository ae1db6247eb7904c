// The vendor's runtime, shared by all devices of a process; once loaded, it stays.
#pragma once

#include <memory>
#include <string>

#include "hdapi.hpp"

namespace calligraphy::hdapi {

class Runtime {
 public:
  /// Returns the runtime, loading it if necessary. For an empty name see OpenHapticsOptions::library.
  /// @throws DeviceError naming what was tried or what is missing, with a remedy
  static std::shared_ptr<Runtime> load(const std::string& name);

  /// Takes the handle returned by dlopen().
  Runtime(void* file, std::string library);
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  const Functions& functions() const noexcept { return functions_; }
  const std::string& library() const noexcept { return library_; }

  /// The first user starts the scheduler, the last one stops it. @throws DeviceError when it does not start
  void use_scheduler();
  void leave_scheduler() noexcept;
  bool scheduler_runs() const;

  /// Fetches all pending errors, and describes those that count: "HD error 0x0301: text"; empty if there are none.
  std::string take_errors(bool (*counts)(ErrorCode) noexcept = [](ErrorCode) noexcept { return true; }) const;

 private:
  std::string library_;
  Functions functions_ = {};
  int users_ = 0;  ///< users of the scheduler
};

}  // namespace calligraphy::hdapi
