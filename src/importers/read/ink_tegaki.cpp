// Tegaki's XML: <character> with <utf8>, <width>, <height> and <strokes>, alone or in a <character-collection>.
#include <algorithm>

#include "base/line_reader.hpp"
#include "ink_file.hpp"
#include "xml_document.hpp"

namespace calligraphy {
namespace {

constexpr double usual_square = 1000.0;  // edge; what Tegaki takes where a character does not say it

class TegakiReader {
 public:
  explicit TegakiReader(std::string_view name) : name_(name) {
    file_.format = InkFormat::tegaki;
    file_.time_unit = 1e-3;
  }

  InkFile read(pugi::xml_node root) {
    walk_elements(root, [this](pugi::xml_node node) { enter(node); },
                  [this](pugi::xml_node node) { leave(local_name(node)); });
    if (has_tilt_) file_.notes.emplace_back("tilts are left out: Tegaki does not say in which unit they are");
    return std::move(file_);
  }

 private:
  void enter(pugi::xml_node node) {
    const std::string_view element = local_name(node);
    if (element == "character") {
      if (is_in_character_) fail("a character within a character");
      if (file_.groups.size() >= max_ink_groups) fail("too many characters");
      is_in_character_ = true;
      width_ = height_ = 0.0;
      file_.groups.emplace_back();
      return;
    }
    if (!is_in_character_) return;
    InkGroup& group = file_.groups.back();
    if (element == "utf8") group.label = text_in(node);
    if (element == "width") width_ = number(text_in(node), "the width");
    if (element == "height") height_ = number(text_in(node), "the height");
    if (element == "stroke") add_run(group, false, name_);
    if (element == "point") {
      if (group.runs.empty()) fail("a point without a stroke");
      add_sample(group.runs.back(), point(node), name_);
    }
  }

  void leave(std::string_view element) {
    if (element != "character") return;
    is_in_character_ = false;
    InkGroup& group = file_.groups.back();
    if (width_ > 0.0 && height_ > 0.0) group.square = std::max(width_, height_);
    else if (fits(group, usual_square)) group.square = usual_square;
  }

  static bool fits(const InkGroup& group, double square) {
    for (const InkRun& run : group.runs) {
      for (const TimedPoint& sample : run.samples) {
        if (sample.point.minCoeff() < 0.0 || sample.point.maxCoeff() > square) return false;
      }
    }
    return true;
  }

  TimedPoint point(pugi::xml_node node) {
    TimedPoint sample = sample_at(number(attribute_of(node, "x"), "x"), number(attribute_of(node, "y"), "y"));
    if (const auto time = attribute_of(node, "timestamp"); is_given(time)) sample.time = number(time, "the timestamp");
    if (const auto pressure = attribute_of(node, "pressure"); is_given(pressure)) {
      sample.stylus.pressure = number(pressure, "the pressure");
    }
    has_tilt_ = has_tilt_ || is_given(attribute_of(node, "xtilt")) || is_given(attribute_of(node, "ytilt"));
    return sample;
  }

  static bool is_given(std::string_view text) { return !trimmed(text).empty() && trimmed(text) != "None"; }

  double number(std::string_view text, const char* what) const {
    const std::optional<double> value = finite_number(trimmed(text));
    if (!value) fail(std::string(what) + " is " + in_quotes(text) + ": expected a number");
    return *value;
  }

  [[noreturn]] void fail(const std::string& what) const {
    const std::size_t number = file_.groups.size();
    const bool has_stroke = number > 0 && !file_.groups.back().runs.empty();
    fail_ink(name_, (number > 0 ? "character " + std::to_string(number) + ": " : "") +
                        (has_stroke ? "stroke " + std::to_string(file_.groups.back().runs.size()) + ": " : "") + what);
  }

  std::string_view name_;
  InkFile file_;
  bool is_in_character_ = false;
  bool has_tilt_ = false;
  double width_ = 0.0, height_ = 0.0;
};

}  // namespace

InkFile read_tegaki(std::string_view text, std::string_view name) {
  pugi::xml_document document;
  load_xml(document, text, name);
  return TegakiReader(name).read(document.document_element());
}

}  // namespace calligraphy
