// The render room: what the hand feels, tick by tick or over a whole trace.
#include <algorithm>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/flush_denormals.hpp>
#include <calligraphy/render/haptic_renderer.hpp>
#include <calligraphy/render/passivity_controller.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "at_work.hpp"
#include "enumeration.hpp"
#include "interrupt.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;

void add_options(py::module_& module) {
  Enumeration<PenTipRule>(module, "PenTipRule")
      .value("projected", PenTipRule::projected)
      .value("wang2006", PenTipRule::wang2006);
  Enumeration<GuidanceLaw>(module, "GuidanceLaw")
      .value("linear", GuidanceLaw::linear)
      .value("saturating", GuidanceLaw::saturating);
  Enumeration<StiffnessCheck>(module, "StiffnessCheck")
      .value("refuse", StiffnessCheck::refuse)
      .value("clip", StiffnessCheck::clip)
      .value("none", StiffnessCheck::none);
  Enumeration<ForceSign>(module, "ForceSign")
      .value("attracting", ForceSign::attracting)
      .value("wang2006", ForceSign::wang2006);
  Enumeration<MotionMappingRule>(module, "MotionMappingRule")
      .value("affine", MotionMappingRule::affine)
      .value("wang2006", MotionMappingRule::wang2006);
  Enumeration<FrictionModel>(module, "FrictionModel")
      .value("breakaway", FrictionModel::breakaway)
      .value("hayward_armstrong", FrictionModel::hayward_armstrong)
      .value("karnopp", FrictionModel::karnopp);
  Record<AssistPolicy>(module, "AssistPolicy", "Help as needed: it fades as the writer improves.")
      .field("enabled", &AssistPolicy::enabled, "False: full help always")
      .field("retention", &AssistPolicy::retention, "of the last stroke's help [1]")
      .field("full_help_error", &AssistPolicy::full_help_error, "RMS lateral error that keeps help at full [m]")
      .field("least", &AssistPolicy::least, "help never falls below [1]");
  Record<FrictionOptions>(module, "FrictionOptions", "Friction between pen and paper.")
      .field("model", &FrictionOptions::model, "FrictionModel")
      .field("coefficient", &FrictionOptions::coefficient, "0: no friction [1]")
      .field("stiffness", &FrictionOptions::stiffness, "of the pen's hold on the paper [N/m]")
      .field("static_ratio", &FrictionOptions::static_ratio, "karnopp: break-away over sliding friction [1]")
      .field("stick_speed", &FrictionOptions::stick_speed, "karnopp [m/s]");
  using O = RendererOptions;
  Record<O> options(module, "RendererOptions", "Everything that a user of the renderer may choose.");
  options.field("servo_rate", &O::servo_rate, "[Hz]")
      .field("paper_stiffness", &O::paper_stiffness, "K_en of eq. (9) [N/m]")
      .field("guidance_stiffness", &O::guidance_stiffness, "K_et of eq. (8) [N/m]")
      .field("guidance_fade_in", &O::guidance_fade_in, "[s]")
      .field("wrong_way_stiffness", &O::wrong_way_stiffness, "0: none [N/m]")
      .field("wrong_way_limit", &O::wrong_way_limit, "[N]")
      .field("wrong_way_slack", &O::wrong_way_slack, "[m]")
      .field("stiffness_check", &O::stiffness_check, "StiffnessCheck: refuse or clip what is not stable")
      .field("softest_grip", &O::softest_grip, "Hand in which the loop is to be stable")
      .field("guidance", &O::guidance, "GuidanceLaw")
      .field("guidance_limit", &O::guidance_limit, "saturating: the largest guidance force [N]")
      .field("guide_to_start", &O::guide_to_start, "on the paper before a stroke, pull to its start")
      .field("assist", &O::assist, "AssistPolicy")
      .field("friction", &O::friction, "FrictionOptions")
      .field("stroke", &O::stroke, "StrokeRules")
      .field("start_radius", &O::start_radius, "neighbourhood of a stroke's start that begins it [m]")
      .field("box_margin", &O::box_margin, "[m]")
      .field("lift_height", &O::lift_height, "hysteresis of the contact [m]")
      .field("box_hysteresis", &O::box_hysteresis, "[m]")
      .field("lift_between_strokes", &O::lift_between_strokes, "the next stroke begins with a new contact")
      .field("solid_paper", &O::solid_paper, "normal force in the adjusting state too")
      .field("in_plane_force_rate", &O::in_plane_force_rate, "[N/s]")
      .field("normal_force_rate", &O::normal_force_rate, "[N/s]")
      .field("limit_force_rate", &O::limit_force_rate, "False: forces step at every transition")
      .field("force_jerk", &O::force_jerk, "infinite: any [N/s^2]")
      .field("passivity_control", &O::passivity_control, "damps out what sampling, delay and limits add to the energy")
      .field("energy_budget", &O::energy_budget, "infinite: any [J]")
      .field("thermal_time_constant", &O::thermal_time_constant, "0: no limit [s]")
      .field("largest_speed", &O::largest_speed, "a faster sample is a fault [m/s]")
      .field("force_sign", &O::force_sign, "ForceSign")
      .field("pen_tip", &O::pen_tip, "PenTipRule")
      .field("motion", &O::motion, "MotionMappingRule");
  options.type()
      .def_static("wang2006", &O::wang2006, "Every rule as printed, but for the signs of eq. (8) and (9).")
      .def_static("for_device", &O::for_device, py::arg("capabilities"),
                  "The defaults at the device's rate, stiffnesses clipped to what it is stable with.")
      .def_static("everything", &O::everything, py::arg("capabilities"), "for_device() with every stage switched on.");
  module.def("clip_stiffness", &clip_stiffness, py::arg("options"), py::arg("capabilities"),
             py::arg("largest_attraction") = 1.0, py::arg("scale") = 1.0,
             "Clips the stiffnesses of `options` in place; what was clipped, each with its reason.");
  module.def("validate", py::overload_cast<const O&, const Capabilities&, double, double>(&validate),
             py::arg("options"), py::arg("capabilities"), py::arg("largest_attraction") = 1.0, py::arg("scale") = 1.0,
             "Raises InvalidValue naming an option out of its domain, or a stiffness that would be clipped.");
}

void add_motion(py::module_& module) {
  Record<MotionMapping>(module, "MotionMapping", "Rigid transform from device axes to the page, with the scale K_S.")
      .field("rotation", &MotionMapping::rotation, "(3, 3), device axes to page axes")
      .field("offset", &MotionMapping::offset, "where the device's zero is on the page, (3,) [m]")
      .field("scale", &MotionMapping::scale, "K_S [1]")
      .type()
      .def(
          "to_page",
          [](const MotionMapping& self, const ArrayLike& v) { return array_of(self.to_page(vector(v, "device"))); },
          py::arg("device"), "(3,) [m]")
      .def(
          "to_device",
          [](const MotionMapping& self, const ArrayLike& v) { return array_of(self.to_device(vector(v, "page"))); },
          py::arg("page"), "(3,) [m]")
      .def(
          "force_to_device",
          [](const MotionMapping& self, const ArrayLike& v) {
            return array_of(self.force_to_device(vector(v, "page")));
          },
          py::arg("page"), "(3,) [N]");
  module.def("upright_page", &upright_page, py::arg("width"), py::arg("height"),
             "Page upright in the device's x-y plane, centred on its zero [m].");
  module.def("desk_page", &desk_page, py::arg("width"), py::arg("height"), "Page flat on the desk [m].");
}

/// The columns of a whole trace; the rows are HapticTick as it is in memory.
py::dtype tick_type() {
  const HapticTick t;
  return Columns<HapticTick>()
      .add("time", t, t.time)
      .add("status", t, t.status)
      .add("state", t, t.state)
      .add("events", t, t.events)
      .add("character", t, t.character)
      .add("stroke", t, t.stroke)
      .add("device_point", t, t.device_point)
      .add("pen_tip", t, t.pen_tip)
      .add("penetration", t, t.penetration)
      .add("element", t, t.contact.element)
      .add("parameter", t, t.contact.foot.parameter)
      .add("foot", t, t.contact.foot.point)
      .add("distance", t, t.contact.foot.distance)
      .add("share", t, t.contact.share)
      .add("arc", t, t.contact.arc)
      .add("attraction", t, t.attraction)
      .add("wrong_way", t, t.wrong_way)
      .add("friction", t, t.friction)
      .add("normal", t, t.normal)
      .add("damping", t, t.damping)
      .add("help", t, t.help)
      .add("energy_given", t, t.energy_given)
      .add("heat", t, t.heat)
      .add("page_force", t, t.page_force)
      .add("force", t, t.force)
      .dtype();
}

template <class Member>
auto vector_of(Member HapticTick::*member) {
  return [member](const HapticTick& self) { return array_of(self.*member); };
}

void add_tick(py::module_& module) {
  Enumeration<InteractionState>(module, "InteractionState", "SS, AS, CS, WS of Fig. 6.")
      .value("separation", InteractionState::separation)
      .value("adjusting", InteractionState::adjusting)
      .value("calibration", InteractionState::calibration)
      .value("writing", InteractionState::writing);
  Enumeration<TickEvent>(module, "TickEvent", "What happened in a tick: bits of HapticTick.events.", py::arithmetic())
      .value("none", TickEvent::none)
      .value("contact", TickEvent::contact)
      .value("lift", TickEvent::lift)
      .value("stroke_started", TickEvent::stroke_started)
      .value("feature_passed", TickEvent::feature_passed)
      .value("stroke_finished", TickEvent::stroke_finished)
      .value("stroke_abandoned", TickEvent::stroke_abandoned)
      .value("character_finished", TickEvent::character_finished)
      .value("page_finished", TickEvent::page_finished);
  Enumeration<TickStatus>(module, "TickStatus", "Whether the sample of a tick could be used.")
      .value("ok", TickStatus::ok)
      .value("bad_sample", TickStatus::bad_sample)
      .value("device_fault", TickStatus::device_fault);
  module.def(
      "has", [](int events, TickEvent event) { return (events & static_cast<int>(event)) != 0; }, py::arg("events"),
      py::arg("event"), "Whether the bits of `events` hold this one.");
  py::class_<HapticTick>(module, "HapticTick", "All that one servo tick found and did. A copy; it does not change.")
      .def_readonly("time", &HapticTick::time, "of the sample [s]")
      .def_readonly("status", &HapticTick::status)
      .def_readonly("state", &HapticTick::state)
      .def_property_readonly(
          "events", [](const HapticTick& self) { return static_cast<int>(self.events); }, "bits of TickEvent")
      .def_readonly("character", &HapticTick::character, "index of the active one; their number once all are written")
      .def_readonly("stroke", &HapticTick::stroke, "index of the active one within it")
      .def_property_readonly("device_point", vector_of(&HapticTick::device_point), "(3,), page frame [m]")
      .def_property_readonly("pen_tip", vector_of(&HapticTick::pen_tip), "(3,), page frame [m]")
      .def_readonly("penetration", &HapticTick::penetration, "[m]")
      .def_property_readonly(
          "contact", [](const HapticTick& self) { return self.contact; },
          "StrokeContact, meaningful in the writing state")
      .def_property_readonly("attraction", vector_of(&HapticTick::attraction), "force term (2,) [N]")
      .def_property_readonly("wrong_way", vector_of(&HapticTick::wrong_way), "force term (2,) [N]")
      .def_property_readonly("friction", vector_of(&HapticTick::friction), "force term (2,) [N]")
      .def_readonly("normal", &HapticTick::normal, "force term, out of the page [N]")
      .def_property_readonly("damping", vector_of(&HapticTick::damping), "of the passivity controller (3,) [N]")
      .def_readonly("help", &HapticTick::help, "share of the guidance that the assist policy gives")
      .def_readonly("energy_given", &HapticTick::energy_given, "[J]")
      .def_readonly("heat", &HapticTick::heat, "1: that of the continuous force")
      .def_property_readonly("page_force", vector_of(&HapticTick::page_force), "sent, page axes (3,) [N]")
      .def_property_readonly("force", vector_of(&HapticTick::force), "sent, device axes (3,) [N]")
      .def("__repr__", [](const py::object& self) {
        const auto& tick = self.cast<const HapticTick&>();
        return told("HapticTick(time {:.6g} s, {}, {}, character {}, stroke {}, force {} N)", tick.time,
                    self.attr("status").attr("name"), self.attr("state").attr("name"), tick.character, tick.stroke,
                    self.attr("force").attr("tolist")());
      });
}

/// Positions of a device at the renderer's rate, or at the times given, through the renderer.
py::array trace(HapticRenderer& renderer, const ArrayLike& positions, const py::object& times) {
  Interrupt interrupt;  // from here, as the rows take their time too
  refuse_at_work(renderer);
  const Doubles points = doubles(positions, "positions", 3);
  const py::ssize_t count = points.shape(0);
  Doubles moments(0);
  if (!times.is_none()) moments = fixed_doubles(times, "times", count);
  std::vector<HapticTick> ticks(static_cast<std::size_t>(count));
  {
    const double* const data = points.data();
    const double* const time = times.is_none() ? nullptr : moments.data();
    const double period = 1.0 / renderer.options().servo_rate;
    const py::gil_scoped_release release;
    const double start = renderer.last().time;
    DeviceState state;
    constexpr py::ssize_t block = 1024;
    for (py::ssize_t first = 0; first < count; first += block) {
      interrupt.check();  // where a handler in Python has its denormals
      const FlushDenormals as_a_servo_thread;
      for (py::ssize_t i = first; i < std::min(first + block, count); ++i) {
        state.time = time ? time[i] : start + static_cast<double>(i + 1) * period;
        state.position = vector_at(data, i);
        ticks[static_cast<std::size_t>(i)] = renderer.update(state);
      }
    }
  }
  return structured(tick_type(), std::move(ticks));
}

void add_renderer(py::module_& module) {
  module.attr("tick_dtype") = tick_type();
  py::class_<HapticRenderer>(
      module, "HapticRenderer", py::is_final(),
      "Guides a pen through the characters of a page, stroke by stroke in the right order and direction. One renderer\n"
      "per device and thread. update() costs about 0.5 us from Python, of which 0.1 us is the tick itself; trace() "
      "costs "
      "a\n"
      "tick per sample. While a ServoLoop has it for its law, nothing else may use it but its options and its page.")
      .def(py::init<std::vector<PlacedCharacter>, const MotionMapping&, const Capabilities&, const RendererOptions&>(),
           py::arg("page"), py::arg("mapping"), py::arg("capabilities"), py::arg("options") = RendererOptions{})
      .def(
          "update", [](HapticRenderer& self, const DeviceState& state) { return idle(self).update(state); },
          py::arg("state"), "Sample in, force out: `force` of the tick is for the device.")
      .def("trace", &trace, py::arg("positions"), py::arg("times") = py::none(),
           "Positions (N, 3) in device axes [m], one per tick, at increasing times (N,) [s] or else at the servo rate "
           "from\n"
           "the last tick on; a structured array of N ticks (tick_dtype). The GIL is released. After a Ctrl-C the\n"
           "renderer stands where it was interrupted: restart() it.")
      .def(
          "restart", [](HapticRenderer& self) { idle(self).restart(); },
          "The page as new: nothing written, force zero at once.")
      .def_property_readonly("last", [](const HapticRenderer& self) { return idle(self).last(); })
      .def_property_readonly("options", &HapticRenderer::options, py::return_value_policy::copy,
                             "As they are at work: clipped stiffnesses may be smaller than asked for.")
      .def_property_readonly("clipped", &HapticRenderer::clipped, "What was clipped, each with the reason.")
      .def_property_readonly("mapping", &HapticRenderer::mapping, py::return_value_policy::copy)
      .def_property_readonly("page", &HapticRenderer::page)
      .def("max_force_step", &HapticRenderer::max_force_step, "from one tick to the next; infinite: not limited [N]")
      .def("__repr__", [](const HapticRenderer& self) {
        return told("HapticRenderer(page of {} at {:g} Hz)", self.page().size(), self.options().servo_rate);
      });
}

void add_passivity(py::module_& module) {
  Record<PassivityOptions>(module, "PassivityOptions", "What a passivity controller may do.")
      .field("max_damping", &PassivityOptions::max_damping, "largest that is injected; 0: no control [N s/m]")
      .field("energy_budget", &PassivityOptions::energy_budget, "that may be given to the hand; infinite: any [J]")
      .field("force_rate", &PassivityOptions::force_rate, "how fast the last stage takes a force away [N/s]")
      .field("delay", &PassivityOptions::delay, "age of a sample when it is read, at most 15 [ticks]");
  using P = PassivityController;
  py::class_<P>(
      module, "PassivityController",
      "Keeps a sampled force law from giving out energy that it does not have: next() once a tick, limits of\n"
      "one's own, then sent().")
      .def(py::init<const PassivityOptions&, double>(), py::arg("options"), py::arg("period"), "period: of a tick [s]")
      .def_static("usable_damping", &P::usable_damping, py::arg("mass"), py::arg("period"), py::arg("delay"),
                  "At which a mass alone is damped and not thrown back [N s/m].")
      .def(
          "next",
          [](P& self, const ArrayLike& position, const ArrayLike& wanted) {
            return array_of(self.next(vector(position, "position"), vector(wanted, "wanted")));
          },
          py::arg("position"), py::arg("wanted"),
          "The force to be sent (3,) for a wanted one (3,) [N], at the device's position (3,) [m]; NaN: it is lost.")
      .def(
          "sent", [](P& self, const ArrayLike& force) { self.sent(vector(force, "force")); }, py::arg("force"),
          "The force (3,) that came out of the limits and holds from now on [N].")
      .def("restart", &P::restart, "Nothing sent, nothing given.")
      .def_property_readonly("energy_given", &P::energy_given, "net, to the hand, as observed [J]")
      .def_property_readonly("energy_left", &P::energy_left, "of the budget [J]")
      .def_property_readonly("longest_force", &P::longest_force, "what the last next() shortened to [N]")
      .def_property_readonly(
          "damping", [](const P& self) { return array_of(self.damping()); }, "(3,), last tick [N]");
}

void add_advice(py::module_& module) {
  Record<SampledLoop>(module, "SampledLoop", "A point mass held against a wall that is computed once a tick.")
      .field("device", &SampledLoop::device, "Capabilities")
      .field("rate", &SampledLoop::rate, "[Hz]")
      .field("wall_damping", &SampledLoop::wall_damping, "[N s/m]")
      .field("grip", &SampledLoop::grip, "Hand; by default nobody holds it");
  Record<StiffnessBound>(module, "StiffnessBound", "A bound of the wall's stiffness, and what it is worth.")
      .field("value", &StiffnessBound::value, "[N/m]")
      .field("formula", &StiffnessBound::formula, "as text, in the letters of SampledLoop")
      .field("validity", &StiffnessBound::validity, "where it holds and what it does not see");
  Record<StiffnessAdvice>(module, "StiffnessAdvice", "The bounds of a loop.")
      .field("passive", &StiffnessAdvice::passive, "the wall never gives out energy")
      .field("quantised", &StiffnessAdvice::quantised, "passive, and no rounding can keep up a swing")
      .field("stable", &StiffnessAdvice::stable, "the linear motion in this grip dies away below it")
      .field("approximate", &StiffnessAdvice::approximate, "a rule of thumb for `stable`");
  module.def("critical_stiffness", &critical_stiffness, py::arg("loop"), Release(),
             "Smallest stiffness at which the linear motion no longer dies away [N/m].");
  module.def("advise_stiffness", &advise_stiffness, py::arg("loop"), Release(),
             "How stiff a wall may be in this loop, by four bounds.");
  module.def("injectable_damping", &injectable_damping, py::arg("loop"), Release(),
             "Largest damping that a passivity controller may inject [N s/m].");
}

}  // namespace

void add_render(py::module_& module) {
  add_options(module);
  add_motion(module);
  add_tick(module);
  add_renderer(module);
  add_passivity(module);
  add_advice(module);
}

}  // namespace calligraphy::python
