// calligraphy write: writes a text in closed loop, with vision only and with vision and force.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>
#include <calligraphy/pictures/picture.hpp>
#include <calligraphy/pictures/plot.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "counted.hpp"
#include "options.hpp"
#include "output_directory.hpp"
#include "output_file.hpp"
#include "pen.hpp"
#include "practice/session_tick.hpp"
#include "progress.hpp"
#include "run_record.hpp"
#include "servo_report.hpp"
#include "summary.hpp"

namespace calligraphy::tools {
namespace {

constexpr const char* summary_file = "summary.json";

struct WriteArguments {
  std::string text;
  RunOutput out;
  std::vector<std::string> characters;
  std::string order;
  std::string device = "simulated:desktop";
  std::optional<std::string> writer;
  std::optional<std::string> like;
  std::optional<double> peak_force;
  std::optional<double> timeout;
  std::string wire_profile;
  std::string model;
  std::optional<std::string> mode;
  std::optional<double> rate;
  int repeat = 1;
  std::uint64_t seed = 1;
  std::string rules = "default";
  std::string renderer = "default";
  PageChoice page;
  StrokeStyle style = StrokeStyle::ink;
  std::optional<std::string> method;
  std::optional<double> tolerance;
  Language language;
  bool json = false;
};

/// A page and the position of its characters in the text.
struct Sheet {
  PracticePage page;
  int first_position;  ///< from 1
};

RendererOptions chosen_renderer(const WriteArguments& options, const Capabilities& capabilities) {
  RendererOptions renderer = options.renderer == "everything"
                                 ? RendererOptions::everything(capabilities, options.page.scale)
                                 : RendererOptions::for_device(capabilities, options.page.scale);
  const RendererOptions printed = RendererOptions::wang2006();
  if (options.rules == "wang2006") {
    if (options.renderer == "everything")
      throw UsageError("--renderer everything: cannot be combined with --rules wang2006");
    RendererOptions rules = printed;
    rules.paper.stiffness = renderer.paper.stiffness;
    rules.guidance.stiffness = renderer.guidance.stiffness;
    rules.guidance.wrong_way_stiffness = renderer.guidance.wrong_way_stiffness;
    rules.guidance.wrong_way_limit = renderer.guidance.wrong_way_limit;
    renderer = rules;
  }
  if (options.method == "exact") renderer.nearest = RendererOptions().nearest;
  if (options.method == "wang2006") renderer.nearest = printed.nearest;
  if (options.tolerance) renderer.nearest.tolerance = *options.tolerance;
  if (options.rate) renderer.servo_rate = *options.rate;
  return renderer;
}

PenOptions chosen_pen(const WriteArguments& options) {
  PenOptions pen;
  pen.device = device_choice(options.device);
  const DeviceKind kind = pen.device.kind;
  const bool is_person = kind == DeviceKind::phantom || kind == DeviceKind::openhaptics;
  const auto refuse = [&options](bool given, const char* option, const char* reason) {
    if (given) throw UsageError(fmt::format("{} with --device {}: {}", option, options.device, reason));
  };
  refuse(options.writer && kind != DeviceKind::simulated, "--writer", "applies only to the simulated writer");
  refuse(options.like && kind != DeviceKind::replay, "--like", "applies only to replay:FILE");
  refuse(options.rate && kind == DeviceKind::replay, "--rate", "the trace determines the rate");
  refuse(options.rate && kind == DeviceKind::openhaptics, "--rate", "the vendor's scheduler determines the rate");
  refuse(options.repeat > 1 && kind == DeviceKind::replay, "--repeat", "every repetition would be the same");
  refuse(options.mode == "both" && kind == DeviceKind::replay, "--mode both", "a trace was written in one mode");
  refuse(options.timeout && !is_person, "--timeout", "applies only to a real device");
  refuse(!options.wire_profile.empty() && kind != DeviceKind::phantom, "--wire-profile",
         "applies only to phantom[:SERIAL]");
  refuse(!options.model.empty() && kind != DeviceKind::phantom, "--model", "applies only to phantom[:SERIAL]");
  pen.device.wire_profile = options.wire_profile;
  pen.device.model = options.model;
  pen.like = options.like.value_or(pen.like);
  pen.peak_force = options.peak_force.value_or(pen.peak_force);
  pen.timeout = options.timeout.value_or(pen.timeout);
  pen.language = options.language;
  return pen;
}

SessionOptions chosen_session(const WriteArguments& options, const Capabilities& device) {
  SessionOptions session;
  session.device = device;
  session.renderer = chosen_renderer(options, device);
  const PageLayout layout = options.page.layout(device);
  session.mapping = options.page.mapping(layout.width, layout.height);
  session.skill = options.writer == "skilled" ? WriterSkill::skilled() : WriterSkill::novice();
  session.measure_ticks = true;
  return session;
}

std::vector<FeedbackMode> chosen_modes(const std::optional<std::string>& mode, bool simulated) {
  if (mode == "vision") return {FeedbackMode::vision};
  if (mode == "force" || (!mode && !simulated)) return {FeedbackMode::force};
  return {FeedbackMode::vision, FeedbackMode::force};
}

std::vector<Sheet> sheets(const std::vector<Character>& characters, const PageLayout& layout) {
  std::vector<Sheet> result;
  int position = 1;
  for (PracticePage& page : lay_out(characters, layout)) {
    const int count = static_cast<int>(page.characters.size());
    result.push_back({std::move(page), position});
    position += count;
  }
  return result;
}

/// The part of a recording in which a character is active.
Recording part(const Recording& recording, int character) {
  Recording result;
  result.rate = recording.rate;
  result.page = recording.page;
  const auto active = [character](const RecordedSample& sample) { return sample.character == character; };
  std::copy_if(recording.samples.begin(), recording.samples.end(), std::back_inserter(result.samples), active);
  return result;
}

Result measure(const CharacterScore& score, const Recording& part) {
  Result result;
  result.score = score;
  std::vector<float> ticks;
  for (const RecordedSample& sample : part.samples) ticks.push_back(sample.tick_ns);
  result.tick_p50 = percentile(ticks, 0.5);
  result.tick_p999 = percentile(ticks, 0.999);
  return result;
}

/// "03-北-force".
std::string file_stem(int position, char32_t code, FeedbackMode mode) {
  return fmt::format("{:02}-{}-{}", position, name_in_file(code), to_string(mode));
}

class WriteRun {
 public:
  explicit WriteRun(const WriteArguments& options)
      : options_(options),
        pen_(chosen_pen(options)),
        session_(chosen_session(options, pen_.capabilities())),
        modes_(chosen_modes(options.mode, !pen_.is_person() && !pen_.is_replay())) {
    summary_.repetitions = options.repeat;
    try {
      // The stable stiffness is lower at a rate below the device's own.
      for (const std::string& reason : clip_stiffness(session_.renderer, session_.device, options.page.scale)) {
        spdlog::warn("clipped: {}", reason);
      }
      validate(session_.renderer, session_.device, options.page.scale);
    } catch (const ValueError& error) {
      throw UsageError(error.what());
    }
  }

  void write() {
    const auto [set, text] = open_characters(options_.characters, characters_of(options_.text), options_.order);
    sheets_ = sheets(characters_of(set, text, options_.order), options_.page.layout(session_.device));
    if (pen_.is_replay() && sheets_.size() > 1)
      throw UsageError("TEXT: does not fit on one page, as a replay requires");
    OutputDirectory out(options_.out.directory, summary_file, options_.out.force);
    explain(out);
    plots_ = gnuplot_available();
    if (!plots_) spdlog::warn("gnuplot is not available: forces are not plotted");
    write_all(out);
    if (summary_.results.empty()) return tell_of_interruption("nothing was written");
    const auto order = [](const Result& a, const Result& b) {
      return std::tie(a.position, a.mode, a.repetition) < std::tie(b.position, b.mode, b.repetition);
    };
    std::sort(summary_.results.begin(), summary_.results.end(), order);
    summary_.interrupted = pen_.interrupted();
    summary_.warnings = pen_.warnings();
    if (pen_.is_person()) out.write("servo.json", json(pen_.statistics()));
    out.keep(json(summary_));
    if (!summary_.interrupted) out.finish();
    report(out);
    if (pen_.interrupted()) tell_of_interruption("results so far are in " + options_.out.directory);
  }

 private:
  /// Space and Esc are how a session is stopped; Ctrl-C ends the program.
  void tell_of_interruption(const std::string& what_is_there) const {
    if (pen_.stopped_by_key()) return spdlog::info("stopped; {}", what_is_there);
    throw Error("interrupted; " + what_is_there);
  }

  /// Says what is known before anything is written.
  void explain(OutputDirectory& out) const {
    const PageLayout layout = options_.page.layout(session_.device);
    nlohmann::ordered_json page = page_json(options_.page, layout);
    page["pages"] = sheets_.size();
    const HapticRenderer renderer(sheets_.front().page.characters, *session_.mapping, session_.device,
                                  session_.renderer);
    nlohmann::ordered_json law, writer, seeds;
    for (const FeedbackMode mode : modes_) {
      law[to_string(mode)] = recording_for(sheets_.front().page, renderer, mode, session_.law).law;
    }
    if (!pen_.is_person() && !pen_.is_replay()) {
      writer = writer_json(options_.writer.value_or("novice"), session_.skill);
      seeds = {{"first", options_.seed}, {"count", sheets_.size() * static_cast<std::size_t>(options_.repeat)}};
    }
    out.explain({{"text", options_.text},
                 {"page", page},
                 {"mapping", mapping_json(*session_.mapping)},
                 {"device", device_json(session_.device)},
                 {"options", options_json(renderer.options())},
                 {"law", law},
                 {"writer", writer},
                 {"seeds", seeds},
                 {"repetitions_requested", summary_.repetitions}});
  }

  void write_all(OutputDirectory& out) {
    Progress progress;
    std::size_t done = 0;
    std::size_t characters = 0;
    for (const Sheet& sheet : sheets_) characters += sheet.page.characters.size();
    const std::size_t runs = characters * modes_.size() * static_cast<std::size_t>(options_.repeat);
    for (std::size_t sheet = 0; sheet < sheets_.size(); ++sheet) {
      const std::size_t count = sheets_[sheet].page.characters.size();
      for (int repetition = 1; repetition <= options_.repeat; ++repetition) {
        session_.seed = options_.seed + static_cast<std::uint64_t>(repetition - 1) * sheets_.size() + sheet;
        for (const FeedbackMode mode : modes_) {
          session_.mode = mode;
          session_.progress = [&](double share) {
            progress.show((static_cast<double>(done) + share * static_cast<double>(count)) / static_cast<double>(runs));
          };
          try {
            write_sheet(sheet, repetition, out);
          } catch (const FileError&) {
            throw;
          } catch (const Error&) {
            if (!pen_.interrupted()) throw;  // otherwise caused by Ctrl-C, which gnuplot receives too
          }
          if (pen_.interrupted()) return;
          done += count;
          progress.show(static_cast<double>(done) / static_cast<double>(runs));
        }
      }
    }
  }

  void write_sheet(std::size_t number, int repetition, OutputDirectory& out) {
    const Sheet& sheet = sheets_[number];
    if (pen_.is_person()) {
      const Language& language = options_.language;
      const char* const mode = session_.mode == FeedbackMode::vision ? "mode.vision_only" : "mode.with_force";
      spdlog::info("{}", language.text("write.hold_pen", {{"page", std::to_string(number + 1)},
                                                          {"pages", std::to_string(sheets_.size())},
                                                          {"mode", language.text(mode)},
                                                          {"keys", pen_.stop_keys()}}));
    }
    const Recording recording = pen_.write(sheet.page, session_);
    // For replay:FILE, which cannot begin in the middle of a page. A single character's trace is the page's.
    const bool several = sheet.page.characters.size() > 1 && !pen_.is_replay() && repetition == 1;
    if (pen_.is_person() || several) {
      std::ostringstream trace;
      write_recording(trace, recording);
      out.write(fmt::format("page-{}-{}-{}.csv", number + 1, to_string(session_.mode), repetition), trace.str());
    }
    const std::vector<CharacterScore> scores = score_page(sheet.page, recording);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const int index = static_cast<int>(i);
      const Recording own = part(recording, index);
      Result result = measure(scores[i], own);
      result.score.mean_pressure *= options_.page.scale;  // as the hand feels it
      result.score.peak_force *= options_.page.scale;
      result.score.max_force_step *= options_.page.scale;
      result.position = sheet.first_position + index;
      result.mode = session_.mode;
      result.repetition = repetition;
      result.seed = session_.seed;
      if (repetition == 1) draw(sheet.page, recording, own, index, result, out);
      summary_.results.push_back(std::move(result));
    }
  }

  void draw(const PracticePage& page, const Recording& recording, const Recording& own, int index, const Result& result,
            OutputDirectory& out) const {
    const char32_t code = result.score.character;
    const std::string stem = file_stem(result.position, code, result.mode);
    const char* const mode = result.mode == FeedbackMode::vision ? "mode.vision_only" : "mode.vision_and_force";
    const std::string title =
        fmt::format("{}, {}, {}", encode_utf8(code), options_.language.text(mode), session_.device.model);
    out.write(stem + ".svg", page_picture(page, recording, index, title, options_.style, options_.language));
    const bool reached = !own.samples.empty();  // the page may have been aborted before
    if (plots_ && reached) {
      out.write(stem + "-force.svg", force_plot(recording, index, title, options_.language));
    }
    std::ostringstream trace;
    write_recording(trace, own);
    out.write(stem + ".csv", trace.str());
  }

  void report(const OutputDirectory& out) const {
    if (options_.json) {
      fmt::print(output(), "{}", out.text());
    } else {
      const Language& language = options_.language;
      fmt::print(output(), "{}{}{}", table(summary_, language), reductions(summary_.results, language),
                 remarks(summary_, language));
      for (const ServoStatistics& statistics : pen_.statistics()) fmt::print(output(), "{}", lines(statistics));
    }
    const auto given_up = [](const Result& r) { return r.score.strokes_completed < r.score.stroke_count; };
    const std::vector<Result>& results = summary_.results;
    const auto unfinished = std::count_if(results.begin(), results.end(), given_up);
    if (unfinished == 0) return;
    spdlog::warn("not completed: {} of {}", unfinished, counted(results.size(), "character"));
    if (pen_.is_replay()) {
      spdlog::warn(
          "a trace is replayed with the TEXT and the page options with which it was recorded: that of a text of "
          "several "
          "characters is page-1-....csv, with the whole text");
    }
  }

  const WriteArguments& options_;
  Pen pen_;
  SessionOptions session_;
  std::vector<FeedbackMode> modes_;
  std::vector<Sheet> sheets_;
  Summary summary_;
  bool plots_ = false;
};

}  // namespace

void add_write(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("write",
                             "Write a text, without and with force. It is written by a simulated writer on a simulated "
                             "device, or by a person on a real one, where space, Esc and Ctrl-C take the force away at "
                             "once and stop. DIR receives summary.json and, per character and mode, a picture, a force "
                             "plot and a trace of the first repetition; of a page of several characters a trace too.");
  command->footer(
      "calligraphy write 永和 -o out                       # without and with force\n"
      "calligraphy write 永 --repeat 20 -o twenty          # what force changes\n"
      "calligraphy write 福 --characters hanzi.set -o fu   # made by `import`\n"
      "calligraphy write 永 --device phantom --wire-profile mine.profile -o mine\n"
      "# mine.profile: see `calligraphy help devices profile`");
  const auto options = std::make_shared<WriteArguments>();
  command
      ->add_option("TEXT", options->text,
                   "Characters to write; white space is ignored, and so is punctuation that the set lacks")
      ->required();
  add_out_directory(*command, options->out, "the results", summary_file)->required();
  add_characters_option(*command, options->characters);
  command->add_option("--order", options->order, "Alternate stroke order (default: the standard one)")
      ->type_name("NAME");
  std::vector<std::string> with_names = simulated_devices();
  with_names.insert(with_names.end(), {"phantom", "openhaptics", "replay:FILE"});
  command
      ->add_option("--device", options->device,
                   "[simulated:]NAME, where NAME is one of " + device_names() +
                       "; phantom[:SERIAL] or openhaptics[:NAME], real devices; or replay:FILE, a trace recorded by "
                       "this command, with the same TEXT and page options: page-N-MODE-1.csv of several characters, "
                       "otherwise 01-CHARACTER-MODE.csv")
      ->capture_default_str()
      ->check(such_as(with_names))
      ->type_name("DEVICE");
  command->add_option("--writer", options->writer, "Skill of the simulated writer (default: novice)")
      ->check(CLI::IsMember({"novice", "skilled"}));
  command
      ->add_option(
          "--mode", options->mode,
          "Vision only, vision and force, or both in turn (default: both on a simulated device, otherwise force)")
      ->check(CLI::IsMember({"both", "vision", "force"}));
  command
      ->add_option("--peak-force", options->peak_force,
                   "Limit of the force, in addition to the device's own, 0.1 to 1000")
      ->check(number(0.1, 1000.0))
      ->type_name("N");
  command
      ->add_option("--timeout", options->timeout, "Real device: abort a page after SECONDS, 1 to 100000 (default: 600)")
      ->check(number(1.0, 1e5))
      ->type_name("SECONDS");
  command
      ->add_option("--like", options->like,
                   "Device profile that supplies limits and workspace for a replay (default: desktop)")
      ->check(such_as(profile_names()))
      ->type_name("NAME");
  add_phantom_options(*command, options->wire_profile, options->model);
  add_page_options(*command, options->page);
  command->add_option("--rate", options->rate, "Servo rate, 10 to 20000 (default: the device's)")
      ->check(number(10.0, 20000.0))
      ->type_name("HZ");
  command
      ->add_option(
          "--repeat", options->repeat,
          "Number of repetitions, each with beliefs of its own; pictures and traces show the first. An effect of "
          "force is reported from 10 on")
      ->check(integer(1, 100000))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of the first repetition; both modes use the same seeds")
      ->check(integer(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--rules", options->rules, "Default rules, or the rules as printed in the paper")
      ->check(CLI::IsMember({"default", "wang2006"}))
      ->capture_default_str();
  command->add_option("--renderer", options->renderer, "Default stages, or the optional stages enabled too")
      ->check(CLI::IsMember({"default", "everything"}))
      ->capture_default_str();
  command->add_option("--method", options->method, "Nearest-point method on curves (default: that of the rules)")
      ->check(CLI::IsMember({"exact", "wang2006"}));
  command
      ->add_option("--tolerance", options->tolerance,
                   "Tolerance of the nearest point, relative to the size of the curve, 1e-15 to 1")
      ->check(number(1e-15, 1.0))
      ->type_name("T");
  add_language_option(*command, options->language);
  add_lines_flag(*command, options->style);
  command->add_flag("--json", options->json, "Print summary.json instead of the table")->disable_flag_override();
  command->callback([options] { WriteRun(*options).write(); });
}

}  // namespace calligraphy::tools
