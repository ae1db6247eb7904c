// Judges the guidance by thousands of cases: whether it throws the pen, whether it takes what it should, and only that.
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/model/character_list.hpp>

#include "arguments.hpp"
#include "judge_program.hpp"
#include "pairs.hpp"
#include "releases.hpp"
#include "stages.hpp"
#include "statistics.hpp"
#include "stroke_line.hpp"

namespace {

using namespace calligraphy_test;
using namespace calligraphy;

constexpr const char* usage =
    "usage: guidance_judge pairs [--cases N] [--device NAME] [--renderer default|everything] [--em MM]\n"
    "                            [--character C [--seed S]] [--first S]\n"
    "           strokes by the novice, with vision alone and with force; C, S: that page alone; --first: the seed of\n"
    "           the first page, 1 by default\n"
    "       guidance_judge releases [--cases N] [--seed S] [--case K]\n"
    "           pens that the guidance lets go of; --case: one of them, its motion as CSV\n"
    "       guidance_judge sequence [--what honest|dishonest|sideways] [--characters N [--half choosing|printed]]\n"
    "                               [--em MM] [--device NAME|all] [--renderer default|everything]\n"
    "                               [--tolerances lenient|normal|strict] [--slack EM] [--held [--naive]]\n"
    "                               [--character C] [--seed S]\n"
    "           what is taken for the due stroke: of the set CALLIGRAPHY_CHARACTER_FILE, or else of the built-in\n"
    "           characters; --half: of those, the half on which the constants were chosen, or the other; --held: a\n"
    "           pen in a hand, or else one that is where it is meant to be; --naive: in a hand that leaves the\n"
    "           device's friction to the spring of its grip\n"
    "       guidance_judge people [--traces DIR:DIR...] [--half choosing|printed] [--characters N] [--em MM]\n"
    "                             [--tolerances lenient|normal|strict]\n"
    "           people's strokes, drawn as they wrote them: of the traces CALLIGRAPHY_ALL_PEN_TRACES that are\n"
    "           right for a character of the sets CALLIGRAPHY_CHARACTER_FILE and CALLIGRAPHY_KANJI_FILE; --half:\n"
    "           printed are the characters of odd codes\n"
    "       guidance_judge wrong_end [--strokes N] [--device NAME|all] [--renderer default|everything] [--em MM]\n"
    "           strokes of the built-in characters, drawn from their ends: whether force resists\n"
    "       guidance_judge everything [--times N] [--device NAME|all] [--text CHARACTERS|all] [--em MM]\n"
    "           vision, the default and everything()\n"
    "each with --threads T (0: one per core)\n";

constexpr std::size_t worst_shown = 10;

std::vector<Character> built_in(const std::string& text) {
  std::vector<Character> characters;
  for (const char32_t code : decode_utf8(text)) characters.push_back(built_in_characters().at(code));
  return characters;
}

// pairs

void print_pairs(const std::vector<CharacterPair>& characters, std::size_t most) {
  std::vector<StrokePair> pairs;
  int strokes = 0, unfinished[2] = {};
  ClusteredMean error, time;
  Share at_once[2];
  for (const CharacterPair& character : characters) {
    strokes += static_cast<int>(character.vision.strokes.size());
    const auto of_character = character.strokes();
    pairs.insert(pairs.end(), of_character.begin(), of_character.end());
    unfinished[0] += !character.vision.finished();
    unfinished[1] += !character.force.finished();
    for (const StrokeRun& run : character.vision.strokes) {
      if (run.meant_at_first) at_once[0].add(run.at_once);
    }
    for (const StrokeRun& run : character.force.strokes) {
      if (run.meant_at_first) at_once[1].add(run.at_once);
    }
    if (!(character.vision.score.rms_error > 0.0)) continue;
    error.add(character.seed, 1.0 - character.force.score.rms_error / character.vision.score.rms_error);
    time.add(character.seed, 1.0 - character.force.score.time / character.vision.score.time);
  }
  Share failed, grave;
  std::vector<double> excess;
  for (const StrokePair& pair : pairs) {
    failed.add(pair.fails());
    grave.add(pair.excess() > 0.004);
    excess.push_back(pair.excess());
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.excess() > b.excess(); });
  for (std::size_t i = 0; i < pairs.size() && (i < most || (i < 4 * most && pairs[i].fails())); ++i) {
    const StrokePair& pair = pairs[i];
    std::printf(
        "--character %s --seed %llu, stroke %d: largest error %.1f mm with force in %d contacts, %.1f mm with "
        "vision in %d\n",
        name_of(pair.character).c_str(), static_cast<unsigned long long>(pair.seed), pair.stroke + 1,
        1e3 * pair.force.largest_error, pair.force.contacts, 1e3 * pair.vision.largest_error, pair.vision.contacts);
  }
  std::printf("%zu characters, %d strokes, %zu pairs\n", characters.size(), strokes, pairs.size());
  std::printf(
      "largest error with force beyond that with vision: > 2 mm in %d of %d (%.3f %%), > 4 mm in %d; median "
      "%.2f, 95 %% %.2f, largest %.2f mm\n",
      failed.count, failed.of, failed.percent(), grave.count, 1e3 * quantile(excess, 0.5), 1e3 * quantile(excess, 0.95),
      1e3 * quantile(excess, 1.0));
  const char* const modes[] = {"vision", "force"};
  for (int i = 0; i < 2; ++i) {
    std::printf(
        "%s: finished at the first touch, if that was meant for the due stroke: %d of %d (%.2f %%); "
        "characters unfinished: %d\n",
        modes[i], at_once[i].count, at_once[i].of, at_once[i].percent(), unfinished[i]);
  }
  std::printf("force changes the RMS error by %+.1f +- %.1f %%, the time by %+.1f +- %.1f %% (95 %%)\n",
              -100.0 * error.mean(), 100.0 * error.half_width(), -100.0 * time.mean(), 100.0 * time.half_width());
}

int pairs(Arguments& arguments) {
  PairOptions options;
  options.device = device_profile(arguments.text("--device", "desktop"));
  options.renderer = renderer_of(arguments.text("--renderer", "default"), options.device);
  options.em = 1e-3 * arguments.number("--em", 40.0);
  options.threads = static_cast<int>(arguments.number("--threads", 0));
  const int cases = static_cast<int>(arguments.number("--cases", 1000));
  const std::string text = arguments.text("--character");
  const int seed = static_cast<int>(arguments.number("--seed", 0));
  const int first_seed = static_cast<int>(arguments.number("--first", 1));
  if (!arguments.understood()) return 2;
  const std::vector<Character> characters = text.empty() ? built_in_characters().characters : built_in(text);
  int pages = 0;
  for (int strokes = 0; strokes < cases; ++pages) {
    strokes += characters[static_cast<std::size_t>(pages) % characters.size()].stroke_count();
  }
  if (seed > 0) pages = static_cast<int>(characters.size());
  const auto first = static_cast<std::uint64_t>(seed > 0 ? seed : first_seed);
  print_pairs(write_pairs(characters, first, pages, options, progress()), worst_shown);
  return 0;
}

// releases

int replay_release(const ReleaseCase& drawn) {
  std::fprintf(stderr, "%s\n", describe(drawn).c_str());
  std::printf(
      "time_s,state,events,weight,x_mm,y_mm,z_mm,intended_x_mm,intended_y_mm,intended_z_mm,speed_mps,"
      "twin_mps,force_x_N,force_y_N,force_z_N\n");
  const auto events = run_release(drawn, [](const ReleaseSample& sample) {
    const Vector3d pen = 1e3 * sample.pen, intended = 1e3 * sample.intended, force = sample.tick.page_force;
    std::printf("%.4f,%s,%d,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.4f,%.4f,%.3f,%.3f,%.3f\n", sample.time,
                to_string(sample.tick.state), static_cast<int>(sample.tick.events), sample.tick.contact.weight, pen.x(),
                pen.y(), pen.z(), intended.x(), intended.y(), intended.z(), sample.velocity.head<2>().norm(),
                sample.twin_speed, force.x(), force.y(), force.z());
  });
  for (const ReleaseEvent& event : events) {
    std::fprintf(stderr, "%.3f s: %s at %.2f N, %.3f m/s beyond the twin after %.0f ms\n", event.time,
                 release_names[static_cast<std::size_t>(event.kind)], event.force, event.excess, 1e3 * event.excess_at);
  }
  return 0;
}

int releases(Arguments& arguments) {
  const int cases = static_cast<int>(arguments.number("--cases", 1000));
  const int one = static_cast<int>(arguments.number("--case", -1));
  const auto seed = static_cast<std::uint64_t>(arguments.number("--seed", 1));
  const int threads = static_cast<int>(arguments.number("--threads", 0));
  if (!arguments.understood()) return 2;
  if (one >= 0) return replay_release(draw_release(seed, one));
  const auto events = run_releases(seed, cases, threads, progress());
  struct Row {
    Share failed;
    std::vector<double> excess;
  };
  std::map<std::string, Row> rows;
  std::vector<std::pair<double, std::string>> worst;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const ReleaseCase drawn = draw_release(seed, static_cast<int>(i));
    for (const ReleaseEvent& event : events[i]) {
      const std::string kind = release_names[static_cast<std::size_t>(event.kind)];
      for (const std::string& row :
           {std::string("all"), "release " + kind,
            std::string("hand: ") + strain_names[static_cast<std::size_t>(drawn.strain)],
            std::string(drawn.everything ? "everything" : "for_device") + ", " + drawn.device.name}) {
        rows[row].failed.add(event.fails());
        rows[row].excess.push_back(event.excess);
      }
      char text[128];
      std::snprintf(text, sizeof text, "    %s at %.2f N: %.3f m/s beyond the twin after %.0f ms", kind.c_str(),
                    event.force, event.excess, 1e3 * event.excess_at);
      worst.emplace_back(event.excess, describe(drawn) + "\n" + text);
    }
  }
  std::sort(worst.begin(), worst.end(), std::greater<>());
  for (std::size_t i = 0; i < std::min(worst_shown, worst.size()); ++i) std::printf("%s\n", worst[i].second.c_str());
  std::printf("%-26s %8s %8s %8s %8s %8s   [m/s beyond the twin]\n", "", "releases", "failed", "median", "95 %",
              "worst");
  for (const auto& [name, row] : rows) {
    std::printf("%-26s %8d %8d %8.3f %8.3f %8.3f\n", name.c_str(), row.failed.of, row.failed.count,
                quantile(row.excess, 0.5), quantile(row.excess, 0.95), quantile(row.excess, 1.0));
  }
  return 0;
}

// everything

int everything(Arguments& arguments) {
  const int times = static_cast<int>(arguments.number("--times", 20));
  const double em = 1e-3 * arguments.number("--em", 40.0);
  const std::string device_name = arguments.text("--device", "all");
  const std::string text = arguments.text("--text", "永北京航空和人三十大学中国文字");
  const int threads = static_cast<int>(arguments.number("--threads", 0));
  if (!arguments.understood()) return 2;
  const std::vector<Character> characters = text == "all" ? built_in_characters().characters : built_in(text);
  std::printf("%-12s %-28s %-36s %s\n", "", "characters unfinished of", "RMS error, default / everything [%]",
              "time, default / everything [%]");
  for (const Capabilities& device : devices_of(device_name)) {
    const auto runs = write_with_stages(characters, times, device, em, threads, progress());
    int unfinished[3] = {};
    ClusteredMean error[2], time[2];
    Share at_once[3];
    double rms[3] = {};
    for (const StagesRun& run : runs) {
      const std::array modes = {&run.vision, &run.standard, &run.everything};
      for (std::size_t i = 0; i < modes.size(); ++i) {
        unfinished[i] += !modes[i]->finished();
        rms[i] += 1e3 * modes[i]->score.rms_error / static_cast<double>(runs.size());
        for (const StrokeRun& stroke : modes[i]->strokes) {
          if (stroke.meant_at_first) at_once[i].add(stroke.at_once);
        }
        if (i == 0 || !(run.vision.score.rms_error > 0.0)) continue;
        error[i - 1].add(run.seed, modes[i]->score.rms_error / run.vision.score.rms_error - 1.0);
        time[i - 1].add(run.seed, modes[i]->score.time / run.vision.score.time - 1.0);
      }
    }
    std::printf(
        "%-12s %5zu: vision %3d, %3d, %3d     %+6.1f +- %.1f  %+6.1f +- %.1f     %+6.1f +- %.1f  %+6.1f +- %.1f\n",
        device.name.c_str(), runs.size(), unfinished[0], unfinished[1], unfinished[2], 100.0 * error[0].mean(),
        100.0 * error[0].half_width(), 100.0 * error[1].mean(), 100.0 * error[1].half_width(), 100.0 * time[0].mean(),
        100.0 * time[0].half_width(), 100.0 * time[1].mean(), 100.0 * time[1].half_width());
    std::printf(
        "             finished at the first touch: vision %.2f %%, default %.2f %%, everything %.2f %%; mean "
        "RMS error %.3f, %.3f, %.3f mm\n",
        at_once[0].percent(), at_once[1].percent(), at_once[2].percent(), rms[0], rms[1], rms[2]);
  }
  return 0;
}

int run(const std::string& command, Arguments& arguments) {
  if (command == "pairs") return pairs(arguments);
  if (command == "releases") return releases(arguments);
  if (command == "everything") return everything(arguments);
  if (command == "sequence") return sequence(arguments);
  if (command == "people") return people(arguments);
  if (command == "wrong_end") return wrong_end(arguments);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // minutes pass between lines
  const std::string command = argc > 1 ? argv[1] : "";
  Arguments arguments(argc > 1 ? argc - 1 : argc, argc > 1 ? argv + 1 : argv);
  try {
    const int result = run(command, arguments);
    if (result == 2) std::fputs(usage, stderr);
    return result;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
