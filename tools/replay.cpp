// calligraphy replay: replays recordings, and pen traces of people on the simulated device.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/ink_import.hpp>
#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/judge/y_axis.hpp>
#include <calligraphy/pictures/replay_picture.hpp>
#include <calligraphy/practice/session.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "gzip_file.hpp"
#include "interrupt.hpp"
#include "kept_recording.hpp"
#include "options.hpp"
#include "output_directory.hpp"
#include "output_file.hpp"
#include "progress.hpp"
#include "replay_recordings.hpp"
#include "replay_report.hpp"
#include "run_record.hpp"

namespace calligraphy::tools {
namespace {

constexpr std::size_t most_recognised = 5;

struct ReplayArguments {
  std::string traces;
  std::vector<std::string> characters;
  RunOutput out;
  std::optional<std::string> only;
  std::string order;
  std::string y_axis = "auto";
  std::string leniency = "normal";
  std::string device = "simulated:desktop";
  std::string renderer = "default";
  PageChoice page;
  StrokeStyle style = StrokeStyle::ink;  ///< of the templates
  Language language;
  bool recognise = false;
  bool ticks = false;
  bool json = false;
};

/// A trace and its position in the file, from 1.
struct Chosen {
  int position;
  PenTrace trace;
};

TextCharacter character_in(const PenTrace& trace) {
  return {trace.character, unified(trace.character), trace.selector};
}

/// Reads the traces of a file whose y axis points up the right way round.
void turn_if_up(std::vector<PenTrace>& traces, const ReplayArguments& options, std::vector<std::string>& warnings) {
  if (options.y_axis == "down") return;
  if (options.y_axis == "auto") {
    if (recognise_y_axis(traces) != YAxis::up) return;
    warnings.push_back(options.traces +
                       ": y seems to point up, not down as this format wants it, and is read so (--y-axis down: it "
                       "is not)");
    spdlog::warn("{}", printable(warnings.back()));
  }
  std::for_each(traces.begin(), traces.end(), turn_over);
}

/// What makes pen traces of a file, if that is a pen recording in another format; otherwise empty.
std::string advice_on(const std::string& path) {
  InkOptions any;
  any.text.assign(1000, {U'一', U'一', 0});  // whatever was written
  try {
    const InkFormat format = import_ink(unpacked(path), path, any).format;
    if (format == InkFormat::pen_traces) return {};
    return fmt::format("is {}, not pen traces: `calligraphy traces {} -o pens.txt` makes them of it",
                       calligraphy::to_string(format), path);
  } catch (const Error&) {
    return {};
  }
}

std::vector<PenTrace> traces_in(const std::string& path) {
  try {
    GzipReader in(path);
    std::vector<PenTrace> traces = read_pen_traces(in, path);
    if (in.was_cut_off()) throw FormatError(path + ": the file is truncated");
    return traces;
  } catch (const FormatError& error) {
    const std::string advice = advice_on(path);
    throw FormatError(printable(advice.empty() ? error.what() : path + ": " + advice));
  }
}

std::vector<Chosen> chosen_traces(const ReplayArguments& options, std::vector<std::string>& warnings) {
  std::vector<Chosen> chosen;
  int position = 0;
  std::vector<PenTrace> traces = traces_in(options.traces);
  turn_if_up(traces, options, warnings);
  for (PenTrace& trace : traces) chosen.push_back({++position, std::move(trace)});
  if (options.only) {
    const auto is_there = [&chosen](char32_t code) {
      return std::any_of(chosen.begin(), chosen.end(),
                         [code](const Chosen& each) { return unified(each.trace.character) == unified(code); });
    };
    std::u32string only = present(characters_of(*options.only), is_there, options.traces);
    std::transform(only.begin(), only.end(), only.begin(), unified);
    std::erase_if(chosen, [&only](const Chosen& each) { return only.find(unified(each.trace.character)) == only.npos; });
  }
  if (chosen.empty()) throw Error(options.traces + " contains no traces");
  return chosen;
}

std::vector<TextCharacter> text_of(const std::vector<Chosen>& traces) {
  std::vector<TextCharacter> text;
  for (const Chosen& each : traces) text.push_back(character_in(each.trace));
  return text;
}

JudgeTolerances tolerances_of(const std::string& leniency) {
  if (leniency == "lenient") return JudgeTolerances::lenient();
  return leniency == "strict" ? JudgeTolerances::strict() : JudgeTolerances::normal();
}

class ReplayRun {
 public:
  explicit ReplayRun(const ReplayArguments& options) : options_(options) {
    session_.device = chosen_device(options.device);
    session_.renderer = options.renderer == "everything"
                            ? RendererOptions::everything(session_.device, options.page.scale)
                            : RendererOptions::for_device(session_.device, options.page.scale);
    layout_ = options.page.layout(session_.device);
    session_.mapping = options.page.mapping(layout_.width, layout_.height);
    report_.renderer = options.renderer;
    report_.device = session_.device;
  }

  void replay() {
    std::vector<Chosen> traces = chosen_traces(options_, report_.warnings);
    const std::vector<TextCharacter> written = text_of(traces);
    const CharacterSet set = options_.only ? open_characters(options_.characters, written).set
                                           : open_sources(options_.characters, codes_of(written));
    ReadingNotes notes;
    std::u32string text;
    for (Chosen& each : traces) {
      const TextCharacter character = character_in(each.trace);
      each.trace.character = character.code_in(set);
      if (!options_.only) notes.tell(character, each.trace.character);  // told when they were looked up
      text += each.trace.character;
    }
    text = each_once(text);
    for (const char32_t code : text) {
      if (accepted_forms(set, code).empty()) report_.without_template += code;
    }
    const CharacterIndex index(set);
    if (options_.recognise) recognise(traces, index);
    if (report_.without_template == text && !options_.recognise)
      throw Error("none of the written characters is in the character set" +
                  (options_.order.empty() ? "" : " in the order or from the source \"" + options_.order + "\"") +
                  " (see --characters), for example " + character_label(text.front()));
    const auto has_template = [this](const Chosen& each) {
      return report_.without_template.find(each.trace.character) == report_.without_template.npos;
    };
    const auto with_template = static_cast<std::size_t>(std::count_if(traces.begin(), traces.end(), has_template));
    const Interrupt interrupt;
    std::optional<OutputDirectory> out;
    if (!options_.out.directory.empty()) {
      out.emplace(options_.out.directory, replay_file, options_.out.force);
      out->explain({{"page", page_json(options_.page, layout_)},
                    {"mapping", mapping_json(*session_.mapping)},
                    {"device", device_json(session_.device)},
                    {"options", options_json(session_.renderer)}});
    }
    Progress progress;
    for (std::size_t i = 0; i < traces.size(); ++i) {
      if (interrupt.asked()) break;
      const std::vector<StoredCharacter> forms = accepted_forms(set, traces[i].trace.character);
      if (!forms.empty()) replay_one(traces[i], forms, index, out);
      progress.show(static_cast<double>(i + 1) / static_cast<double>(traces.size()));
    }
    if (report_.traces.empty()) interrupt.check();
    report_.interrupted = report_.traces.size() < with_template;
    if (out) out->keep(json(report_));
    if (out && !report_.interrupted) out->finish();
    fmt::print("{}", options_.json ? json_text(json(report_)) : table(report_, options_.language));
    if (report_.interrupted) {
      throw Error(fmt::format("interrupted after {} of {} traces", report_.traces.size(), with_template));
    }
  }

 private:
  /// Those of the order or source that was asked for, or all.
  std::vector<StoredCharacter> accepted_forms(const CharacterSet& set, char32_t code) const {
    std::vector<StoredCharacter> forms = set.forms(code);
    const std::string& name = options_.order;
    std::erase_if(forms, [&name](const StoredCharacter& form) {
      return form.order() != name && !form.provenance().source.starts_with(name);
    });
    return forms;
  }

  void recognise(const std::vector<Chosen>& traces, const CharacterIndex& index) {
    for (const Chosen& each : traces) {
      report_.recognised.push_back(
          {each.position, each.trace.character, index.recognise(pen_paths(each.trace), most_recognised)});
    }
  }

  void replay_one(const Chosen& chosen, const std::vector<StoredCharacter>& forms, const CharacterIndex& index,
                  std::optional<OutputDirectory>& out) {
    std::vector<Character> accepted;
    for (const StoredCharacter& form : forms) accepted.push_back(form.character());
    const std::vector<PenPath> paths = pen_paths(chosen.trace);
    Replayed result;
    result.match = match_strokes(accepted, paths, tolerances_of(options_.leniency), &index);
    const auto read_as = static_cast<std::size_t>(result.match.accepted);
    const Character& character = accepted[read_as];
    result.order = std::string(forms[read_as].order());
    result.source = forms[read_as].provenance().source;
    result.accepted = forms.size();
    const PracticePage page = lay_out({&character, 1}, layout_).front();
    const HapticRenderer renderer(page.characters, *session_.mapping, session_.device, session_.renderer);
    report_.max_force_step = renderer.max_force_step();

    const Recording recording = follow_trace(page, chosen.trace, session_);
    result.position = chosen.position;
    result.set = chosen.trace.set;
    std::vector<PenKinematics> motions;
    for (const PenStroke& stroke : chosen.trace.strokes) {
      if (!is_erasing(stroke)) motions.push_back(pen_kinematics(stroke));
    }
    result.motion = writing_motion(motions);
    result.guided = score_page(page, recording).front();
    result.guided.peak_force *= options_.page.scale;  // as the hand feels it
    result.guided.max_force_step *= options_.page.scale;
    result.faults =
        static_cast<int>(std::count_if(recording.samples.begin(), recording.samples.end(),
                                       [](const RecordedSample& sample) { return sample.status != TickStatus::ok; }));
    if (out) {
      const std::string title =
          fmt::format("{}, {}, {}", encode_utf8(character.code), chosen.trace.set, report_.device.model);
      const std::vector<PenPath> guided = pen_paths(recording, page.characters.front().placement);
      out->write(fmt::format("{:02}-{}.svg", chosen.position, name_in_file(character.code)),
                 replay_picture(character, paths, result.match, guided, title, options_.style, options_.language));
    }
    report_.traces.push_back(std::move(result));
  }

  const ReplayArguments& options_;
  SessionOptions session_;
  PageLayout layout_;
  ReplayReport report_;
};

/// Options that apply only to pen traces.
constexpr const char* of_traces[] = {"--characters", "--only",         "--order",    "--device",
                                     "--page",       "--motion-scale", "--renderer", "--recognise",
                                     "--y-axis"};

/// Replays a recording, those of a run, or pen traces.
void replay(const ReplayArguments& options, const CLI::App& command) {
  const std::filesystem::path path = options.traces;
  const bool is_run = std::filesystem::is_directory(path);
  if (!is_run && !is_recording(path)) {
    if (options.ticks) throw UsageError("--ticks: applies only to recordings");
    return ReplayRun(options).replay();
  }
  for (const char* const option : of_traces) {
    if (command.get_option(option)->count() > 0) {
      throw UsageError(fmt::format("{}: applies only to pen traces, and {} is of recordings", option, options.traces));
    }
  }
  if (options.ticks && options.out.directory.empty()) throw UsageError("--ticks: needs --out DIR");
  replay_recordings({is_run ? recordings_in(path) : std::vector{path}, options.out, tolerances_of(options.leniency),
                     options.style, options.language, options.ticks, options.json});
}

}  // namespace

void add_replay(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "replay",
      "Replay a recording, the recordings of a run of `write`, or pen traces of people. The forces of a recording are "
      "made again from what came in, and the page is scored. Pens in traces move the simulated device; the report is "
      "of the order and direction in which they wrote and of the forces of the guidance. With --out DIR, also writes "
      "pictures and replay.json.");
  command->footer(
      "calligraphy replay out         # of write --out out\n"
      "calligraphy replay pens.txt    # for its format see docs/pen-traces.md\n"
      "calligraphy replay pens.txt --only 永 --characters hanzi.set --out out\n"
      "# hanzi.set: see `calligraphy help import`");
  const auto options = std::make_shared<ReplayArguments>();
  command->add_option("WHAT", options->traces,
                      "A recording or pen traces, compressed by gzip or not, or the directory of a run")
      ->required()
      ->type_name("PATH");
  add_characters_option(*command, options->characters);
  add_out_directory(*command, options->out, "pictures and JSON");
  command->add_option("--only", options->only, "Replay only traces of these characters")->type_name("TEXT");
  command
      ->add_option("--order", options->order,
                   "Accept only this alternate stroke order, or this source (default: every order and form that the "
                   "sets have)")
      ->type_name("NAME");
  command
      ->add_option("--y-axis", options->y_axis,
                   "Where y of the traces points; auto: as most of them were written, or down if that does not show")
      ->check(CLI::IsMember({"auto", "up", "down"}))
      ->capture_default_str();
  command
      ->add_option("--leniency", options->leniency,
                   "How sure or grave a remark must be: strict tells what normal does and more, lenient less")
      ->check(CLI::IsMember({"strict", "normal", "lenient"}))
      ->capture_default_str();
  add_device_option(*command, options->device);
  add_page_options(*command, options->page);
  command->add_option("--renderer", options->renderer, "Default stages, or the optional stages enabled too")
      ->check(CLI::IsMember({"default", "everything"}))
      ->capture_default_str();
  command
      ->add_flag("--recognise", options->recognise,
                 "Also look up what was written: the characters of as many strokes that each trace resembles most")
      ->disable_flag_override();
  add_language_option(*command, options->language);
  add_lines_flag(*command, options->style);
  command
      ->add_flag("--ticks", options->ticks, "Of recordings, also write the ticks as comma-separated values into DIR")
      ->disable_flag_override();
  command->add_flag("--json", options->json, "Print JSON instead of the table")->disable_flag_override();
  command->callback([options, command] { replay(*options, *command); });
}

}  // namespace calligraphy::tools
