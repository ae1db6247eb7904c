// The only file that is compiled anew for another commit.
#include "source_commit.hpp"

#include "commit_text.hpp"  // made by source_commit.cmake

namespace calligraphy::tools {

const char* source_commit() noexcept { return CALLIGRAPHY_SOURCE_COMMIT; }

}  // namespace calligraphy::tools
