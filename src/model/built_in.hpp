// Texts of data/, compiled in by cmake/embed.cmake.
#pragma once

namespace calligraphy::built_in {

extern const char* const characters;
extern const char* const paper_example;

}  // namespace calligraphy::built_in
