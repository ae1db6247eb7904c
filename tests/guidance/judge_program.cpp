#include "judge_program.hpp"

#include <cstdio>

#include <unistd.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/device_profiles.hpp>

namespace calligraphy_test {

using namespace calligraphy;

std::function<void(double)> progress() {
  if (isatty(STDERR_FILENO) == 0) return nullptr;
  return [](double share) { std::fprintf(stderr, share < 1.0 ? "\r%3.0f %%" : "\r     \r", 100.0 * share); };
}

std::string name_of(char32_t code) { return encode_utf8(code); }

RendererOptions renderer_of(const std::string& name, const Capabilities& device) {
  if (name == "default") return RendererOptions::for_device(device);
  if (name == "everything") return RendererOptions::everything(device);
  throw ValueError("--renderer " + name + ": expected default or everything");
}

StrokeTolerances tolerances_of(const std::string& name) {
  if (name == "lenient") return StrokeTolerances::lenient();
  if (name == "normal") return StrokeTolerances::normal();
  if (name == "strict") return StrokeTolerances::strict();
  throw ValueError("--tolerances " + name + ": expected lenient, normal or strict");
}

std::vector<Capabilities> devices_of(const std::string& name) {
  const auto profiles = device_profiles();
  if (name == "all") return {profiles.begin(), profiles.end()};
  return {device_profile(name)};
}

}  // namespace calligraphy_test
