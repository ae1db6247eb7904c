// The words of every language, compiled into the program (cmake/component.cmake).
#pragma once

namespace calligraphy::built_in {

/// A file of data/languages.
struct LanguageFile {
  const char* code;
  const char* text;
};

/// By code; the last has none.
extern const LanguageFile languages[];

}  // namespace calligraphy::built_in
