// Temporarily drops the rights of root.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace calligraphy_test {

/// Root may open everything, so tests of refused access run as another user.
class AsNobody {
 public:
  AsNobody() {
    if (getuid() == 0 && setresuid(nobody, nobody, 0) != 0) throw std::runtime_error("cannot become another user");
  }
  ~AsNobody() {
    if (getuid() == nobody && setresuid(0, 0, 0) != 0) std::abort();
  }

 private:
  static constexpr uid_t nobody = 65534;
};

}  // namespace calligraphy_test
