// The haptic renderer, tick by tick or over a whole trace, and the stiffness bounds.
#include <calligraphy/devices/detail/flush_denormals.hpp>
#include <calligraphy/render/haptic_renderer.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

auto mapped(Eigen::Vector3d (MotionMapping::*function)(const Eigen::Vector3d&) const, const char* name) {
  return [function, name](const MotionMapping& self, const ArrayLike& value) {
    return array_of((self.*function)(vector(value, name)));
  };
}

/// One table for a tick as an object and for the columns of a whole trace, whose rows are HapticTick as in memory.
class TickColumns {
 public:
  explicit TickColumns(py::module_& module)
      : type_(module, "HapticTick", "Result of one servo tick: the columns of tick_dtype. A copy.") {}

  /// Each a member of `tick` and "name: what it is [unit]".
  template <class Member, class... Rest>
  void add(const Member& member, const std::string& text, const Rest&... rest) {
    const NamedText named(text);
    const auto offset = reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&tick);
    const auto get = [offset](const HapticTick& self) {
      return as_python(*reinterpret_cast<const Member*>(reinterpret_cast<const char*>(&self) + offset));
    };
    columns_.add(named.name.c_str(), tick, member);
    type_.def_property_readonly(named.name.c_str(), get, named.documentation.c_str());
    if constexpr (sizeof...(rest) > 0) add(rest...);
  }

  py::dtype dtype() const { return columns_.dtype(); }

  const HapticTick tick;  ///< gives the offsets of the members

 private:
  py::class_<HapticTick> type_;
  Columns<HapticTick> columns_;
};

/// Passes device positions, at the renderer's rate or at the given times, through the renderer.
py::array trace(HapticRenderer& renderer, const ArrayLike& positions, const std::optional<ArrayLike>& times) {
  Interrupt interrupt;  // started here, because the conversion takes time as well
  const AtWork at_work({AtWork::User::call}, nullptr, &renderer);
  const Doubles points = doubles(positions, "positions", 3);
  const py::ssize_t count = points.shape(0);
  Doubles moments(0);
  if (times) moments = fixed_doubles(*times, "times", count);
  std::vector<HapticTick> ticks(static_cast<std::size_t>(count));
  {
    const double* const data = points.data();
    const double* const time = times ? moments.data() : nullptr;
    const double period = 1.0 / renderer.options().servo_rate;
    const py::gil_scoped_release release;
    const double start = renderer.last().time;
    DeviceState state;
    constexpr py::ssize_t block = 1024;
    for (py::ssize_t first = 0; first < count; first += block) {
      interrupt.check();  // outside the scope that flushes denormals: a Python handler may need them
      const FlushDenormals as_a_servo_thread;
      for (py::ssize_t i = first; i < std::min(first + block, count); ++i) {
        state.time = time ? time[i] : start + static_cast<double>(i + 1) * period;
        state.position = vector_at(data, i);
        ticks[static_cast<std::size_t>(i)] = renderer.update(state);
      }
    }
  }
  return structured(py::module_::import("calligraphy._calligraphy").attr("tick_dtype").cast<py::dtype>(),
                    std::move(ticks));
}

py::dict as_dict(const StiffnessBound& bound) {
  return py::dict("value"_a = bound.value, "formula"_a = bound.formula, "validity"_a = bound.validity);
}

}  // namespace

void add_render(py::module_& module) {
  add_enum(module, "GuidanceLaw", "Guidance force over the distance.", GuidanceLaw::saturating, "linear saturating");
  add_enum(module, "StiffnessCheck", "What to do with an unstable stiffness; `off` is for simulated devices only.",
           StiffnessCheck::off, "reject clip off");

  add_struct<AssistPolicy>(
      module, "AssistPolicy", "Assistance as needed.", &AssistPolicy::enabled, "enabled: False: full assistance always",
      &AssistPolicy::retention, "retention: share of the previous assistance retained [1]",
      &AssistPolicy::full_assistance_error, "full_assistance_error: RMS lateral error that keeps assistance at 1 [em]",
      &AssistPolicy::min_assistance, "min_assistance: lower bound of the assistance [1]");
  add_struct<FrictionOptions>(module, "FrictionOptions", "Friction between pen and paper.", &FrictionOptions::coefficient,
                              "coefficient: mu; 0: no friction [1]", &FrictionOptions::stiffness,
                              "stiffness: of the spring between pen and anchor [N/m]", &FrictionOptions::damping,
                              "damping: of that spring, not of the sliding pen [N s/m]");
  using T = StrokeTolerances;
  add_struct<T>(module, "StrokeTolerances", "How exactly a stroke must be written to count as the one that is due.",
                &T::start_distance, "start_distance: it begins within this distance of its start [em]", &T::direction,
                "direction: its first stretch runs within this angle of the stroke's own [rad]", &T::first_stretch,
                "first_stretch: length over which that is judged, at most a quarter of the stroke; 0: place only [em]",
                &T::distinction,
                "distinction: a later stroke is meant if its start fits better by this factor; infinite: never [1]",
                &T::corridor, "corridor: half the width of the corridor in which the pen makes progress [em]",
                &T::coverage,
                "coverage: share of the length to be written in order; 0: the feature planes finish it [1]", &T::slack,
                "slack: length that may be missing besides [em]")
      .def_static("lenient", &T::lenient, "For beginners and for large devices held loosely.")
      .def_static("normal", &T::normal, "The default.")
      .def_static("strict", &T::strict, "For examinations.");
  using P = PaperOptions;
  add_struct<P>(module, "PaperOptions", "The paper under the pen.", &P::stiffness, "stiffness: K_en of eq. (9) [N/m]",
                &P::damping, "damping: against motion in the paper, along its normal [N s/m]", &P::onset,
                "onset: depth over which the paper becomes as stiff and as damped as that [m]", &P::solid,
                "solid: normal force in the adjusting state too", &P::friction, "friction: FrictionOptions");
  using G = GuidanceOptions;
  add_struct<G>(module, "GuidanceOptions", "The lateral force.", &G::stiffness, "stiffness: K_et of eq. (8) [N/m]",
                &G::damping, "damping: against motion across the stroke [N s/m]", &G::law, "law: GuidanceLaw",
                &G::limit, "limit: saturating: maximum force [N]", &G::to_start, "to_start: pull the pen to the start",
                &G::space, "space: ConstraintSpace", &G::fade_in, "fade_in: time [s]", &G::fade_out,
                "fade_out: time [s]", &G::wrong_way_stiffness, "wrong_way_stiffness: 0: none [N/m]",
                &G::wrong_way_limit, "wrong_way_limit: maximum force [N]", &G::wrong_way_slack,
                "wrong_way_slack: dead band [em]", &G::assist, "assist: AssistPolicy");
  using K = ContactOptions;
  add_struct<K>(module, "ContactOptions", "When the pen touches the paper.", &K::lift_time, "lift_time: [s]",
                &K::lift_clearance, "lift_clearance: [m]", &K::lift_between_strokes,
                "lift_between_strokes: the next stroke begins with a new contact", &K::box_margin, "box_margin: [em]");
  using L = ForceLimits;
  add_struct<L>(module, "ForceLimits", "What bounds the force.", &L::in_plane_rate, "in_plane_rate: [N/s]",
                &L::normal_rate, "normal_rate: [N/s]", &L::thermal_time_constant, "thermal_time_constant: [s]",
                &L::max_speed, "max_speed: [m/s]");
  using E = EnergyOptions;
  add_struct<E>(module, "EnergyOptions", "What energy the force may deliver.", &E::budget, "budget: [J]", &E::max_gap, "max_gap: [s]");
  using O = RendererOptions;
  add_struct<O>(module, "RendererOptions", "Options of the haptic renderer.", &O::servo_rate, "servo_rate: [Hz]",
                &O::rules, "rules: Rules", &O::stiffness_check, "stiffness_check: StiffnessCheck", &O::nearest,
                "nearest: NearestPointOptions", &O::velocity_cutoff, "velocity_cutoff: [Hz]", &O::grip_stiffness,
                "grip_stiffness: [N/m, device]", &O::paper, "paper: PaperOptions", &O::guidance,
                "guidance: GuidanceOptions", &O::contact, "contact: ContactOptions", &O::tolerances,
                "tolerances: StrokeTolerances", &O::limits, "limits: ForceLimits", &O::energy, "energy: EnergyOptions")
      .def_static("wang2006", &O::wang2006, "Every rule as printed, except the signs of eq. (8) and (9).")
      .def_static("for_device", &O::for_device, "capabilities"_a, "scale"_a = 1.0,
                  "The defaults at the device's rate, stiffnesses clipped to what is usable and stable; the hand feels "
                  "the same at every `scale` of the MotionMapping.")
      .def_static(
          "everything", &O::everything, "capabilities"_a, "scale"_a = 1.0,
          "for_device() with the optional stages that serve every writer on the device: neither passivity control nor "
          "assistance as needed.");
  module.def(
      "clip_stiffness", &clip_stiffness, "options"_a, "capabilities"_a, "scale"_a = 1.0,
      "Clips stiffnesses and dampings in place to what is usable, and stable in any hand; `scale` is that of the "
      "MotionMapping. Returns what was clipped, each with its reason.");
  module.def("validate", py::overload_cast<const O&, const Capabilities&, double>(&validate), "options"_a,
             "capabilities"_a, "scale"_a = 1.0,
             "Raises InvalidValue naming an option out of range, or a stiffness or damping that would be clipped.");

  add_struct<MotionMapping>(
      module, "MotionMapping", "Rigid transform from device axes to page axes, with the motion scale K_S.",
      &MotionMapping::rotation, "rotation: (3, 3), device axes to page axes", &MotionMapping::offset,
      "offset: position of the device origin on the page, (3,) [m]", &MotionMapping::scale, "scale: K_S [1]")
      .def("to_page", mapped(&MotionMapping::to_page, "device"), "device"_a, "(3,) [m] to (3,) [m].")
      .def("to_device", mapped(&MotionMapping::to_device, "page"), "page"_a, "(3,) [m] to (3,) [m].")
      .def("force_to_device", mapped(&MotionMapping::force_to_device, "page"), "page"_a, "(3,) [N] to (3,) [N].");
  module.def("upright_page", &upright_page, "width"_a, "height"_a, "scale"_a = 1.0,
             "Upright page in the x-y plane of the device [m], centred on its origin for every motion scale K_S.");
  module.def("desk_page", &desk_page, "width"_a, "height"_a, "scale"_a = 1.0,
             "Page flat on the desk [m]; page y points away from the user. Otherwise as upright_page.");

  add_enum(module, "InteractionState", "SS, AS, CS, WS of Fig. 6.", InteractionState::writing,
           "separation adjusting calibration writing");
  add_enum(
      module, "TickEvent", "What happened in a tick; bit flags.", TickEvent::page_finished,
      "contact lift stroke_started feature_passed stroke_finished stroke_abandoned character_finished page_finished",
      true);
  add_enum(module, "TickStatus", "Whether a sample was usable.", TickStatus::device_fault,
           "ok stale bad_sample device_fault");
  add_enum(module, "WritingHint", "Why a pen on the paper is not guided; to_string() gives the words for a display.",
           WritingHint::lift_first,
           "none write too_far at_end in_middle wrong_direction another_stroke off_stroke lift_first");
  module.def("to_string", py::overload_cast<WritingHint>(&to_string), "hint"_a,
             "The words of a hint, such as \"too far from the start\"; \"\" for `none`.");
  module.def(
      "hint_text",
      [](WritingHint hint, const ArrayLike& to_start) { return hint_text(hint, point(to_start, "to_start")); },
      "hint"_a, "to_start"_a,
      "The words of a hint with the way to the start [m, page], such as \"too far from the start: 12 mm to the "
      "upper left\".");
  TickColumns columns(module);
  const HapticTick& t = columns.tick;
  columns.add(t.time, "time: sample time [s]", t.status, "status: TickStatus", t.state, "state: InteractionState",
              t.events, "events: TickEvent flags", t.character,
              "character: index of the active one; their number once all are written", t.stroke,
              "stroke: index of the active stroke in the character", t.device_point,
              "device_point: (3,), page frame [m]", t.pen_tip, "pen_tip: (3,), page frame [m]", t.penetration,
              "penetration: of the device point into the paper [m]", t.contact.element,
              "element: writing: index of the active element", t.contact.closest.parameter,
              "parameter: writing: of the closest point on that element, in [0, 1]", t.contact.closest.point,
              "closest: writing: closest point on the active element, (2,) [m]", t.contact.closest.distance,
              "distance: writing: from the pen tip to the closest point [m]", t.contact.weight,
              "weight: writing: of the guidance force, 0 outside the constraint space", t.contact.arc,
              "arc: writing: of the closest point from the start of the stroke [m]", t.covered,
              "covered: share of the active stroke written in order [1]", t.hint, "hint: WritingHint", t.to_start,
              "to_start: from the pen tip to the start of the active stroke (2,) [m]", t.attraction,
              "attraction: force term (2,) [N]", t.wrong_way, "wrong_way: force term (2,) [N]", t.friction,
              "friction: force term (2,) [N]", t.normal, "normal: force term, out of the page [N]", t.viscous,
              "viscous: damping by guidance, friction and paper (3,) [N]", t.assistance,
              "assistance: factor on the guidance, from the assist policy [1]", t.energy_given,
              "energy_given: net energy delivered to the hand [J]", t.heat,
              "heat: of the motors; 1: in equilibrium at the continuous force [1]", t.page_force,
              "page_force: as sent, page axes (3,) [N]", t.force, "force: as sent, device axes (3,) [N]");
  module.attr("tick_dtype") = columns.dtype();

  py::class_<HapticRenderer>(
      module, "HapticRenderer", py::is_final(),
      "Guides a pen through the characters of a page, stroke by stroke in the correct order and direction. Use one per "
      "device and thread: one that a running ServoLoop or another thread uses raises Error. Raises InvalidValue naming "
      "the option, the character or its placement.")
      .def(py::init<std::vector<PlacedCharacter>, const MotionMapping&, const Capabilities&, const RendererOptions&>(),
           "page"_a, "mapping"_a, "capabilities"_a, "options"_a = RendererOptions{})
      .def(
          "update", [](HapticRenderer& self, const DeviceState& state) { return idle(self).update(state); }, "state"_a,
          "Processes one sample; write `force` of the result to the device.")
      .def("trace", &trace, "positions"_a, "times"_a = py::none(),
           "Processes positions (N, 3) in device axes [m], one per tick, at increasing times (N,) [s], by default at "
           "the servo rate from the last tick on. Returns N ticks (tick_dtype). Releases the GIL. After Ctrl-C, call "
           "restart().")
      .def(
          "restart", [](HapticRenderer& self) { idle(self).restart(); },
          "Starts the page again: nothing written, force zero immediately.")
      .def_property_readonly(
          "last", [](const HapticRenderer& self) { return idle(self).last(); }, "the last HapticTick, copied")
      .def_property_readonly("options", &HapticRenderer::options, py::return_value_policy::copy,
                             "effective options: clipped stiffnesses and dampings may be lower than requested")
      .def_property_readonly("clipped", &HapticRenderer::clipped, "what was clipped, each with its reason")
      .def_property_readonly("mapping", &HapticRenderer::mapping, py::return_value_policy::copy,
                             "MotionMapping, copied")
      .def_property_readonly(
          "page", [](const HapticRenderer& self) { return std::vector<PlacedCharacter>(self.page()); },
          "list of PlacedCharacter, copied")
      .def("max_force_step", &HapticRenderer::max_force_step, "Maximum change per tick; infinite: no limit [N].")
      .def("__repr__", [](const HapticRenderer& self) {
        return told("HapticRenderer(page of {} at {:g} Hz)", self.page().size(), self.options().servo_rate);
      });

  add_struct<SampledLoop>(module, "SampledLoop", "A point mass held against a sampled virtual wall.",
                          &SampledLoop::device, "device: Capabilities", &SampledLoop::rate, "rate [Hz]",
                          &SampledLoop::wall_damping, "wall_damping [N s/m]", &SampledLoop::grip,
                          "grip: GripImpedance; by default nobody holds it");
  module.def("critical_stiffness", released(&critical_stiffness), "loop"_a,
             "Minimum stiffness at which the linear motion no longer decays [N/m].");
  module.def(
      "stiffness_for_any_hand", released(&stiffness_for_any_hand), "loop"_a, "velocity_cutoff"_a, "most"_a,
      "Maximum stiffness, up to `most`, of a spring with loop.wall_damping, filtered at velocity_cutoff [Hz], that is "
      "damped in every hand [N/m]; loop.grip is not used. RendererOptions are clipped to it.");
  module.def(
      "advise_stiffness",
      [](const SampledLoop& loop) {
        const StiffnessAdvice advice = released(&advise_stiffness)(loop);
        return py::dict("passive"_a = as_dict(advice.passive), "quantised"_a = as_dict(advice.quantised),
                        "stable"_a = as_dict(advice.stable), "approximate"_a = as_dict(advice.approximate));
      },
      "loop"_a,
      "Bounds on the wall stiffness in this loop: `passive`, the wall generates no energy; `quantised`, the "
      "quantisation of positions cannot sustain an oscillation either; `stable`, below it the linear motion in this "
      "grip decays; `approximate`, a rule of thumb for `stable`. Each is a dict: value [N/m], formula and validity.");
  module.def("injectable_damping", released(&injectable_damping), "loop"_a,
             "Maximum damping that a passivity controller may inject [N s/m].");
}

}  // namespace calligraphy::python
