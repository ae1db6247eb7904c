// The language of what people are told of their writing.
#pragma once

#include <string>

#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy::tools {

enum class Language { english, chinese };

/// What a remark says in a language.
inline const std::string& words(const StrokeRemark& remark, Language language) {
  return language == Language::chinese ? remark.reason_zh : remark.reason;
}

}  // namespace calligraphy::tools
