#include <calligraphy/practice/recording_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/render/option_values.hpp>

#include "base/charconv.hpp"
#include "base/line_reader.hpp"
#include "base/require.hpp"
#include "base/stylus_fields.hpp"
#include "input_codec.hpp"

namespace calligraphy {
namespace {

constexpr std::string_view first_line = "calligraphy recording 1", ticks_line = "ticks", end_word = "end";
constexpr std::size_t max_bytes = 1 << 30;         ///< of the text
constexpr std::size_t max_ticks = 4'000'000;       ///< more than an hour at 1 kHz, in 2 GB of memory
constexpr std::size_t max_line_bytes = 1 << 16;    ///< of a character with many strokes
constexpr std::size_t max_name_bytes = 1000;       ///< the rest of a name is not written
constexpr std::size_t max_characters = 10000;      ///< on a page
constexpr std::size_t max_character_lines = 1000;  ///< of one
constexpr std::size_t chunk = 1 << 14;             ///< bytes given to the stream at a time

constexpr std::array<std::pair<std::string_view, double Capabilities::*>, 10> device_numbers = {{
    {"peak_force", &Capabilities::peak_force},
    {"continuous_force", &Capabilities::continuous_force},
    {"usable_stiffness", &Capabilities::usable_stiffness},
    {"force_step", &Capabilities::force_step},
    {"encoder_step", &Capabilities::encoder_step},
    {"velocity_cutoff", &Capabilities::velocity_cutoff},
    {"update_rate", &Capabilities::update_rate},
    {"apparent_mass", &Capabilities::apparent_mass},
    {"viscous_friction", &Capabilities::viscous_friction},
    {"coulomb_friction", &Capabilities::coulomb_friction},
}};

/// A name on one line.
std::string one_line(std::string_view name) {
  std::string text(name.substr(0, max_name_bytes));
  std::replace_if(text.begin(), text.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return text;
}

std::string bits_of(const DeviceAxes& axes) {
  std::string bits;
  for (const bool axis : {axes.x, axes.y, axes.z, axes.rotations}) bits += axis ? '1' : '0';
  return bits;
}

/// The text before the ticks.
std::string head_of(const Recording& recording) {
  const RecordingSetup& setup = *recording.setup;
  std::string text(first_line);
  const auto add = [&text](std::string_view key, std::initializer_list<double> numbers) {
    text.append("\n").append(key);
    for (const double number : numbers) text.append(" ").append(number_text(number));
  };
  const auto add_text = [&text](std::string_view key, std::string_view value) {
    text.append("\n").append(key).append(" ").append(one_line(value));
  };
  add("rate", {recording.rate});
  add_text("mode", to_string(setup.mode));
  add_text("law", recording.law);
  if (setup.has_own_law) add_text("forces", "stored");
  add("paper", {setup.page.width, setup.page.height});
  const Eigen::Matrix3d& turn = setup.mapping.rotation;
  add("mapping", {turn(0, 0), turn(0, 1), turn(0, 2), turn(1, 0), turn(1, 1), turn(1, 2), turn(2, 0), turn(2, 1),
                  turn(2, 2), setup.mapping.offset.x(), setup.mapping.offset.y(), setup.mapping.offset.z(),
                  setup.mapping.scale});
  const Capabilities& device = setup.device;
  add_text("device name", device.name);
  add_text("device model", device.model);
  add_text("device simulated", device.simulated ? "1" : "0");
  add_text("device sensed", bits_of(device.sensed));
  add_text("device driven", bits_of(device.driven));
  add_text("device velocity", to_string(device.velocity));
  add("device sample_delay", {static_cast<double>(device.sample_delay)});
  add("device workspace", {device.workspace.x(), device.workspace.y(), device.workspace.z()});
  for (const auto& [name, member] : device_numbers) add("device " + std::string(name), {device.*member});
  for (const OptionValue& option : option_values(setup.renderer)) {
    const bool is_own = setup.has_own_law && option.name == "guidance.force";
    if (!is_own) add_text("option " + option.name, option.value);
  }
  for (const PlacedCharacter& placed : setup.page.characters) {
    std::ostringstream out;
    write_characters(out, {{}, {placed.character}});
    const std::string lines = out.str();
    if (std::count(lines.begin(), lines.end(), '\n') > static_cast<std::ptrdiff_t>(max_character_lines)) {
      throw ValueError("recording: a character takes more than " + std::to_string(max_character_lines) + " lines");
    }
    add("character", {placed.placement.origin.x(), placed.placement.origin.y(), placed.placement.em,
                      static_cast<double>(std::count(lines.begin(), lines.end(), '\n'))});
    text.append("\n").append(lines, 0, lines.size() - 1);
  }
  return text.append("\n").append(ticks_line).append("\n");
}

/// Reads what RecordingWriter writes and nothing else, except that line ends may be of either kind.
class RecordingParser : private LineReader {
 public:
  RecordingParser(std::istream& in, std::string_view name)
      : LineReader(bytes_of(in, name), name, max_bytes, max_line_bytes) {}

  StoredRecording parse() {
    next_whole();
    if (line() != first_line) {
      fail("expected '" + std::string(first_line) + "', found " + calligraphy::in_quotes(line()));
    }
    while (next_whole() && line() != ticks_line) read_head();
    if (line() != ticks_line) fail("expected the ticks, found the end of the file");
    for (const char* const key : {"rate", "mode", "law", "paper", "mapping", "device name", "device model",
                                  "device simulated", "device sensed", "device driven", "device velocity",
                                  "device sample_delay", "device workspace"}) {
      if (seen_.count(key) == 0) fail(std::string("there is no statement '") + key + "'");
    }
    for (const auto& [name, member] : device_numbers) {
      if (seen_.count("device " + std::string(name)) == 0) fail("there is no statement 'device " + std::string(name) + "'");
    }
    stored_.recording.page = page_id(setup().page);
    const std::uint64_t checksum = read_ticks();
    make_ticks();
    stored_.has_same_forces = stored_.is_complete && checksum == force_checksum(stored_.recording.samples);
    return std::move(stored_);
  }

 private:
  RecordingSetup& setup() {
    if (!stored_.recording.setup) stored_.recording.setup.emplace();
    return *stored_.recording.setup;
  }

  void read_head() {
    const std::string_view key = word();
    if (key != "device" && key != "option" && key != "character") see(key);
    if (key == "rate") {
      stored_.recording.rate = number();
      if (!(std::isfinite(stored_.recording.rate) && stored_.recording.rate > 0.0)) {
        fail("the rate is not a finite number above 0");
      }
    } else if (key == "mode") {
      const bool is_vision = is_second(to_string(FeedbackMode::force), to_string(FeedbackMode::vision));
      setup().mode = is_vision ? FeedbackMode::vision : FeedbackMode::force;
    } else if (key == "law") {
      stored_.recording.law = rest();
    } else if (key == "forces") {
      setup().has_own_law = is_second("made", "stored");
    } else if (key == "paper") {
      setup().page.width = number();
      setup().page.height = number();
    } else if (key == "mapping") {
      for (Eigen::Index i = 0; i < 9; ++i) setup().mapping.rotation(i / 3, i % 3) = number();
      for (double& coordinate : setup().mapping.offset) coordinate = number();
      setup().mapping.scale = number();
    } else if (key == "device") {
      read_device();
    } else if (key == "option") {
      const std::string name(word());
      see("option " + name);
      try {
        set_option(setup().renderer, name, word());
      } catch (const ValueError& error) {
        fail(error.what());
      }
    } else if (key == "character") {
      return read_character();
    } else {
      fail("unknown statement " + in_quotes(key));
    }
    if (!rest().empty()) fail("unexpected text at the end of the line");
  }

  void read_device() {
    Capabilities& device = setup().device;
    const std::string_view key = word();
    see("device " + std::string(key));
    if (key == "name") {
      device.name = rest();
    } else if (key == "model") {
      device.model = rest();
    } else if (key == "simulated") {
      device.simulated = is_second("0", "1");
    } else if (key == "sensed" || key == "driven") {
      DeviceAxes& axes = key == "sensed" ? device.sensed : device.driven;
      const std::string_view bits = word();
      if (bits.size() != 4 || bits.find_first_not_of("01") != bits.npos) fail("expected four bits for the axes, found " + in_quotes(bits));
      axes = {bits[0] == '1', bits[1] == '1', bits[2] == '1', bits[3] == '1'};
    } else if (key == "velocity") {
      const bool is_measured = is_second(to_string(VelocitySource::estimated), to_string(VelocitySource::measured));
      device.velocity = is_measured ? VelocitySource::measured : VelocitySource::estimated;
    } else if (key == "sample_delay") {
      device.sample_delay = static_cast<int>(count(1e5));
    } else if (key == "workspace") {
      for (double& extent : device.workspace) extent = number();
    } else {
      for (const auto& [name, member] : device_numbers) {
        if (name != key) continue;
        device.*member = number();
        return;
      }
      fail("unknown property of the device " + in_quotes(key));
    }
  }

  void read_character() {
    if (setup().page.characters.size() >= max_characters) fail("too many characters");
    Placement placement;
    placement.origin.x() = number();
    placement.origin.y() = number();
    placement.em = number();
    const auto lines = static_cast<std::size_t>(count(max_character_lines));
    if (!rest().empty()) fail("unexpected text at the end of the line");
    const int first = LineReader::number();
    std::string text;
    for (std::size_t i = 0; i < lines; ++i) {
      if (!next_whole()) fail("the file is truncated within a character");
      text.append(line()).append("\n");
    }
    std::istringstream in(text);
    CharacterList list = read_characters(in, name() + ": the character after line " + std::to_string(first));
    if (list.characters.size() != 1) fail("expected one character");
    setup().page.characters.push_back({std::move(list.characters.front()), placement});
  }

  /// Returns the checksum of the forces.
  std::uint64_t read_ticks() {
    Recording& recording = stored_.recording;
    InputDecoder decoder(recording.rate, setup().device, setup().has_own_law);
    while (next()) {
      if (!is_whole()) break;  // it was being written
      if (line().starts_with(end_word)) return read_end();
      if (recording.inputs.size() >= max_ticks) fail("more than " + std::to_string(max_ticks) + " ticks");
      try {
        recording.inputs.push_back(decoder.decode(line()));
      } catch (const FormatError& error) {
        fail(error.what());
      }
      if (setup().has_own_law) own_forces_.push_back(decoder.own_force());
    }
    return 0;
  }

  std::uint64_t read_end() {
    if (word() != end_word) fail("expected a tick or the end, found " + calligraphy::in_quotes(line()));
    const std::string_view count = word(), checksum = word();
    std::size_t ticks = 0;
    std::uint64_t forces = 0;
    const auto is_number = [](std::string_view text, auto& value, int base) {
      const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value, base);
      return error == std::errc() && end == text.data() + text.size();
    };
    if (!is_number(count, ticks, 10) || !is_number(checksum, forces, 16) || !rest().empty()) {
      fail("expected the number of ticks and a checksum, found " + calligraphy::in_quotes(line()));
    }
    if (ticks != stored_.recording.inputs.size()) {
      fail("the file has " + std::to_string(stored_.recording.inputs.size()) + " of " + std::to_string(ticks) +
           " ticks");
    }
    if (next()) fail("text after the end");
    stored_.is_complete = true;
    return forces;
  }

  void make_ticks() {
    Recording& recording = stored_.recording;
    try {
      recording.samples = replayed(recording).samples;
    } catch (const ValueError& error) {
      throw FormatError(name() + ": " + error.what());
    }
    for (std::size_t i = 0; i < own_forces_.size(); ++i) recording.samples[i].force = own_forces_[i];
  }

  /// Notes that a statement was there. @throws FormatError if it was before
  void see(std::string_view statement) {
    if (!seen_.emplace(statement).second) fail("a second statement '" + std::string(statement) + "'");
  }

  /// Whether the next word is the second of two.
  bool is_second(std::string_view first, std::string_view second) {
    const std::string_view text = word();
    if (text != first && text != second) {
      fail("expected '" + std::string(first) + "' or '" + std::string(second) + "', found " + in_quotes(text));
    }
    return text == second;
  }

  double count(double most) {
    const double value = number(0.0, most);
    if (std::trunc(value) != value) fail("expected an integer, found " + number_text(value));
    return value;
  }

  double number(double least = -std::numeric_limits<double>::infinity(),
                double most = std::numeric_limits<double>::infinity()) {
    const std::string_view text = word();
    double value = 0.0;
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = !text.empty() && error == std::errc() && end == text.data() + text.size();
    if (!is_number || !(value >= least && value <= most)) fail("expected a number, found " + in_quotes(text));
    return value;
  }

  StoredRecording stored_;
  std::set<std::string, std::less<>> seen_;  ///< statements
  std::vector<Eigen::Vector3d> own_forces_;
};

}  // namespace

class RecordingWriter::Implementation {
 public:
  Implementation(std::ostream& out, const Recording& recording)
      : out_(out),
        encoder_(recording.rate, recording.setup->device, recording.setup->has_own_law),
        text_(head_of(recording)) {
    flush();
  }

  void add(const Recording& recording) {
    if (recording.inputs.size() != recording.samples.size()) {
      throw ValueError("recording: " + std::to_string(recording.samples.size()) + " ticks and " +
                       std::to_string(recording.inputs.size()) + " inputs");
    }
    for (; count_ < recording.samples.size(); ++count_) {
      encoder_.append(text_, recording.inputs[count_], recording.samples[count_].force);
      checksum_ = force_checksum({&recording.samples[count_], 1}, checksum_);
      if (text_.size() >= chunk) flush();
    }
    flush();
  }

  void finish() {
    char hex[16];
    text_.append(end_word).append(" ").append(std::to_string(count_)).append(" ");
    text_.append(hex, to_chars(hex, hex + sizeof hex, checksum_, 16).ptr).append("\n");
    flush();
  }

 private:
  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  std::ostream& out_;
  InputEncoder encoder_;
  std::string text_;
  std::size_t count_ = 0;
  std::uint64_t checksum_ = force_checksum({});
};

RecordingWriter::RecordingWriter(std::ostream& out, const Recording& recording) {
  if (!recording.setup) throw ValueError("recording: without a set-up its forces could not be made again");
  implementation_ = std::make_unique<Implementation>(out, recording);
}

RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter::~RecordingWriter() = default;

void RecordingWriter::add(const Recording& recording) { implementation_->add(recording); }

void RecordingWriter::finish() { implementation_->finish(); }

void write_recording(std::ostream& out, const Recording& recording) {
  RecordingWriter writer(out, recording);
  writer.add(recording);
  writer.finish();
}

StoredRecording read_recording(std::istream& in, std::string_view name) { return RecordingParser(in, name).parse(); }

StoredRecording read_recording(const std::filesystem::path& path) {
  std::ifstream in = open_file(path, max_bytes);
  return read_recording(in, path.string());
}

}  // namespace calligraphy
