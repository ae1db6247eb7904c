// libFuzzer's entry to serial_framing.hpp.
#include "serial_framing.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  calligraphy_test::try_serial_framing(std::as_bytes(std::span(data, size)));
  return 0;
}
