// Lists what is plugged in, with the Phantom backend of an installed copy.
#include <cstdio>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/phantom/device_list.hpp>
#include <calligraphy/devices/phantom/phantom_device.hpp>

int main() {
  try {
    for (const calligraphy::PluggedDevice& device : calligraphy::plugged_devices()) {
      std::printf("%s\n", calligraphy::describe_device(device).c_str());
    }
  } catch (const calligraphy::DeviceError& error) {
    std::printf("%s\n", error.what());  // a machine without USB
  }
  return std::string(calligraphy::to_string(calligraphy::DeviceFault::unplugged)) == "unplugged" ? 0 : 1;
}
