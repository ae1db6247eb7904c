// The haptic renderer, tick by tick or over a whole trace, and the stiffness bounds.
#include <calligraphy/devices/detail/flush_denormals.hpp>
#include <calligraphy/render/haptic_renderer.hpp>
#include <calligraphy/render/option_values.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

auto mapped(Eigen::Vector3d (MotionMapping::*function)(const Eigen::Vector3d&) const, const char* name) {
  return [function, name](const MotionMapping& self, const ArrayLike& value) {
    return array_of((self.*function)(vector(value, name)));
  };
}

/// The fields of a tick, as properties of an object and as columns of a trace, whose rows are HapticTick as in memory.
/// Some members of the contact are columns of their own.
class TickColumns {
 public:
  explicit TickColumns(py::module_& module) : type_(module, "HapticTick") {
    each_field<HapticTick>([this](const auto& field) {
      using Value = std::remove_cvref_t<decltype(tick_.*field.member)>;
      if constexpr (std::is_same_v<Value, StrokeContact>) {
        const StrokeContact& contact = tick_.*field.member;
        add("element", contact.element, text_of("StrokeContact", "element"));
        add("parameter", contact.closest.parameter, text_of("NearestPoint", "parameter"));
        add("closest", contact.closest.point, text_of("NearestPoint", "point"));
        add("distance", contact.closest.distance, text_of("NearestPoint", "distance"));
        add("weight", contact.weight, text_of("StrokeContact", "weight"));
        add("arc", contact.arc, text_of("StrokeContact", "arc"));
      } else {
        add(field.name, tick_.*field.member);
      }
    });
    module.attr("tick_dtype") = columns_.dtype();
  }

 private:
  template <class Member>
  void add(const char* name, const Member& member, const char* text = "") {
    const auto offset = reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&tick_);
    const auto get = [offset](const HapticTick& self) {
      return as_python(*reinterpret_cast<const Member*>(reinterpret_cast<const char*>(&self) + offset));
    };
    columns_.add(name, tick_, member);
    type_.def_property_readonly(name, get, text);
  }

  const HapticTick tick_;  ///< gives the offsets of the members
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
      const detail::FlushDenormals as_a_servo_thread;
      for (py::ssize_t i = first; i < std::min(first + block, count); ++i) {
        state.time = time ? time[i] : start + static_cast<double>(i + 1) * period;
        state.position = vector_at(data, i);
        ticks[static_cast<std::size_t>(i)] = updated(renderer, state);
      }
    }
  }
  return structured(std::move(ticks), py::module_::import("calligraphy._calligraphy").attr("tick_dtype"));
}

}  // namespace

void add_render(py::module_& module) {
  add_types<InteractionState, TickEvent, TickStatus, WritingHint, SampledLoop>(module);
  add_struct<StrokeTolerances>(module)
      .def_static("lenient", &StrokeTolerances::lenient)
      .def_static("normal", &StrokeTolerances::normal)
      .def_static("strict", &StrokeTolerances::strict);
  add_types<GuidanceInput, GuidanceTerms, GuidanceTraits>(module);
  module.def(
      "guidance_damper",
      [](const GuidanceInput& input, double share) { return array_of(guidance_damper(input, share)); }, "input"_a,
      "share"_a);
  add_struct<GuidanceOptions>(module).attr("force").attr("__doc__") =
      "how the force depends on where the pen is: linear, saturating, wang2006 or a law of your own (docs/python.md): "
      "a class with a method force(GuidanceInput), or a function. It returns GuidanceTerms, or the spring (2,) [N], "
      "which guidance_damper() damps";
  add_struct<RendererOptions>(module)
      .def_static("wang2006", &RendererOptions::wang2006)
      .def_static("for_device", &RendererOptions::for_device, "capabilities"_a, "scale"_a = 1.0)
      .def_static("everything", &RendererOptions::everything, "capabilities"_a, "scale"_a = 1.0);
  module.def("clip_stiffness", &clip_stiffness, "options"_a, "capabilities"_a, "scale"_a = 1.0,
             "+ Changes the options in place.");
  module.def("validate", py::overload_cast<const RendererOptions&, const Capabilities&, double>(&validate), "options"_a,
             "capabilities"_a, "scale"_a = 1.0,
             "Raises InvalidValue naming an option out of range, or a stiffness or damping that would be clipped.");

  module.def(
      "option_values",
      [](const RendererOptions& options) {
        py::typing::Dict<py::str, py::str> values;
        for (const OptionValue& option : option_values(options)) values[option.name.c_str()] = option.value;
        return values;
      },
      "options"_a, "+ Values by name.");
  module.def("set_option", &set_option, "options"_a, "name"_a, "value"_a);

  add_struct<MotionMapping>(module)
      .def("to_page", mapped(&MotionMapping::to_page, "device"), "device"_a, "+ (3,) [m] to (3,) [m].")
      .def("to_device", mapped(&MotionMapping::to_device, "page"), "page"_a, "+ (3,) [m] to (3,) [m].")
      .def("force_to_device", mapped(&MotionMapping::force_to_device, "page"), "page"_a, "+ (3,) [N] to (3,) [N].");
  module.def("upright_page", &upright_page, "width"_a, "height"_a, "scale"_a = 1.0);
  module.def("desk_page", &desk_page, "width"_a, "height"_a, "scale"_a = 1.0);

  module.def("to_string", py::overload_cast<WritingHint>(&to_string), "hint"_a,
             "The name of a hint, such as \"too_far\"; for people hint_text() puts it into words.");
  module.def("to_string", py::overload_cast<InteractionState>(&to_string), "state"_a, "A state as in write_ticks().");
  module.def("to_string", py::overload_cast<TickStatus>(&to_string), "status"_a, "A status as in write_ticks().");
  const TickColumns columns(module);

  py::class_<HapticRenderer>(module, "HapticRenderer", py::is_final(),
                             "+ Raises Error while a running ServoLoop or another thread uses it.")
      .def(py::init<std::vector<PlacedCharacter>, const MotionMapping&, const Capabilities&, const RendererOptions&>(),
           "page"_a, "mapping"_a, "capabilities"_a, "options"_a = RendererOptions{})
      .def(
          "update",
          [](HapticRenderer& self, const DeviceState& state) {
            const AtWork at_work({AtWork::User::call}, nullptr, &self);  // a law in Python lets other threads run
            return updated(self, state);
          },
          "state"_a, "+ Raises what a guidance law in Python raised; the force ramps down to zero while it does.")
      .def("trace", &trace, "positions"_a, "times"_a = py::none(),
           "Processes positions (N, 3) in device axes [m], one per tick, at increasing times (N,) [s], by default at "
           "the servo rate from the last tick on. Returns N ticks (tick_dtype). Releases the GIL. After Ctrl-C or an "
           "exception of a guidance law, call restart().")
      .def("restart", [](HapticRenderer& self) { idle(self).restart(); })
      .def("skip_stroke", [](HapticRenderer& self) { return idle(self).skip_stroke(); })
      .def(
          "set_due",
          [](HapticRenderer& self, int character, int stroke) { return idle(self).set_due(character, stroke); },
          "character"_a, "stroke"_a)
      .def_property_readonly("last", [](const HapticRenderer& self) { return idle(self).last(); })
      .def_property_readonly("options", &HapticRenderer::options, py::return_value_policy::copy)
      .def_property_readonly("law", &HapticRenderer::law, py::return_value_policy::copy)
      .def_property_readonly("clipped", &HapticRenderer::clipped)
      .def_property_readonly("mapping", &HapticRenderer::mapping, py::return_value_policy::copy)
      .def_property_readonly("page",
                             [](const HapticRenderer& self) { return std::vector<PlacedCharacter>(self.page()); })
      .def("max_force_step", &HapticRenderer::max_force_step)
      .def("__repr__", [](const HapticRenderer& self) {
        return formatted("HapticRenderer(page of {} at {:g} Hz)", self.page().size(), self.options().servo_rate);
      });

  module.def("critical_stiffness", released(&critical_stiffness), "loop"_a);
  module.def("stiffness_for_any_hand", released(&stiffness_for_any_hand), "loop"_a, "velocity_cutoff"_a, "most"_a);
  module.def(
      "advise_stiffness", [](const SampledLoop& loop) { return as_dict(released(&advise_stiffness)(loop)); }, "loop"_a,
      "+ Returns a dict of the bounds, each a dict: value [N/m], formula and validity.");
  module.def("injectable_damping", released(&injectable_damping), "loop"_a);
}

}  // namespace calligraphy::python
