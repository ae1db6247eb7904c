// What accuracy costs and what is stable: trades, walls and force fields, as the practice room has them.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <calligraphy/experiments/force_field.hpp>
#include <calligraphy/experiments/nearest_point_workload.hpp>
#include <calligraphy/experiments/stability_map.hpp>
#include <calligraphy/experiments/trade.hpp>

#include "enumeration.hpp"
#include "interrupt.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;

void add_walls(py::module_& module) {
  Record<WallEncounter>(module, "WallEncounter", "How the pen meets the wall in a simulation.")
      .field("push", &WallEncounter::push, "steady force towards the wall [N]")
      .field("height", &WallEncounter::height, "from which the pen falls [m]")
      .field("seconds", &WallEncounter::seconds, "of virtual time")
      .field("controlled", &WallEncounter::controlled, "a passivity controller follows the wall")
      .field("lost", &WallEncounter::lost, "share of the samples that do not arrive")
      .field("reordered", &WallEncounter::reordered, "share that change places with the next one");
  Record<WallOutcome>(module, "WallOutcome", "What became of the pen.")
      .field("settles", &WallOutcome::settles, "it comes to rest")
      .field("swing", &WallOutcome::swing, "from peak to peak, at the end [m]")
      .field("largest_force", &WallOutcome::largest_force, "sent [N]")
      .field("last_force", &WallOutcome::last_force, "largest at the end [N]");
  module.def("meet_wall", &meet_wall, py::arg("loop"), py::arg("stiffness"), py::arg("encounter") = WallEncounter{},
             Release(), "One pen on one wall of this stiffness [N/m], in virtual time.");

  Record<StabilityLine>(module, "StabilityLine", "Every stiffness against one loop.")
      .field("loop", &StabilityLine::loop, "SampledLoop")
      .field("passive", &StabilityLine::passive, "[N/m]")
      .field("quantised", &StabilityLine::quantised, "[N/m]")
      .field("stable", &StabilityLine::stable, "[N/m]")
      .field("approximate", &StabilityLine::approximate, "[N/m]")
      .field("settles", &StabilityLine::settles, "for each stiffness of the map, copied")
      .field("controlled_settles", &StabilityLine::controlled_settles, "the same with the controller, copied")
      .field("largest", &StabilityLine::largest, "below which no stiffness tried is unstable [N/m]")
      .field("controlled_largest", &StabilityLine::controlled_largest, "the same with the controller [N/m]")
      .field("controlled_within_peak", &StabilityLine::controlled_within_peak, "and within the peak force [N/m]");
  Record<StabilitySweep>(module, "StabilitySweep", "One property of the loop varied.")
      .field("name", &StabilitySweep::name, "for example damping")
      .field("label", &StabilitySweep::label, "with its unit")
      .field("values", &StabilitySweep::values, "one per line, copied")
      .field("lines", &StabilitySweep::lines, "list of StabilityLine, copied");
  Record<StabilityMap>(module, "StabilityMap", "Where a virtual wall is stable.")
      .field("device", &StabilityMap::device, "Capabilities")
      .field("encounter", &StabilityMap::encounter, "WallEncounter")
      .field("stiffnesses", &StabilityMap::stiffnesses, "that every line was tried at [N/m]")
      .field("sweeps", &StabilityMap::sweeps, "list of StabilitySweep, copied")
      .field("grid", &StabilityMap::grid, "list of StabilityLine, copied");
  using O = StabilityMapOptions;
  Record<O>(module, "StabilityMapOptions", "What a stability map tries.")
      .field("device", &O::device, "Capabilities")
      .field("encounter", &O::encounter, "WallEncounter")
      .field("per_decade", &O::per_decade, "stiffnesses that are tried")
      .field("softest", &O::softest, "[N/m]")
      .field("stiffest", &O::stiffest, "[N/m]")
      .field("coulomb_friction", &O::coulomb_friction, "of the loops whose positions are rounded [N]")
      .field("dampings", &O::dampings, "of the grid, copied [N s/m]")
      .field("rates", &O::rates, "copied [Hz]")
      .field("delays", &O::delays, "copied [ticks]")
      .field("encoder_steps", &O::encoder_steps, "copied [m]")
      .field("wall_dampings", &O::wall_dampings, "copied [N s/m]")
      .field("grips", &O::grips, "list of Hand, copied")
      .field("with_sweeps", &O::with_sweeps, "whether to try the sweeps")
      .field("with_grid", &O::with_grid, "whether to try the grid");
  module.def(
      "stability_map",
      [](O options, std::function<void(double)> progress) {
        options.progress = interruptible(std::move(progress));
        return stability_map(options);
      },
      py::arg("options") = O{}, py::arg("progress") = py::none(), Release(),
      "The map, on every core; progress(share) is called now and then. With all defaults this takes minutes.");
}

void add_trades(py::module_& module) {
  py::class_<NearestPointCost>(module, "NearestPointCost", "What a method costs and how right it is.")
      .def_readonly("queries", &NearestPointCost::queries, "which ones")
      .def_readonly("ns", &NearestPointCost::ns, "per query, median [ns]")
      .def_readonly("ns_p90", &NearestPointCost::ns_p90, "[ns]")
      .def_readonly("batch_ns", &NearestPointCost::batch_ns, "per query in batches [ns]")
      .def_readonly("error", &NearestPointCost::error, "median, in sizes of the curve")
      .def_readonly("error_p99", &NearestPointCost::error_p99)
      .def_readonly("error_worst", &NearestPointCost::error_worst)
      .def_readonly("wrong", &NearestPointCost::wrong, "share of wrong branches")
      .def("__repr__", [](const NearestPointCost& self) {
        return told("NearestPointCost({}: {:.0f} ns, error {:.3g}, wrong {:.3g})", self.queries, self.ns, self.error,
                    self.wrong);
      });
  py::class_<NearestPointTrade>(module, "NearestPointTrade", "A method at a setting, its costs and its errors.")
      .def_property_readonly("name", [](const NearestPointTrade& self) { return self.setting.name; })
      .def_property_readonly("options", [](const NearestPointTrade& self) { return self.setting.options; })
      .def_readonly("real", &NearestPointTrade::real, "on real strokes")
      .def_readonly("hard", &NearestPointTrade::hard, "on hostile curves")
      .def_readonly("ticks", &NearestPointTrade::ticks, "following a pen along whole strokes")
      .def("__repr__", [](const py::object& self) {
        return told("NearestPointTrade({}, {!r})", self.attr("name"), self.attr("real"));
      });
  module.def(
      "nearest_point_trade",
      [](const std::vector<Character>& characters, int queries, int rounds, std::uint64_t seed,
         std::function<void(double)> progress) {
        NearestPointTradeOptions options;
        options.queries = queries;
        options.rounds = rounds;
        options.seed = seed;
        options.progress = interruptible(std::move(progress));
        return nearest_point_trade(characters, options);
      },
      py::arg("characters"), py::arg("queries") = 4000, py::arg("rounds") = 21, py::arg("seed") = 1,
      py::arg("progress") = py::none(), Release(),
      "One entry per method and setting; all but times is the same in every run.");
  using S = ServoRateTrade;
  Record<S>(module, "ServoRateTrade", "A simulated novice writes in closed loop at one servo rate.")
      .field("rate", &S::rate, "[Hz]")
      .field("stiffness", &S::stiffness, "of the paper, the default [N/m]")
      .field("stable", &S::stable, "a pen that is pressed on this paper comes to rest")
      .field("penetration", &S::penetration, "largest, while the paper is solid [m]")
      .field("path_error", &S::path_error, "RMS, lateral [m]")
      .field("force_step", &S::force_step, "largest, from one tick to the next [N]")
      .field("written", &S::written, "share of the strokes that were completed")
      .field("loop_stiffness", &S::loop_stiffness, "largest of the paper at which a pressed pen comes to rest [N/m]")
      .field("unlimited_stiffness", &S::unlimited_stiffness, "with no limit on the rate of the normal force [N/m]")
      .field("held_stiffness", &S::held_stiffness, "critical_stiffness() in the writer's hand [N/m]")
      .field("free_stiffness", &S::free_stiffness, "critical_stiffness() of the device let go [N/m]")
      .field("hard_stiffness", &S::hard_stiffness, "half of unlimited_stiffness [N/m]")
      .field("hard_penetration", &S::hard_penetration, "on such paper [m]")
      .field("hard_force_step", &S::hard_force_step, "on such paper [N]");
  module.def(
      "servo_rate_trade",
      [](const std::vector<Character>& characters, const std::vector<double>& rates, int seeds, std::uint64_t seed,
         const std::string& device, std::function<void(double)> progress) {
        const ServoRateTradeOptions options{rates, seeds, seed, device, interruptible(std::move(progress))};
        return servo_rate_trade(characters, options);
      },
      py::arg("characters"), py::arg("rates") = ServoRateTradeOptions{}.rates, py::arg("seeds") = 3,
      py::arg("seed") = 1, py::arg("device") = "desktop", py::arg("progress") = py::none(), Release(),
      "One entry per rate, the same in every run; progress(share) is called now and then. Minutes with all defaults.");
  using W = CoordinateWidthTrade;
  Record<W>(module, "CoordinateWidthTrade", "Control points rounded to a grid of 2^bits places along each edge.")
      .field("bits", &W::bits, "per coordinate")
      .field("step", &W::step, "of the grid [em]")
      .field("largest_error", &W::largest_error, "between the strokes as they are and as stored, both ways [em]")
      .field("rms_error", &W::rms_error, "over their length, both ways [em]")
      .field("bytes", &W::bytes, "per character");
  module.def("with_coordinate_width", &with_coordinate_width, py::arg("character"), py::arg("bits"),
             "The character with its control points on the grid, 1 to 32 bits.");
  module.def(
      "coordinate_width_trade",
      [](const std::vector<Character>& characters, std::function<void(double)> progress) {
        return coordinate_width_trade(characters, interruptible(std::move(progress)));
      },
      py::arg("characters"), py::arg("progress") = py::none(), Release(),
      "One entry per width from 4 to 16 bits; progress(share) is called now and then.");
  const char* const plot = "SVG text by gnuplot; can_plot() says whether it is there.";
  module.def(
      "nearest_point_trade_plot",
      [](const std::vector<NearestPointTrade>& trade) { return nearest_point_trade_plot(trade); }, py::arg("trade"),
      Release(), plot);
  module.def(
      "servo_rate_trade_plot", [](const std::vector<ServoRateTrade>& trade) { return servo_rate_trade_plot(trade); },
      py::arg("trade"), Release(), plot);
  module.def(
      "coordinate_width_trade_plot",
      [](const std::vector<CoordinateWidthTrade>& trade) { return coordinate_width_trade_plot(trade); },
      py::arg("trade"), Release(), plot);
  module.def(
      "curve_control_points",
      [](const std::vector<Character>& characters, double em) {
        py::list result;
        for (const auto& curve : curve_control_points(characters, em)) result.append(array_of_points(curve));
        return result;
      },
      py::arg("characters"), py::arg("em") = 0.04, "(4, 2) of every cubic curve, on squares of `em` [m].");
}

py::dtype jump_type() {
  const ForceJump jump{};
  return Columns<ForceJump>()
      .add("begin", jump, jump.begin)
      .add("end", jump, jump.end)
      .add("size", jump, jump.size)
      .add("from_stroke", jump, jump.from_stroke)
      .add("passes_feature", jump, jump.passes_feature)
      .dtype();
}

void add_figures(py::module_& module) {
  using Panel = ForceFieldFigure::Panel;
  py::class_<Panel>(module, "ForceFieldPanel", "One rule of a figure (ForceFieldFigure::Panel in C++).")
      .def_readonly("name", &Panel::name)
      .def_readonly("fades_in", &Panel::fades_in, "guidance comes in gradually where a feature point is passed")
      .def_readonly("field", &Panel::field, "ForceField")
      .def("__repr__", [](const py::object& self) { return told("ForceFieldPanel({!r})", self.attr("name")); });
  using F = ForceFieldFigure;
  py::class_<F>(module, "ForceFieldFigure", "One case of ambiguity on a real stroke: the same pen under several rules.")
      .def_readonly("name", &F::name, "bend, corner, parallel or crossed")
      .def_readonly("title", &F::title, "for a person")
      .def_readonly("placed", &F::placed, "PlacedCharacter")
      .def_readonly("stroke", &F::stroke, "the active one, by index")
      .def_readonly("progress", &F::progress, "share of its length")
      .def_property_readonly(
          "pen", [](const F& self) { return array_of(self.pen); }, "the stroke's point at `progress`, (2,) [m]")
      .def_property_readonly(
          "panels", [](const F& self) { return std::vector<Panel>(self.panels); },
          "list of ForceFieldPanel, copied: the nearest stroke, the rules as printed, the default")
      .def("__repr__", [](const py::object& self) { return told("ForceFieldFigure({!r})", self.attr("name")); });
  module.def("ambiguity_figures", &ambiguity_figures, py::arg("columns") = 96, Release(),
             "Figs. 25 to 28 on built-in characters; columns: places per edge of each square.");
  module.def("force_field_picture", &force_field_picture, py::arg("figure"), Release(),
             "SVG text: the size of the force as colour, its direction as arrows, its jumps as lines.");
}

void add_fields(py::module_& module) {
  Enumeration<Attractor>(module, "Attractor")
      .value("active_stroke", Attractor::active_stroke)
      .value("nearest_stroke", Attractor::nearest_stroke);
  py::class_<ForceField>(module, "ForceField", "The guidance force on a resting pen over a square of the page.")
      .def_property_readonly(
          "corner", [](const ForceField& self) { return array_of(self.corner); }, "(2,) [m]")
      .def_readonly("edge", &ForceField::edge, "[m]")
      .def_readonly("columns", &ForceField::columns, "and as many rows")
      .def_property_readonly(
          "forces",
          [](const py::object& self) {
            const auto& field = self.cast<const ForceField&>();
            return view(field.forces.empty() ? nullptr : field.forces.front().data(), {field.columns, field.columns, 2},
                        self, false);
          },
          "(rows, columns, 2), rows from below, read only [N]")
      .def_property_readonly(
          "jumps", [](const ForceField& self) { return structured(jump_type(), std::vector<ForceJump>(self.jumps)); },
          "Where the force jumps, a structured array (m,), copied: begin, end (2,) [m], size [N], from_stroke, the\n"
          "distance from the active stroke [m], passes_feature, which is crossed once, in order.")
      .def("largest_force", &ForceField::largest_force, "[N]")
      .def("__repr__", [](const ForceField& self) {
        return told("ForceField({0} x {0} places, edge {1:.6g} m)", self.columns, self.edge);
      });
  module.def(
      "guidance_field",
      [](const PlacedCharacter& placed, int stroke, double progress, const ArrayLike& corner, double edge, int columns,
         double stiffness, Attractor attractor, const StrokeRules& rules) {
        ForceFieldOptions options;
        options.attractor = attractor;
        options.rules = rules;
        options.stiffness = stiffness;
        options.columns = columns;
        options.progress = interruptible(nullptr);
        const Point where = point(corner, "corner");
        const py::gil_scoped_release release;
        return guidance_field(placed, stroke, progress, where, edge, options);
      },
      py::arg("placed"), py::arg("stroke"), py::arg("progress"), py::arg("corner"), py::arg("edge"),
      py::arg("columns") = 96, py::arg("stiffness") = 600.0, py::arg("attractor") = Attractor::active_stroke,
      py::arg("rules") = StrokeRules{}, "The attraction of eq. (8) at each place of a square [m].");
}

}  // namespace

void add_trials(py::module_& module) {
  add_walls(module);
  add_trades(module);
  add_fields(module);
  add_figures(module);
}

}  // namespace calligraphy::python
