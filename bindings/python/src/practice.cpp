// Pages, writers, recordings, scores and imports.
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/practice/mean_interval.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/practice/stroke_matching.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// The columns of a recording, whose rows are RecordedSample as in memory.
py::dtype sample_type() {
  const RecordedSample s;
  return columns_of(s, "time", s.time, "device_point", s.device_point, "pen_tip", s.pen_tip, "force", s.force, "state",
                    s.state, "events", s.events, "status", s.status, "character", s.character, "stroke", s.stroke,
                    "tick_ns", s.tick_ns);
}

/// A recording from a structured array with these columns.
Recording recording_of(double rate, const ArrayLike& samples) {
  const py::array rows = py::module_::import("numpy").attr("asarray")(samples, sample_type());
  if (rows.ndim() != 1) throw ValueError("samples: expected shape (n,), got " + shape_of(rows));
  if (!(std::isfinite(rate) && rate > 0.0))
    throw ValueError("rate: expected a finite number above 0, got " + std::to_string(rate));
  Recording result{rate, std::vector<RecordedSample>(static_cast<std::size_t>(rows.size()))};
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    RecordedSample& sample = result.samples[i];
    std::memcpy(static_cast<void*>(&sample), rows.data(static_cast<py::ssize_t>(i)), sizeof sample);
    if (sample.state > InteractionState::writing || sample.status > TickStatus::device_fault) {
      throw ValueError(told("samples[{}]: state {}, status {}: no such state or status", i,
                            static_cast<int>(sample.state), static_cast<int>(sample.status)));
    }
  }
  return result;
}

py::array samples_of(const py::object& self) {
  const auto& samples = self.cast<const Recording&>().samples;
  py::array result(sample_type(), samples.size(), samples.data(), self);
  result.attr("flags").attr("writeable") = false;
  return result;
}

PenTrace trace_of(char32_t character, const std::vector<ArrayLike>& strokes, std::string set, double em) {
  PenTrace result{character, std::move(set), em, {}};
  for (const ArrayLike& stroke : strokes) {
    const Doubles rows = doubles(stroke, "strokes", 3);
    PenStroke& down = result.strokes.emplace_back();
    for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
      down.push_back({Point(rows.at(i, 0), rows.at(i, 1)), rows.at(i, 2)});
    }
  }
  return result;
}

MatchResult match_of(const Character& character, const std::vector<ArrayLike>& paths,
                     const StrokeTolerances& tolerances) {
  std::vector<PenPath> drawn;
  for (const ArrayLike& path : paths) drawn.push_back(points(path, "paths"));
  return released(+[](const Character& of, const std::vector<PenPath>& by, const StrokeTolerances& within) {
    return match_strokes(of, by, within);
  })(character, drawn, tolerances);
}

using Arrays = py::typing::List<Doubles>;

Arrays pen_downs(const PenTrace& trace) {
  Arrays result;
  for (const PenStroke& stroke : trace.strokes) {
    Doubles rows({static_cast<py::ssize_t>(stroke.size()), py::ssize_t{3}});
    double* to = rows.mutable_data();
    for (const TimedPoint& sample : stroke) *to++ = sample.point.x(), *to++ = sample.point.y(), *to++ = sample.time;
    result.append(rows);
  }
  return result;
}

py::dict as_dict(const ImportReport& report) {
  py::list within, worst, measures, skipped;
  for (const FitCount& count : report.within) {
    within.append(py::make_tuple(count.error, count.strokes, count.characters));
  }
  for (const StrokeError& e : report.worst) {
    worst.append(py::make_tuple(py::cast(e.place.code), e.place.order, e.place.stroke, e.id, e.error));
  }
  for (const StrokeMeasures& m : report.measures) {
    measures.append(py::make_tuple(py::cast(m.place.code), m.place.order, m.place.stroke, m.id, m.frechet, m.backward,
                                   m.length, m.source_length, m.half_width, m.false_corners, m.lost_corners,
                                   m.lost_inside));
  }
  for (const SkippedFile& file : report.skipped) skipped.append(py::make_tuple(file.path, file.reason));
  return py::dict("kind"_a = to_string(report.kind), "characters"_a = report.characters, "strokes"_a = report.strokes,
                  "labelled"_a = report.labelled, "agreed"_a = report.agreed, "allowed"_a = report.allowed,
                  "ids_used"_a = report.ids_used,
                  "letters_unused"_a = report.letters_unused, "notes"_a = report.notes,
                  "within"_a = table(within, dtype_of("error:f8 strokes:i4 characters:i4")),
                  "worst"_a = table(worst, dtype_of("code:U1 order:U32 stroke:i4 id:i4 error:f8")),
                  "measures"_a = table(measures, dtype_of("code:U1 order:U32 stroke:i4 id:i4 frechet:f8 backward:f8 "
                                                          "length:f8 source_length:f8 half_width:f8 false_corners:i4 "
                                                          "lost_corners:i4 lost_inside:f8")),
                  "ink"_a = as_numbers(report.ink.strokes),
                  "crossings"_a = py::make_tuple(report.crossings.source, report.crossings.kept),
                  "skipped"_a = skipped);
}

}  // namespace

void add_practice(py::module_& module) {
  module.attr("sample_dtype") = sample_type();
  py::class_<Recording>(module, "Recording", "Recording of a session, tick by tick. Immutable.")
      .def(py::init(&recording_of), "rate"_a, "samples"_a)
      .def_readonly("rate", &Recording::rate, "[Hz]")
      .def_property_readonly(
          "samples", &samples_of,
          "A structured array (n,), a read-only view of the recording (sample_dtype): time [s], device_point, pen_tip "
          "[m] and force [N] in page axes, state, events, status, character, stroke, tick_ns [ns].")
      .def("__len__", [](const Recording& self) { return self.samples.size(); })
      .attr("__match_args__") = py::make_tuple("rate", "samples");
  module.def("write_recording", released(+[](const std::filesystem::path& path, const Recording& recording) {
               std::ostringstream out;
               write_recording(out, recording);
               write_file(path, out.str());
             }),
             "path"_a, "recording"_a, "Writes a recording, atomically. Raises FileError.");
  module.def(
      "read_recording", released(+[](const std::filesystem::path& path) { return read_recording(path); }), "path"_a,
      "Reads exactly what write_recording wrote. Raises FileError, or FormatError naming the line and the value.");
  module.def("device_states", released(&device_states), "recording"_a, "mapping"_a,
             "The samples in device axes, for a ReplayDevice.");

  add_struct<PageLayout>(module, "PageLayout", "Characters in rows.", &PageLayout::width, "width [m]",
                         &PageLayout::height, "height [m]", &PageLayout::em, "em: edge of a character's square [m]",
                         &PageLayout::gap, "gap: between and around squares [m]");
  add_struct<PracticePage>(module, "PracticePage", "A page of placed characters.", &PracticePage::width, "width [m]",
                           &PracticePage::height, "height [m]", &PracticePage::characters,
                           "characters: list of PlacedCharacter, copied");
  module.def("workspace_layout", &workspace_layout, "device"_a, "mapping"_a = MotionMapping{},
             "The PageLayout that fills the workspace of a device (Capabilities) along the axes that the rotation of a "
             "MotionMapping uses, times its scale.");
  module.def(
      "lay_out",
      [](const std::vector<Character>& characters, const PageLayout& layout) { return lay_out(characters, layout); },
      "characters"_a, "layout"_a = PageLayout{},
      "As many pages as needed. Raises InvalidValue unless lengths are positive and a square fits.");

  py::class_<PenTrace>(module, "PenTrace", "A person's recorded pen while writing a character. Immutable.")
      .def(py::init(&trace_of), "character"_a, "strokes"_a, "set"_a = "unnamed", "em"_a = 1000.0)
      .def_readonly("character", &PenTrace::character, "the character to be written")
      .def_property_readonly("strokes", &pen_downs, "one array (n, 3) per pen-down, copied: x, y [em], time [s]")
      .def_readonly("set", &PenTrace::set, "one word for the source: a writer, a session, a corpus")
      .def_readonly("em", &PenTrace::em, "edge length of the square in the file's units [1]")
      .attr("__match_args__") = py::make_tuple("character", "strokes", "set", "em");
  module.def("read_pen_traces",
             released(+[](const std::filesystem::path& path) { return read_pen_traces(path.string()); }), "path"_a,
             "Reads the format of docs/pen-traces.md. Raises FileError, or FormatError naming the line and the value.");
  module.def(
      "write_pen_traces",
      released(+[](const std::filesystem::path& path, const std::vector<PenTrace>& traces, const std::string& notice) {
        std::ostringstream out;
        write_pen_traces(out, traces, notice);
        write_file(path, out.str());
      }),
      "path"_a, "traces"_a, "notice"_a = "",
      "Writes the format of docs/pen-traces.md; each line of `notice` becomes a comment. Raises FileError, and "
      "InvalidValue naming a trace that cannot be written.");

  using W = WriterSkill;
  add_struct<W>(
      module, "WriterSkill", "Skill of a simulated writer (docs/practice.md).", &W::grip,
      "grip: GripImpedance: impedance between the plan and the device", &W::offset,
      "offset: spread of the believed position [em]", &W::bias, "bias: an additional offset in a random direction [em]",
      &W::scale, "scale: spread of the believed scale [1]", &W::tilt, "tilt: spread of the believed tilt [rad]",
      &W::shape, "shape: spread of the believed place of each stroke [em]", &W::drift,
      "drift: random walk off the plan [em/s^0.5]", &W::tremor, "tremor: amplitude, at 8 to 12 Hz [m]", &W::aim,
      "aim: spread of where a stroke is begun [em]", &W::wrong_order,
      "wrong_order: share of strokes replaced by another one [1]", &W::wrong_direction,
      "wrong_direction: share of strokes begun at their end [1]", &W::speed, "speed: mean speed along a stroke [em/s]",
      &W::pause, "pause: before the pen moves to a stroke [s]", &W::visual_delay, "visual_delay [s]", &W::correction,
      "correction: share of the perceived error corrected per second [1/s]", &W::caution,
      "caution: perceived error at which the speed is halved [em]")
      .def_static("novice", &W::novice, "The novice of the experiments.")
      .def_static("skilled", &W::skilled, "The skilled writer of the experiments.");

  add_enum(module, "FeedbackMode", "The two modes of the paper's experiment.", FeedbackMode::force, "vision force");
  add_struct<SessionOptions>(
      module, "SessionOptions", "Options of a writer, a device and a renderer in closed loop.", &SessionOptions::mode,
      "mode: FeedbackMode", &SessionOptions::device, "device: Capabilities", &SessionOptions::renderer,
      "renderer: RendererOptions", &SessionOptions::mapping, "mapping: MotionMapping; None: upright_page() of the page",
      &SessionOptions::skill, "skill: WriterSkill", &SessionOptions::seed,
      "seed: of the writer's beliefs and mistakes; each character draws its own", &SessionOptions::measure_ticks,
      "measure_ticks: measure execution times", &SessionOptions::character_timeout,
      "character_timeout: virtual time until a character is aborted [s]");
  const auto with = [](SessionOptions options, const Progress& progress) {
    options.progress = interruptible(progress);
    return options;
  };
  module.def(
      "write_page",
      [with](const PracticePage& page, const SessionOptions& options, const Progress& progress) {
        return released(&write_page)(page, with(options, progress));
      },
      "page"_a, "options"_a, "progress"_a = py::none(),
      "Writes the page once, in virtual time. Deterministic per seed. progress(share) is called from time to time. "
      "Raises InvalidValue when an option is out of range.");
  module.def(
      "follow_trace",
      [with](const PracticePage& page, const PenTrace& trace, const SessionOptions& options, const Progress& progress) {
        return released(&follow_trace)(page, trace, with(options, progress));
      },
      "page"_a, "trace"_a, "options"_a, "progress"_a = py::none(),
      "A session in which the hand follows a recorded pen, on a page of one character. See write_page for progress.");
  module.def(
      "replay_page",
      [with](const PracticePage& page, ReplayDevice& device, const SessionOptions& options, const Progress& progress) {
        const AtWork at_work({AtWork::User::call}, &device);
        return released(+[](const PracticePage& on, ReplayDevice* const& of, const SessionOptions& chosen) {
          return replay_page(on, *of, chosen);
        })(page, &device, with(options, progress));
      },
      "page"_a, "device"_a, "options"_a, "progress"_a = py::none(),
      "Runs the renderer on recorded samples. See write_page for progress.");
  module.def(
      "run_session",
      [with](const PracticePage& page, const SessionOptions& options, const PenMotion& motion,
             const Progress& progress) { return released(&run_session)(page, with(options, progress), motion); },
      "page"_a, "options"_a, "motion"_a, "progress"_a = py::none(),
      "Runs the closed loop with your own motion: motion(tick, seconds) returns an Intention on the page, or None to "
      "end. Takes about 3 us per tick. See write_page for progress.");

  add_enum(module, "WritingMistakeKind", "Kind of mistake.", WritingMistakeKind::direction, "order direction");
  add_struct<WritingMistake>(module, "WritingMistake", "A mistake of the writer.", &WritingMistake::kind,
                             "kind: WritingMistakeKind", &WritingMistake::stroke, "stroke: the expected stroke, from 0",
                             &WritingMistake::time, "time: of the pen-down [s]", &WritingMistake::reason,
                             "reason: one line for people");
  using S = CharacterScore;
  add_struct<S>(module, "CharacterScore", "Score of a written character.", &S::character,
                "character: a str of length 1", &S::time, "time [s]", &S::rms_error,
                "rms_error: lateral, over the completed strokes [m]", &S::max_error, "max_error: lateral [m]",
                &S::stroke_count, "stroke_count: strokes of the character", &S::strokes_completed,
                "strokes_completed: by the writer", &S::peak_force, "peak_force [N]", &S::max_force_step,
                "max_force_step: per tick [N]", &S::mistakes, "mistakes: list of WritingMistake, copied", &S::contour,
                "contour: exp(-rms error / 5 % of the em), [0, 1]", &S::external_sequence,
                "external_sequence: completed / (completed + order mistakes)", &S::internal_sequence,
                "internal_sequence: completed / (completed + direction mistakes)", &S::fidelity,
                "fidelity: geometric mean of the three")
      .def("order_mistakes", &S::order_mistakes, "Number of order mistakes.")
      .def("direction_mistakes", &S::direction_mistakes, "Number of direction mistakes.");
  module.def("score_page", released(&score_page), "page"_a, "recording"_a, "One score per character of the page.");

  add_enum(module, "WritingDirection", "Direction of a pen-down along what it wrote.", WritingDirection::unknown,
           "forwards backwards neither unknown");
  add_enum(module, "StrokeRemarkKind", "What there is to remark on a stroke.", StrokeRemarkKind::extra,
           "order direction shape joined broken missing extra");
  using D = DrawnStroke;
  add_struct<D>(module, "DrawnStroke", "What a pen-down wrote.", &D::stroke, "stroke: from 0; -1: none",
                &D::stroke_count, "stroke_count: strokes that it wrote; above 1: joined", &D::continues,
                "continues: it continues the stroke that the previous pen-down began", &D::in_turn,
                "in_turn: written in order", &D::tap, "tap: shorter than 2 % of the em", &D::direction,
                "direction: WritingDirection", &D::distance, "distance: mean, once both are aligned [em]");
  add_struct<StrokeRemark>(module, "StrokeRemark", "A remark on a stroke.", &StrokeRemark::kind,
                           "kind: StrokeRemarkKind", &StrokeRemark::path, "path: the pen-down, from 0; -1: none",
                           &StrokeRemark::stroke, "stroke: from 0; -1: none", &StrokeRemark::reason,
                           "reason: one sentence for people");
  py::class_<MatchResult>(module, "MatchResult", "Result of match_strokes.")
      .def_readonly("drawn", &MatchResult::drawn, "list of DrawnStroke, one per pen-down, copied")
      .def_readonly("remarks", &MatchResult::remarks, "list of StrokeRemark, copied")
      .def("count", &MatchResult::count, "kind"_a, "Number of remarks of a kind.");
  module.def("match_strokes", &match_of, "character"_a, "paths"_a, "tolerances"_a = StrokeTolerances(),
             "Which stroke each pen-down (n, 2) [em] wrote, in which order and direction, from geometry alone. Of the "
             "tolerances `direction` and `distinction` apply. Raises InvalidValue.");

  add_struct<MeanInterval>(module, "MeanInterval", "A mean with its 95 % confidence interval.", &MeanInterval::mean,
                           "mean: of the values; NaN if there are none", &MeanInterval::half_width,
                           "half_width: of the interval; NaN with fewer than two draws", &MeanInterval::values,
                           "values: number of values", &MeanInterval::draws, "draws: number of independent draws");
  module.def(
      "mean_interval",
      [](const ArrayLike& values, const std::vector<std::uint64_t>& draws) {
        const Doubles numbers = doubles(values, "values");
        if (static_cast<std::size_t>(numbers.size()) != draws.size()) {
          throw ValueError(told("draws: expected one for each of {} values, got {}", numbers.size(), draws.size()));
        }
        std::vector<DrawnValue> drawn(draws.size());
        for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] = {numbers.data()[i], draws[i]};
        return mean_interval(drawn);
      },
      "values"_a, "draws"_a,
      "The MeanInterval of values (n,), clustered by the independent draw that each belongs to, an integer (n,): "
      "Student's t with one degree of freedom less than there are draws.");

  add_enum(module, "InkDetail", "How closely imported ink follows the outlines of its source.", InkDetail::full,
           "none half_widths full");
  module.def(
      "import_characters",
      [](const std::filesystem::path& source, const std::optional<std::filesystem::path>& letters,
         const std::u32string& only, bool alternates, bool ideographs_only, const std::string& date, int threads,
         bool report, const Progress& progress, InkDetail ink) {
        // Optional, because an empty C++ path would become "." in Python.
        const ImportOptions options = {letters.value_or(""), alternates, ideographs_only, ink, only, date, threads,
                                       report,               {},         interruptible(progress)};
        ImportResult imported = released(&import_characters)(source, options);
        return py::typing::Tuple<CharacterList, py::dict>(
            py::make_tuple(std::move(imported.list), as_dict(imported.report)));
      },
      "source"_a, "letters"_a = py::none(), "only"_a = std::u32string(), "alternates"_a = false,
      "ideographs_only"_a = true, "date"_a = "", "threads"_a = 0, "report"_a = false, "progress"_a = py::none(),
      "ink"_a = InkDetail::full,
      "Imports hanzi-writer-data or KanjiVG (a directory or a tarball), a set file or the text format. Returns a "
      "CharacterList and a report (docs/import.md): kind, characters, strokes, labelled, agreed, allowed, ids_used "
      "by id, letters_unused, notes; within: strokes and characters within an error [em]; worst: code, order, stroke "
      "(from 1), id, error [em]; skipped files with reasons. With `report`, every stroke is measured against its "
      "source (docs/strokes.md): measures, a row for each, lengths in em; crossings: in the source, kept; ink: of each "
      "stroke, intersection over union with its outline. `ink` is kept of hanzi-writer-data. Raises "
      "FileError, FormatError, InvalidValue.");
}

}  // namespace calligraphy::python
