// A font of this computer in which pictures can write Chinese.
#pragma once

#include <string>
#include <string_view>

namespace calligraphy {

/// The family of an installed font that has all characters of the text (UTF-8) and is made for simplified Chinese: of
/// several, the one that the user's configuration prefers. Empty if there is none, and where the library was built
/// without fontconfig, which looks for it. @throws FormatError when the text is not UTF-8
std::string chinese_font(std::string_view text);

/// Whether the library was built with fontconfig.
bool fonts_can_be_found() noexcept;

}  // namespace calligraphy
