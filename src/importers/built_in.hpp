// Texts of data/, compiled in by cmake/component.cmake.
#pragma once

namespace calligraphy::built_in {

extern const char* const kanjivg_labels;
extern const char* const order_corrections;

}  // namespace calligraphy::built_in
