#include "xml_document.hpp"

#include <algorithm>
#include <cstddef>

#include "ink_file.hpp"

namespace calligraphy {

void load_xml(pugi::xml_document& document, std::string_view text, std::string_view name) {
  const auto result = document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_comments,
                                           pugi::encoding_utf8);
  if (result) return;
  const auto end = text.begin() + std::clamp<std::ptrdiff_t>(result.offset, 0, std::ssize(text));
  fail_ink(name, "line " + std::to_string(1 + std::count(text.begin(), end, '\n')) + ": not XML: " +
                     result.description());
}

std::string_view local_name(pugi::xml_node node) noexcept {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);
}

std::string_view attribute_of(pugi::xml_node node, std::string_view name) noexcept {
  for (const pugi::xml_attribute each : node.attributes()) {
    const std::string_view full = each.name();
    if (full.substr(full.find(':') + 1) == name) return each.value();
  }
  return {};
}

std::string_view text_in(pugi::xml_node node) noexcept {
  constexpr int deepest = 8;
  for (int depth = 0; node && depth < deepest; ++depth) {
    if (const std::string_view text = trimmed(node.child_value()); !text.empty()) return text;
    node = node.find_child([](pugi::xml_node child) { return child.type() == pugi::node_element; });
  }
  return {};
}

}  // namespace calligraphy
