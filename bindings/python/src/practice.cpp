// The practice room: pages, writers, recordings, scores, pictures.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>

#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/pictures/picture.hpp>
#include <calligraphy/pictures/plot.hpp>
#include <calligraphy/pictures/replay_picture.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

#include "at_work.hpp"
#include "enumeration.hpp"
#include "interrupt.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;
using Progress = std::function<void(double)>;

/// The columns of a recording; the rows are Sample as it is in memory.
py::dtype sample_type() {
  const Sample s;
  return Columns<Sample>()
      .add("time", s, s.time)
      .add("device_point", s, s.device_point)
      .add("pen_tip", s, s.pen_tip)
      .add("force", s, s.force)
      .add("state", s, s.state)
      .add("events", s, s.events)
      .add("status", s, s.status)
      .add("character", s, s.character)
      .add("stroke", s, s.stroke)
      .add("tick_ns", s, s.tick_ns)
      .dtype();
}

/// A recording of the rows of a structured array with these columns.
Recording recording_of(double rate, const py::object& samples) {
  const py::array rows = py::module_::import("numpy").attr("asarray")(samples, sample_type());
  if (rows.ndim() != 1) {
    throw ValueError("samples: shape (n,) is expected, not " + py::str(rows.attr("shape")).cast<std::string>());
  }
  if (!(std::isfinite(rate) && rate > 0.0)) {
    throw ValueError("rate: a finite number above 0 is expected, not " + std::to_string(rate));
  }
  Recording result;
  result.rate = rate;
  result.samples.resize(static_cast<std::size_t>(rows.size()));
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    Sample& sample = result.samples[i];
    std::memcpy(static_cast<void*>(&sample), rows.data(static_cast<py::ssize_t>(i)), sizeof sample);
    if (sample.state > InteractionState::writing || sample.status > TickStatus::device_fault) {
      throw ValueError("samples[" + std::to_string(i) + "]: state " + std::to_string(static_cast<int>(sample.state)) +
                       ", status " + std::to_string(static_cast<int>(sample.status)) + ": no such state or status");
    }
  }
  return result;
}

py::array samples_of(const py::object& self) {
  const auto& samples = self.cast<const Recording&>().samples;
  py::array result(sample_type(), {static_cast<py::ssize_t>(samples.size())},
                   {static_cast<py::ssize_t>(sizeof(Sample))}, samples.data(), self);
  result.attr("flags").attr("writeable") = false;
  return result;
}

void add_recordings(py::module_& module) {
  module.attr("sample_dtype") = sample_type();
  py::class_<Recording>(module, "Recording",
                        "What happened while a page was written, tick by tick. It does not change.")
      .def(py::init(&recording_of), py::arg("rate"), py::arg("samples"))
      .def_readonly("rate", &Recording::rate, "[Hz]")
      .def_property_readonly(
          "samples", &samples_of,
          "A structured array (n,) over the recording's own memory, read only (sample_dtype): time [s],\n"
          "device_point, pen_tip [m] and force [N] in page axes, state, events, status, character,\n"
          "stroke, tick_ns [ns].")
      .def("__len__", [](const Recording& self) { return self.samples.size(); })
      .def("__repr__",
           [](const Recording& self) {
             const std::size_t count = self.samples.size();
             return told("Recording({} samples at {:g} Hz, {:.6g} s)", count, self.rate,
                         static_cast<double>(count) / self.rate);
           })
      .def(
          "to_csv",
          [](const Recording& self) {
            std::ostringstream out;
            write_csv(out, self);
            return out.str();
          },
          Release(), "As text; read_csv_text gives the same back.")
      .def(py::pickle(
          [](const py::object& self) { return py::make_tuple(self.attr("rate"), samples_of(self).attr("copy")()); },
          [](const py::tuple& state) { return recording_of(state[0].cast<double>(), state[1]); }));
  module.def(
      "write_csv",
      [](const std::filesystem::path& path, const Recording& recording) {
        std::ostringstream out;
        write_csv(out, recording);
        write_file(path, out.str());
      },
      py::arg("path"), py::arg("recording"), Release(), "Writes a whole file or none.");
  module.def(
      "read_csv", [](const std::filesystem::path& path) { return read_csv(path); }, py::arg("path"), Release(),
      "What write_csv wrote, exactly.");
  module.def(
      "read_csv_text",
      [](const std::string& text) {
        std::istringstream in(text);
        return read_csv(in, "text");
      },
      py::arg("text"), Release(), "What Recording.to_csv gave.");
  module.def("device_states", &device_states, py::arg("recording"), py::arg("mapping"),
             "The samples in device axes, for a ReplayDevice.");
}

void add_pages(py::module_& module) {
  Record<PageLayout>(module, "PageLayout", "Characters in rows.")
      .field("width", &PageLayout::width, "[m]")
      .field("height", &PageLayout::height, "[m]")
      .field("em", &PageLayout::em, "edge of a character's square [m]")
      .field("gap", &PageLayout::gap, "between squares, and round them [m]");
  Record<Page>(module, "Page", "Characters at their places.")
      .field("width", &Page::width, "[m]")
      .field("height", &Page::height, "[m]")
      .field("characters", &Page::characters, "list of PlacedCharacter, copied");
  module.def(
      "lay_out",
      [](const std::vector<Character>& characters, const PageLayout& layout) { return lay_out(characters, layout); },
      py::arg("characters"), py::arg("layout") = PageLayout{}, "As many pages as it takes.");
}

void add_traces(py::module_& module) {
  py::class_<PenTrace>(module, "PenTrace", "What a person's pen did while it wrote a character.")
      .def(py::init([](char32_t character, const std::vector<ArrayLike>& strokes, std::string set, double em) {
             PenTrace result{character, std::move(set), em, {}};
             for (const ArrayLike& stroke : strokes) {
               const Doubles rows = doubles(stroke, "strokes", 3);
               PenStroke& down = result.strokes.emplace_back();
               for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
                 down.push_back({Point(rows.at(i, 0), rows.at(i, 1)), rows.at(i, 2)});
               }
             }
             return result;
           }),
           py::arg("character"), py::arg("strokes"), py::arg("set") = "unnamed", py::arg("em") = 1000.0)
      .def_readonly("character", &PenTrace::character, "what was to be written")
      .def_readonly("set", &PenTrace::set, "where it comes from, a word: write_pen_traces() takes no other")
      .def_readonly("em", &PenTrace::em, "edge of the square in the file's units")
      .def_property_readonly(
          "strokes",
          [](const PenTrace& self) {
            py::list result;
            for (const PenStroke& stroke : self.strokes) {
              py::array_t<double> rows({static_cast<py::ssize_t>(stroke.size()), py::ssize_t{3}});
              double* to = rows.mutable_data();
              for (const TimedPoint& sample : stroke) {
                *to++ = sample.point.x(), *to++ = sample.point.y(), *to++ = sample.time;
              }
              result.append(rows);
            }
            return result;
          },
          "one array (n, 3) per pen-down, copied: x, y [em], time [s]")
      .def("__repr__",
           [](const PenTrace& self) {
             return told("PenTrace({}, {} strokes, {!r})", encode_utf8(self.character), self.strokes.size(), self.set);
           })
      .def("__reduce__", [](const py::object& self) {
        return py::make_tuple(py::type::of(self), py::make_tuple(self.attr("character"), self.attr("strokes"),
                                                                 self.attr("set"), self.attr("em")));
      });
  module.def(
      "read_pen_traces", [](const std::filesystem::path& path) { return read_pen_traces(path.string()); },
      py::arg("path"), Release(), "Reads the format of docs/pen-traces.md.");
  module.def(
      "write_pen_traces",
      [](const std::filesystem::path& path, const std::vector<PenTrace>& traces, const std::string& notice) {
        std::ostringstream out;
        write_pen_traces(out, traces, notice);
        write_file(path, out.str());
      },
      py::arg("path"), py::arg("traces"), py::arg("notice") = "", Release(),
      "Writes the format of docs/pen-traces.md; each line of `notice` becomes a comment.");
}

void add_writers(py::module_& module) {
  Record<WriterSkill> skill(module, "WriterSkill", "How well a person writes; docs/practice.md.");
  using W = WriterSkill;
  skill.field("hand", &W::hand, "Hand: impedance between the plan and the device")
      .field("offset", &W::offset, "of the believed character [em]")
      .field("bias", &W::bias, "length of one more offset, in a direction drawn for each character [em]")
      .field("scale", &W::scale, "of the believed character [1]")
      .field("tilt", &W::tilt, "[rad]")
      .field("shape", &W::shape, "of each stroke's believed place [em]")
      .field("drift", &W::drift, "[em/s^0.5]")
      .field("tremor", &W::tremor, "8 to 12 Hz [m]")
      .field("aim", &W::aim, "of where a stroke is begun [em]")
      .field("wrong_order", &W::wrong_order, "share of strokes begun with another one")
      .field("wrong_direction", &W::wrong_direction, "share of strokes begun at their end")
      .field("speed", &W::speed, "mean speed along a stroke [em/s]")
      .field("pause", &W::pause, "before the pen moves to a stroke [s]")
      .field("sight_delay", &W::sight_delay, "[s]")
      .field("correction", &W::correction, "share of the error seen that is corrected per second [1/s]")
      .field("caution", &W::caution, "error seen at which the pace is halved [em]");
  skill.type().def_static("novice", &W::novice).def_static("skilled", &W::skilled);
  Record<Sight>(module, "Sight", "What the display shows: nothing of forces, nothing of the mode.")
      .field("pen_tip", &Sight::pen_tip, "(3,), page [m]")
      .field("character", &Sight::character, "the yellow one, by index")
      .field("stroke", &Sight::stroke, "the one whose start has the red ellipse")
      .field("writing", &Sight::writing, "a green trace grows from the pen");
  py::class_<SimulatedWriter>(module, "SimulatedWriter", "Moves a hand through the strokes of a page. Deterministic.")
      .def(py::init<const Page&, const WriterSkill&, std::uint64_t>(), py::arg("page"), py::arg("skill"),
           py::arg("seed"))
      .def("update", &SimulatedWriter::update, py::arg("sight"), py::arg("seconds"),
           "Sees the display, lets time pass and says how the pen is meant to move, on the page.")
      .def_property_readonly("done", &SimulatedWriter::done)
      .def_property_readonly("gave_up", &SimulatedWriter::gave_up);
}

void add_sessions(py::module_& module) {
  Enumeration<Mode>(module, "Mode", "The two modes of the paper's experiment.")
      .value("vision", Mode::vision, "the device is told zero")
      .value("force", Mode::force, "vision and force");
  Record<SessionOptions>(module, "SessionOptions", "A writer, a device and a renderer in closed loop.")
      .field("mode", &SessionOptions::mode, "Mode")
      .field("device", &SessionOptions::device, "Capabilities")
      .field("renderer", &SessionOptions::renderer, "RendererOptions")
      .field("skill", &SessionOptions::skill, "WriterSkill")
      .field("seed", &SessionOptions::seed, "of the writer")
      .field("measure_ticks", &SessionOptions::measure_ticks, "reads the clock round every tick")
      .field("longest_character", &SessionOptions::longest_character, "after which a character is given up [s]");
  module.def(
      "write_page",
      [](const Page& page, SessionOptions options, Progress progress) {
        options.progress = interruptible(std::move(progress));
        return write_page(page, options);
      },
      py::arg("page"), py::arg("options"), py::arg("progress") = py::none(), Release(),
      "Writes the page once, in virtual time. Deterministic per seed. progress(share) is called now and then.");
  module.def(
      "follow_trace",
      [](const Page& page, const PenTrace& trace, SessionOptions options, Progress progress) {
        options.progress = interruptible(std::move(progress));
        return follow_trace(page, trace, options);
      },
      py::arg("page"), py::arg("trace"), py::arg("options"), py::arg("progress") = py::none(), Release(),
      "A hand that moves as a person's pen did, on a page of one character. progress(share) is called now and then.");
  module.def(
      "replay_page",
      [](const Page& page, ReplayDevice& device, SessionOptions options, Progress progress) {
        const AtWork at_work(device);
        const py::gil_scoped_release release;
        options.progress = interruptible(std::move(progress));
        return replay_page(page, device, options);
      },
      py::arg("page"), py::arg("device"), py::arg("options"), py::arg("progress") = py::none(),
      "The renderer on recorded samples: what it would have done. progress(share) is called now and then.");
  module.def(
      "run_session",
      [](const Page& page, SessionOptions options, const PenMotion& motion, Progress progress) {
        options.progress = interruptible(std::move(progress));
        return run_session(page, options, motion);
      },
      py::arg("page"), py::arg("options"), py::arg("motion"), py::arg("progress") = py::none(), Release(),
      "The closed loop with a motion of one's own: motion(tick, seconds) gives an Intention on the page, or None to\n"
      "end. Costs about 3 us per tick. progress(share) is called now and then.");
}

void add_scores(py::module_& module) {
  Enumeration<MistakeKind>(module, "MistakeKind")
      .value("order", MistakeKind::order)
      .value("direction", MistakeKind::direction);
  Record<Mistake>(module, "Mistake", "A mistake of the writer.")
      .field("kind", &Mistake::kind, "MistakeKind")
      .field("stroke", &Mistake::stroke, "that was due, from 0")
      .field("time", &Mistake::time, "when the pen was put down [s]")
      .field("reason", &Mistake::reason, "one line for a person");
  using S = CharacterScore;
  Record<S>(module, "CharacterScore", "How well a character was written.")
      .field("character", &S::character, "a str of length 1")
      .field("time", &S::time, "[s]")
      .field("rms_error", &S::rms_error, "lateral, over the strokes completed [m]")
      .field("max_error", &S::max_error, "lateral [m]")
      .field("stroke_count", &S::stroke_count, "of the character")
      .field("strokes_completed", &S::strokes_completed, "by the writer")
      .field("peak_force", &S::peak_force, "[N]")
      .field("max_force_step", &S::max_force_step, "from one tick to the next [N]")
      .field("mistakes", &S::mistakes, "list of Mistake, copied")
      .field("contour", &S::contour, "exp(-rms error / 5 % of the em), [0, 1]")
      .field("external_sequence", &S::external_sequence, "share of pen-downs that wrote the stroke due")
      .field("internal_sequence", &S::internal_sequence, "share of strokes not written backwards")
      .field("fidelity", &S::fidelity, "geometric mean of the three")
      .type()
      .def("order_mistakes", &S::order_mistakes)
      .def("direction_mistakes", &S::direction_mistakes);
  module.def("score", &score, py::arg("page"), py::arg("recording"), Release(), "One score per character of the page.");
}

void add_pictures(py::module_& module) {
  module.def("page_picture", &page_picture, py::arg("page"), py::arg("recording"), py::arg("active"), py::arg("title"),
             Release(), "SVG text: templates blue, the active character yellow, traces green.");
  module.def("typical_strokes_picture", &typical_strokes_picture, Release(), "SVG text.");
  module.def("can_plot", &can_plot, Release(), "Whether the program gnuplot can be started.");
  module.def("force_plot", &force_plot, py::arg("recording"), py::arg("character"), py::arg("title"), Release(),
             "SVG text by gnuplot: the forces while the character of this index was active.");
}

std::vector<PenPath> paths_of(const std::vector<ArrayLike>& paths, const char* name) {
  std::vector<PenPath> result;
  for (const ArrayLike& path : paths) result.push_back(points(path, name));
  return result;
}

py::list arrays_of(const std::vector<PenPath>& paths) {
  py::list result;
  for (const PenPath& path : paths) result.append(array_of_points(path));
  return result;
}

void add_verdicts(py::module_& module) {
  module.def(
      "pen_paths", [](const PenTrace& trace) { return arrays_of(pen_paths(trace)); }, py::arg("trace"),
      "(n, 2) of every pen-down, in the square that was written in [em].");
  module.def(
      "pen_paths",
      [](const Recording& recording, const Placement& placement) { return arrays_of(pen_paths(recording, placement)); },
      py::arg("recording"), py::arg("placement"),
      "(n, 2) of every pen-down, whatever the renderer made of it, in the square of a character [em].");
  Enumeration<Course>(module, "Course", "How a pen-down runs along what it wrote.")
      .value("forwards", Course::forwards)
      .value("backwards", Course::backwards)
      .value("neither", Course::neither)
      .value("unknown", Course::unknown);
  Enumeration<RemarkKind>(module, "RemarkKind", "What there is to say of a pen-down.")
      .value("order", RemarkKind::order)
      .value("direction", RemarkKind::direction)
      .value("shape", RemarkKind::shape)
      .value("joined", RemarkKind::joined)
      .value("broken", RemarkKind::broken)
      .value("missing", RemarkKind::missing)
      .value("extra", RemarkKind::extra);
  Record<DrawnStroke>(module, "DrawnStroke", "One pen-down.")
      .field("stroke", &DrawnStroke::stroke, "that it wrote, or the first of those, from 0; -1: none")
      .field("stroke_count", &DrawnStroke::stroke_count, "1; above: joined; 0: none")
      .field("continues", &DrawnStroke::continues, "it goes on with the stroke that the pen-down before began")
      .field("in_turn", &DrawnStroke::in_turn, "no stroke that comes later was written before")
      .field("tap", &DrawnStroke::tap, "it left no more than a point")
      .field("course", &DrawnStroke::course, "Course")
      .field("distance", &DrawnStroke::distance, "mean, from what it wrote [em]");
  Record<Remark>(module, "Remark", "What there is to say of a pen-down or a stroke.")
      .field("kind", &Remark::kind, "RemarkKind")
      .field("path", &Remark::path, "the pen-down, from 0; -1: none")
      .field("stroke", &Remark::stroke, "of the character, from 0; -1: none")
      .field("reason", &Remark::reason, "one sentence for a person");
  Record<BoxMap>(module, "BoxMap", "A map of the em square that moves and stretches: scale * point + offset.")
      .field("scale", &BoxMap::scale, "(2,)")
      .field("offset", &BoxMap::offset, "(2,) [em]");
  Record<StrokeVerdict>(module, "StrokeVerdict", "Which stroke each pen-down wrote, in which order and direction.")
      .field("drawn", &StrokeVerdict::drawn, "list of DrawnStroke, one per pen-down, copied")
      .field("remarks", &StrokeVerdict::remarks, "list of Remark, copied")
      .field("fit", &StrokeVerdict::fit, "BoxMap that laid the pen-downs on the character")
      .type()
      .def("count", &StrokeVerdict::count, py::arg("kind"));
  module.def(
      "judge_strokes",
      [](const Character& character, const std::vector<ArrayLike>& paths) {
        const std::vector<PenPath> drawn = paths_of(paths, "paths");
        const py::gil_scoped_release release;
        return judge_strokes(character, drawn);
      },
      py::arg("character"), py::arg("paths"), "Matches pen-downs (n, 2) [em] with strokes, from geometry alone.");
  module.def(
      "replay_picture",
      [](const Character& character, const std::vector<ArrayLike>& paths, const StrokeVerdict& verdict,
         const std::vector<ArrayLike>& guided, const std::string& title) {
        const std::vector<PenPath> drawn = paths_of(paths, "paths"), led = paths_of(guided, "guided");
        const py::gil_scoped_release release;
        return replay_picture(character, drawn, verdict, led, title);
      },
      py::arg("character"), py::arg("paths"), py::arg("verdict"), py::arg("guided"), py::arg("title"),
      "SVG text: a person's pen-downs beside the template, and where the pen of the device went; (n, 2) each [em].");
}

void add_import(py::module_& module) {
  Enumeration<SourceKind>(module, "SourceKind", "What characters were imported from.")
      .value("hanzi_writer_data", SourceKind::hanzi_writer_data)
      .value("kanjivg", SourceKind::kanjivg)
      .value("calligraphy", SourceKind::calligraphy);
  Enumeration<LabelFate>(module, "LabelFate", "What became of a label that does not say what the shape says.")
      .value("unknown", LabelFate::unknown)
      .value("obeyed", LabelFate::obeyed)
      .value("overruled", LabelFate::overruled);
  Record<StrokePlace>(module, "StrokePlace", "A stroke of the characters imported.")
      .field("code", &StrokePlace::code, "a str of length 1")
      .field("order", &StrokePlace::order, "empty for the standard one")
      .field("stroke", &StrokePlace::stroke, "from 1");
  Record<FitCount>(module, "FitCount", "What is within an error of what was drawn.")
      .field("error", &FitCount::error, "[em]")
      .field("strokes", &FitCount::strokes, "how many")
      .field("characters", &FitCount::characters, "with every stroke");
  Record<StrokeError>(module, "StrokeError", "How far a stroke is from its drawing.")
      .field("place", &StrokeError::place, "StrokePlace")
      .field("id", &StrokeError::id, "of the typical stroke")
      .field("error", &StrokeError::error, "largest distance, both ways [em]");
  Record<LabelDoubt>(module, "LabelDoubt", "A label that does not say what the shape says.")
      .field("place", &LabelDoubt::place, "StrokePlace")
      .field("label", &LabelDoubt::label, "as it stands in the source")
      .field("fate", &LabelDoubt::fate, "LabelFate")
      .field("recognised", &LabelDoubt::recognised, "id by geometry alone")
      .field("id", &LabelDoubt::id, "as imported");
  Record<Confusion>(module, "Confusion", "How often a label goes with an id that is none of the label's.")
      .field("label", &Confusion::label, "as it stands in the source")
      .field("recognised", &Confusion::recognised, "id by geometry alone")
      .field("count", &Confusion::count, "how often")
      .field("example", &Confusion::example, "StrokePlace");
  Record<SkippedFile>(module, "SkippedFile", "A file that was not read.")
      .field("path", &SkippedFile::path, "within the source")
      .field("reason", &SkippedFile::reason, "why");
  using R = ImportReport;
  Record<R>(module, "ImportReport", "How an import went.")
      .field("kind", &R::kind, "SourceKind")
      .field("characters", &R::characters, "alternate orders counted for themselves")
      .field("strokes", &R::strokes, "of all")
      .field("within", &R::within, "FitCount each: within 0.005, 0.01, 0.02 em of the pen's path in the drawing")
      .field("within_median", &R::within_median, "the same with the corners that a brush's median cuts")
      .field("worst", &R::worst, "list of StrokeError, at most ten, copied")
      .field("ids_used", &R::ids_used, "strokes by id, copied")
      .field("labelled", &R::labelled, "strokes with a label or letter that is known")
      .field("agreed", &R::agreed, "of these, recognised by geometry alone as what the label says")
      .field("confusions", &R::confusions, "list of Confusion, the commonest first, copied")
      .field("label_doubts", &R::label_doubts, "list of LabelDoubt, copied")
      .field("letters_unused", &R::letters_unused, "characters with more or fewer letters than strokes, copied")
      .field("skipped", &R::skipped, "list of SkippedFile, copied")
      .field("notes", &R::notes, "what else whoever passes the characters on should know, copied");
  py::class_<Import>(module, "Import", "Characters and how their import went.")
      .def_readonly("list", &Import::list, "CharacterList")
      .def_readonly("report", &Import::report, "ImportReport")
      .def("__repr__", [](const Import& self) {
        return told("Import({} characters, {} files skipped)", self.list.characters.size(), self.report.skipped.size());
      });
  module.def(
      "import_characters",
      [](const std::filesystem::path& source, const std::optional<std::filesystem::path>& letters,
         const std::u32string& only, bool alternates, bool ideographs_only, const std::string& date, int threads,
         Progress progress) {
        ImportOptions options;
        if (letters) options.letters = *letters;  // an empty path of C++ is "." in Python, and back
        options.only = only;
        options.alternates = alternates;
        options.ideographs_only = ideographs_only;
        options.date = date;
        options.threads = threads;
        options.progress = interruptible(std::move(progress));
        return import_characters(source, options);
      },
      py::arg("source"), py::arg("letters") = py::none(), py::arg("only") = std::u32string(),
      py::arg("alternates") = false, py::arg("ideographs_only") = true, py::arg("date") = "", py::arg("threads") = 0,
      py::arg("progress") = py::none(), Release(),
      "hanzi-writer-data or KanjiVG (a directory or a tarball), a set file or the text format: an Import, with the\n"
      "characters in `list`. progress(share) is called now and then.");
}

}  // namespace

void add_practice(py::module_& module) {
  add_recordings(module);
  add_pages(module);
  add_traces(module);
  add_writers(module);
  add_sessions(module);
  add_scores(module);
  add_pictures(module);
  add_verdicts(module);
  add_import(module);
}

}  // namespace calligraphy::python
