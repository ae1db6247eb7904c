#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "../../catch.hpp"
#include "fuzz/packet_codec.hpp"
#include "fuzz/serial_framing.hpp"
#include "fuzz/wire_profile.hpp"

// What the fuzzers of tests/devices/phantom/fuzz found worth keeping holds without them too, with every compiler.
TEST_CASE("every fuzz target passes on its corpus", "[phantom][fuzz]") {
  using Try = void (*)(std::span<const std::byte>);
  const std::vector<std::pair<std::string, Try>> targets = {{"packet_codec", calligraphy_test::try_packet_codec},
                                                            {"serial_framing", calligraphy_test::try_serial_framing},
                                                            {"wire_profile", calligraphy_test::try_wire_profile}};
  for (const auto& [name, attempt] : targets) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(CALLIGRAPHY_SOURCE_DIR) +
                                                                 "/tests/devices/phantom/fuzz/corpus/" + name)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
      attempt(std::as_bytes(std::span(text)));
      ++files;
    }
    CAPTURE(name);
    CHECK(files >= 5);
  }
}
