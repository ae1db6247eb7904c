// What the name of a file says of the character in it; private to the importers.
#pragma once

#include <string>
#include <string_view>

namespace calligraphy {

enum class FileForm {
  none,  ///< no character file
  json,  ///< one character, or, if there are several lines, one a line
  list,  ///< one character a line, as JSON
  svg
};

struct FileName {
  FileForm form = FileForm::none;
  char32_t code = 0;     ///< 0: the name does not say, or not for certain
  char32_t hex = 0;      ///< of a name that is a number, as KanjiVG reads it; 0: it is none
  char32_t decimal = 0;  ///< the same as animCJK reads it
  std::string order;     ///< KanjiVG's suffix, as in 04e86-Kaisho.svg; empty for the standard one

  bool has_meaning() const { return code != 0 || hex != 0 || decimal != 0; }
};

/// From the path within a source. Characters are named by themselves, percent-encoded or not; by U+4E00, u4e00 or
/// uni4E00; in KanjiVG by five hexadecimal digits, in animCJK by decimal ones.
FileName parse_file_name(std::string_view path);

/// "graphicsJa.txt" and the like of animCJK, unlike the graphics.txt of Make Me a Hanzi.
bool is_anim_cjk_list(std::string_view path);

}  // namespace calligraphy
