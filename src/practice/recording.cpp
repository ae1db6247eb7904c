#include <calligraphy/practice/recording.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <istream>
#include <limits>
#include <ostream>
#include <string>
#include <system_error>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>

#include "base/charconv.hpp"
#include "base/line_reader.hpp"

namespace calligraphy {
namespace {

constexpr std::array<std::string_view, 16> column_names = {
    "time_s",    "device_x_m", "device_y_m", "device_z_m", "tip_x_m", "tip_y_m",   "tip_z_m", "force_x_N",
    "force_y_N", "force_z_N",  "state",      "events",     "status",  "character", "stroke",  "tick_ns"};
constexpr std::string_view rate_comment = "# rate_Hz=", page_comment = " page=", law_comment = " law=";
constexpr std::size_t max_recording_bytes = 1 << 30;  ///< more than an hour at 1 kHz
constexpr std::size_t max_row_bytes = 4096;           ///< enough for sixteen values as written
constexpr std::size_t max_law_bytes = 1000;           ///< the rest of a name is not written
constexpr std::size_t chunk = 1 << 16;                ///< bytes given to the stream at a time

constexpr std::array states = {InteractionState::separation, InteractionState::adjusting, InteractionState::calibration,
                               InteractionState::writing};
constexpr std::array statuses = {TickStatus::ok, TickStatus::stale, TickStatus::bad_sample, TickStatus::device_fault,
                                 TickStatus::bad_clock, TickStatus::bad_law};
constexpr int all_events = 2 * static_cast<int>(TickEvent::page_finished) - 1;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string header() {
  std::string text;
  for (const std::string_view column : column_names) text.append(text.empty() ? "" : ",").append(column);
  return text;
}

template <typename Number>
void append(std::string& text, Number value) {
  char buffer[32];
  text.append(buffer, to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

void append_row(std::string& text, const RecordedSample& sample) {
  append(text, sample.time);
  for (const Eigen::Vector3d* vector : {&sample.device_point, &sample.pen_tip, &sample.force}) {
    for (const double value : *vector) append(text += ',', value);
  }
  text.append(",").append(to_string(sample.state));
  append(text += ',', static_cast<int>(sample.events));
  text.append(",").append(to_string(sample.status));
  append(text += ',', sample.character);
  append(text += ',', sample.stroke);
  append(text += ',', sample.tick_ns);
  text += '\n';
}

/// Reads what write_recording writes and nothing else, except that line ends may be of either kind.
class RecordingParser : private LineReader {
 public:
  RecordingParser(std::istream& in, std::string_view name)
      : LineReader(bytes_of(in, name), name, max_recording_bytes, max_row_bytes) {}

  Recording parse() {
    next_whole();
    if (line() != header()) fail("expected '" + header() + "', found " + calligraphy::in_quotes(line()));
    next_whole();
    if (!line().starts_with(rate_comment)) {
      fail("expected '" + std::string(rate_comment) + "...', found " + calligraphy::in_quotes(line()));
    }
    Recording recording;
    std::string_view values = std::string_view(line()).substr(rate_comment.size());
    if (const std::size_t law = values.find(law_comment); law != std::string_view::npos) {
      recording.law = values.substr(law + law_comment.size());
      values = values.substr(0, law);
    }
    const std::string_view rate = values.substr(0, values.find(page_comment));
    recording.rate = number<double>("rate_Hz", rate);
    if (!(std::isfinite(recording.rate) && recording.rate > 0.0)) {
      fail("rate_Hz is '" + std::string(rate) + "': expected a finite number above 0");
    }
    if (rate.size() < values.size()) {
      recording.page = number<std::uint32_t>("page", values.substr(rate.size() + page_comment.size()));
    }
    while (next_whole()) recording.samples.push_back(sample());
    return recording;
  }

 private:
  RecordedSample sample() {
    split();
    column_ = 0;
    RecordedSample sample;
    sample.time = next_number<double>();
    for (Eigen::Vector3d* vector : {&sample.device_point, &sample.pen_tip, &sample.force}) {
      for (double& value : *vector) value = next_number<double>();
    }
    sample.state = next_of(states, "SS, AS, CS or WS");
    sample.events = static_cast<TickEvent>(next_integer(all_events));
    sample.status = next_of(statuses, "ok, stale, bad_sample, device_fault, bad_clock or bad_law");
    sample.character = next_integer(std::numeric_limits<int>::max());
    sample.stroke = next_integer(std::numeric_limits<int>::max());
    sample.tick_ns = next_number<float>();
    return sample;
  }

  void split() {
    std::size_t count = 0;
    std::string_view rest = line();
    for (bool more = true; more; ++count) {
      const std::size_t comma = rest.find(',');
      if (count < values_.size()) values_[count] = rest.substr(0, comma);
      more = comma != std::string_view::npos;
      if (more) rest.remove_prefix(comma + 1);
    }
    if (count != column_names.size()) {
      fail("expected " + std::to_string(column_names.size()) + " values, found " + std::to_string(count) + " in '" +
           line() + "'");
    }
  }

  template <typename Number>
  Number number(std::string_view column, std::string_view text) const {
    Number value{};
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) {
      fail(std::string(column) + " is '" + std::string(text) + "': out of range");
    }
    if (error != std::errc() || end != text.data() + text.size()) {
      fail(std::string(column) + " is '" + std::string(text) + "': expected a number");
    }
    return value;
  }

  template <typename Number>
  Number next_number() {
    const std::size_t i = column_++;
    return number<Number>(column_names[i], values_[i]);
  }

  int next_integer(int largest) {
    const int value = next_number<int>();
    if (value < 0 || value > largest) {
      fail(std::string(column_names[column_ - 1]) + " is '" + std::to_string(value) + "': expected 0 to " +
           std::to_string(largest));
    }
    return value;
  }

  template <typename Values>
  typename Values::value_type next_of(const Values& values, const char* expected) {
    const std::size_t i = column_++;
    for (const auto value : values) {
      if (values_[i] == to_string(value)) return value;
    }
    fail(std::string(column_names[i]) + " is '" + std::string(values_[i]) + "': expected " + expected);
  }

  std::array<std::string_view, column_names.size()> values_;  ///< values of the current line
  std::size_t column_ = 0;                                    ///< next value to be read
};

}  // namespace

void write_recording(std::ostream& out, const Recording& recording) {
  std::string text = header().append("\n").append(rate_comment);
  append(text, recording.rate);
  if (recording.page != 0) append(text.append(page_comment), recording.page);
  if (!recording.law.empty()) {
    text.append(law_comment).append(recording.law, 0, max_law_bytes);
    std::replace_if(text.begin() + static_cast<std::ptrdiff_t>(header().size() + 1), text.end(), is_control, ' ');
  }
  text += '\n';
  for (const RecordedSample& sample : recording.samples) {
    append_row(text, sample);
    if (text.size() < chunk) continue;
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  }
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

Recording read_recording(std::istream& in, std::string_view name) { return RecordingParser(in, name).parse(); }

Recording read_recording(const std::filesystem::path& path) {
  std::ifstream in = open_file(path, max_recording_bytes);
  return read_recording(in, path.string());
}

std::vector<DeviceState> device_states(const Recording& recording, const MotionMapping& mapping) {
  std::vector<DeviceState> result;
  result.reserve(recording.samples.size());
  for (const RecordedSample& sample : recording.samples) {
    DeviceState state;
    state.time = sample.time;
    state.position = mapping.to_device(sample.device_point);
    // A fault is replayed as a fault: the sample holds the last good point.
    if (sample.status == TickStatus::bad_sample) state.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (sample.status == TickStatus::stale) state.status = DeviceStatus::stale;
    if (sample.status == TickStatus::device_fault) state.status = DeviceStatus::fault;
    result.push_back(state);
  }
  return result;
}

}  // namespace calligraphy
