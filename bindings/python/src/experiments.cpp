// Trade-offs, stability maps and force fields.
#include <calligraphy/experiments/force_field.hpp>
#include <calligraphy/experiments/stability_map.hpp>
#include <calligraphy/experiments/tradeoff.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// One row per loop, with one result per stiffness.
py::array as_table(const std::vector<StabilityLine>& lines, std::size_t stiffnesses) {
  py::list rows;
  for (const StabilityLine& line : lines) {
    const SampledLoop& loop = line.loop;
    const Capabilities& device = loop.device;
    rows.append(py::make_tuple(loop.rate, device.apparent_mass, device.viscous_friction, device.coulomb_friction,
                               device.encoder_step, device.sample_delay, loop.wall_damping,
                               py::make_tuple(loop.grip.mass, loop.grip.damping, loop.grip.stiffness), line.passive,
                               line.quantised, line.stable, line.approximate, line.stable_at, line.controlled_stable_at,
                               line.max_stable, line.controlled_max_stable, line.controlled_max_stable_below_peak));
  }
  const std::string each = "(" + std::to_string(stiffnesses) + ",)?";
  return table(
      rows, dtype_of("rate:f8 apparent_mass:f8 viscous_friction:f8 coulomb_friction:f8 encoder_step:f8 sample_delay:i4 "
                     "wall_damping:f8 grip:3f8 passive:f8 quantised:f8 stable:f8 approximate:f8 stable_at:" +
                     each + " controlled_stable_at:" + each +
                     " max_stable:f8 controlled_max_stable:f8 controlled_max_stable_below_peak:f8"));
}

py::tuple as_row(const NearestPointCost& cost) {
  return py::make_tuple(cost.ns, cost.ns_p90, cost.batch_ns, cost.error, cost.error_p99, cost.error_worst, cost.wrong);
}

py::array nearest_points_cost(const std::vector<Character>& characters, int queries, int rounds, std::uint64_t seed,
                              const Progress& progress) {
  NearestPointTradeoffOptions options;
  options.queries = queries;
  options.rounds = rounds;
  options.seed = seed;
  options.progress = interruptible(progress);
  py::list rows;
  for (const NearestPointTradeoff& entry : released (&nearest_point_tradeoff)(characters, options)) {
    const NearestPointOptions& setting = entry.setting.options;
    rows.append(py::make_tuple(entry.setting.name, to_string(setting.method), setting.tolerance, setting.samples,
                               setting.refinements, as_row(entry.real), as_row(entry.hard), as_row(entry.ticks)));
  }
  py::list dtype = dtype_of("name:U32 method:U16 tolerance:f8 samples:i4 refinements:i4");
  for (const char* const queries_on : {"real", "hard", "ticks"}) {
    dtype.append(py::make_tuple(queries_on,
                                dtype_of("ns:f8 ns_p90:f8 batch_ns:f8 error:f8 error_p99:f8 error_worst:f8 wrong:f8")));
  }
  return table(rows, dtype);
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
        const StabilityMap map = released(&stability_map)(options);
        const std::size_t count = map.stiffnesses.size();
        py::dict sweeps;
        for (const StabilitySweep& sweep : map.sweeps) {
          sweeps[sweep.name.c_str()] =
              py::dict("label"_a = sweep.label, "values"_a = sweep.values, "lines"_a = as_table(sweep.lines, count));
        }
        return py::dict("stiffnesses"_a = as_numbers(map.stiffnesses), "sweeps"_a = sweeps,
                        "grid"_a = as_table(map.grid, count));
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
        ForceFieldOptions options;
        options.attractor = attractor;
        options.stroke = rules;
        options.stiffness = stiffness;
        options.columns = columns;
        options.progress = interruptible(std::nullopt);
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
