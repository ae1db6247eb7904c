#include "issue_cases.hpp"

#include <atomic>
#include <cstdio>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/device_profiles.hpp>

#include "base/parallel.hpp"

namespace calligraphy_test {
namespace {

using namespace calligraphy;

constexpr GripImpedance nobody = {0.0, 0.0, 0.0}, soft = {0.05, 1.0, 100.0}, normal = {0.1, 3.0, 300.0},
                        light = {0.02, 0.3, 30.0};
constexpr double depth = 0.001;  // where the hand means to be in the paper [m]

Vector3d on_page(const Point& point, double z) { return {point.x(), point.y(), z}; }

template <typename... Values>
std::string text(const char* format, Values... values) {
  char result[256];
  std::snprintf(result, sizeof result, format, values...);
  return result;
}

std::string swing(const HandFigures& figures) {
  return text("%.1f mm, %.1f N (peak %.1f N), %.1f Hz", 1e3 * figures.motion, figures.force, figures.peak,
              figures.frequency);
}

IssueFigure swings(const std::string& name, const std::string& reported, const HandRun& run) {
  try {
    const HandFigures figures = run_hand(run);
    return {name, reported, swing(figures), figures.at_rest()};
  } catch (const Error& error) {
    return {name, reported, error.what(), false};
  }
}

void set_rate(HandRun& run, double rate) {
  run.device.update_rate = rate;
  run.options = RendererOptions::for_device(run.device);
}

}  // namespace

StrokePath first_stroke(char32_t character) { return {in_the_middle(built_in_characters().at(character)), 0}; }

HandFigures run_hand(const HandRun& run) {
  const MotionMapping mapping = upright_page(page_width, page_height);
  RendererOptions options = run.options;
  options.stiffness_check = StiffnessCheck::clip;
  HapticRenderer renderer({in_the_middle(built_in_characters().at(run.character), run.attraction)}, mapping, run.device,
                          options);
  IndependentDevice device(run.device, mapping.to_device(run.start));
  const auto hand = [&](double time, const Vector3d& position, const Vector3d& velocity) {
    constexpr double moment = 1e-4;
    HandAction action;
    action.mass = run.grip.mass;
    if (run.grip.mass > 0.0) {
      const Vector3d to = run.intention ? run.intention(time) : run.start;
      Vector3d speed = run.intention ? Vector3d((run.intention(time + moment) - to) / moment) : Vector3d(0.0, 0.0, 0.0);
      if (speed.norm() > 2.0) speed.setZero();  // a leap
      action.force = grip_force(run.grip, to, speed, mapping.to_page(position), velocity);
    }
    if (run.force) action.force += run.force(time, mapping.to_page(position));
    action.force = mapping.force_to_device(action.force);
    return action;
  };
  HandFigures figures;
  Extent motion, force;
  std::array<int, 3> turns = {};
  Vector3d last_velocity = Vector3d::Zero();
  const double rate = run.device.update_rate;
  for (int tick = 0; tick < run.end * rate; ++tick) {
    const HapticTick& felt = renderer.update(device.read());
    device.write(felt.force);
    figures.strokes += has_event(felt.events, TickEvent::stroke_finished);
    figures.abandoned += has_event(felt.events, TickEvent::stroke_abandoned);
    if (tick >= run.window * rate) {
      motion.add(device.position());
      force.add(device.force());
      figures.peak = std::max(figures.peak, device.force().norm());
      for (int i = 0; i < 3; ++i) turns[static_cast<std::size_t>(i)] += device.velocity()[i] * last_velocity[i] < 0.0;
      last_velocity = device.velocity();
    }
    device.advance(1.0 / rate, hand);
  }
  Eigen::Index axis = 0;
  figures.motion = motion.size().maxCoeff(&axis);
  figures.force = force.size().maxCoeff();
  figures.frequency = 0.5 * turns[static_cast<std::size_t>(axis)] / (run.end - run.window);
  return figures;
}

HandRun jogged(const std::string& profile, const GripImpedance& grip, double distance, double duration) {
  HandRun run;
  run.device = device_profile(profile);
  if (run.device.viscous_friction == 0.0) run.device.viscous_friction = 0.05;
  run.options = RendererOptions::for_device(run.device);
  run.grip = grip;
  const StrokePath stroke = first_stroke(run.character);
  run.start = on_page(stroke.at(0.0), 0.005);
  run.intention = [=](double time) {
    const Point on_stroke = stroke.at(0.4 * stroke.length() * smooth_step((time - 0.3) / 0.3));
    Vector3d to = on_page(on_stroke, 0.005 - (0.005 + depth) * smooth_step(time / 0.2));
    if (time >= 1.0 && time < 1.0 + duration) to.y() += distance;
    return to;
  };
  run.window = 2.5 + duration;
  run.end = run.window + 1.0;
  return run;
}

HandRun returning(const GripImpedance& grip, double beside) {
  HandRun run;
  run.device = device_profile("desktop");
  run.options = RendererOptions::for_device(run.device);
  run.grip = grip;
  const StrokePath stroke = first_stroke(run.character);
  run.start = on_page(stroke.at(0.002) + Point(0.0, beside), 0.005);
  run.intention = [=](double time) {
    const double aside = beside * (1.0 - smooth_step((time - 0.7) / 0.05));
    return on_page(stroke.at(0.002) + Point(0.0, aside), 0.005 - (0.005 + depth) * smooth_step(time / 0.2));
  };
  run.window = 2.25;
  run.end = 3.25;
  return run;
}

HandRun pressed(const std::string& profile, double force) {
  HandRun run;
  run.device = device_profile(profile);
  run.options = RendererOptions::for_device(run.device);
  run.grip = nobody;
  run.start = on_page(first_stroke(run.character).at(0.002), 0.0001);
  run.force = [force](double, const Vector3d& position) {
    return Vector3d(0.0, 0.0, -force * std::clamp((position.z() + 0.015) / 0.005, 0.0, 1.0));
  };
  run.window = 1.6;
  run.end = 2.6;
  return run;
}

HandRun pulled_aside(double force) {
  HandRun run = jogged("desktop", light, 0.0);
  run.options.guidance.force = linear_guidance;
  run.force = [force](double time, const Vector3d&) {
    const double press = std::clamp((time - 0.2) / 0.1, 0.0, 1.0);
    return Vector3d(0.0, time >= 1.0 && time < 1.04 ? force : 0.0, -press);
  };
  return run;
}

HandRun writing(const std::string& profile, char32_t character, const GripImpedance& grip) {
  constexpr double raised_pen = 0.008, pressed_pen = 0.0025, speed = 0.8 * 0.04;
  HandRun run;
  run.device = device_profile(profile);
  run.options = RendererOptions::for_device(run.device);
  run.character = character;
  run.grip = grip;
  struct Part {
    StrokePath path;
    double begins, lowered, written, ends;
  };
  std::vector<Part> parts;
  const PlacedCharacter placed = in_the_middle(built_in_characters().at(character));
  double time = 0.0;
  for (int i = 0; i < placed.character.stroke_count(); ++i) {
    Part part{StrokePath(placed, static_cast<std::size_t>(i)), time, 0.0, 0.0, 0.0};
    part.lowered = part.begins + (i > 0 ? 0.4 : 0.0) + 0.2;
    part.written = part.lowered + std::max(0.12, part.path.length() / speed) + 0.2;
    part.ends = part.written + 0.12;
    time = part.ends;
    parts.push_back(part);
  }
  run.start = on_page(parts.front().path.at(0.0), raised_pen);
  run.intention = [parts](double at) {
    std::size_t i = 0;
    while (i + 1 < parts.size() && at >= parts[i].ends) ++i;
    const Part& part = parts[i];
    const double lowering = smooth_step((at - part.lowered + 0.2) / 0.2),
                 raising = smooth_step((at - part.written) / 0.12);
    const double z = raised_pen - (raised_pen + pressed_pen) * (lowering - raising);
    const double span = part.written - part.lowered - 0.2;
    Point to = part.path.at(part.path.length() * smooth_step((at - part.lowered) / span));
    if (i > 0) {
      const Point from = parts[i - 1].path.at(parts[i - 1].path.length());
      to = from + smooth_step((at - part.begins) / 0.4) * (to - from);
    }
    return on_page(to, z);
  };
  run.end = time + 0.3;
  run.window = run.end - 0.1;
  return run;
}

int count_swinging(const std::string& profile, const std::function<void(RendererOptions&)>& change, int count,
                   int threads, bool everything, std::uint64_t seed) {
  std::atomic<int> swinging = 0;
  parallel_for(
      static_cast<std::size_t>(count), threads, [](double) {},
      [&](std::size_t i) {
        Random random(seed, {static_cast<int>(i)});
        GripImpedance grip;
        grip.mass = random.between(0.05, 0.15);
        grip.damping = random.between(1.0, 5.0);
        grip.stiffness = random.between(100.0, 500.0);
        HandRun run = jogged(profile, grip, 0.01, random.between(0.02, 0.06));
        if (everything) run.options = RendererOptions::everything(run.device);
        if (change) change(run.options);
        if (!run_hand(run).at_rest()) ++swinging;
      });
  return swinging;
}

std::vector<IssueFigure> issue_figures(int threads, int grips) {
  std::vector<IssueFigure> rows;
  for (const double rate : {1000.0, 10000.0}) {
    HandRun run = returning(normal);
    set_rate(run, rate);
    rows.push_back(swings(text("Desktop, 5.7 mm beside, hand returns in 50 ms, %.0f kHz", rate / 1000.0),
                          "20.9 mm, 2.7 N, 8.5 Hz", run));
  }
  for (const double duration : {0.02, 0.04, 0.06}) {
    HandRun run = jogged("desktop", normal, 0.01, duration);
    run.window = 6.0;
    run.end = 7.0;
    rows.push_back(swings(text("Desktop, arm jogged by 10 mm for %.0f ms, 5 s later", 1e3 * duration), "20.8 mm", run));
  }

  const auto count = [&](const std::string& name, const std::string& reported, const std::string& profile, int of,
                         const std::function<void(RendererOptions&)>& change, bool everything = false) {
    try {
      const int swinging = count_swinging(profile, change, of, threads, everything);
      rows.push_back(
          {profile + ", random grips jogged, " + name, reported, text("%d of %d", swinging, of), swinging == 0});
    } catch (const Error& error) {
      rows.push_back({profile + ", random grips jogged, " + name, reported, error.what(), false});
    }
  };
  const struct {
    const char* profile;
    const char* reported;
  } profiles[] = {
      {"omni", "67 of 150"}, {"desktop", "92 of 150"}, {"premium-1.5", "105 of 150"}, {"touch", "6 of 150"}};
  for (const auto& [profile, reported] : profiles) {
    count("for_device()", reported, profile, grips, {});
    count("everything()", "0", profile, grips, {}, true);
  }
  count("400 N/s in the plane", "0 of 400", "desktop", grips,
        [](RendererOptions& options) { options.limits.in_plane_rate = 400.0; });
  count("guidance of 500 N/m", "54 of 150", "desktop", grips,
        [](RendererOptions& options) { options.guidance.stiffness = std::min(500.0, options.guidance.stiffness); });
  count("20 N/s in the plane", "46 of 60", "desktop", std::min(grips, 60),
        [](RendererOptions& options) { options.limits.in_plane_rate = 20.0; });

  count("guidance of 1500 N/m", "accepted, 5 N", "ideal", grips,
        [](RendererOptions& options) { options.guidance.stiffness = 1500.0; });
  HandRun stiff = jogged("ideal", soft);
  stiff.options.guidance.stiffness = 1500.0;
  rows.push_back(swings("ideal, guidance of 1500 N/m, jogged in a soft grip", "forces of 5 N", stiff));
  for (const double force : {0.3, 1.0, 3.0}) {
    rows.push_back(swings(text("Desktop, bare pen pressed with %.1f N", force), force == 3.0 ? "bounces to 7.9 N" : "",
                          pressed("desktop", force)));
  }
  HandRun delayed = pressed("desktop", 1.0);
  delayed.device.sample_delay = 1;
  delayed.options = RendererOptions::for_device(delayed.device);
  rows.push_back(swings("Desktop, bare pen pressed with 1 N, one tick of delay", "bounces", delayed));
  rows.push_back(swings("Desktop, light grip on the paper", "7.9 mm", pulled_aside(0.0)));
  for (const double force : {1.0, 2.0}) {
    rows.push_back(swings(text("Desktop, light grip, linear law, pulled aside with %.0f N", force), "170 mm",
                          pulled_aside(force)));
  }

  for (const auto* profile : {"desktop", "ideal"}) {
    HandRun run = writing(profile, U'美', soft);
    run.device.coulomb_friction = 0.0;
    run.options = RendererOptions::for_device(run.device);
    const HandFigures figures = run_hand(run);
    rows.push_back({text("%s without Coulomb friction, 美 in a soft grip", profile), "0 of 9 strokes",
                    text("%d of 9 strokes, %d abandoned", figures.strokes, figures.abandoned), figures.strokes == 9});
  }
  const struct {
    const char* profile;
    double factor;
  } factors[] = {{"desktop", 1.7}, {"desktop", 3.0}, {"touch", 1.05}, {"touch", 2.0}};
  for (const auto& [profile, factor] : factors) {
    std::string measured = "accepted";
    try {
      const Capabilities& device = device_profile(profile);
      HapticRenderer({in_the_middle(built_in_characters().at(U'一'), factor)}, upright_page(page_width, page_height),
                     device, RendererOptions::for_device(device));
    } catch (const Error& error) {
      measured = error.what();
    }
    rows.push_back({text("%s, attraction factor %.2f", profile, factor), "throws", measured, measured == "accepted"});
  }
  return rows;
}

bool print_issue_cases(int threads) {
  bool all = true;
  std::printf("%-66s %-24s %s\n", "case", "as reported", "measured");
  for (const IssueFigure& row : issue_figures(threads)) {
    std::printf("%-5s %-60s %-24s %s\n", row.right ? "ok" : "FAILS", row.name.c_str(), row.reported.c_str(),
                row.measured.c_str());
    all = all && row.right;
  }
  return all;
}

}  // namespace calligraphy_test
