// JSON of signature_pad: an array of pen-downs, each an array of points, since version 4 as the member `points`.
#include <cstdint>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/line_reader.hpp"
#include "ink_file.hpp"

namespace calligraphy {
namespace {

/// Takes the points as they come, so that a file takes no more memory than they do.
class SignaturePadReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit SignaturePadReader(std::string_view name) : name_(name) {
    file_.format = InkFormat::signature_pad;
    file_.time_unit = 1e-3;  // since 1970
    file_.pressure_is_scaled = true;
    file_.groups.emplace_back();
  }

  InkFile file() && { return std::move(file_); }

  bool start_array(std::size_t) override {
    const bool is_points = levels_ == "[" || (levels_ == "[{" && key_ == "points");
    open('[');
    if (is_points) add_run(group(), false, name_), points_level_ = levels_.size();
    return true;
  }
  bool end_array() override {
    if (levels_.size() == points_level_) points_level_ = 0;
    return close();
  }
  bool start_object(std::size_t) override {
    open('{');
    if (levels_ == "[{") is_erasing_ = false, erased_from_ = group().runs.size();
    if (is_in_point()) point_ = sample_at(std::nan(""), std::nan(""));
    return true;
  }
  bool end_object() override {
    if (is_in_point()) {
      if (std::isnan(point_.point.x()) || std::isnan(point_.point.y())) fail("a point without x or y");
      add_sample(group().runs.back(), point_, name_);
    }
    if (levels_ == "[{" && is_erasing_) erase();
    return close();
  }
  bool key(std::string& word) override {
    key_ = word;
    return true;
  }
  bool null() override { return value_is_no_number("null"); }
  bool boolean(bool) override { return value_is_no_number("a boolean"); }
  bool number_integer(std::int64_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) override { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) override { return number(value); }
  bool string(std::string& text) override {
    if (levels_ == "[{" && key_ == "compositeOperation") is_erasing_ = text == "destination-out";
    return value_is_no_number(in_quotes(text));
  }
  bool binary(nlohmann::json::binary_t&) override { return value_is_no_number("binary"); }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception&) override {
    fail("not JSON at byte " + std::to_string(position));
  }

 private:
  InkGroup& group() { return file_.groups.front(); }
  bool is_in_point() const { return points_level_ > 0 && levels_.size() == points_level_ + 1 && levels_.back() == '{'; }

  void open(char level) {
    constexpr std::size_t deepest = 16;
    if (levels_.size() >= deepest) fail("nested too deeply for signature_pad");
    if (points_level_ > 0 && levels_.size() == points_level_ && level == '[') {
      fail("a point is an array, not an object");
    }
    levels_ += level;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  /// What takes ink away is kept, but is no writing.
  void erase() {
    constexpr int eraser = 32;  // of a Pointer Event's buttons
    for (std::size_t i = erased_from_; i < group().runs.size(); ++i) {
      for (TimedPoint& sample : group().runs[i].samples) sample.buttons = eraser;
    }
  }

  double* member() {
    if (!is_in_point()) return nullptr;
    if (key_ == "x") return &point_.point.x();
    if (key_ == "y") return &point_.point.y();
    if (key_ == "time") return &point_.time;
    return key_ == "pressure" ? &point_.stylus.pressure : nullptr;
  }

  bool number(double value) {
    if (double* const to = member()) *to = value;
    else if (points_level_ > 0 && levels_.size() == points_level_) fail("a point is a number, not an object");
    return true;
  }

  bool value_is_no_number(const std::string& what) {
    if (member() != nullptr && !(what == "null" && key_ != "x" && key_ != "y")) {
      fail(key_ + " is " + what + ": expected a number");
    }
    return true;
  }

  [[noreturn]] void fail(const std::string& what) const {
    const std::size_t stroke = file_.groups.front().runs.size();
    fail_ink(name_, (stroke > 0 ? "stroke " + std::to_string(stroke) + ": " : "") + what);
  }

  std::string_view name_;
  InkFile file_;
  std::string levels_;            ///< brackets that are open
  std::size_t points_level_ = 0;  ///< of the array of points; 0: outside
  std::string key_;
  bool is_erasing_ = false;       ///< the points of this object take ink away
  std::size_t erased_from_ = 0;   ///< its first run
  TimedPoint point_;
};

}  // namespace

InkFile read_signature_pad(std::string_view text, std::string_view name) {
  SignaturePadReader reader(name);
  nlohmann::json::sax_parse(text.begin(), text.end(), &reader);
  return std::move(reader).file();
}

}  // namespace calligraphy
