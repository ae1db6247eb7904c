#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/set_encoding.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "../catch.hpp"
#include "../hard_cases.hpp"
#include "pages.hpp"

using namespace calligraphy;
using calligraphy_test::page_of;
using calligraphy_test::same;
using calligraphy_test::session;

namespace {

double max_step(const Recording& recording) {
  double largest = 0.0;
  for (std::size_t i = 1; i < recording.samples.size(); ++i) {
    largest = std::max(largest, (recording.samples[i].force - recording.samples[i - 1].force).norm());
  }
  return largest;
}

}  // namespace

TEST_CASE("with all stiffness and damping at zero, force mode equals vision mode to the last digit", "[practice]") {
  const PracticePage page = page_of("永北");
  SessionOptions with = session(WriterSkill::novice(), FeedbackMode::force, 7);
  with.renderer.paper.stiffness = with.renderer.guidance.stiffness = with.renderer.guidance.wrong_way_stiffness = 0.0;
  with.renderer.paper.damping = with.renderer.guidance.damping = 0.0;
  SessionOptions without = session(WriterSkill::novice(), FeedbackMode::vision, 7);
  const Recording felt = write_page(page, with);
  CHECK(same(felt, write_page(page, without)));

  const auto scores = score_page(page, felt);
  CHECK(scores[0].strokes_completed == 5);
  CHECK(scores[0].peak_force == 0.0);
}

TEST_CASE("in vision mode no force is applied to the hand", "[practice]") {
  const Recording recording = write_page(page_of("永"), session(WriterSkill::novice(), FeedbackMode::vision));
  CHECK(std::all_of(recording.samples.begin(), recording.samples.end(),
                    [](const RecordedSample& sample) { return sample.force.isZero(0.0); }));
}

TEST_CASE("the same seed gives the same recording, another seed a different one", "[practice]") {
  const PracticePage page = page_of("书");
  const Recording first = write_page(page, session(WriterSkill::novice(), FeedbackMode::force, 3));
  CHECK(same(first, write_page(page, session(WriterSkill::novice(), FeedbackMode::force, 3))));
  CHECK_FALSE(same(first, write_page(page, session(WriterSkill::novice(), FeedbackMode::force, 4))));
}

TEST_CASE("the simulated device and the stiffness advice use the same sample delay", "[practice]") {
  Capabilities late = device_profile("desktop");
  late.sample_delay = 15;
  const RendererOptions advised = RendererOptions::for_device(late);
  SampledLoop loop{late, late.update_rate};
  loop.wall_damping = advised.paper.damping;
  CHECK(advised.paper.stiffness == Approx(stiffness_for_any_hand(loop, advised.velocity_cutoff, 1e6)));
  CHECK(advised.paper.stiffness < 100.0);

  const PracticePage page = page_of("永");
  const auto strokes_written = [&page](const Capabilities& device, const RendererOptions& renderer) {
    SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force);
    options.device = device;
    options.renderer = renderer;
    return score_page(page, write_page(page, options)).front().strokes_completed;
  };
  CHECK(strokes_written(late, advised) == 5);
  // A stiffness that ignores the delay is rejected: the loop oscillates, and at most one stroke is written.
  RendererOptions careless = RendererOptions::for_device(device_profile("desktop"));
  CHECK(careless.paper.stiffness == 600.0);
  careless.stiffness_check = StiffnessCheck::reject;
  CHECK_THROWS_AS(strokes_written(late, careless), ValueError);
  careless.stiffness_check = StiffnessCheck::off;
  CHECK(strokes_written(late, careless) <= 1);
}

TEST_CASE("a device that lacks an axis needed for writing is rejected by name", "[practice]") {
  SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force);
  options.device.driven.z = false;
  CHECK_THROWS_WITH(write_page(page_of("永"), options),
                    "device \"desktop\": sensed axes are x, y, z, driven axes are x, y; the renderer needs x, y and z "
                    "to be sensed and driven");
}

TEST_CASE("both writers complete every stroke of a page on every device profile", "[practice]") {
  const bool novice = GENERATE(true, false);
  const std::string name = GENERATE("omni", "touch", "desktop", "premium-1.5", "ideal");
  CAPTURE(novice, name);
  const PracticePage page = page_of("马〇");
  SessionOptions options = session(novice ? WriterSkill::novice() : WriterSkill::skilled(), FeedbackMode::force);
  options.device = device_profile(name);
  options.renderer = RendererOptions::for_device(options.device);
  const Recording recording = write_page(page, options);
  for (const CharacterScore& character : score_page(page, recording)) {
    CHECK(character.strokes_completed == character.stroke_count);
    CHECK(character.peak_force <= options.device.peak_force);
  }
}

namespace {

/// Checks that every stroke is completed in both modes, without a fault or a force step above the limit.
void check_written(const Character& character, std::uint64_t seed) {
  const PracticePage page = lay_out(std::span(&character, 1)).front();
  for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
    CAPTURE(encode_utf8(character.code), mode == FeedbackMode::force);
    const SessionOptions options = session(WriterSkill::novice(), mode, seed);
    const Recording recording = write_page(page, options);
    const HapticRenderer renderer(page.characters, upright_page(page.width, page.height), options.device,
                                  options.renderer);
    const CharacterScore result = score_page(page, recording).front();
    CHECK(result.strokes_completed == result.stroke_count);
    CHECK(max_step(recording) <= renderer.max_force_step() * (1.0 + 1e-12));
    CHECK(std::all_of(recording.samples.begin(), recording.samples.end(),
                      [](const RecordedSample& sample) { return sample.status == TickStatus::ok; }));
  }
}

constexpr int drawn_characters = 200;

}  // namespace

TEST_CASE("every built-in character is completed in both modes, and force steps stay within the limit", "[practice]") {
  for (const Character& character : built_in_characters().characters) check_written(character, 11);
}

TEST_CASE("characters drawn at random from a whole set, as stored in a set file, are completed in both modes",
          "[practice][corpus]") {
  const char* const path = std::getenv("CALLIGRAPHY_CHARACTER_FILE");
  if (path == nullptr) {
    WARN("skipped: CALLIGRAPHY_CHARACTER_FILE does not name a character set made by calligraphy import");
    CHECK(std::getenv("CALLIGRAPHY_REQUIRE_DATA") == nullptr);
    return;
  }
  std::vector<StoredCharacter> all;
  for (const StoredCharacter& character : CharacterSet::open(path)) all.push_back(character);
  REQUIRE(all.size() >= 9574);
  calligraphy_test::Sequence random(20061);
  CharacterList drawn;
  while (drawn.characters.size() < drawn_characters) {
    const auto index = static_cast<std::size_t>(random.next() * static_cast<double>(all.size()));
    if (drawn.find(all[index].code()) == nullptr) drawn.characters.push_back(all[index].character());
  }
  const CharacterSet kept = CharacterSet::from_bytes(encode_character_set(drawn), "drawn");
  for (const StoredCharacter& character : kept) check_written(character.character(), character.code());
}

TEST_CASE("the printed rules step the force by newtons where the default keeps its limit", "[practice]") {
  const PracticePage page = page_of("永北");
  const SessionOptions standard = session(WriterSkill::novice(), FeedbackMode::force, 1);
  SessionOptions printed = standard;
  printed.renderer = RendererOptions::wang2006();
  const double with_default = max_step(write_page(page, standard));
  const double as_printed = max_step(write_page(page, printed));
  WARN("maximum force step per tick: default " << with_default << " N, wang2006 " << as_printed << " N");
  CHECK(with_default <= std::hypot(0.1, 0.4) * (1.0 + 1e-12));
  CHECK(as_printed > 1.0);
}

TEST_CASE("the path error at other servo rates is the same within one force JND", "[practice]") {
  // The force JND is 6 to 10 %; the results of the experiment must not depend on the rate by more than that.
  const PracticePage page = page_of("永");
  double reference = 0.0;
  for (const double rate : {1000.0, 500.0, 4000.0}) {
    SessionOptions options = session(WriterSkill::skilled(), FeedbackMode::force, 2);
    options.skill.drift = 0.0;  // its noise is drawn per tick
    options.renderer.servo_rate = rate;
    const double error = score_page(page, write_page(page, options)).front().rms_error;
    if (reference == 0.0) reference = error;
    CHECK(error == Approx(reference).epsilon(0.06));
  }
}

TEST_CASE("a parameter of the writer or the session out of its domain is rejected by name", "[practice]") {
  const PracticePage page = page_of("一");
  SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force);
  std::string named;
  SECTION("sight") { options.skill.visual_delay = -1.0, named = "visual_delay"; }
  SECTION("speed") { options.skill.speed = std::nan(""), named = "speed"; }
  SECTION("rate") { options.renderer.servo_rate = -1.0, named = "servo_rate"; }
  SECTION("duration") { options.character_timeout = 0.0, named = "character_timeout"; }
  try {
    write_page(page, options);
    FAIL("accepted");
  } catch (const ValueError& error) {
    CHECK(std::string(error.what()).find(named) != std::string::npos);
  }
}
