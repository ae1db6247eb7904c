// The only file that is compiled anew for another commit.
#include "source_commit.hpp"

namespace calligraphy::tools {

const char* source_commit() noexcept { return CALLIGRAPHY_SOURCE_COMMIT; }

}  // namespace calligraphy::tools
