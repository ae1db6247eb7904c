// SVC: the number of samples, then x y t pen [azimuth altitude pressure] of each (SVC2004, and corpora after it).
#include <algorithm>
#include <array>

#include "base/line_reader.hpp"
#include "ink_file.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t svc_columns = 7;       // x, y, time, pen, azimuth, altitude, pressure
constexpr std::size_t svc_least_columns = 4;  // as of SVC2004's first task

/// The numbers of a line; none if a word is not one, or there are too many.
std::size_t numbers_of(std::string_view line, std::array<double, svc_columns>& numbers) {
  std::size_t count = 0;
  for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    const std::optional<double> number = finite_number(line.substr(0, end));
    if (!number || count == svc_columns) return 0;
    numbers[count++] = *number;
    line.remove_prefix(end);
  }
  return count;
}

bool is_svc_size(std::size_t count) { return count == svc_least_columns || count == svc_columns; }

}  // namespace

bool is_svc(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return false;
  std::array<double, svc_columns> numbers{};
  if (numbers_of(text.substr(0, end), numbers) != 1) return false;
  const std::string_view second = trimmed(text.substr(end));
  return is_svc_size(numbers_of(second.substr(0, second.find('\n')), numbers));
}

InkFile read_svc(std::string_view text, std::string_view name) {
  InkFile file{InkFormat::svc};
  file.usual = YAxis::up;
  file.azimuth_from_north = true;  // as in Wintab
  InkGroup& group = file.groups.emplace_back();
  LineReader in(bytes_of(text), name);
  std::array<double, svc_columns> numbers{};
  std::size_t columns = 0;
  double announced = -1.0, read = 0.0;
  while (in.next()) {
    if (trimmed(in.line()).empty()) continue;
    const std::size_t count = numbers_of(in.line(), numbers);
    if (announced < 0.0) {
      if (count != 1 || numbers[0] < 1.0) in.fail("expected the number of samples, found " + in_quotes(in.line()));
      announced = numbers[0];
      continue;
    }
    if (columns == 0) columns = count;
    if (!is_svc_size(count) || count != columns) {
      in.fail(in_quotes(in.line()) + ": expected " +
              (columns == svc_least_columns ? "4" : columns == 0 ? "4 or 7" : "7") +
              " numbers: x, y, time, pen" + (columns == svc_least_columns ? "" : ", azimuth, altitude, pressure"));
    }
    if (numbers[3] < 0.0) in.fail("the pen is " + in_quotes(in.line()) + ": expected 0 in the air, 1 on the paper");
    read += 1.0;
    const bool in_air = numbers[3] == 0.0;
    if (group.runs.empty() || group.runs.back().in_air != in_air) add_run(group, in_air, name);
    TimedPoint sample = sample_at(numbers[0], numbers[1]);
    sample.time = numbers[2];
    if (columns == svc_columns) {
      sample.stylus.azimuth = numbers[4];
      sample.stylus.altitude = numbers[5];
      sample.stylus.pressure = numbers[6];
    }
    add_sample(group.runs.back(), sample, name);
  }
  const std::string counts = "has " + std::to_string(static_cast<long long>(read)) + " samples: the first line says " +
                             std::string(trimmed(text.substr(0, text.find('\n'))));
  if (read < announced) fail_ink(name, counts);  // cut off
  if (read > announced) file.notes.push_back(counts);
  return file;
}

}  // namespace calligraphy
