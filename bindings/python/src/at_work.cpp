// Devices and renderers that a loop uses in a thread of its own.
#include "at_work.hpp"

#include <set>
#include <string>
#include <utility>

#include <calligraphy/base/error.hpp>

namespace calligraphy::python {
namespace {

std::set<const void*> busy;                     ///< under the GIL
thread_local const InLaw* innermost = nullptr;  ///< law that this thread is within

void refuse(const void* thing, const char* what) {
  if (busy.empty() || InLaw::here() || busy.count(thing) == 0) return;
  throw Error(std::string("the ") + what +
              " is at work in a running loop: use it from the force law, or stop the loop");
}

}  // namespace

AtWork::AtWork(const HapticDevice& device, const HapticRenderer* renderer) : device_(device), renderer_(renderer) {
  refuse(&device, "device");
  if (renderer != nullptr) refuse(renderer, "renderer");
  busy.insert(&device);
  if (renderer != nullptr) busy.insert(renderer);
}

AtWork::~AtWork() {
  busy.erase(&device_);
  busy.erase(renderer_);
}

InLaw::InLaw(const void* law) noexcept : law_(law), outer_(std::exchange(innermost, this)) {}
InLaw::~InLaw() { innermost = outer_; }
bool InLaw::here() noexcept { return innermost != nullptr; }
bool InLaw::here(const void* law) noexcept {
  const InLaw* each = innermost;
  while (each != nullptr && each->law_ != law) each = each->outer_;
  return each != nullptr;
}

void refuse_at_work(const HapticDevice& device) { refuse(&device, "device"); }
void refuse_at_work(const HapticRenderer& renderer) { refuse(&renderer, "renderer"); }

}  // namespace calligraphy::python
