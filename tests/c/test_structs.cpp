// What the structs of the C interface say is what the library does.
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/set_encoding.hpp>
#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_ink.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "c_interface.hpp"
#include "pen_path.hpp"
#include "temporary_directory.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

using Change = void (*)(calligraphy_renderer_options&, RendererOptions&);

/// Every option, each changed to what is valid and no default.
const std::vector<std::pair<const char*, Change>> changes = {
#define CHANGE(c, o, value)                                                                              \
  {                                                                                                      \
#c, [](calligraphy_renderer_options & in_c, RendererOptions & in_cpp) { in_c.c = in_cpp.o = value; } \
  }
#define CHOOSE(c, o, in_c_value, in_cpp_value)                                         \
  {                                                                                    \
#c, [](calligraphy_renderer_options & in_c,                                        \
           RendererOptions & in_cpp) { in_c.c = in_c_value, in_cpp.o = in_cpp_value; } \
  }
    CHOOSE(rules, rules, CALLIGRAPHY_RULES_WANG2006, Rules::wang2006),
    CHOOSE(stiffness_check, stiffness_check, CALLIGRAPHY_STIFFNESS_OFF, StiffnessCheck::off),
    CHOOSE(stiffness_check, stiffness_check, CALLIGRAPHY_STIFFNESS_REJECT, StiffnessCheck::reject),
    CHOOSE(nearest_method, nearest.method, CALLIGRAPHY_NEAREST_EXACT, NearestPointMethod::exact),
    CHOOSE(nearest_method, nearest.method, CALLIGRAPHY_NEAREST_SAMPLED, NearestPointMethod::sampled),
    CHOOSE(nearest_method, nearest.method, CALLIGRAPHY_NEAREST_WANG2006, NearestPointMethod::wang2006),
    CHANGE(nearest_tolerance, nearest.tolerance, 1e-7),
    CHANGE(nearest_samples, nearest.samples, 20),
    CHANGE(nearest_refinements, nearest.refinements, 3),
    CHANGE(servo_rate, servo_rate, 2000.0),
    CHANGE(velocity_cutoff, velocity_cutoff, 45.0),
    CHANGE(grip_stiffness, grip_stiffness, 250.0),
    CHANGE(paper_stiffness, paper.stiffness, 301.0),
    CHANGE(paper_damping, paper.damping, 3.1),
    CHANGE(paper_onset, paper.onset, 0.0011),
    CHANGE(paper_friction_coefficient, paper.friction.coefficient, 0.11),
    CHANGE(paper_friction_stiffness, paper.friction.stiffness, 201.0),
    CHANGE(paper_friction_damping, paper.friction.damping, 2.1),
    CHOOSE(guidance_law, guidance.force, CALLIGRAPHY_GUIDANCE_SATURATING, saturating_guidance),
    CHANGE(guidance_to_start, guidance.to_start, true),
    CHANGE(assist_enabled, guidance.assist.enabled, true),
    CHANGE(guidance_stiffness, guidance.stiffness, 302.0),
    CHANGE(guidance_damping, guidance.damping, 3.2),
    CHANGE(guidance_limit, guidance.limit, 1.5),
    CHANGE(guidance_radius, guidance.space.radius, 0.31),
    CHANGE(guidance_fade_width, guidance.space.fade_width, 0.21),
    CHANGE(guidance_fade_in, guidance.fade_in, 0.16),
    CHANGE(guidance_fade_out, guidance.fade_out, 0.31),
    CHANGE(guidance_wrong_way_stiffness, guidance.wrong_way_stiffness, 101.0),
    CHANGE(guidance_wrong_way_limit, guidance.wrong_way_limit, 0.9),
    CHANGE(guidance_wrong_way_slack, guidance.wrong_way_slack, 0.06),
    CHANGE(assist_retention, guidance.assist.retention, 0.7),
    CHANGE(assist_full_error, guidance.assist.full_assistance_error, 0.06),
    CHANGE(assist_min, guidance.assist.min_assistance, 0.2),
    CHANGE(contact_lift_time, contact.lift_time, 0.06),
    CHANGE(contact_lift_clearance, contact.lift_clearance, 0.004),
    CHANGE(contact_box_margin, contact.box_margin, 0.3),
    CHANGE(contact_lift_between_strokes, contact.lift_between_strokes, false),
    CHANGE(tolerance_start_distance, tolerances.start_distance, 0.21),
    CHANGE(tolerance_direction, tolerances.direction, 0.9),
    CHANGE(tolerance_first_stretch, tolerances.first_stretch, 0.05),
    CHANGE(tolerance_distinction, tolerances.distinction, 2.5),
    CHANGE(tolerance_corridor, tolerances.corridor, 0.07),
    CHANGE(tolerance_coverage, tolerances.coverage, 0.85),
    CHANGE(tolerance_slack, tolerances.slack, 0.05),
    CHANGE(tolerance_next_decides, tolerances.next_decides, false),
    CHANGE(limit_in_plane_rate, limits.in_plane_rate, 110.0),
    CHANGE(limit_normal_rate, limits.normal_rate, INFINITY),
    CHANGE(limit_thermal_time_constant, limits.thermal_time_constant, 20.0),
    CHANGE(limit_max_speed, limits.max_speed, 4.0),
    CHANGE(limit_max_acceleration, limits.max_acceleration, 150.0),
    CHANGE(limit_max_standstill, limits.max_standstill, 0.7),
    CHANGE(energy_budget, energy.budget, 0.2),
    CHANGE(energy_max_gap, energy.max_gap, 0.02),
#undef CHANGE
#undef CHOOSE
};

/// The forces on a pen that is pressed down and drawn along a stroke, faster and slower, on a page of 永.
template <class Update>
std::vector<Eigen::Vector3d> forces(Update&& update) {
  std::vector<Eigen::Vector3d> result;
  const PlacedCharacter placed{built_in_characters().at(U'永'), {{0.06, 0.04}, 0.04}};
  const MotionMapping upright = upright_page(0.16, 0.12);
  double time = 0.0;
  for (const Stroke& stroke : strokes(placed.character)) {
    const auto way = beside(path_of(stroke, placed.placement, 0.0002), 0.003);
    for (int i = 0; i < 100; ++i)
      result.push_back(update(time += 1e-3, upright.to_device({way[0].x(), way[0].y(), 4e-3 - 8e-5 * i})));
    for (const Point& point : way)
      result.push_back(update(time += 1e-3, upright.to_device({point.x(), point.y(), -0.004})));
    for (int i = 0; i < 100; ++i)
      result.push_back(update(time += 1e-3, upright.to_device({way.back().x(), way.back().y(), -4e-3 + 8e-5 * i})));
  }
  return result;
}

}  // namespace

TEST_CASE("every option of a renderer arrives and is reported") {
  auto capabilities = profile();
  capabilities.simulated = 1;
  Capabilities device = device_profile("desktop");
  device.simulated = true;
  const auto page = page_of("永");
  const PracticePage in_cpp = lay_out(std::vector{built_in_characters().at(U'永')}).front();
  const auto in_c = options_for(capabilities);
  for (const auto& [name, change] : changes) {
    CAPTURE(name);
    auto changed = in_c;
    RendererOptions expected = RendererOptions::for_device(device);
    change(changed, expected);
    const auto renderer = renderer_of(page.get(), capabilities, &changed);
    HapticRenderer there(in_cpp.characters, upright_page(0.16, 0.12), device, expected);
    auto effective = sized<calligraphy_renderer_options>(), before = effective;
    REQUIRE(calligraphy_renderer_effective_options(renderer.get(), &effective) == CALLIGRAPHY_OK);
    // It is reported: nothing else is changed beside it, but for what is clipped.
    before = changed;
    if (changed.servo_rate == 0.0) before.servo_rate = 1000.0;
    CHECK(effective.paper_stiffness == there.options().paper.stiffness);
    CHECK(effective.guidance_stiffness == there.options().guidance.stiffness);
    before.paper_stiffness = effective.paper_stiffness;
    before.guidance_stiffness = effective.guidance_stiffness;
    before.guidance_wrong_way_stiffness = effective.guidance_wrong_way_stiffness;
    before.paper_friction_stiffness = effective.paper_friction_stiffness;
    CHECK(std::memcmp(&effective, &before, sizeof effective) == 0);
    CHECK(std::memcmp(&changed, &in_c, sizeof in_c) != 0);
    // And it arrives: the forces are those of C++.
    auto tick = sized<calligraphy_tick>();
    auto state = sized<calligraphy_device_state>();
    const auto found = forces([&](double time, const Eigen::Vector3d& position) {
      state.time = time;
      std::memcpy(state.position, position.data(), sizeof state.position);
      REQUIRE(calligraphy_renderer_update(renderer.get(), &state, &tick) == CALLIGRAPHY_OK);
      return Eigen::Vector3d(tick.force[0], tick.force[1], tick.force[2]);
    });
    const auto wanted = forces([&](double time, const Eigen::Vector3d& position) {
      DeviceState sample;
      sample.time = time;
      sample.position = position;
      return there.update(sample).force;
    });
    CHECK(found == wanted);
  }
}

TEST_CASE("options of the size that they first had leave nothing to the next stroke") {
  const auto page = page_of("永");
  const auto capabilities = profile();
  auto options = options_for(capabilities), effective = options;
  REQUIRE(options.tolerance_next_decides == 1);
  options.size = static_cast<std::uint32_t>(offsetof(calligraphy_renderer_options, tolerance_next_decides));
  const auto renderer = renderer_of(page.get(), capabilities, &options);
  REQUIRE(calligraphy_renderer_effective_options(renderer.get(), &effective) == CALLIGRAPHY_OK);
  CHECK(effective.tolerance_next_decides == 0);
  CHECK(effective.tolerance_coverage == options.tolerance_coverage);
}

TEST_CASE("what was clipped is said, with the reason") {
  const auto capabilities = profile("omni");
  auto options = options_for(capabilities);
  options.paper_stiffness = 5000.0;
  const auto page = page_of("永");
  const auto renderer = renderer_of(page.get(), capabilities, &options);
  const char* lines = nullptr;
  REQUIRE(calligraphy_renderer_clipped(renderer.get(), &lines) == CALLIGRAPHY_OK);
  CHECK(std::string(lines).find("paper.stiffness = 5000 N/m: the device omni is usable") != std::string::npos);
  CHECK(std::string(lines).back() == '\n');
  auto effective = sized<calligraphy_renderer_options>();
  REQUIRE(calligraphy_renderer_effective_options(renderer.get(), &effective) == CALLIGRAPHY_OK);
  CHECK(effective.paper_stiffness < 5000.0);
}

TEST_CASE("the tolerances of a level are those of C++") {
  const auto capabilities = profile();
  const std::pair<calligraphy_tolerance, StrokeTolerances> levels[] = {
      {CALLIGRAPHY_TOLERANCE_NORMAL, StrokeTolerances::normal()},
      {CALLIGRAPHY_TOLERANCE_LENIENT, StrokeTolerances::lenient()},
      {CALLIGRAPHY_TOLERANCE_STRICT, StrokeTolerances::strict()}};
  for (const auto& [level, expected] : levels) {
    auto options = sized<calligraphy_renderer_options>();
    REQUIRE(calligraphy_renderer_options_for(&capabilities, CALLIGRAPHY_PRESET_DEVICE, 1.0, level, &options) ==
            CALLIGRAPHY_OK);
    CHECK(options.tolerance_start_distance == expected.start_distance);
    CHECK(options.tolerance_direction == expected.direction);
    CHECK(options.tolerance_corridor == expected.corridor);
    CHECK(options.tolerance_coverage == expected.coverage);
    CHECK((options.tolerance_next_decides != 0) == expected.next_decides);
  }
}

TEST_CASE("a profile is that of C++") {
  for (const Capabilities& expected : device_profiles()) {
    CAPTURE(expected.name);
    const auto found = profile(expected.name.c_str());
    CHECK(found.name == expected.name);
    CHECK(found.simulated == expected.simulated);
    CHECK((found.velocity_measured != 0) == (expected.velocity == VelocitySource::measured));
    CHECK(found.sample_delay == expected.sample_delay);
    CHECK(found.workspace[2] == expected.workspace.z());
    const double numbers[] = {found.peak_force,      found.continuous_force, found.usable_stiffness,
                              found.force_step,      found.encoder_step,     found.velocity_cutoff,
                              found.update_rate,     found.apparent_mass,    found.viscous_friction,
                              found.coulomb_friction};
    const double wanted[] = {expected.peak_force,      expected.continuous_force, expected.usable_stiffness,
                             expected.force_step,      expected.encoder_step,     expected.velocity_cutoff,
                             expected.update_rate,     expected.apparent_mass,    expected.viscous_friction,
                             expected.coulomb_friction};
    CHECK(std::memcmp(numbers, wanted, sizeof wanted) == 0);

    // And arrives as that: its options depend on the mass, the delay, the rate, the stiffness and the forces.
    const auto options = options_for(found, CALLIGRAPHY_PRESET_EVERYTHING, 0.5);
    const RendererOptions there = RendererOptions::everything(expected, 0.5);
    CHECK(options.paper_stiffness == there.paper.stiffness);
    CHECK(options.guidance_stiffness == there.guidance.stiffness);
    CHECK(options.paper_friction_coefficient == there.paper.friction.coefficient);
    CHECK(options.limit_thermal_time_constant == there.limits.thermal_time_constant);
    CHECK(options.energy_budget == there.energy.budget);
    auto late = found;
    late.sample_delay = 5;
    Capabilities late_there = expected;
    late_there.sample_delay = 5;
    const auto careful = options_for(late, CALLIGRAPHY_PRESET_DEVICE, 0.5);
    CHECK(careful.paper_stiffness == RendererOptions::for_device(late_there, 0.5).paper.stiffness);
  }
}

TEST_CASE("a device without a limit of its force has an infinite one") {
  CHECK(profile("ideal").peak_force == INFINITY);
}

TEST_CASE("a mapping leads from the page to the device as in C++") {
  const auto page = page_of("永");
  auto info = sized<calligraphy_page_info>();
  REQUIRE(calligraphy_page_read_info(page.get(), &info) == CALLIGRAPHY_OK);
  CHECK(info.character_count == 1);
  CHECK(info.width == 0.16);
  CHECK(info.height == 0.12);
  auto mapping = sized<calligraphy_mapping>();
  REQUIRE(calligraphy_page_mapping(page.get(), CALLIGRAPHY_DESK, 2.0, &mapping) == CALLIGRAPHY_OK);
  mapping.offset[2] = 0.015;
  MotionMapping there = desk_page(0.16, 0.12, 2.0);
  there.offset.z() = 0.015;
  const double on_page[3] = {0.01, 0.02, 0.03};
  double found[3];
  REQUIRE(calligraphy_mapping_to_device(&mapping, on_page, found) == CALLIGRAPHY_OK);
  const Eigen::Vector3d expected = there.to_device({0.01, 0.02, 0.03});
  CHECK(std::memcmp(found, expected.data(), sizeof found) == 0);
}

TEST_CASE("a page lists its characters, strokes and shapes as C++ draws them") {
  const auto page = page_of("永北");
  const auto in_cpp = lay_out(std::vector{built_in_characters().at(U'永'), built_in_characters().at(U'北')}).front();
  auto placed = sized<calligraphy_placed_character>();
  auto found = sized<calligraphy_stroke>();
  for (int c = 0; c < 2; ++c) {
    const PlacedCharacter& expected = in_cpp.characters[static_cast<std::size_t>(c)];
    const Placement& placement = expected.placement;
    REQUIRE(calligraphy_page_character(page.get(), c, &placed) == CALLIGRAPHY_OK);
    CHECK(placed.code == expected.character.code);
    CHECK(placed.stroke_count == expected.character.stroke_count());
    CHECK(placed.has_ink == 0);
    CHECK(placed.origin[0] == placement.origin.x());
    CHECK(placed.origin[1] == placement.origin.y());
    CHECK(placed.em == placement.em);
    const Character inked = with_typical_ink(expected.character);
    for (int s = 0; s < placed.stroke_count; ++s) {
      const Stroke stroke = strokes(expected.character)[static_cast<std::size_t>(s)];
      REQUIRE(calligraphy_page_stroke(page.get(), c, s, &found) == CALLIGRAPHY_OK);
      CHECK(found.id == stroke.type->id);
      CHECK(found.element_count == static_cast<int>(stroke.elements.size()));
      const Point start = placement.to_page(stroke.control_points.front());
      const Point next = placement.to_page(stroke.control_points[1]);
      const Point end = placement.to_page(stroke.control_points.back());
      CHECK(found.start[0] == start.x());
      CHECK(found.end[1] == end.y());
      CHECK(found.direction[0] == Approx((next - start).normalized().x()).margin(1e-9));
      CHECK(found.direction[1] == Approx((next - start).normalized().y()).margin(1e-9));
      for (const auto shape : {CALLIGRAPHY_PATH, CALLIGRAPHY_OUTLINE}) {
        const auto wanted = shape == CALLIGRAPHY_PATH ? stroke_polyline(stroke, 1e-3)
                                                      : ink_outline(strokes(inked)[static_cast<std::size_t>(s)], 1e-3);
        std::size_t count = 0;
        REQUIRE(calligraphy_page_polyline(page.get(), c, s, shape, 1e-3 * placement.em, nullptr, 0, &count) ==
                CALLIGRAPHY_OK);
        REQUIRE(count == wanted.size());
        std::vector<double> points(2 * count);
        REQUIRE(calligraphy_page_polyline(page.get(), c, s, shape, 1e-3 * placement.em, points.data(), count, &count) ==
                CALLIGRAPHY_OK);
        double length = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
          const Point there = placement.to_page(wanted[i]);
          REQUIRE(std::hypot(points[2 * i] - there.x(), points[2 * i + 1] - there.y()) < 1e-12);
          if (i > 0) length += std::hypot(points[2 * i] - points[2 * i - 2], points[2 * i + 1] - points[2 * i - 1]);
        }
        if (shape == CALLIGRAPHY_PATH) CHECK(found.length == Approx(length).epsilon(0.01));
      }
    }
  }
}

TEST_CASE("a layout takes defaults where it says nothing, and says how many characters fit") {
  const auto set = built_in_set();
  auto layout = sized<calligraphy_layout>();
  layout.em = 0.08;
  std::int32_t placed = -1;
  calligraphy_page* handle = nullptr;
  REQUIRE(calligraphy_page_lay_out(set.get(), "永一北", &layout, &placed, &handle) == CALLIGRAPHY_OK);
  const Owned<calligraphy_page> page(handle);
  CHECK(placed == 1);
  auto character = sized<calligraphy_placed_character>();
  REQUIRE(calligraphy_page_character(page.get(), 0, &character) == CALLIGRAPHY_OK);
  CHECK(character.em == 0.08);
  CHECK(character.origin[0] == Approx(0.04));
  CHECK(character.origin[1] == Approx(0.02));
  CHECK(calligraphy_page_character(page.get(), 1, &character) == CALLIGRAPHY_INVALID_VALUE);
}

TEST_CASE("a set is listed, opened from a file and taken from memory alike") {
  const auto built_in = built_in_set();
  std::vector<std::uint32_t> codes;
  for (std::uint32_t code = 0; calligraphy_set_next(built_in.get(), code, &code) == CALLIGRAPHY_OK; ++code) {
    codes.push_back(code);
  }
  CHECK(codes.size() == built_in_characters().characters.size());
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "characters.set").string();
  const auto bytes = encode_character_set(built_in_characters(), {});
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  calligraphy_set *opened = nullptr, *taken = nullptr;
  REQUIRE(calligraphy_set_open(path.c_str(), &opened) == CALLIGRAPHY_OK);
  std::vector<std::byte> copied(bytes.begin(), bytes.end());
  REQUIRE(calligraphy_set_from_memory(copied.data(), copied.size(), nullptr, &taken) == CALLIGRAPHY_OK);
  std::fill(copied.begin(), copied.end(), std::byte{0xff});  // the set has its own bytes
  for (calligraphy_set* set : {opened, taken}) {
    const Owned<calligraphy_set> owned(set);
    std::size_t i = 0;
    for (std::uint32_t code = 0; calligraphy_set_next(set, code, &code) == CALLIGRAPHY_OK; ++code, ++i) {
      std::int32_t strokes_here = 0, strokes_there = 0;
      REQUIRE(code == codes.at(i));
      REQUIRE(calligraphy_set_stroke_count(set, code, &strokes_here) == CALLIGRAPHY_OK);
      REQUIRE(calligraphy_set_stroke_count(built_in.get(), code, &strokes_there) == CALLIGRAPHY_OK);
      REQUIRE(strokes_here == strokes_there);
    }
    CHECK(i == codes.size());
  }
}

TEST_CASE("pen-downs are matched as in C++, with remarks for people") {
  const auto page = page_of("永");
  const PlacedCharacter placed = lay_out(std::vector{built_in_characters().at(U'永')}).front().characters.front();
  std::vector<PenPath> paths;
  for (const Stroke& stroke : strokes(placed.character)) paths.push_back(path_of(stroke, {{0.0, 0.0}, 1.0}, 0.02));
  std::swap(paths[3], paths[4]);                   // out of order
  std::reverse(paths[1].begin(), paths[1].end());  // backwards
  const std::size_t half = paths[4].size() / 2;    // lifted midway
  paths.emplace_back(paths[4].begin() + static_cast<std::ptrdiff_t>(half), paths[4].end());
  paths[4].resize(half + 1);
  paths.push_back({{0.1, 0.1}, {0.1, 0.1}});  // tapped
  std::vector<double> points;
  std::vector<std::uint32_t> sizes;
  for (const PenPath& path : paths) {
    sizes.push_back(static_cast<std::uint32_t>(path.size()));
    for (const Point& point : path) {
      const Point there = placed.placement.to_page(point);
      points.insert(points.end(), {there.x(), there.y()});
    }
  }
  calligraphy_match* handle = nullptr;
  REQUIRE(calligraphy_match_strokes(page.get(), 0, points.data(), sizes.data(), sizes.size(),
                                    CALLIGRAPHY_TOLERANCE_NORMAL, nullptr, nullptr, &handle) == CALLIGRAPHY_OK);
  const Owned<calligraphy_match> match(handle);
  const MatchResult expected = match_strokes(placed.character, paths);
  auto drawn = sized<calligraphy_drawn_stroke>();
  int taps = 0, continuations = 0;
  for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
    REQUIRE(calligraphy_match_drawn(match.get(), i, &drawn) == CALLIGRAPHY_OK);
    const DrawnStroke& there = expected.drawn[static_cast<std::size_t>(i)];
    CHECK(drawn.stroke == there.stroke);
    CHECK(drawn.stroke_count == there.stroke_count);
    CHECK((drawn.continues != 0) == there.continues);
    CHECK((drawn.in_turn != 0) == there.in_turn);
    CHECK((drawn.tap != 0) == there.tap);
    CHECK(drawn.direction == static_cast<int>(there.direction));
    CHECK(drawn.attempt == there.attempt);
    CHECK(drawn.also == there.also);
    CHECK(drawn.length == Approx(there.length));
    if (std::isfinite(there.distance)) CHECK(drawn.distance == Approx(there.distance).margin(1e-12));
    taps += there.tap;
    continuations += there.continues;
  }
  CHECK(taps == 1);
  CHECK(continuations == 1);
  std::int32_t count = 0;
  REQUIRE(calligraphy_match_remark_count(match.get(), &count) == CALLIGRAPHY_OK);
  REQUIRE(count == static_cast<int>(expected.remarks.size()));
  REQUIRE(count >= 3);  // one stroke backwards, one pair in the wrong order, one tap
  auto remark = sized<calligraphy_remark>();
  const char* reason = nullptr;
  for (int i = 0; i < count; ++i) {
    REQUIRE(calligraphy_match_remark(match.get(), i, &remark) == CALLIGRAPHY_OK);
    const StrokeRemark& there = expected.remarks[static_cast<std::size_t>(i)];
    CHECK(remark.kind == static_cast<int>(there.kind));
    CHECK(remark.path == there.path);
    CHECK(remark.path_count == there.path_count);
    CHECK(remark.stroke == there.stroke);
    CHECK(remark.stroke_count == there.stroke_count);
    CHECK(remark.other_path == there.other_path);
    CHECK(remark.other_stroke == there.other_stroke);
    CHECK(remark.other_character == there.other_character);
    CHECK((Point(remark.place[0], remark.place[1]) - there.place).norm() < 1e-9);
    CHECK(remark.direction == static_cast<int>(there.direction));
    CHECK(std::isnan(remark.length) == std::isnan(there.length));
    if (!std::isnan(there.length)) CHECK(remark.length == Approx(there.length));
    CHECK(remark.evidence == Approx(there.evidence));
    CHECK(remark.end == static_cast<int>(there.end));
    CHECK(remark.orientation == static_cast<int>(there.orientation));
    CHECK((remark.amount == there.amount || (std::isnan(remark.amount) && std::isnan(there.amount))));
    CHECK(Point(remark.offset[0], remark.offset[1]) == there.offset);
    for (const char* const language : {"en", "zh"}) {
      REQUIRE(calligraphy_match_remark_text(match.get(), i, language, &reason) == CALLIGRAPHY_OK);
      CHECK(reason == remark_text(there, placed.character, Language(language)));
    }
    const char* in_english = nullptr;
    REQUIRE(calligraphy_match_remark_text(match.get(), i, nullptr, &in_english) == CALLIGRAPHY_OK);
    CHECK(in_english == remark_text(there, placed.character));
    CHECK(std::string(reason) != in_english);  // and the text asked for before is still there
  }
  CHECK(calligraphy_match_remark(match.get(), count, &remark) == CALLIGRAPHY_INVALID_VALUE);
  const auto without_form = static_cast<std::uint32_t>(offsetof(calligraphy_remark, end));  // as it first was
  remark.size = without_form;
  remark.end = 85;
  CHECK((calligraphy_match_remark(match.get(), 0, &remark) == CALLIGRAPHY_OK && remark.end == 85));
  remark.size = without_form - 1;
  CHECK(calligraphy_match_remark(match.get(), 0, &remark) == CALLIGRAPHY_INVALID_VALUE);
  CHECK(calligraphy_match_remark_text(match.get(), count, "zh", &reason) == CALLIGRAPHY_INVALID_VALUE);
}

TEST_CASE("several forms are accepted, and other characters noticed, as in C++") {
  const Character ten = built_in_characters().at(U'十');
  std::vector<StrokeInput> swapped;
  for (const Stroke& stroke : strokes(ten)) swapped.insert(swapped.begin(), input_of(stroke));
  CharacterList list;
  list.characters = {ten, make_character(U'十', swapped), built_in_characters().at(U'二')};
  list.characters[1].order = "swapped";
  const std::vector<std::byte> bytes = encode_character_set(list);
  calligraphy_set* set = nullptr;
  REQUIRE(calligraphy_set_from_memory(bytes.data(), bytes.size(), nullptr, &set) == CALLIGRAPHY_OK);
  const Owned<calligraphy_set> forms(set);
  calligraphy_index* index = nullptr;
  REQUIRE(calligraphy_index_create(forms.get(), &index) == CALLIGRAPHY_OK);
  const Owned<calligraphy_index> others(index);
  const auto page = page_of("十");
  const Placement place = page_in_cpp(U"十").characters.front().placement;
  const auto match = [&](const std::vector<Point>& in_em, const calligraphy_set* of, const calligraphy_index* beside) {
    std::vector<double> points;
    for (const Point& point : in_em) {
      const Point there = place.to_page(point);
      points.insert(points.end(), {there.x(), there.y()});
    }
    const std::uint32_t sizes[] = {2, 2};
    calligraphy_match* handle = nullptr;
    REQUIRE(calligraphy_match_strokes(page.get(), 0, points.data(), sizes, 2, CALLIGRAPHY_TOLERANCE_NORMAL, of, beside,
                                      &handle) == CALLIGRAPHY_OK);
    return Owned<calligraphy_match>(handle);
  };
  const auto kinds = [](const Owned<calligraphy_match>& of) {
    std::int32_t count = 0, accepted = 0;
    REQUIRE(calligraphy_match_remark_count(of.get(), &count) == CALLIGRAPHY_OK);
    REQUIRE(calligraphy_match_accepted(of.get(), &accepted) == CALLIGRAPHY_OK);
    std::vector<std::int32_t> found = {accepted};
    auto remark = sized<calligraphy_remark>();
    for (std::int32_t i = 0; i < count; ++i) {
      REQUIRE(calligraphy_match_remark(of.get(), i, &remark) == CALLIGRAPHY_OK);
      found.push_back(remark.kind);
    }
    return found;
  };
  using Kinds = std::vector<std::int32_t>;  // after the index of the accepted form
  const std::vector<Point> down_first = {{0.5, 0.9}, {0.5, 0.1}, {0.1, 0.5}, {0.9, 0.5}};
  const std::vector<Point> two = {{0.2, 0.75}, {0.8, 0.75}, {0.05, 0.1}, {0.95, 0.1}};
  CHECK(kinds(match(down_first, nullptr, nullptr)) == Kinds{0, CALLIGRAPHY_REMARK_ORDER});
  CHECK(kinds(match(down_first, forms.get(), nullptr)) == Kinds{1});
  CHECK(kinds(match(two, nullptr, others.get())) == Kinds{0, CALLIGRAPHY_REMARK_CHARACTER});
  std::uint32_t codes[3];
  double distances[3];
  std::size_t count = 0;
  const std::uint32_t sizes[] = {2, 2};
  const double lines[] = {0.2, 0.75, 0.8, 0.75, 0.05, 0.1, 0.95, 0.1};
  REQUIRE(calligraphy_index_recognise(others.get(), lines, sizes, 2, codes, distances, 3, &count) == CALLIGRAPHY_OK);
  CHECK(count == 2);
  CHECK((codes[0] == U'二' && codes[1] == U'十' && distances[0] < distances[1]));
}

TEST_CASE("the languages are those of C++") {
  std::int32_t count = 0;
  REQUIRE(calligraphy_language_count(&count) == CALLIGRAPHY_OK);
  std::vector<std::string_view> expected;
  for (const Language& language : languages()) expected.push_back(language.code());
  REQUIRE(count == static_cast<int>(expected.size()));
  const char* code = nullptr;
  for (std::int32_t i = 0; i < count; ++i) {
    REQUIRE(calligraphy_language_code(i, &code) == CALLIGRAPHY_OK);
    CHECK(code == expected[static_cast<std::size_t>(i)]);
  }
  CHECK(calligraphy_language_code(count, &code) == CALLIGRAPHY_INVALID_VALUE);
}

TEST_CASE("the version of the header is that of the library") {
  CHECK(calligraphy_version() == std::to_string(CALLIGRAPHY_VERSION_MAJOR) + "." +
                                     std::to_string(CALLIGRAPHY_VERSION_MINOR) + "." +
                                     std::to_string(CALLIGRAPHY_VERSION_PATCH));
}

TEST_CASE("structs have the sizes stated here: one that grows must state its first size (src/c/structs.hpp)") {
  CHECK(sizeof(calligraphy_layout) == 40);
  CHECK(sizeof(calligraphy_page_info) == 24);
  CHECK(sizeof(calligraphy_placed_character) == 40);
  CHECK(sizeof(calligraphy_stroke) == 72);
  CHECK(sizeof(calligraphy_mapping) == 112);
  CHECK(sizeof(calligraphy_capabilities) == 168);
  CHECK(sizeof(calligraphy_device_state) == 168);
  CHECK(sizeof(calligraphy_stylus) == 56);
  CHECK(sizeof(calligraphy_grip) == 32);
  CHECK(sizeof(calligraphy_pointer_options) == 56);
  CHECK(sizeof(calligraphy_guidance_input) == 256);
  CHECK(sizeof(calligraphy_guidance_terms) == 48);
  CHECK(sizeof(calligraphy_stroke_place) == 56);
  CHECK(sizeof(calligraphy_guidance_functions) == 56);
  CHECK(sizeof(calligraphy_renderer_options) == 392);
  CHECK(sizeof(calligraphy_tick) == 360);
  CHECK(sizeof(calligraphy_servo_state) == 192);
  CHECK(sizeof(calligraphy_drawn_stroke) == 56);
  CHECK(sizeof(calligraphy_remark) == 104);
  CHECK(sizeof(calligraphy_character_score) == 208);
  CHECK(sizeof(calligraphy_stroke_score) == 56);
  CHECK(sizeof(calligraphy_pen_down_score) == 64);
  CHECK(sizeof(calligraphy_trace_info) == 32);
  CHECK(sizeof(calligraphy_text_character) == 24);
}

TEST_CASE("the names of C are the values of C++") {
  CHECK(CALLIGRAPHY_DEVICE_FAULT == static_cast<int>(DeviceStatus::fault));
  CHECK(CALLIGRAPHY_DEVICE_STALE == static_cast<int>(DeviceStatus::stale));
  CHECK(CALLIGRAPHY_DEVICE_DISCONNECTED == static_cast<int>(DeviceStatus::disconnected));
  CHECK(CALLIGRAPHY_DEVICE_WARM_MOTORS == static_cast<int>(DeviceStatus::warm_motors));
  CHECK(CALLIGRAPHY_DEVICE_NEEDS_CALIBRATION == static_cast<int>(DeviceStatus::needs_calibration));
  CHECK(CALLIGRAPHY_ADJUSTING == static_cast<int>(InteractionState::adjusting));
  CHECK(CALLIGRAPHY_CALIBRATION == static_cast<int>(InteractionState::calibration));
  CHECK(CALLIGRAPHY_WRITING == static_cast<int>(InteractionState::writing));
  CHECK(CALLIGRAPHY_LIFT == static_cast<int>(TickEvent::lift));
  CHECK(CALLIGRAPHY_STROKE_STARTED == static_cast<int>(TickEvent::stroke_started));
  CHECK(CALLIGRAPHY_FEATURE_PASSED == static_cast<int>(TickEvent::feature_passed));
  CHECK(CALLIGRAPHY_STROKE_FINISHED == static_cast<int>(TickEvent::stroke_finished));
  CHECK(CALLIGRAPHY_STROKE_ABANDONED == static_cast<int>(TickEvent::stroke_abandoned));
  CHECK(CALLIGRAPHY_CHARACTER_FINISHED == static_cast<int>(TickEvent::character_finished));
  CHECK(CALLIGRAPHY_PAGE_FINISHED == static_cast<int>(TickEvent::page_finished));
  CHECK(CALLIGRAPHY_TICK_STALE == static_cast<int>(TickStatus::stale));
  CHECK(CALLIGRAPHY_TICK_BAD_SAMPLE == static_cast<int>(TickStatus::bad_sample));
  CHECK(CALLIGRAPHY_TICK_DEVICE_FAULT == static_cast<int>(TickStatus::device_fault));
  CHECK(CALLIGRAPHY_TICK_BAD_LAW == static_cast<int>(TickStatus::bad_law));
  CHECK(CALLIGRAPHY_HINT_TOO_FAR == static_cast<int>(WritingHint::too_far));
  CHECK(CALLIGRAPHY_HINT_AT_END == static_cast<int>(WritingHint::at_end));
  CHECK(CALLIGRAPHY_HINT_IN_MIDDLE == static_cast<int>(WritingHint::in_middle));
  CHECK(CALLIGRAPHY_HINT_WRONG_DIRECTION == static_cast<int>(WritingHint::wrong_direction));
  CHECK(CALLIGRAPHY_HINT_ANOTHER_STROKE == static_cast<int>(WritingHint::another_stroke));
  CHECK(CALLIGRAPHY_HINT_OFF_STROKE == static_cast<int>(WritingHint::off_stroke));
  CHECK(CALLIGRAPHY_HINT_LIFT_FIRST == static_cast<int>(WritingHint::lift_first));
  CHECK(CALLIGRAPHY_HINT_WARM_MOTORS == static_cast<int>(WritingHint::warm_motors));
  CHECK(CALLIGRAPHY_HINT_LIFTED_EARLY == static_cast<int>(WritingHint::lifted_early));
  CHECK(CALLIGRAPHY_SERVO_RUNNING == static_cast<int>(ServoPhase::running));
  CHECK(CALLIGRAPHY_SERVO_FALLING == static_cast<int>(ServoPhase::falling));
  CHECK(CALLIGRAPHY_NEITHER == static_cast<int>(WritingDirection::neither));
  CHECK(CALLIGRAPHY_UNKNOWN_DIRECTION == static_cast<int>(WritingDirection::unknown));
  CHECK(CALLIGRAPHY_REMARK_SHAPE == static_cast<int>(StrokeRemarkKind::shape));
  CHECK(CALLIGRAPHY_REMARK_JOINED == static_cast<int>(StrokeRemarkKind::joined));
  CHECK(CALLIGRAPHY_REMARK_BROKEN == static_cast<int>(StrokeRemarkKind::broken));
  CHECK(CALLIGRAPHY_REMARK_MISSING == static_cast<int>(StrokeRemarkKind::missing));
  CHECK(CALLIGRAPHY_REMARK_EXTRA == static_cast<int>(StrokeRemarkKind::extra));
  CHECK(CALLIGRAPHY_REMARK_CHARACTER == static_cast<int>(StrokeRemarkKind::character));
  CHECK(CALLIGRAPHY_BUTTON_TIP == tip_button);
  CHECK(CALLIGRAPHY_BUTTON_BARREL == barrel_button);
  CHECK(CALLIGRAPHY_BUTTON_ERASER == eraser_button);
  CHECK(CALLIGRAPHY_REMARK_LOOKALIKE == static_cast<int>(StrokeRemarkKind::lookalike));
  CHECK(CALLIGRAPHY_REMARK_UNREADABLE == static_cast<int>(StrokeRemarkKind::unreadable));
  CHECK(CALLIGRAPHY_REMARK_ORIENTATION == static_cast<int>(StrokeRemarkKind::orientation));
  CHECK(CALLIGRAPHY_REMARK_SEVERAL == static_cast<int>(StrokeRemarkKind::several));
  CHECK(CALLIGRAPHY_REMARK_PARTS == static_cast<int>(StrokeRemarkKind::parts));
  CHECK(CALLIGRAPHY_REMARK_CROSSING == static_cast<int>(StrokeRemarkKind::crossing));
  CHECK(CALLIGRAPHY_REMARK_NO_CROSSING == static_cast<int>(StrokeRemarkKind::no_crossing));
  CHECK(CALLIGRAPHY_REMARK_GAP == static_cast<int>(StrokeRemarkKind::gap));
  CHECK(CALLIGRAPHY_REMARK_OVERLAP == static_cast<int>(StrokeRemarkKind::overlap));
  CHECK(CALLIGRAPHY_REMARK_SIDE == static_cast<int>(StrokeRemarkKind::side));
  CHECK(CALLIGRAPHY_REMARK_STRAIGHT == static_cast<int>(StrokeRemarkKind::straight));
  CHECK(CALLIGRAPHY_REMARK_BENT == static_cast<int>(StrokeRemarkKind::bent));
  CHECK(CALLIGRAPHY_REMARK_WAVY == static_cast<int>(StrokeRemarkKind::wavy));
  CHECK(CALLIGRAPHY_REMARK_HOOK == static_cast<int>(StrokeRemarkKind::hook));
  CHECK(CALLIGRAPHY_REMARK_PLACE == static_cast<int>(StrokeRemarkKind::place));
  CHECK(CALLIGRAPHY_REMARK_LENGTH == static_cast<int>(StrokeRemarkKind::length));
  CHECK(CALLIGRAPHY_REMARK_PROPORTION == static_cast<int>(StrokeRemarkKind::proportion));
  CHECK(CALLIGRAPHY_START_OF_STROKE == static_cast<int>(StrokeEnd::start));
  CHECK(CALLIGRAPHY_END_OF_STROKE == static_cast<int>(StrokeEnd::end));
  CHECK(CALLIGRAPHY_ORIENTATION_MIRRORED == static_cast<int>(WritingOrientation::mirrored));
  CHECK(CALLIGRAPHY_ORIENTATION_UPSIDE_DOWN == static_cast<int>(WritingOrientation::upside_down));
  CHECK(CALLIGRAPHY_ORIENTATION_HALF_TURNED == static_cast<int>(WritingOrientation::half_turned));
  CHECK(CALLIGRAPHY_ORIENTATION_TURNED_LEFT == static_cast<int>(WritingOrientation::turned_left));
  CHECK(CALLIGRAPHY_ORIENTATION_TURNED_RIGHT == static_cast<int>(WritingOrientation::turned_right));
  CHECK(CALLIGRAPHY_ORIENTATION_MIRRORED_LEFT == static_cast<int>(WritingOrientation::mirrored_left));
  CHECK(CALLIGRAPHY_ORIENTATION_MIRRORED_RIGHT == static_cast<int>(WritingOrientation::mirrored_right));
}
