#include <calligraphy/importers/ink_import.hpp>

#include <algorithm>

#include <calligraphy/base/text.hpp>

#include "base/enum_name.hpp"
#include "base/require.hpp"
#include "ink_file.hpp"

namespace calligraphy {
namespace {

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

/// The name of the root element of an XML text, without its prefix; empty if it is none.
std::string_view root_element(std::string_view text) {
  while (true) {
    text = trimmed(text);
    if (!text.starts_with('<')) return {};
    std::string_view end = ">";
    if (text.starts_with("<!--")) end = "-->";
    else if (text.starts_with("<?")) end = "?>";
    else if (!text.starts_with("<!")) break;
    const std::size_t at = text.find(end);
    if (at == std::string_view::npos) return {};
    text.remove_prefix(at + end.size());
  }
  const std::string_view tag = text.substr(1, text.find_first_of(" \t\r\n/>") - 1);
  return tag.substr(tag.find(':') + 1);
}

/// @throws FormatError naming the file and the byte
void check_utf8(std::string_view bytes, std::string_view name) {
  if (is_utf8(bytes)) return;
  try {
    decode_utf8(bytes);
  } catch (const FormatError& error) {
    fail_ink(name, error.what());
  }
}

/// As `replay` reads the text format.
InkImport own_traces(std::string_view text, std::string_view name, const InkOptions& options) {
  InkImport import{InkFormat::pen_traces, parse_pen_traces(text, name), {}, 0};
  if (import.traces.empty()) fail_ink(name, "contains no traces");
  YAxis axis = options.y_axis.value_or(YAxis::down);
  if (!options.y_axis && recognise_y_axis(import.traces) == YAxis::up) {
    axis = YAxis::up;
    import.notes.emplace_back("y points up, as the writing shows, not down as in this format");
  }
  if (axis == YAxis::up) std::for_each(import.traces.begin(), import.traces.end(), turn_over);
  if (!options.set.empty()) {
    for (PenTrace& trace : import.traces) trace.set = options.set;
  }
  return import;
}

}  // namespace

const char* to_string(InkFormat format) noexcept {
  static constexpr const char* names[] = {"InkML", "signature_pad", "Tegaki", "SVC", "CSV", "pen traces"};
  return name_of<InkFormat::pen_traces>(format, names, "unknown");
}

InkImport import_ink(std::string_view bytes, std::string_view name, const InkOptions& options) {
  const bool is_word = std::none_of(options.set.begin(), options.set.end(),
                                    [](char c) { return static_cast<unsigned char>(c) <= 0x20 || c == 0x7F; });
  if (!is_word || !is_utf8(options.set)) throw ValueError("set = '" + printable(options.set) + "', must be one word");
  if (bytes.size() > max_ink_bytes) fail_ink(name, "larger than 64 MiB");
  if (is_utf16(bytes)) fail_ink(name, "is UTF-16, not UTF-8: save it as UTF-8");
  if (bytes.starts_with(utf8_mark)) bytes.remove_prefix(utf8_mark.size());
  check_utf8(bytes, name);
  const std::string_view text = trimmed(bytes);
  if (text.empty()) fail_ink(name, "is empty");
  const std::string_view root = root_element(text);
  if (!root.empty() && bytes.size() > max_xml_bytes) fail_ink(name, "larger than 16 MiB: divide it");
  if (root == "ink") return traces_of(read_inkml(bytes, name), name, options);
  if (root.starts_with("character")) return traces_of(read_tegaki(bytes, name), name, options);
  if (text.front() == '{' || text.front() == '[') {
    const bool has_medians = text.find("\"medians\"") != std::string_view::npos;
    if (text.front() == '{' || has_medians) {
      fail_ink(name, std::string("is JSON, but not of signature_pad's toData()") +
                         (has_medians ? ": characters are read by `calligraphy import`" : ""));
    }
    return traces_of(read_signature_pad(bytes, name), name, options);
  }
  if (is_svc(text)) return traces_of(read_svc(bytes, name), name, options);
  if (text.starts_with("C ") || text.starts_with("V ") || text.front() == '#') return own_traces(bytes, name, options);
  if (is_ink_table(text)) return traces_of(read_ink_table(bytes, name), name, options);
  fail_ink(name, "is none of the formats that are read: InkML, signature_pad's JSON, Tegaki's XML, SVC, CSV with named "
                 "columns, pen traces");
}

}  // namespace calligraphy
