// Lessons: with any device, and with a pointer.
#include <optional>

#include <calligraphy/practice/pointer_lesson.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// The half of a lesson that looks on, for AtWork; the lesson itself stands for the loop's half. A law in Python lets
/// other threads run where it is asked, made or destroyed.
const void* other_half(const Lesson& lesson) { return reinterpret_cast<const char*>(&lesson) + 1; }

/// A member function of that half; returns a copy.
template <class Result, class... Arguments>
auto looking(Result (Lesson::*function)(Arguments...)) {
  return [function](Lesson& self, std::remove_cvref_t<Arguments>... given) -> std::remove_cvref_t<Result> {
    const AtWork at_work({AtWork::User::call}, nullptr, other_half(self), "lesson");
    return (self.*function)(std::move(given)...);
  };
}

/// Acts in the loop's half. @throws as raise_again()
template <class Act>
auto in_loop(Lesson& lesson, const Act& act) {
  const AtWork at_work({AtWork::User::call}, nullptr, &lesson, "lesson");
  const HapticTick tick = act();
  if (const std::exception_ptr error = lesson.law_error()) raise_again(error);
  return tick;
}

HapticTick update(Lesson& self, const DeviceState& sample, const std::optional<ArrayLike>& hand) {
  LessonHand known;
  if (hand) known.place = point(*hand, "hand");
  return in_loop(self, [&] { return self.update(sample, hand ? &known : nullptr); });
}

void advance(PointerLesson& self, double time) {
  in_loop(self.lesson(), [&] {
    self.advance(time);
    return self.last();
  });
}

std::vector<LessonEvent> events(Lesson& self) {
  std::vector<LessonEvent> taken;
  for (LessonEvent event; self.take_event(event);) taken.push_back(event);
  return taken;
}

void add_commands(py::class_<Lesson>& type) {
  for (const auto& [kind, name, text] : members_of<LessonCommandKind>) {
    if (kind == LessonCommandKind::ignore) continue;  // as Lesson::ignore(), which needs no queue
    const std::string documentation = formatted("Sends the command: {}. See send().", text);
    type.def(
        name, [kind = kind](Lesson& self, std::uint64_t tick) { return self.send({kind, tick}); }, "tick"_a = 0,
        documentation.c_str());
  }
}

}  // namespace

void add_lesson(py::module_& module) {
  add_types<LessonOptions, LessonCommand, LessonWriting, LessonScore>(module);
  add_struct<LessonView>(module).attr("has_failed").attr("__doc__") =
      "a law has raised, or its force was not finite: Lesson.update() raises it";
  py::class_<Lesson> lesson(module, "Lesson", py::is_final(),
                            "+ One thread may call update() while another looks on; two in the same half: Error.");
  lesson
      .def(py::init<std::vector<PracticePage>, const Capabilities&, const LessonOptions&>(), "pages"_a, "device"_a,
           "options"_a = LessonOptions{})
      .def("update", &update, "sample"_a, "hand"_a = py::none(),
           "+ (2,). Raises what a law raised, from then on until a page begins.")
      .def_property_readonly("force", when_idle(&Lesson::force))
      .def("ignore", when_idle(&Lesson::ignore))
      .def_property_readonly("is_waiting", when_idle(&Lesson::is_waiting))
      .def("send", &Lesson::send, "command"_a)
      .def("again", looking(&Lesson::again), "tick"_a = 0)
      .def("next", looking(&Lesson::next), "tick"_a = 0)
      .def("begin", looking(&Lesson::begin), "pages"_a, "tick"_a = 0)
      .def("change", looking(&Lesson::change), "options"_a, "tick"_a = 0)
      .def_property_readonly("page", &Lesson::page, py::return_value_policy::copy)
      .def_property_readonly("options", &Lesson::options, py::return_value_policy::copy)
      .def_property_readonly("rate", &Lesson::rate)
      .def("look", looking(&Lesson::look))
      .def("events", &events, "Takes the events that wait, up to the last look(): at most 1,024.")
      .def_property_readonly("recording", &Lesson::recording, py::return_value_policy::copy, "+ Copied.")
      .def_property_readonly(
          "hands", [](const Lesson& self) { return structured(std::vector<LessonHand>(self.hands())); },
          "+ A structured array (n,), copied: `place` [m, page] and `time` [s], NaN where it is not known or where the "
          "pen is, and `pressure`, NaN where it is not sensed [1].")
      .def("writing", &Lesson::writing);
  add_commands(lesson);

  add_types<PointerSample>(module);
  py::class_<PointerLesson>(module, "PointerLesson", py::is_final(), "+ For one thread; the lesson as Lesson says.")
      .def(py::init<std::vector<PracticePage>, const Capabilities&, const LessonOptions&>(), "pages"_a, "device"_a,
           "options"_a = LessonOptions{})
      .def("move", &PointerLesson::move, "sample"_a)
      .def("advance", &advance, "time"_a, "+ Raises as Lesson.update().")
      .def_property_readonly("is_busy", &PointerLesson::is_busy)
      .def("change",
           [](PointerLesson& self, const LessonOptions& options) {
             const AtWork at_work({AtWork::User::call}, nullptr, other_half(self.lesson()), "lesson");
             self.change(options);
           },
           "options"_a)
      .def_property_readonly("lesson", py::overload_cast<>(&PointerLesson::lesson),
                             py::return_value_policy::reference_internal, "the lesson that it holds")
      .def_property_readonly("last", &PointerLesson::last, py::return_value_policy::copy);

  module.attr("usual_remarks") = usual_remarks;
  module.def("score_lesson", released(&score_lesson), "writing"_a, "tolerances"_a = JudgeTolerances());
  module.def(
      "lesson_remark_text",
      [](const LessonRemark& remark, const Character& character, const std::string& language) {
        return lesson_remark_text(remark, character, Language(language));
      },
      "remark"_a, "character"_a, "language"_a = "en");
  module.def(
      "refusal_text",
      [](RefusalReason reason, const std::string& language) { return refusal_text(reason, Language(language)); },
      "reason"_a, "language"_a = "en");
}

}  // namespace calligraphy::python
