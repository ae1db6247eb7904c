// calligraphy write: writes a text in closed loop, with vision only and with vision and force.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/session.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "counted.hpp"
#include "kept_recording.hpp"
#include "lesson_report.hpp"
#include "options.hpp"
#include "output_directory.hpp"
#include "output_file.hpp"
#include "page_results.hpp"
#include "pen.hpp"
#include "progress.hpp"
#include "run_record.hpp"
#include "servo_report.hpp"
#include "summary.hpp"

namespace calligraphy::tools {
namespace {


struct WriteArguments {
  std::string text;
  RunOutput out;
  std::vector<std::string> characters;
  std::string order;
  std::string device = "simulated:desktop";
  std::optional<std::string> writer;
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
  bool ticks = false;
  bool json = false;
};

/// A recording of which pictures are made.
struct Drawn {
  std::string name;
  PageInRun where;
  std::vector<RecordedSample> samples;  ///< unless they can be made again from what is stored
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
  refuse(options.rate && kind == DeviceKind::openhaptics, "--rate", "the vendor's scheduler determines the rate");
  refuse(options.timeout && !is_person, "--timeout", "applies only to a real device");
  refuse(!options.wire_profile.empty() && kind != DeviceKind::phantom, "--wire-profile",
         "applies only to phantom[:SERIAL]");
  refuse(!options.model.empty() && kind != DeviceKind::phantom, "--model", "applies only to phantom[:SERIAL]");
  pen.device.wire_profile = options.wire_profile;
  pen.device.model = options.model;
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

class WriteRun {
 public:
  explicit WriteRun(const WriteArguments& options)
      : options_(options),
        pen_(chosen_pen(options)),
        session_(chosen_session(options, pen_.capabilities())),
        modes_(chosen_modes(options.mode, !pen_.is_person())) {
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
    OutputDirectory out(options_.out.directory, summary_file, options_.out.force);
    explain(out);
    try {
      finish(out);
    } catch (const FileError&) {  // such as a full disk
      spdlog::warn("the recordings in {} have what was written until then, and `calligraphy replay` reads them",
                   options_.out.directory);
      throw;
    }
  }

 private:
  void finish(OutputDirectory& out) {
    write_all(out);
    if (summary_.results.empty()) return tell_of_interruption("nothing was written");
    const auto order = [](const Result& a, const Result& b) {
      return std::tie(a.position, a.mode, a.repetition) < std::tie(b.position, b.mode, b.repetition);
    };
    std::sort(summary_.results.begin(), summary_.results.end(), order);
    summary_.interrupted = pen_.interrupted();
    summary_.warnings = pen_.warnings();
    summary_.warnings.insert(summary_.warnings.end(), warnings_.begin(), warnings_.end());
    if (!options_.json) report();
    if (pen_.is_person()) out.write("servo.json", json(pen_.statistics()));
    out.write("strokes.csv", strokes_table(summary_.results));
    out.keep(json(summary_));
    draw(out);
    summary_.interrupted = pen_.interrupted();
    out.keep(json(summary_));
    if (!summary_.interrupted) out.finish();
    if (options_.json) fmt::print(output(), "{}", out.text());
    warn_of_unfinished();
    if (pen_.interrupted()) tell_of_interruption("results so far are in " + options_.out.directory);
  }

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
      law[to_string(mode)] = mode == FeedbackMode::vision ? "none" : renderer.law().name;
    }
    if (!pen_.is_person()) {
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
      const std::string hold_pen = language.text("write.hold_pen", {{"page", std::to_string(number + 1)},
                                                                    {"pages", std::to_string(sheets_.size())},
                                                                    {"mode", language.text(mode)},
                                                                    {"keys", pen_.stop_keys()}});
      spdlog::info("{}{}", hold_pen, pen_.lesson_keys());
    }
    const std::string name = fmt::format("page-{}-{}-{}", number + 1, to_string(session_.mode), repetition);
    KeptRecording kept(out, name);
    // Of a simulated writer the rest can be made again from the seeds.
    const bool is_kept = pen_.is_person() || repetition == 1;
    session_.keep = [&](const Recording& recording) {
      if (is_kept) kept.take(recording);
    };
    const PageInRun where = {static_cast<int>(number) + 1, sheet.first_position, repetition, session_.seed};
    Recording recording = [&] {
      try {
        return pen_.write(sheet.page, session_);
      } catch (const Error&) {
        if (!pen_.is_person() && pen_.interrupted()) kept.discard();
        throw;
      }
    }();
    const bool can_be_made_again = recording.setup.has_value();
    if (!can_be_made_again) {
      recording.setup = {sheet.page, *session_.mapping, session_.device, session_.renderer, session_.mode};
      warnings_.push_back(kept.name() + ": strokes were skipped or taken back: its forces cannot be made again");
      spdlog::warn("{}", warnings_.back());
    }
    if (is_kept) {
      kept.finish();
      if (options_.ticks) {
        try_to_write(name + "-ticks.csv", [&] { return ticks_table(recording); }, out, warnings_);
      }
    }
    for (Result& result : results_of(recording, where)) summary_.results.push_back(std::move(result));
    if (!is_kept || repetition != 1) return;
    drawn_.push_back({kept.name(), where, {}});
    if (!can_be_made_again) drawn_.back().samples = std::move(recording.samples);
  }

  /// Pictures come last: what was written is safe by then. Their forces are made again from what is stored.
  void draw(OutputDirectory& out) {
    const bool was_stopped = pen_.interrupted();  // what was written until then is drawn
    const PictureOptions options = {options_.style, options_.language, !drawn_.empty() && can_plot(summary_.warnings),
                                    [&] { return !was_stopped && pen_.interrupted(); }, {}};
    std::vector<Character> characters;
    for (const Sheet& sheet : sheets_) {
      for (const PlacedCharacter& placed : sheet.page.characters) characters.push_back(placed.character);
    }
    warn_of_missing_font(characters, options_.language);
    for (auto& [name, where, samples] : drawn_) {
      Recording recording = open_recording(out.reserve(name)).recording;
      if (!samples.empty()) recording.samples = std::move(samples);
      draw_page(recording, where, options, out, summary_.warnings);
    }
    draw_errors(summary_.results, session_.device.model, options, out, summary_.warnings);
  }

  void report() const {
    const Language& language = options_.language;
    fmt::print(output(), "{}{}{}{}", table(summary_, language), reductions(summary_.results, language),
               remarks(summary_, language), lines(pen_.lessons(), language));
    for (const ServoStatistics& statistics : pen_.statistics()) fmt::print(output(), "{}", lines(statistics));
    std::fflush(output());  // pictures take a while
  }

  void warn_of_unfinished() const {
    const auto given_up = [](const Result& r) { return r.score.strokes_completed < r.score.stroke_count; };
    const std::vector<Result>& results = summary_.results;
    const auto unfinished = std::count_if(results.begin(), results.end(), given_up);
    if (unfinished == 0) return;
    spdlog::warn("not completed: {} of {}", unfinished, counted(results.size(), "character"));
  }

  const WriteArguments& options_;
  Pen pen_;
  SessionOptions session_;
  std::vector<FeedbackMode> modes_;
  std::vector<Sheet> sheets_;
  Summary summary_;
  std::vector<std::string> warnings_;
  std::vector<Drawn> drawn_;
};

}  // namespace

void add_write(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("write",
                             "Write a text, without and with force. It is written by a simulated writer on a simulated "
                             "device, or by a person on a real one, where space, Esc and Ctrl-C take the force away at "
                             "once and stop. DIR receives summary.json, which explains the run, strokes.csv, a recording "
                             "of each page and mode, which `replay` reads, and pictures: of what was written, for each "
                             "character, mode and page, and of the forces over time.");
  command->footer(
      "calligraphy write 永和 -o out                       # without and with force\n"
      "calligraphy write ㇏㇇ -o two                       # strokes; also \"6 17\"\n"
      "calligraphy write 永 --repeat 20 -o twenty          # what force changes\n"
      "calligraphy write 福 --characters hanzi.set -o fu   # made by `import`\n"
      "calligraphy write 永 --device phantom --wire-profile mine.profile -o mine\n"
      "# mine.profile: see `calligraphy help devices profile`");
  const auto options = std::make_shared<WriteArguments>();
  command
      ->add_option("TEXT", options->text,
                   "Characters to write; white space is ignored, and so is punctuation that the set lacks")
      ->required();
  add_out_directory(*command, options->out, "the results")->required();
  add_characters_option(*command, options->characters);
  command->add_option("--order", options->order, "Alternate stroke order (default: the standard one)")
      ->type_name("NAME");
  std::vector<std::string> with_names = simulated_devices();
  with_names.insert(with_names.end(), {"phantom", "openhaptics"});
  command
      ->add_option("--device", options->device,
                   "[simulated:]NAME, where NAME is one of " + device_names() +
                       "; or phantom[:SERIAL] or openhaptics[:NAME], real devices")
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
  add_phantom_options(*command, options->wire_profile, options->model);
  add_page_options(*command, options->page);
  command->add_option("--rate", options->rate, "Servo rate, 10 to 20000 (default: the device's)")
      ->check(number(10.0, 20000.0))
      ->type_name("HZ");
  command
      ->add_option(
          "--repeat", options->repeat,
          "Number of repetitions, each with beliefs of its own; pictures and recordings are of the first. An effect of "
          "force is reported from 10 on, and drawn in error-by-character.svg")
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
  command
      ->add_flag("--ticks", options->ticks,
                 "Also write the ticks of each recording as comma-separated values: page-N-MODE-R-ticks.csv")
      ->disable_flag_override();
  command->add_flag("--json", options->json, "Print summary.json instead of the table")->disable_flag_override();
  command->callback([options] { WriteRun(*options).write(); });
}

}  // namespace calligraphy::tools
