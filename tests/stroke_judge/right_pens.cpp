#include "right_pens.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/practice/session.hpp>

#include "base/parallel.hpp"
#include "judge/pens/resemblance.hpp"
#include "polyline.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

constexpr double flat = 0.25;           // of the other side: a side of a box that is too short to be scaled by itself
constexpr double rounding = 1e-12;      // [em]
constexpr std::size_t tablet_step = 8;  // samples of 1 ms per point of a tablet of 125 Hz

using Samples = std::array<Point, 8>;

Samples samples_of(const PenPath& path) {
  Samples samples;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k] = point_at(path, static_cast<double>(k) / static_cast<double>(samples.size() - 1));
  }
  return samples;
}

double mean_distance_of(const Samples& one, const Samples& other) {
  double sum = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) sum += (one[k] - other[k]).norm();
  return sum / static_cast<double>(one.size());
}

Samples backwards(Samples samples) {
  std::reverse(samples.begin(), samples.end());
  return samples;
}

/// The pen-downs, laid on the box by the centre and the scale of each axis.
std::vector<PenPath> laid_on(const Box& to, std::span<const PenPath> paths) {
  const Box from = box_of(paths);
  const Point sides = from.sizes(), wanted = to.sizes();
  Point scale = Point::Ones();
  const auto is_flat = [&](int axis) {
    return sides[axis] <= flat * sides[1 - axis] || wanted[axis] <= flat * wanted[1 - axis];
  };
  for (const int axis : {0, 1}) {
    if (!is_flat(axis)) scale[axis] = wanted[axis] / sides[axis];
  }
  for (const int axis : {0, 1}) {
    if (!is_flat(axis) && is_flat(1 - axis)) scale[1 - axis] = scale[axis];
  }
  std::vector<PenPath> laid(paths.begin(), paths.end());
  for (PenPath& path : laid) {
    for (Point& point : path) point = to.center() + scale.cwiseProduct(point - from.center());
  }
  return laid;
}

bool has_negative_cycle(std::vector<std::vector<double>> weights) {
  const std::size_t count = weights.size();
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        weights[i][j] = std::min(weights[i][j], weights[i][k] + weights[k][j]);
      }
      if (weights[i][i] < -rounding) return true;
    }
  }
  return false;
}

std::optional<Character> character_written(char32_t code, std::span<const PenPath> paths,
                                           const std::vector<CharacterSet>& sets) {
  for (const CharacterSet& set : sets) {
    const auto stored = set.find(code);
    if (!stored || stored->stroke_count() != static_cast<int>(paths.size())) continue;
    const Character character = stored->character();
    if (is_right(character, paths)) return character;
  }
  return std::nullopt;
}

std::vector<std::string> text_files(const std::vector<std::string>& directories) {
  std::vector<std::string> files;
  for (const std::string& directory : directories) {
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(directory, failure)) {
      if (entry.path().extension() == ".txt") files.push_back(entry.path().string());
    }
    if (failure) throw ValueError("directory of pen traces '" + directory + "': " + failure.message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// As a tablet records them.
std::vector<PenPath> at_the_rate_of_a_tablet(const std::vector<PenPath>& paths) {
  std::vector<PenPath> thinned;
  for (const PenPath& path : paths) {
    PenPath& kept = thinned.emplace_back();
    for (std::size_t i = 0; i + 1 < path.size(); i += tablet_step) kept.push_back(path[i]);
    kept.push_back(path.back());
  }
  return thinned;
}

std::vector<PenPath> write(const Character& character, bool skilled, std::uint64_t seed) {
  SessionOptions options;
  options.mode = FeedbackMode::vision;
  options.device = device_profile("desktop");
  options.renderer = RendererOptions::for_device(options.device);
  options.skill = skilled ? WriterSkill::skilled() : WriterSkill::novice();
  options.skill.wrong_order = options.skill.wrong_direction = 0.0;
  options.seed = seed;
  const PracticePage page = lay_out(std::span(&character, 1)).front();
  return at_the_rate_of_a_tablet(pen_paths(write_page(page, options), page.characters.front().placement));
}

}  // namespace

bool is_right(const Character& character, std::span<const PenPath> paths) {
  const std::vector<Stroke> all = strokes(character);
  const std::size_t count = all.size();
  if (paths.size() != count || count == 0) return false;
  std::vector<PenPath> lines;
  for (const Stroke& stroke : all) lines.push_back(middle_line(stroke, {Point::Zero(), 1.0}));
  const std::vector<PenPath> laid = laid_on(box_of(lines), paths);
  std::vector<std::vector<double>> weights(count, std::vector<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Samples drawn = samples_of(laid[i]), reversed_drawn = backwards(drawn);
    for (std::size_t j = 0; j < count; ++j) {
      const Samples stroke = samples_of(lines[j]);
      const double along = mean_distance_of(drawn, stroke), against = mean_distance_of(reversed_drawn, stroke);
      const bool reversible = path_length(laid[i]) == 0.0 || chord(lines[j]) < 0.5 * path_length(lines[j]);
      if (i == j && !reversible && !(along < against)) return false;
      weights[i][j] = std::min(along, against);
    }
    const double own = weights[i][i];
    for (double& weight : weights[i]) weight -= own;
  }
  return !has_negative_cycle(std::move(weights));
}

std::vector<RightPen> pens_of_people(const std::vector<std::string>& directories,
                                     const std::vector<CharacterSet>& sets) {
  std::vector<RightPen> pens;
  for (const std::string& file : text_files(directories)) {
    for (const PenTrace& trace : read_pen_traces(file)) {
      std::vector<PenPath> paths = pen_paths(trace);
      const auto character = character_written(trace.character, paths, sets);
      if (character) pens.push_back({std::filesystem::path(file).stem().string(), *character, std::move(paths)});
    }
  }
  return pens;
}

std::vector<Character> spread_over(const CharacterSet& set, std::size_t count) {
  const std::size_t size = set.size();
  std::vector<Character> characters;
  std::size_t i = 0;
  for (const StoredCharacter& stored : set) {
    // The k-th of `count` at the index k size / count, rounded up.
    if (characters.size() * size <= i * count && characters.size() < count) characters.push_back(stored.character());
    ++i;
  }
  return characters;
}

std::vector<RightPen> written_pens(const std::vector<Character>& characters, std::uint64_t first_seed, int threads,
                                   const std::function<void(double)>& progress) {
  std::vector<std::optional<RightPen>> written(characters.size());
  parallel_for(characters.size(), threads, progress, [&](std::size_t i) {
    std::vector<PenPath> paths = write(characters[i], i % 2 == 1, first_seed + i);
    if (is_right(characters[i], paths)) written[i] = RightPen{"written", characters[i], std::move(paths)};
  });
  std::vector<RightPen> pens;
  for (std::optional<RightPen>& pen : written) {
    if (pen) pens.push_back(std::move(*pen));
  }
  return pens;
}

std::vector<RightPen> medians(const std::vector<Character>& characters) {
  std::vector<RightPen> pens;
  for (const Character& each : characters) pens.push_back({"medians", each, middle_lines(each)});
  return pens;
}

}  // namespace calligraphy_test
