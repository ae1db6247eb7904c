// The options of the haptic renderer by their names: to record them, to show them and to set them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// An option in words.
struct OptionValue {
  std::string name;   ///< as in C++, from RendererOptions on: "guidance.stiffness"
  std::string value;  ///< "600"

  /// Whether both are the same.
  bool operator==(const OptionValue&) const = default;
};

/// Every option of a renderer, in the order of RendererOptions. Numbers have the fewest digits that read back as the
/// same number, whatever the locale, "inf" where infinite; enumerators and "true" have their names. `guidance.force` is
/// "linear", "saturating", "wang2006" (printed_guidance) or "own", which says that the law is the program's own.
std::vector<OptionValue> option_values(const RendererOptions& options);

/// Sets the option of this name to a value as option_values() writes it. It does not validate(): the value may be out
/// of range. @throws ValueError naming the option and the value if there is no such option, the value is none of its
/// kind, or it is "own", since only the program that has the law can set it; then nothing has changed
void set_option(RendererOptions& options, std::string_view name, std::string_view value);

}  // namespace calligraphy
