// XML of drawings and pen recordings: nothing here is recursive, because nesting may be as deep as the file is long.
#pragma once

#include <string>
#include <string_view>

#include <pugixml.hpp>

namespace calligraphy {

/// With its comments. `name` begins messages. @throws FormatError naming the line if the text is no XML
void load_xml(pugi::xml_document& document, std::string_view text, std::string_view name);

/// The name of an element without its prefix.
std::string_view local_name(pugi::xml_node node) noexcept;

/// The value of an attribute, empty if there is none; the prefix of its name does not matter.
std::string_view attribute_of(pugi::xml_node node, std::string_view name) noexcept;

/// The first text in an element, or in one of a few nested in it.
std::string_view text_in(pugi::xml_node node) noexcept;

/// Calls enter(node) for every element below and including a root, in the order of the document, and leave(node) at its
/// end.
template <typename Enter, typename Leave>
void walk_elements(pugi::xml_node root, const Enter& enter, const Leave& leave) {
  pugi::xml_node node = root;
  while (node) {
    if (node.type() == pugi::node_element) enter(node);
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node) {
      if (node.type() == pugi::node_element) leave(node);
      if (node == root) return;
      if (node.next_sibling()) break;
      node = node.parent();
    }
    node = node.next_sibling();
  }
}

}  // namespace calligraphy
