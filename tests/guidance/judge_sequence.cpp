// guidance_judge sequence: what is taken for the stroke that is due.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>

#include "judge_program.hpp"
#include "sequence.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

bool is_of_half(const Character& character, const std::string& half) {
  if (half.empty()) return true;
  if (half != "choosing" && half != "printed") throw ValueError("--half " + half + ": expected choosing or printed");
  return (Random(character.code).bits() % 2 == 0) == (half == "choosing");
}

class SequenceProgram {
 public:
  explicit SequenceProgram(Arguments& arguments)
      : what_(arguments.text("--what", "honest")),
        device_(arguments.text("--device", "ideal")),
        renderer_(arguments.text("--renderer", "default")),
        tolerances_(arguments.text("--tolerances", "normal")),
        slack_(arguments.number("--slack", -1.0)),
        em_(arguments.number("--em", 0.0)) {
    const int count = static_cast<int>(arguments.number("--characters", 100));
    const std::string text = arguments.text("--character"), half = arguments.text("--half");
    options_.held = arguments.flag("--held");
    options_.arm = arguments.flag("--naive") ? Arm::naive : Arm::skilled;
    options_.seed = static_cast<std::uint64_t>(arguments.number("--seed", 1));
    options_.threads = static_cast<int>(arguments.number("--threads", 0));
    const char* const file = std::getenv("CALLIGRAPHY_CHARACTER_FILE");
    if (!arguments.understood()) return;
    characters_ = some_characters(file != nullptr ? file : "", 1000000, 1);
    std::erase_if(characters_, [&](const Character& character) {
      return !is_of_half(character, half) || (!text.empty() && text.find(name_of(character.code)) == std::string::npos);
    });
    characters_.resize(std::min(characters_.size(), static_cast<std::size_t>(count)));
  }

  void run() {
    for (const Capabilities& device : devices_of(device_)) {
      options_.device = device;
      options_.renderer = renderer_of(renderer_, device);
      options_.renderer.tolerances = tolerances_of(tolerances_);
      if (slack_ >= 0.0) options_.renderer.tolerances.slack = slack_;
      for (const double em : {10.0, 20.0, 40.0}) {
        if (em_ > 0.0 && em != 10.0) continue;
        options_.em = 1e-3 * (em_ > 0.0 ? em_ : em);
        std::printf("%s, em %.0f mm, %zu characters, %s pen\n", device.name.c_str(), 1e3 * options_.em,
                    characters_.size(), options_.held ? "held" : "kinematic");
        run_one();
      }
    }
  }

 private:
  void run_one() {
    if (what_ == "honest") {
      run_honest();
    } else if (what_ == "dishonest") {
      run_dishonest();
    } else if (what_ == "sideways") {
      for (const double share : {0.05, -0.05, 0.1, -0.1, 0.15, -0.15, 0.1875, -0.1875}) {
        char name[96];
        std::snprintf(name, sizeof name, "displaced sideways by %+.2f %% of the em", 100.0 * share);
        judge(name, displaced_sideways(share * options_.em));
      }
    } else {
      throw ValueError("--what " + what_ + ": expected honest, dishonest or sideways");
    }
  }

  void run_honest() {
    struct Variant {
      const char* name;
      PeopleDraw people;
    };
    constexpr double shift = 0.05;
    const Variant variants[] = {
        {"exactly", {0.0, Noise::none, 0.0}},
        {"shifted by up to 5 %", {shift, Noise::none, 0.0}},
        {"shifted, each stroke displaced by 2 %", {shift, Noise::displacement, 0.02}},
        {"shifted, each stroke distorted by 1 %", {shift, Noise::distortion, 0.01}},
        {"shifted, each stroke distorted by 2 %", {shift, Noise::distortion, 0.02}},
        {"shifted, each stroke distorted by 3 %", {shift, Noise::distortion, 0.03}},
        {"shifted, each stroke distorted by 4 %", {shift, Noise::distortion, 0.04}},
        {"shifted, each stroke distorted by 2 %, scaled by up to 3 %", {shift, Noise::distortion, 0.02, 0.03}},
        {"shifted, the square warped by 3 %", {shift, Noise::warp, 0.03}},
        {"shifted, distorted by 2 %, round, trembling, ends off by 2 %",
         {shift, Noise::distortion, 0.02, 0.0, 0.06, 0.005, 0.02}},
    };
    for (const Variant& variant : variants) {
      const bool held = options_.held;
      for (const bool feels : {true, false}) {
        options_.feels = feels;
        if (!held && !feels) continue;
        const SequenceResult result = judge_people(characters_, options_, variant.people, progress());
        print(std::string(variant.name) + (!held ? "" : feels ? ", force" : ", vision"), result, nullptr);
      }
    }
  }

  void run_dishonest() {
    const double em = options_.em;
    judge("the first half", part_of_stroke(0.0, 0.5));
    judge("the middle half", part_of_stroke(0.25, 0.75));
    judge("the second half", part_of_stroke(0.5, 1.0));
    judge_part("the first 58 %", part_of_stroke(0.0, 0.58));
    judge("the last 58 %", part_of_stroke(0.42, 1.0));
    judge_part("the first 65 %", part_of_stroke(0.0, 0.65));
    judge_part("the last 65 %", part_of_stroke(0.35, 1.0));
    judge("the first 80 %", part_of_stroke(0.0, 0.8));
    judge_part("the first 80 % of strokes of 0.4 em and longer", part_of_stroke(0.0, 0.8, 0.4 * em));
    judge("from the end to the start", backwards());
    judge("to the middle and back", doubled_back(0.5));
    judge("one of 6 tremors of +-2 to 4 % of the em, strokes < 0.2 em", tremors(em), "length");
    judge("one of 4 circlings of radius 3 or 5 % of the em, strokes < 0.2 em", circling(em, true), "length");
    judge("one of 4 circlings of radius 3 or 5 %, strokes of 0.2 em and longer", circling(em, false), "length");
    judge("one of 8 sine waves of +-10 % of the em", zigzags(em, 0.1, true), "length");
    judge("one of 8 zigzags of +-10 % of the em", zigzags(em, 0.1, false), "length");
    judge("one of 8 sine waves of +-7 % of the em", zigzags(em, 0.07, true));
    judge("a later stroke, different by > 5 % of the em", later_strokes(em), "different by");
    judge("the same, distorted by 2 %", later_strokes(em, 0.02), "different by");
    judge("the chord of a stroke that differs from it by > 5 % of the em", chord(em), "different by");
  }

  void judge(const std::string& name, const Attempts& attempts, const char* figure = nullptr) {
    print(name, judge_attempts(characters_, options_, attempts, progress()), figure);
  }

  /// By itself, and with the exact next stroke after it.
  void judge_part(const std::string& name, const Attempts& attempts) {
    judge(name, attempts);
    judge(name + ", the exact next stroke follows", going_on(attempts));
  }

  /// `figure`: what that of a finding says; the worst are shown.
  void print(const std::string& what, SequenceResult result, const char* figure) const {
    ClusteredMean share;
    for (std::size_t i = 0; i < result.by_character.size(); ++i) {
      for (int k = 0; k < result.by_character[i].of; ++k) share.add(i, k < result.by_character[i].count ? 1.0 : 0.0);
    }
    std::printf("%-80s %6d of %6d (%6.2f +- %.2f %%)", what.c_str(), result.taken.count, result.taken.of,
                result.taken.percent(), 100.0 * share.half_width());
    if (result.tries.of > result.taken.of) std::printf(", %.2f %% of %d", result.tries.percent(), result.tries.of);
    if (result.not_finished_exactly > 0) {
      std::printf("; broken off, because a stroke drawn exactly was not finished: %d", result.not_finished_exactly);
    }
    if (result.taken_for_next > 0) {
      std::printf("; drawn exactly after it, taken for the next stroke: %d", result.taken_for_next);
    }
    std::printf("\n");
    std::sort(result.findings.begin(), result.findings.end(),
              [](const Finding& a, const Finding& b) { return a.figure > b.figure; });
    for (std::size_t i = 0; figure != nullptr && i < std::min<std::size_t>(3, result.findings.size()); ++i) {
      const Finding& finding = result.findings[i];
      std::printf("    --character %s, stroke %d, attempt %d: %s %.2f em\n", name_of(finding.character).c_str(),
                  finding.stroke + 1, finding.attempt + 1, figure, finding.figure);
    }
  }

  std::string what_, device_, renderer_, tolerances_;
  double slack_, em_;
  SequenceOptions options_;
  std::vector<Character> characters_;
};

}  // namespace

int sequence(Arguments& arguments) {
  SequenceProgram program(arguments);
  if (!arguments.understood()) return 2;
  program.run();
  return 0;
}

}  // namespace calligraphy_test
