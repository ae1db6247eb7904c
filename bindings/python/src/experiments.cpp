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
  const ServoRateTradeoff r;
  const py::dtype columns =
      columns_of(r, "rate", r.rate, "stiffness", r.stiffness, "stable", r.stable, "penetration", r.penetration,
                 "path_error", r.path_error, "force_step", r.force_step, "written", r.written, "loop_stiffness",
                 r.loop_stiffness, "unlimited_stiffness", r.unlimited_stiffness, "held_stiffness", r.held_stiffness,
                 "free_stiffness", r.free_stiffness, "hard_stiffness", r.hard_stiffness, "hard_penetration",
                 r.hard_penetration, "hard_force_step", r.hard_force_step);
  return structured(columns,
                    released(&servo_rate_tradeoff)(characters, {rates, seeds, seed, device, interruptible(progress)}));
}

py::array coordinate_widths_cost(const std::vector<Character>& characters, const Progress& progress) {
  const CoordinateWidthTradeoff w;
  const py::dtype columns = columns_of(w, "bits", w.bits, "step", w.step, "max_error", w.max_error, "rms_error",
                                       w.rms_error, "bytes", w.bytes);
  return structured(columns, released(&coordinate_width_tradeoff)(characters, interruptible(progress)));
}

}  // namespace

void add_experiments(py::module_& module) {
  add_struct<WallContact>(module, "WallContact", "Contact of the pen with the wall in a simulation.",
                          &WallContact::push, "push: constant force towards the wall [N]", &WallContact::height,
                          "height: initial height of the pen [m]", &WallContact::seconds,
                          "seconds: duration, in virtual time [s]", &WallContact::controlled,
                          "controlled: a passivity controller follows the wall", &WallContact::lost,
                          "lost: share of the samples that are lost [1]", &WallContact::reordered,
                          "reordered: share of the samples that are swapped with the next one [1]");
  module.def(
      "simulate_wall_contact",
      [](const SampledLoop& loop, double stiffness, const WallContact& contact) {
        const WallContactResult outcome = released(&simulate_wall_contact)(loop, stiffness, contact);
        return py::dict("stable"_a = outcome.stable, "peak_to_peak"_a = outcome.peak_to_peak,
                        "max_force"_a = outcome.max_force, "last_force"_a = outcome.last_force);
      },
      "loop"_a, "stiffness"_a, "contact"_a = WallContact{},
      "Simulates a pen on a wall of this stiffness [N/m], in virtual time. Returns a dict: `stable`, the pen comes to "
      "rest; its `peak_to_peak` amplitude at the end [m]; `max_force` sent, and `last_force`, the maximum at the end "
      "[N].");
  using O = StabilityMapOptions;
  add_struct<O>(
      module, "StabilityMapOptions", "Options of a stability map; the grid has every combination of the lists.",
      &O::device, "device: Capabilities, of which one property at a time is varied", &O::contact,
      "contact: WallContact", &O::per_decade, "per_decade: number of stiffnesses per decade", &O::min_stiffness,
      "min_stiffness [N/m]", &O::max_stiffness, "max_stiffness [N/m]", &O::coulomb_friction,
      "coulomb_friction: of loops with quantised positions [N]", &O::dampings,
      "dampings: viscous, of the device, copied [N s/m]", &O::rates, "rates: copied [Hz]", &O::delays,
      "delays: copied [ticks]", &O::encoder_steps, "encoder_steps: copied [m]", &O::wall_dampings,
      "wall_dampings: copied [N s/m]", &O::grips, "grips: list of GripImpedance, copied", &O::with_sweeps,
      "with_sweeps: whether to vary one property at a time", &O::with_grid, "with_grid: whether to simulate the grid");
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
        return py::dict("stiffnesses"_a = Doubles(count, map.stiffnesses.data()), "sweeps"_a = sweeps,
                        "grid"_a = as_table(map.grid, count));
      },
      "options"_a = O{}, "progress"_a = py::none(),
      "Maps where a virtual wall is stable, on all cores; progress(share) is called from time to time. Takes minutes "
      "with the defaults. Returns a dict: `stiffnesses` (n,) [N/m]; `grid`, a structured array with one row per loop: "
      "its properties, the bounds passive, quantised, stable and approximate [N/m], stable_at (n,), per stiffness, and "
      "max_stable, below which all are stable [N/m]; controlled_: with a passivity controller; below_peak: and the "
      "force below the peak; `sweeps`, by name: label, values, and lines as in the grid.");

  module.def("nearest_point_tradeoff", &nearest_points_cost, "characters"_a, "queries"_a = 4000, "rounds"_a = 21,
             "seed"_a = 1, "progress"_a = py::none(),
             "Cost and accuracy of each nearest-point method at each setting, as a structured array: name, method, "
             "tolerance, samples and refinements; on `real` strokes, `hard` curves and tracking a pen in `ticks`: ns "
             "per query (median), ns_p90 and batch_ns; error (median), error_p99 and error_worst, relative to the size "
             "of the curve; wrong, the share of wrong branches.");
  module.def("servo_rate_tradeoff", &servo_rates_cost, "characters"_a, "rates"_a = ServoRateTradeoffOptions{}.rates,
             "seeds"_a = 3, "seed"_a = 1, "device"_a = "desktop", "progress"_a = py::none(),
             "A simulated novice writes in closed loop at each rate [Hz]. Returns a structured array: stiffness of the "
             "paper [N/m], stable, penetration [m], RMS path_error [m], force_step [N], written, the share of strokes "
             "completed, and maximum stable stiffnesses [N/m]: loop_, unlimited_ without a limit on the rate of the "
             "normal force, held_ in the writer's hand, free_ with the device released; hard_: half of "
             "unlimited_stiffness, and its results. Takes minutes with the defaults.");
  module.def("coordinate_width_tradeoff", &coordinate_widths_cost, "characters"_a, "progress"_a = py::none(),
             "Control points rounded to 2^bits positions along each edge, bits from 4 to 16, as a structured array: "
             "step of the grid, max_error and rms_error of the strokes, in both directions [em]; bytes per character.");

  add_enum(module, "Attractor", "What attracts the pen.", Attractor::nearest_stroke, "active_stroke nearest_stroke");
  module.def(
      "guidance_field",
      [](const PlacedCharacter& placed, int stroke, double progress, const ArrayLike& corner, double edge, int columns,
         double stiffness, Attractor attractor, const StrokeOptions& stroke_options) {
        ForceFieldOptions options;
        options.attractor = attractor;
        options.stroke = stroke_options;
        options.stiffness = stiffness;
        options.columns = columns;
        options.progress = interruptible(std::nullopt);
        ForceField field = released(&guidance_field)(placed, stroke, progress, point(corner, "corner"), edge, options);
        const ForceJump jump{};
        const py::dtype jump_type = columns_of(jump, "begin", jump.begin, "end", jump.end, "size", jump.size,
                                               "from_stroke", jump.from_stroke, "passes_feature", jump.passes_feature);
        const py::object forces = array_of_points(field.forces).attr("reshape")(columns, columns, 2);
        return py::dict("forces"_a = forces, "jumps"_a = structured(jump_type, std::move(field.jumps)));
      },
      "placed"_a, "stroke"_a, "progress"_a, "corner"_a, "edge"_a, "columns"_a = 96, "stiffness"_a = 600.0,
      "attractor"_a = Attractor::active_stroke, "options"_a = StrokeOptions{},
      "Attraction of eq. (8) on a pen that has written a share `progress` of a stroke, at each cell of a square with "
      "lower left `corner` (2,) and this edge [m]. Returns a dict: `forces` (rows, columns, 2), bottom row first [N]; "
      "`jumps`, a structured array of the segments across which the force jumps: begin, end (2,) [m], size [N], "
      "from_stroke, the distance from the active stroke [m], passes_feature, crossed only once, in order.");
}

}  // namespace calligraphy::python
