#include <calligraphy/pictures/chinese_font.hpp>

#include <fontconfig/fontconfig.h>

#include <memory>

#include <calligraphy/base/text.hpp>

namespace calligraphy {
namespace {

template <auto Destroy>
struct Destroyer {
  template <class T>
  void operator()(T* object) const {
    Destroy(object);
  }
};

using Config = std::unique_ptr<FcConfig, Destroyer<FcConfigDestroy>>;
using Pattern = std::unique_ptr<FcPattern, Destroyer<FcPatternDestroy>>;
using CharSet = std::unique_ptr<FcCharSet, Destroyer<FcCharSetDestroy>>;
using FontSet = std::unique_ptr<FcFontSet, Destroyer<FcFontSetDestroy>>;

FcChar8* fc_string(const char* text) { return reinterpret_cast<FcChar8*>(const_cast<char*>(text)); }

bool has(FcPattern* font, const FcCharSet* wanted) {
  FcCharSet* characters = nullptr;
  FcLangSet* languages = nullptr;
  return FcPatternGetCharSet(font, FC_CHARSET, 0, &characters) == FcResultMatch &&
         FcCharSetIsSubset(wanted, characters) == FcTrue &&
         FcPatternGetLangSet(font, FC_LANG, 0, &languages) == FcResultMatch &&
         FcLangSetHasLang(languages, fc_string("zh-cn")) == FcLangEqual;
}

}  // namespace

bool fonts_can_be_found() noexcept { return true; }

std::string chinese_font(std::string_view text) {
  const CharSet wanted(FcCharSetCreate());
  for (const char32_t code : decode_utf8(text)) FcCharSetAddChar(wanted.get(), code);
  const Config config(FcInitLoadConfigAndFonts());  // its own: what is installed now, and nothing global is changed
  const Pattern pattern(FcPatternCreate());
  if (!config || !pattern) return {};
  FcPatternAddString(pattern.get(), FC_FAMILY, fc_string("sans-serif"));
  FcPatternAddString(pattern.get(), FC_LANG, fc_string("zh-cn"));
  FcConfigSubstitute(config.get(), pattern.get(), FcMatchPattern);
  FcDefaultSubstitute(pattern.get());
  FcResult result = FcResultNoMatch;
  const FontSet fonts(FcFontSort(config.get(), pattern.get(), FcFalse, nullptr, &result));
  for (int i = 0; fonts && i < fonts->nfont; ++i) {
    FcChar8* family = nullptr;
    if (!has(fonts->fonts[i], wanted.get())) continue;
    if (FcPatternGetString(fonts->fonts[i], FC_FAMILY, 0, &family) != FcResultMatch) continue;
    return reinterpret_cast<const char*>(family);
  }
  return {};
}

}  // namespace calligraphy
