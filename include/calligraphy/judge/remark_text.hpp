// Remarks in words.
#pragma once

#include <string>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/judge/stroke_remark.hpp>
#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// What is wrong and what to do, in a sentence or two. `character` is the one that the writing was matched with; among
/// several forms, MatchResult::character.
/// @throws ValueError when the remark names a stroke that the character does not have
std::string remark_text(const StrokeRemark& remark, const Character& character, const Language& language = {});

}  // namespace calligraphy
