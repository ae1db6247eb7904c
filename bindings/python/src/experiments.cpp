// Trade-offs, stability maps and force fields.
#include <calligraphy/experiments/force_field.hpp>
#include <calligraphy/experiments/stability_map.hpp>
#include <calligraphy/experiments/tradeoff.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

py::array nearest_points_cost(const std::vector<Character>& characters, int queries, int rounds, std::uint64_t seed,
                              const Progress& progress) {
  const NearestPointTradeoffOptions options = {
      .queries = queries, .rounds = rounds, .seed = seed, .progress = interruptible(progress)};
  return in_tables("nearest_point_tradeoff", as_dicts(released(&nearest_point_tradeoff)(characters, options)));
}

py::array servo_rates_cost(const std::vector<Character>& characters, const std::vector<double>& rates, int seeds,
                           std::uint64_t seed, const std::string& device, const Progress& progress) {
  return structured(released(&servo_rate_tradeoff)(characters, {rates, seeds, seed, device, interruptible(progress)}));
}

py::array coordinate_widths_cost(const std::vector<Character>& characters, const Progress& progress) {
  return structured(released(&coordinate_width_tradeoff)(characters, interruptible(progress)));
}

}  // namespace

void add_experiments(py::module_& module) {
  add_types<WallContact, StabilityMapOptions, Attractor>(module);
  module.def(
      "simulate_wall_contact",
      [](const SampledLoop& loop, double stiffness, const WallContact& contact) {
        return as_dict(released(&simulate_wall_contact)(loop, stiffness, contact));
      },
      "loop"_a, "stiffness"_a, "contact"_a = WallContact{}, ("+ " + fields_text<WallContactResult>()).c_str());
  module.def(
      "stability_map",
      [](StabilityMapOptions options, const Progress& progress) {
        options.progress = interruptible(progress);
        return py::dict(in_tables("stability_map", as_dict(released(&stability_map)(options))));
      },
      "options"_a = StabilityMapOptions{}, "progress"_a = py::none(),
      "+ Takes minutes with the defaults. Returns a dict: `stiffnesses` (n,) [N/m]; `grid`, a structured array of "
      "loops: their properties and bounds [N/m], `stable_at` (n,), whether each stiffness is stable, and `max_stable`, "
      "below which all are; controlled_: with a passivity controller; `sweeps` by name: label, values, and lines as in "
      "the grid.");

  module.def("nearest_point_tradeoff", &nearest_points_cost, "characters"_a, "queries"_a = 4000, "rounds"_a = 21,
             "seed"_a = 1, "progress"_a = py::none(),
             "+ Returns a structured array: name, method, tolerance, samples and refinements; on `real` strokes, "
             "`hard` curves and tracking a pen in `ticks`: ns per query (median), ns_p90 and batch_ns; error (median), "
             "error_p99 and error_worst, relative to the size of the curve; wrong, the share of wrong branches.");
  module.def("servo_rate_tradeoff", &servo_rates_cost, "characters"_a, "rates"_a = ServoRateTradeoffOptions{}.rates,
             "seeds"_a = 3, "seed"_a = 1, "device"_a = "desktop", "progress"_a = py::none(),
             ("+ Takes minutes with the defaults. " + fields_text<ServoRateTradeoff>("A structured array")).c_str());
  module.def("coordinate_width_tradeoff", &coordinate_widths_cost, "characters"_a, "progress"_a = py::none(),
             ("+ " + fields_text<CoordinateWidthTradeoff>("A structured array")).c_str());

  module.def(
      "guidance_field",
      [](const PlacedCharacter& placed, int stroke, double progress, const ArrayLike& corner, double edge, int columns,
         double stiffness, Attractor attractor, const StrokeOptions& rules) {
        const ForceFieldOptions options = {.attractor = attractor,
                                           .stroke = rules,
                                           .stiffness = stiffness,
                                           .columns = columns,
                                           .progress = interruptible(std::nullopt)};
        ForceField field = released(&guidance_field)(placed, stroke, progress, point(corner, "corner"), edge, options);
        const py::object forces = array_of_points(field.forces).attr("reshape")(columns, columns, 2);
        return py::dict("forces"_a = forces, "jumps"_a = structured(std::move(field.jumps)));
      },
      "placed"_a, "stroke"_a, "progress"_a, "corner"_a, "edge"_a, "columns"_a = 96, "stiffness"_a = 600.0,
      "attractor"_a = Attractor::active_stroke, "options"_a = StrokeOptions{},
      ("+ `corner` (2,) is the lower left of the square [m]. Returns a dict: forces (rows, columns, 2), bottom row "
       "first [N]; jumps: " +
       fields_text<ForceJump>("A structured array"))
          .c_str());
}

}  // namespace calligraphy::python
