// Asks for a device of the vendor's runtime, which need not be there.
#include <cstdio>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>

int main() {
  try {
    calligraphy::OpenHapticsDevice device;
    std::printf("%s\n", device.capabilities().model.c_str());
  } catch (const calligraphy::DeviceError& error) {
    std::printf("%s\n", error.what());
  }
  return 0;
}
