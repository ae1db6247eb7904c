#include "sequence.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/parallel.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

std::unique_ptr<Pen> pen_for(const PracticePage& page, const SequenceOptions& options) {
  if (!options.held) return std::make_unique<KinematicPen>(page, options.device, options.renderer);
  return std::make_unique<HeldPen>(page, options.device, options.renderer, GripImpedance{}, options.arm, options.feels);
}

/// Judges each character by itself, in parallel.
SequenceResult judge_each(const std::vector<Character>& characters, const SequenceOptions& options,
                          const std::function<void(double)>& progress,
                          const std::function<SequenceResult(const PracticePage&, Pen&)>& judge) {
  std::vector<SequenceResult> results(characters.size());
  parallel_for(
      characters.size(), options.threads, progress ? progress : [](double) {},
      [&](std::size_t i) {
        const PracticePage page = page_of(characters[i], options.em);
        const std::unique_ptr<Pen> pen = pen_for(page, options);
        results[i] = judge(page, *pen);
        for (Finding& finding : results[i].findings) finding.character = characters[i].code;
      });
  SequenceResult all;
  for (const SequenceResult& result : results) all.add(result);
  return all;
}

Point normal_point(Random& random, double deviation) {
  const double x = random.normal();
  return deviation * Point(x, random.normal());
}

/// Three waves along a stroke, their deviations per axis.
class Distortion {
 public:
  Distortion(Random& random, Noise noise, double size) {
    const double per_axis = size / std::numbers::sqrt2;
    if (noise == Noise::displacement) waves_[0] = normal_point(random, per_axis);
    if (noise != Noise::distortion) return;
    waves_[0] = normal_point(random, per_axis * std::sqrt(1.0 / 3.0));
    for (std::size_t i = 1; i < 3; ++i) waves_[i] = normal_point(random, per_axis * std::sqrt(2.0 / 3.0));
  }
  Point operator()(double share) const {
    const double angle = std::numbers::pi * share;
    return waves_[0] + std::cos(angle) * waves_[1] + std::cos(2.0 * angle) * waves_[2];
  }

 private:
  std::array<Point, 3> waves_ = {Point::Zero(), Point::Zero(), Point::Zero()};
};

}  // namespace

void SequenceResult::add(const SequenceResult& other) {
  taken.add(other.taken);
  not_finished_exactly += other.not_finished_exactly;
  findings.insert(findings.end(), other.findings.begin(), other.findings.end());
}

SequenceResult judge_attempts(const std::vector<Character>& characters, const SequenceOptions& options,
                              const Attempts& attempts, const std::function<void(double)>& progress) {
  return judge_each(characters, options, progress, [&](const PracticePage& page, Pen& pen) {
    SequenceResult result;
    const std::vector<StrokeLine> lines = stroke_lines(page.characters.front());
    for (std::size_t due = 0; due < lines.size(); ++due) {
      bool taken = false;
      const std::vector<Attempt> tried = attempts(lines, due);
      for (std::size_t i = 0; i < tried.size() && !taken; ++i) {
        taken = pen.draw(tried[i].line, options.em).finished;
        if (!taken) continue;
        result.findings.push_back(tried[i].finding);
        result.findings.back().stroke = static_cast<int>(due);
      }
      if (!tried.empty()) result.taken.add(taken);
      if (taken || pen.draw(lines[due], options.em).finished) continue;
      ++result.not_finished_exactly;
      result.findings.push_back({0, static_cast<int>(due)});
      break;
    }
    return result;
  });
}

Attempts later_strokes(double em, double different) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due) {
    std::vector<Attempt> later;
    for (std::size_t i = due + 1; i < lines.size(); ++i) {
      const double difference = mean_distance(lines[due], lines[i]) / em;
      if (difference > different) later.push_back({lines[i], {0, 0, static_cast<int>(i), difference}});
    }
    return later;
  };
}

Attempts part_of_stroke(double from, double to) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due) {
    return std::vector<Attempt>{{lines[due].part(from, to), {}}};
  };
}

Attempts displaced_sideways(double distance) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due) {
    const Point along = (lines[due].at(lines[due].length()) - lines[due].at(0.0)).normalized();
    const Point way = distance * Point(-along.y(), along.x());
    return std::vector<Attempt>{{lines[due].moved([&](const Point& point, double) { return Point(point + way); }), {}}};
  };
}

StrokeLine zigzag_about(const StrokeLine& line, const Zigzag& zigzag, double em) {
  const double length = line.length(), wave = std::min(zigzag.wavelength * em, length);
  const int steps = std::max(64, static_cast<int>(48.0 * length / wave));
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i) {
    const double arc = length * i / steps;
    const double phase = (wave > 0.0 ? arc / wave : 0.0) + (zigzag.at_extreme ? 0.25 : 0.0);
    const double angle = 2.0 * std::numbers::pi * phase;
    const double height = zigzag.sine ? std::sin(angle) : std::asin(std::sin(angle)) * 2.0 / std::numbers::pi;
    const Point tangent = line.tangent(arc);
    points.push_back(line.at(arc) + zigzag.amplitude * em * height * Point(-tangent.y(), tangent.x()));
  }
  const std::size_t last = points.size() - 1;
  return StrokeLine(std::move(points), {0, last});
}

Attempts zigzags(double em, const std::vector<Zigzag>& zigzags) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due) {
    std::vector<Attempt> attempts;
    for (std::size_t i = 0; i < zigzags.size(); ++i) {
      attempts.push_back(
          {zigzag_about(lines[due], zigzags[i], em), {0, 0, static_cast<int>(i), lines[due].length() / em}});
    }
    return attempts;
  };
}

SequenceResult judge_people(const std::vector<Character>& characters, const SequenceOptions& options,
                            const PeopleDraw& people, const std::function<void(double)>& progress) {
  return judge_each(characters, options, progress, [&](const PracticePage& page, Pen& pen) {
    constexpr int exact_attempts = 3;
    SequenceResult result;
    const std::vector<StrokeLine> lines = stroke_lines(page.characters.front());
    Random random(options.seed, {static_cast<int>(page.characters.front().character.code)});
    const double angle = random.between(0.0, 2.0 * std::numbers::pi);
    const double away = people.shift * options.em * std::sqrt(random.next());
    const Point shift(away * std::cos(angle), away * std::sin(angle));
    bool goes_on = true;
    for (std::size_t due = 0; due < lines.size(); ++due) {
      const Distortion distortion(random, people.noise, people.noise_size * options.em);
      const double scale = 1.0 + people.scale * random.between(-1.0, 1.0);
      const Point start = lines[due].at(0.0);
      const StrokeLine drawn = lines[due].moved([&](const Point& point, double share) {
        return Point(start + scale * (point - start) + shift + distortion(share));
      });
      const bool at_once = goes_on && pen.draw(drawn, options.em).finished;
      result.taken.add(at_once);
      if (at_once) continue;
      result.findings.push_back({0, static_cast<int>(due), -1, lines[due].length() / options.em});
      for (int i = 0; goes_on && i <= exact_attempts; ++i) {
        goes_on = i < exact_attempts;
        if (goes_on && pen.draw(lines[due], options.em).finished) break;
      }
      if (!goes_on && result.not_finished_exactly == 0) result.not_finished_exactly = 1;
    }
    return result;
  });
}

}  // namespace calligraphy_test
