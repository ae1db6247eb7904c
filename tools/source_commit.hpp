// The commit of the source that the program was built from.
#pragma once

namespace calligraphy::tools {

/// 40 hexadecimal digits, then "-dirty" if files differed; or "unknown".
const char* source_commit() noexcept;

}  // namespace calligraphy::tools
