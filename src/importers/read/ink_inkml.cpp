// W3C Ink Markup Language (InkML), Recommendation of 20 September 2011.
#include <algorithm>
#include <map>
#include <numbers>
#include <unordered_map>
#include <utility>

#include <calligraphy/base/text.hpp>

#include "base/line_reader.hpp"
#include "base/require.hpp"
#include "ink_file.hpp"
#include "xml_document.hpp"

namespace calligraphy {
namespace {

constexpr double not_declared = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t max_channels = 64;
constexpr std::size_t max_contexts = 256;

struct InkUnit {
  std::string_view name;
  double value;  // [s], [m], [rad] or [N]
};
constexpr InkUnit time_units[] = {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"µs", 1e-6}, {"ns", 1e-9}};
constexpr InkUnit length_units[] = {{"m", 1.0},     {"cm", 1e-2},          {"mm", 1e-3},         {"um", 1e-6},
                                    {"in", 0.0254}, {"pt", 0.0254 / 72.0}, {"pc", 0.0254 / 6.0}, {"himetric", 1e-5}};
constexpr InkUnit angle_units[] = {
    {"rad", 1.0}, {"deg", std::numbers::pi / 180.0}, {"degrees", std::numbers::pi / 180.0}};
constexpr InkUnit force_units[] = {{"N", 1.0}, {"g", 9.80665e-3}};

template <std::size_t count>
double unit_in(const InkUnit (&units)[count], std::string_view name) noexcept {
  for (const InkUnit& unit : units) {
    if (unit.name == name) return unit.value;
  }
  return not_declared;
}

enum class ChannelUse { x, y, height, time, force, azimuth, altitude, twist, tilt_x, tilt_y, other };

struct InkChannel {
  ChannelUse use = ChannelUse::other;
  bool is_intermittent = false;
  std::string units = {};
  double per_unit = 1.0;  ///< how many of its values are one of its units
  double least = not_declared, most = not_declared, otherwise = 0.0;
  bool is_reversed = false;
  std::string name = {};
  bool is_integer = false;
};

template <std::size_t count>
double unit_of(const InkChannel& channel, const InkUnit (&units)[count]) noexcept {
  return unit_in(units, channel.units) / channel.per_unit;
}

struct ChannelFormat {
  std::vector<InkChannel> channels;
  double rate = not_declared;  ///< of samples [Hz]
};

ChannelUse use_of(std::string_view name) {
  constexpr std::pair<std::string_view, ChannelUse> names[] = {
      {"X", ChannelUse::x},        {"Y", ChannelUse::y},         {"Z", ChannelUse::height},
      {"T", ChannelUse::time},     {"F", ChannelUse::force},     {"OA", ChannelUse::azimuth},
      {"OE", ChannelUse::altitude}, {"OR", ChannelUse::twist},   {"OTx", ChannelUse::tilt_x},
      {"OTy", ChannelUse::tilt_y}};
  for (const auto& [each, use] : names) {
    if (each == name) return use;
  }
  return ChannelUse::other;
}

/// How the values of a channel are given, which holds until it changes.
struct ChannelState {
  int differences = 0;  ///< 0: the value itself, 1: its difference from the last one, 2: the difference of differences
  double value = 0.0, speed = 0.0, change = 0.0;
};

/// Reads the values in a trace, one point after the other.
class TraceText {
 public:
  TraceText(std::string_view text, std::string_view place) : rest_(text), place_(place) {}

  bool next_point() {
    skip_blanks();
    return !rest_.empty();
  }
  /// After the last value of a point. @throws FormatError if there is another
  void end_point() {
    skip_blanks();
    if (rest_.starts_with(',')) return rest_.remove_prefix(1);
    if (!rest_.empty()) fail("a point has too many values, or an unknown one: " + in_quotes(rest_.substr(0, 20)));
  }
  bool is_at_end_of_point() {
    skip_blanks();
    return rest_.empty() || rest_.front() == ',';
  }

  /// The next value of a channel; NaN: reported as not known.
  double value(ChannelState& state, double otherwise) {
    skip_blanks();
    if (rest_.empty() || rest_.front() == ',') fail("a point has too few values");
    constexpr std::string_view prefixes = "!'\"";
    if (const std::size_t prefix = prefixes.find(rest_.front()); prefix != std::string_view::npos) {
      state.differences = static_cast<int>(prefix);
      rest_.remove_prefix(1);
      skip_blanks();
    }
    if (rest_.empty()) fail("a point has too few values");
    switch (rest_.front()) {
      case '*':  // the number before stands again: the value, its difference or the difference of differences
        rest_.remove_prefix(1);
        if (state.differences == 2) state.speed += state.change;
        return state.differences == 0 ? state.value : state.value += state.speed;
      case '?':
        rest_.remove_prefix(1);
        return otherwise;
      case 'T':
      case 'F':
        state.value = rest_.front() == 'T' ? 1.0 : 0.0;
        rest_.remove_prefix(1);
        return state.value;
      default:
        break;
    }
    const double number = next_number();
    if (state.differences == 0) {
      state.speed = number - state.value;
      return state.value = number;
    }
    state.change = number;
    state.speed = state.differences == 1 ? number : state.speed + number;
    return state.value += state.speed;
  }

 private:
  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size())); }

  double next_number() {
    const std::string_view begin = rest_;
    double sign = 1.0;
    if (rest_.starts_with('-') || rest_.starts_with('+')) {
      sign = rest_.front() == '-' ? -1.0 : 1.0;
      rest_.remove_prefix(1);
      skip_blanks();
    }
    double value = 0.0;
    const char* const end = rest_.data() + rest_.size();
    std::from_chars_result result{rest_.data(), std::errc::invalid_argument};
    if (rest_.starts_with('#')) {
      std::uint32_t hex = 0;
      result = from_chars(rest_.data() + 1, end, hex, 16);
      value = hex;
    } else if (!rest_.empty() && (rest_.front() == '.' || (rest_.front() >= '0' && rest_.front() <= '9'))) {
      result = from_chars(rest_.data(), end, value);
    }
    if (result.ec != std::errc() || !std::isfinite(value)) {
      fail(in_quotes(begin.substr(0, std::min<std::size_t>(begin.find_first_of(" ,\n"), 20))) + ": expected a number");
    }
    rest_.remove_prefix(static_cast<std::size_t>(result.ptr - rest_.data()));
    return sign * value;
  }

  [[noreturn]] void fail(const std::string& what) const { throw FormatError(std::string(place_) + what); }

  std::string_view rest_;
  std::string_view place_;
};

class InkmlReader {
 public:
  explicit InkmlReader(std::string_view name) : name_(name) { file_.format = InkFormat::inkml; }

  InkFile read(pugi::xml_node root) {
    walk_elements(root, [this](pugi::xml_node node) { note_id(node); }, [](pugi::xml_node) {});
    frames_.push_back({root, {}, label_of(root), no_group, false});
    default_format_ = child_named(root, "traceFormat");
    walk_elements(root, [this](pugi::xml_node node) { enter(node); }, [this](pugi::xml_node node) { leave(node); });
    group_by_views();
    if (has_timed_ && has_untimed_) fail("some traces have a unit of time or times, others have none");
    if (has_timed_) file_.time_unit = 1.0;
    if (angle_is_declared_) file_.angle_unit = 1.0;
    return std::move(file_);
  }

 private:
  static constexpr std::size_t no_group = static_cast<std::size_t>(-1);

  /// What holds for traces within an element.
  struct Frame {
    pugi::xml_node node;
    pugi::xml_node context;
    std::string label;
    std::size_t group = no_group;
    bool is_definition = false;
    std::size_t view = no_group;
  };
  /// What names a character that is written with traces elsewhere in the file.
  struct View {
    std::string label;
    std::vector<std::string> traces = {};
  };
  struct Place {
    std::size_t group, run;
  };

  [[noreturn]] void fail(const std::string& what) const { fail_ink(name_, what); }

  void note_id(pugi::xml_node node) {
    const std::string_view id = attribute_of(node, "id");
    if (!id.empty()) by_id_.emplace(id, node);
    has_offsets_ = has_offsets_ || (local_name(node) == "trace" && !attribute_of(node, "timeOffset").empty());
  }

  /// The element that a reference such as "#pen" names; none if it is empty or the default of the specification.
  pugi::xml_node referred(std::string_view reference) const {
    if (reference.empty()) return {};
    const std::string_view id = reference.substr(reference.find('#') + 1);
    const auto found = by_id_.find(std::string(id));
    if (found != by_id_.end()) return found->second;
    if (id.starts_with("Default")) return {};
    fail("there is no element with the id " + in_quotes(id));
  }

  static pugi::xml_node child_named(pugi::xml_node node, std::string_view name) {
    return node.find_child([name](pugi::xml_node child) { return local_name(child) == name; });
  }

  static std::string label_of(pugi::xml_node node) {
    for (const pugi::xml_node child : node.children()) {
      const std::string_view element = local_name(child);
      if (element != "annotation" && element != "annotationXML") continue;
      std::string type(attribute_of(child, "type"));
      std::transform(type.begin(), type.end(), type.begin(),
                     [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
      const bool is_label = type == "truth" || type == "label" || type == "transcription" || type == "character";
      if (is_label || (element == "annotationXML" && type.empty())) {
        if (const std::string_view text = text_in(child); !text.empty()) return std::string(text);
      }
    }
    return {};
  }

  /// Whether it names what was written with the traces within, and not a line or a page of characters.
  static bool is_of_character(const std::string& label) {
    return !label.empty() && label.size() <= 8 && decode_utf8(label).size() <= 2;
  }

  void enter(pugi::xml_node node) {
    const std::string_view element = local_name(node);
    const Frame& outer = frames_.back();
    if (element == "definitions") {
      frames_.push_back({node, outer.context, {}, no_group, true});
    } else if (element == "traceGroup") {
      Frame frame{node, outer.context, label_of(node), no_group, outer.is_definition};
      if (const pugi::xml_node context = referred(attribute_of(node, "contextRef"))) frame.context = context;
      if (frame.label.empty() && frames_.size() > 1 && is_of_character(outer.label)) {
        frame.label = outer.label;
        frame.group = group_of(frames_.back());
      }
      frames_.push_back(std::move(frame));
    } else if (element == "context" && node.parent() == frames_.front().node) {
      frames_.front().context = node;
    } else if (element == "trace" && !outer.is_definition) {
      read_trace(node);
    } else if (element == "traceView" && !outer.label.empty() && !attribute_of(node, "traceDataRef").empty()) {
      see_trace(node);
    }
  }

  void see_trace(pugi::xml_node node) {
    Frame& frame = frames_.back();
    if (frame.view == no_group) {
      if (views_.size() >= max_ink_groups) fail("too many characters");
      frame.view = views_.size();
      views_.emplace_back().label = frame.label;
    }
    if (!attribute_of(node, "from").empty() || !attribute_of(node, "to").empty()) {
      fail("a traceView of a part of a trace, with from or to, is not read");
    }
    const std::string_view reference = attribute_of(node, "traceDataRef");
    views_[frame.view].traces.emplace_back(reference.substr(reference.find('#') + 1));
  }

  /// As in CROHME: all traces first, then groups that say which of them are one character.
  void group_by_views() {
    if (views_.empty()) return;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> viewers;  // of a group and a run
    std::vector<InkGroup> groups;
    for (const View& view : views_) {
      InkGroup& group = groups.emplace_back();
      group.label = view.label;
      for (const std::string& id : view.traces) {
        const auto found = runs_.find(id);
        if (found == runs_.end()) fail("a traceView names " + in_quotes(id) + ", which is no trace of the drawing");
        const Place& place = found->second;
        const auto [viewer, is_new] = viewers.try_emplace({place.group, place.run}, groups.size());
        if (viewer->second != groups.size()) fail("two groups name the trace " + in_quotes(id));
        if (is_new) group.runs.push_back(std::move(file_.groups[place.group].runs[place.run]));
      }
    }
    std::size_t all = 0;
    for (const InkGroup& group : file_.groups) all += group.runs.size();
    if (all > viewers.size()) {
      file_.notes.push_back(std::to_string(all - viewers.size()) + " traces that no traceView names were left out");
    }
    file_.groups = std::move(groups);
  }

  void leave(pugi::xml_node node) {
    if (frames_.size() > 1 && frames_.back().node == node) frames_.pop_back();
  }

  std::size_t group_of(Frame& frame) {
    if (frame.group == no_group) {
      if (file_.groups.size() >= max_ink_groups) fail("too many characters");
      frame.group = file_.groups.size();
      file_.groups.emplace_back().label = frame.label;
    }
    return frame.group;
  }

  void read_trace(pugi::xml_node node) {
    const std::string place = std::string(name_) + ": trace " + std::to_string(++traces_) + ": ";
    const std::size_t group = group_of(frames_.back());
    pugi::xml_node context = referred(attribute_of(node, "contextRef"));
    if (!context) context = frames_.back().context;
    const ChannelFormat& format = format_of(context);
    const std::string_view continuation = attribute_of(node, "continuation");
    const std::string_view prior = attribute_of(node, "priorRef").empty() ? attribute_of(node, "priorTrace")
                                                                          : attribute_of(node, "priorRef");
    Place to{group, no_group};
    if (continuation == "middle" || continuation == "end") {
      const auto found = runs_.find(std::string(prior.substr(prior.find('#') + 1)));
      if (found != runs_.end()) to = found->second;
      else if (prior.empty() && !file_.groups[group].runs.empty()) to.run = file_.groups[group].runs.size() - 1;
      else throw FormatError(place + "continues " + in_quotes(prior) + ", which is no trace before it");
    } else {
      add_run(file_.groups[group], attribute_of(node, "type") == "penUp", name_);
      to.run = file_.groups[group].runs.size() - 1;
    }
    if (const std::string_view id = attribute_of(node, "id"); !id.empty()) runs_[std::string(id)] = to;
    std::optional<double> offset;
    if (has_offsets_) offset = 0.0;  // Office leaves out that of the first trace
    if (const std::string_view text = attribute_of(node, "timeOffset"); !text.empty()) {
      offset = finite_number(text);
      if (!offset) throw FormatError(place + "timeOffset is " + in_quotes(text) + ": expected a number");
    }
    std::string content;  // comments may divide it
    for (const pugi::xml_node child : node.children()) content += child.value();
    read_points(content, format, offset, file_.groups[to.group].runs[to.run], place);
  }

  void read_points(std::string_view content, const ChannelFormat& format, std::optional<double> offset, InkRun& run,
                   std::string_view place) {
    TraceText text(content, place);
    std::vector<ChannelState> states(format.channels.size());
    for (std::size_t i = 0; i < states.size(); ++i) states[i].value = format.channels[i].otherwise;
    for (std::size_t count = 0; text.next_point(); ++count) {
      TimedPoint sample = sample_at(0.0, 0.0);
      double tilt_x = not_declared, tilt_y = not_declared;
      for (std::size_t i = 0; i < states.size(); ++i) {
        const InkChannel& channel = format.channels[i];
        if (channel.is_intermittent && text.is_at_end_of_point()) continue;
        const bool is_place = channel.use == ChannelUse::x || channel.use == ChannelUse::y;
        const double value = text.value(states[i], is_place ? states[i].value : not_declared);
        set(sample, channel, value, offset, tilt_x, tilt_y);
      }
      text.end_point();
      if (!std::isnan(tilt_x) && std::isnan(sample.stylus.azimuth)) {
        set_tilt(sample.stylus, tilt_x, tilt_y);
        angle_is_declared_ = true;
      }
      if (std::isnan(sample.time) && offset && !std::isnan(format.rate)) {
        sample.time = *offset * 1e-3 + static_cast<double>(count) / format.rate;
      } else if (std::isnan(sample.time) && !std::isnan(format.rate)) {
        sample.time = static_cast<double>(count) / format.rate;
      }
      const bool has_time_channel =
          std::any_of(format.channels.begin(), format.channels.end(),
                      [](const InkChannel& channel) { return channel.use == ChannelUse::time; });
      const bool is_timed = has_time_channel ? is_time_declared(format, offset) : !std::isnan(format.rate);
      (is_timed ? has_timed_ : has_untimed_) = true;
      add_sample(run, sample, name_);
    }
  }

  static bool is_time_declared(const ChannelFormat& format, std::optional<double> offset) {
    return std::all_of(format.channels.begin(), format.channels.end(), [&](const InkChannel& channel) {
      return channel.use != ChannelUse::time || offset || !std::isnan(unit_of(channel, time_units));
    });
  }

  /// The orientations of a pen are in degrees unless they are declared to be in radians.
  static double angle(const InkChannel& channel, double value) {
    const double unit = unit_of(channel, angle_units);
    return value * (std::isnan(unit) ? angle_units[1].value : unit);
  }

  void set(TimedPoint& sample, const InkChannel& channel, double value, std::optional<double> offset, double& tilt_x,
           double& tilt_y) {
    const double sign = channel.is_reversed ? -1.0 : 1.0;
    switch (channel.use) {
      case ChannelUse::x:
      case ChannelUse::y: {
        const double unit = unit_of(channel, length_units);
        const double coordinate = sign * value * (std::isnan(unit) ? 1.0 : unit);
        (channel.use == ChannelUse::x ? sample.point.x() : sample.point.y()) = coordinate;
        break;
      }
      case ChannelUse::height:
        sample.stylus.height = sign * value * unit_of(channel, length_units);
        break;
      case ChannelUse::time: {
        const double unit = unit_of(channel, time_units);
        if (std::isnan(unit) && !offset) sample.time = value;
        else sample.time = value * (std::isnan(unit) ? 1e-3 : unit) + offset.value_or(0.0) * 1e-3;
        break;
      }
      case ChannelUse::force:
        if (const double unit = unit_of(channel, force_units); !std::isnan(unit)) {
          sample.stylus.force = value * unit;
        } else if (channel.units == "%") {
          sample.stylus.pressure = value / 100.0;
          file_.pressure_is_scaled = true;
        } else if (channel.most > 0.0) {
          const double least = std::isnan(channel.least) ? 0.0 : channel.least;
          sample.stylus.pressure = (value - least) / (channel.most - least);
          file_.pressure_is_scaled = true;
        } else {
          sample.stylus.pressure = value;
        }
        break;
      case ChannelUse::azimuth:
        sample.stylus.azimuth = angle(channel, value);
        angle_is_declared_ = true;
        break;
      case ChannelUse::altitude:
        sample.stylus.altitude = angle(channel, value);
        angle_is_declared_ = true;
        break;
      case ChannelUse::twist:
        sample.stylus.twist = std::remainder(angle(channel, value), 2.0 * std::numbers::pi);
        break;
      case ChannelUse::tilt_x:
        tilt_x = angle(channel, value);
        break;
      case ChannelUse::tilt_y:
        tilt_y = angle(channel, value);
        break;
      case ChannelUse::other:
        break;
    }
  }

  // Formats -----------------------------------------------------------------------------------------------------------

  const ChannelFormat& format_of(pugi::xml_node context) {
    const std::size_t key = context.hash_value();
    const auto found = formats_.find(key);
    if (found != formats_.end()) return found->second;
    if (formats_.size() >= max_contexts) fail("more than " + std::to_string(max_contexts) + " contexts");
    return formats_.emplace(key, resolved(context)).first->second;
  }

  ChannelFormat resolved(pugi::xml_node context) {
    double rate = not_declared;
    constexpr int deepest = 16;  // contexts that refer to others, perhaps in a circle
    for (int depth = 0; context && depth < deepest; ++depth) {
      pugi::xml_node source = child_named(context, "inkSource");
      if (!source) source = referred(attribute_of(context, "inkSourceRef"));
      if (std::isnan(rate)) rate = rate_of(source);
      pugi::xml_node format = child_named(context, "traceFormat");
      if (!format) format = referred(attribute_of(context, "traceFormatRef"));
      if (!format) format = child_named(source, "traceFormat");
      if (format) return channels_of(format, rate, source);
      context = referred(attribute_of(context, "contextRef"));
    }
    if (default_format_) return channels_of(default_format_, rate, {});
    return {{InkChannel{ChannelUse::x}, InkChannel{ChannelUse::y}}, rate};
  }

  static double rate_of(pugi::xml_node source) {
    const pugi::xml_node rate = child_named(source, "sampleRate");
    const std::optional<double> value = finite_number(attribute_of(rate, "value"));
    const bool is_even = attribute_of(rate, "uniform") != "false" && attribute_of(rate, "uniform") != "F";
    return value && *value > 0.0 && is_even ? *value : not_declared;
  }

  ChannelFormat channels_of(pugi::xml_node node, double rate, pugi::xml_node source) {
    ChannelFormat format{{}, rate};
    for (const pugi::xml_node child : node.children()) {
      const std::string_view element = local_name(child);
      if (element == "channel") add_channel(format, child, false);
      if (element != "regularChannels" && element != "intermittentChannels") continue;
      for (const pugi::xml_node channel : child.children()) {
        if (local_name(channel) == "channel") add_channel(format, channel, element == "intermittentChannels");
      }
    }
    const auto has = [&format](ChannelUse use) {
      return std::count_if(format.channels.begin(), format.channels.end(),
                           [use](const InkChannel& channel) { return channel.use == use; }) == 1;
    };
    if (!has(ChannelUse::x) || !has(ChannelUse::y)) fail("a traceFormat needs one channel X and one channel Y");
    set_resolutions(format, child_named(source, "channelProperties"));
    InkChannel *x = nullptr, *y = nullptr;
    for (InkChannel& channel : format.channels) {
      if (channel.use == ChannelUse::x) x = &channel;
      if (channel.use == ChannelUse::y) y = &channel;
    }
    if (std::isnan(unit_in(length_units, x->units)) || std::isnan(unit_in(length_units, y->units))) {
      x->units.clear(), y->units.clear();  // of one scale, for all that is known
    }
    return format;
  }

  /// Office writes hundredths of a degree so: units "deg", of which there are 100 to 1.
  void set_resolutions(ChannelFormat& format, pugi::xml_node properties) const {
    for (const pugi::xml_node property : properties.children()) {
      const std::string_view units = attribute_of(property, "units");
      if (attribute_of(property, "name") != "resolution" || !units.starts_with("1/")) continue;
      const double value = number_of(property, "value", not_declared);
      for (InkChannel& channel : format.channels) {
        if (channel.name != attribute_of(property, "channel") || !channel.is_integer || !(value > 0.0)) continue;
        channel.per_unit = value;
        channel.units = units.substr(2);
      }
    }
  }

  void add_channel(ChannelFormat& format, pugi::xml_node node, bool is_intermittent) {
    if (format.channels.size() >= max_channels) fail("a traceFormat has more than 64 channels");
    InkChannel channel{use_of(attribute_of(node, "name")), is_intermittent};
    channel.name = attribute_of(node, "name");
    channel.is_integer = attribute_of(node, "type") == "integer";
    channel.units = attribute_of(node, "units");
    channel.least = number_of(node, "min", not_declared);
    channel.most = number_of(node, "max", not_declared);
    channel.otherwise = number_of(node, "default", 0.0);
    const std::string_view orientation = attribute_of(node, "orientation");
    channel.is_reversed = orientation == "-ve" && channel.use != ChannelUse::y;
    if (channel.use == ChannelUse::y && !orientation.empty()) {
      file_.declared = orientation == "-ve" ? YAxis::up : YAxis::down;
    }
    format.channels.push_back(std::move(channel));
  }

  double number_of(pugi::xml_node node, std::string_view attribute, double otherwise) const {
    const std::string_view text = trimmed(attribute_of(node, attribute));
    if (text.empty()) return otherwise;
    if (text == "T" || text == "F") return text == "T" ? 1.0 : 0.0;
    const std::optional<double> value = finite_number(text);
    if (!value) fail("the " + std::string(attribute) + " of a channel is " + in_quotes(text) + ": expected a number");
    return *value;
  }

  std::string_view name_;
  InkFile file_;
  std::unordered_map<std::string, pugi::xml_node> by_id_;
  std::unordered_map<std::string, Place> runs_;
  std::map<std::size_t, ChannelFormat> formats_;
  std::vector<Frame> frames_;
  std::vector<View> views_;
  pugi::xml_node default_format_;
  std::size_t traces_ = 0;
  bool has_offsets_ = false;  ///< in some trace
  bool has_timed_ = false, has_untimed_ = false;
  bool angle_is_declared_ = false;
};

}  // namespace

InkFile read_inkml(std::string_view text, std::string_view name) {
  pugi::xml_document document;
  load_xml(document, text, name);
  return InkmlReader(name).read(document.document_element());
}

}  // namespace calligraphy
