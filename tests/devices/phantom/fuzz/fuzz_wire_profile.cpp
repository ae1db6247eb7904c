// libFuzzer's entry to wire_profile.hpp.
#include "wire_profile.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  calligraphy_test::try_wire_profile(std::as_bytes(std::span(data, size)));
  return 0;
}
