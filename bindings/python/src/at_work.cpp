// Devices and renderers that a loop uses in a thread of its own.
#include "at_work.hpp"

#include <set>
#include <string>

#include <calligraphy/error.hpp>

namespace calligraphy::python {
namespace {

std::set<const void*> busy;  ///< under the GIL
thread_local int laws = 0;   ///< that this thread is within

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

InLaw::InLaw() noexcept { ++laws; }
InLaw::~InLaw() { --laws; }
bool InLaw::here() noexcept { return laws > 0; }

void refuse_at_work(const HapticDevice& device) { refuse(&device, "device"); }
void refuse_at_work(const HapticRenderer& renderer) { refuse(&renderer, "renderer"); }

}  // namespace calligraphy::python
