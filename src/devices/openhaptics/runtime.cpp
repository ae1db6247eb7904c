#include "runtime.hpp"

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>

#include "errors.hpp"

namespace calligraphy::hdapi {
namespace {

constexpr int max_errors = 64;  // bounds the loop if a runtime never reports that there are no more

/// The vendor's runtime is global to the process: devices opened in several places share its scheduler. Its file stays
/// loaded, because its own threads may outlive a device.
std::mutex registry_mutex;
std::vector<std::pair<void*, std::shared_ptr<Runtime>>> registry;

/// Guards the user counts of all schedulers.
std::mutex scheduler_mutex;

std::vector<std::string> names_to_try(const std::string& name) {
  if (!name.empty()) return {name};
  const char* from_environment = std::getenv("CALLIGRAPHY_LIBHD");
  if (from_environment != nullptr && *from_environment != '\0') return {from_environment};
  return {"libHD.so", "libHD.so.3"};
}

template <class Function>
void find(void* file, const char* name, Function& function, std::string& missing) {
  function = reinterpret_cast<Function>(dlsym(file, name));
  if (function == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(name);
}

std::string find_all(void* file, Functions& f) {
  std::string missing;
  find(file, "hdInitDevice", f.hdInitDevice, missing);
  find(file, "hdMakeCurrentDevice", f.hdMakeCurrentDevice, missing);
  find(file, "hdDisableDevice", f.hdDisableDevice, missing);
  find(file, "hdBeginFrame", f.hdBeginFrame, missing);
  find(file, "hdEndFrame", f.hdEndFrame, missing);
  find(file, "hdGetError", f.hdGetError, missing);
  find(file, "hdGetErrorString", f.hdGetErrorString, missing);
  find(file, "hdEnable", f.hdEnable, missing);
  find(file, "hdDisable", f.hdDisable, missing);
  find(file, "hdGetDoublev", f.hdGetDoublev, missing);
  find(file, "hdSetDoublev", f.hdSetDoublev, missing);
  find(file, "hdGetIntegerv", f.hdGetIntegerv, missing);
  find(file, "hdGetString", f.hdGetString, missing);
  find(file, "hdCheckCalibration", f.hdCheckCalibration, missing);
  find(file, "hdUpdateCalibration", f.hdUpdateCalibration, missing);
  find(file, "hdStartScheduler", f.hdStartScheduler, missing);
  find(file, "hdStopScheduler", f.hdStopScheduler, missing);
  find(file, "hdScheduleAsynchronous", f.hdScheduleAsynchronous, missing);
  find(file, "hdUnschedule", f.hdUnschedule, missing);
  return missing;
}

}  // namespace

std::shared_ptr<Runtime> Runtime::load(const std::string& name) {
  std::string tried;
  for (const std::string& candidate : names_to_try(name)) {
    void* const file = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (file == nullptr) {
      const char* const message = dlerror();
      const std::string reason = message != nullptr ? message : "no reason given";
      const bool names_it = reason.starts_with(candidate + ":");
      tried += (tried.empty() ? "" : "; ") + (names_it ? "" : candidate + ": ") + reason;
      continue;
    }
    const std::lock_guard lock(registry_mutex);
    for (const auto& [known, runtime] : registry) {
      if (known == file) return runtime;
    }
    const auto runtime = std::make_shared<Runtime>(file, candidate);
    registry.emplace_back(file, runtime);
    return runtime;
  }
  throw DeviceError("the vendor's runtime libHD cannot be loaded (" + tried +
                    "): install OpenHaptics and the device driver from the vendor, or set the environment "
                    "variable CALLIGRAPHY_LIBHD to the file");
}

Runtime::Runtime(void* file, std::string library) : library_(std::move(library)) {
  const std::string missing = find_all(file, functions_);
  if (missing.empty()) return;
  throw DeviceError(library_ + " lacks " + missing +
                    ": it is not the vendor's HDAPI, or too old. Install OpenHaptics from the vendor, or set the "
                    "environment variable CALLIGRAPHY_LIBHD to another file");
}

void Runtime::use_scheduler() {
  const std::lock_guard lock(scheduler_mutex);
  if (users_ == 0) {
    functions_.hdStartScheduler();
    const std::string errors = take_errors(prevents_start);
    if (!errors.empty()) {
      functions_.hdStopScheduler();
      take_errors();
      throw DeviceError("the scheduler of " + library_ + " does not start: " + errors);
    }
  }
  ++users_;
}

void Runtime::leave_scheduler() noexcept {
  const std::lock_guard lock(scheduler_mutex);
  if (--users_ == 0) functions_.hdStopScheduler();
}

bool Runtime::scheduler_runs() const {
  const std::lock_guard lock(scheduler_mutex);
  return users_ > 0;
}

std::string Runtime::take_errors(bool (*counts)(ErrorCode) noexcept) const {
  std::string result;
  for (int i = 0; i < max_errors; ++i) {
    const ErrorInfo error = functions_.hdGetError();
    if (error.code == no_error) break;
    if (!counts(error.code)) continue;
    char code[32];
    std::snprintf(code, sizeof code, "HD error 0x%04x", error.code);
    const char* text = functions_.hdGetErrorString(error.code);
    result += (result.empty() ? "" : "; ") + std::string(code);
    if (text != nullptr && *text != '\0') result += std::string(": ") + text;
  }
  return result;
}

}  // namespace calligraphy::hdapi
