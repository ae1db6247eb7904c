// libFuzzer's entry to packet_codec.hpp.
#include "packet_codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  calligraphy_test::try_packet_codec(std::as_bytes(std::span(data, size)));
  return 0;
}
