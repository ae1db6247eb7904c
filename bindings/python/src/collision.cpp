// Nearest points in batches, and the rules of the active stroke.
#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/collision/nearest_point.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// Fewer queries than this are answered with the GIL held: releasing it alone costs about 0.1 us.
constexpr py::ssize_t few = 64;

StrokeElement element_of(const ArrayLike& control_points) {
  const Doubles array = doubles(control_points, "control_points", 2);
  const py::ssize_t count = array.shape(0);
  if (count < 2 || count > max_curve_degree + 1) {
    throw ValueError("control_points: expected shape (2, 2) to (5, 2), got (" + std::to_string(count) + ", 2)");
  }
  return prepare_element({reinterpret_cast<const Point*>(array.data()), static_cast<std::size_t>(count)});
}

/// Results of many queries, as parts of one array, because large arrays are slow to allocate and free.
struct NearestPoints {
  Doubles parameter, point, distance, tangent;
  py::array_t<std::uint8_t> status;
};

NearestPoints ask(const std::variant<const StrokeElement*, ArrayLike>& control_points, const ArrayLike& queries,
                  const Given<NearestPointMethod>& method, double tolerance, int samples, int refinements) {
  const NearestPointOptions options = {converted(method, "method"), tolerance, samples, refinements};
  validate(options);
  const auto* const prepared = std::get_if<const StrokeElement*>(&control_points);
  const StrokeElement element = prepared != nullptr ? **prepared : element_of(std::get<ArrayLike>(control_points));
  const Doubles array = doubles(queries, "queries", 2);
  const py::ssize_t count = array.shape(0);
  const std::span asked(reinterpret_cast<const Point*>(array.data()), static_cast<std::size_t>(count));
  const Doubles all(6 * count);
  const auto part = [&](std::vector<py::ssize_t> shape, py::ssize_t first) {
    return Doubles(std::move(shape), all.data() + first * count, all);
  };
  NearestPoints result = {part({count}, 0), part({count, 2}, 1), part({count}, 3), part({count, 2}, 4),
                          py::array_t<std::uint8_t>(count)};
  Eigen::Map<Eigen::VectorXd> parameter(result.parameter.mutable_data(), count);
  Eigen::Map<Eigen::VectorXd> distance(result.distance.mutable_data(), count);
  Eigen::Map<Eigen::Matrix2Xd> point(result.point.mutable_data(), 2, count);
  Eigen::Map<Eigen::Matrix2Xd> tangent(result.tangent.mutable_data(), 2, count);
  std::uint8_t* const status = result.status.mutable_data();
  std::optional<py::gil_scoped_release> release;
  if (count >= few) release.emplace();
  Interrupt interrupt;
  std::array<NearestPoint, 256> block;  // stays in the processor's cache
  for (std::size_t done = 0; done < asked.size(); done += block.size()) {
    if (release) interrupt.check();
    const std::size_t size = std::min(block.size(), asked.size() - done);
    nearest_points(element, asked.subspan(done, size), std::span(block).first(size), options);
    for (std::size_t i = 0; i < size; ++i) {
      const auto at = static_cast<py::ssize_t>(done + i);
      parameter[at] = block[i].parameter;
      distance[at] = block[i].distance;
      point.col(at) = block[i].point;
      tangent.col(at) = block[i].tangent;
      status[at] = static_cast<std::uint8_t>(block[i].status);
    }
  }
  return result;
}

/// A function of the parameter, for one value or many.
template <class Function>
auto at_parameters(Function function) {
  return [function](const StrokeElement& self, const ArrayLike& t) {
    bool one = false;
    const Doubles parameters = one_or_many(t, "t", 0, one);
    Doubles result({parameters.size(), py::ssize_t{2}});
    Eigen::Map<Eigen::Matrix2Xd> values(result.mutable_data(), 2, parameters.size());
    for (py::ssize_t i = 0; i < parameters.size(); ++i) values.col(i) = (self.*function)(parameters.data()[i]);
    return one ? Doubles(result[py::int_(0)]) : result;
  };
}

std::variant<double, Doubles> curvature(const StrokeElement& self, const ArrayLike& t) {
  bool one = false;
  const Doubles parameters = one_or_many(t, "t", 0, one);
  if (one) return self.curvature(*parameters.data());
  Doubles result(parameters.size());
  std::transform(parameters.data(), parameters.data() + parameters.size(), result.mutable_data(),
                 [&](double each) { return self.curvature(each); });
  return result;
}

}  // namespace

void add_collision(py::module_& module) {
  add_types<NearestPointStatus, StrokeOptions>(module);

  py::class_<NearestPoints>(module, "NearestPoints", "Results of N queries, one array per property.")
      .def(py::init<Doubles, Doubles, Doubles, Doubles, py::array_t<std::uint8_t>>(), "parameter"_a, "point"_a,
           "distance"_a, "tangent"_a, "status"_a)
      .def_readonly("parameter", &NearestPoints::parameter, "(N,) in [0, 1]")
      .def_readonly("point", &NearestPoints::point, "(N, 2), on the element, in the unit of the control points")
      .def_readonly("distance", &NearestPoints::distance, "(N,), from query to point; infinite if not finite")
      .def_readonly("tangent", &NearestPoints::tangent, "(N, 2), unit vectors in writing direction")
      .def_readonly("status", &NearestPoints::status, "(N,), values of NearestPointStatus, uint8")
      .def_property_readonly(
          "certified",
          [](const NearestPoints& self) -> py::array_t<bool> {
            return self.status.attr("__eq__")(static_cast<int>(NearestPointStatus::certified));
          },
          "(N,), bool: no other point of the element is nearer, within the tolerance and rounding")
      .def("__len__", [](const NearestPoints& self) { return self.parameter.size(); });

  py::class_<StrokeElement>(module, "StrokeElement",
                            "+ Control points (2, 2) to (5, 2), in any unit; all other lengths are in the same unit.")
      .def(py::init(&element_of), "control_points"_a)
      .def_property_readonly("degree", &StrokeElement::degree)
      .def_property_readonly("size", &StrokeElement::size)
      .def_property_readonly("length", &StrokeElement::length)
      .def("point", at_parameters(&StrokeElement::point), "t"_a, "+ (2,) at one parameter, (N, 2) at N.")
      .def("derivative", at_parameters(&StrokeElement::derivative), "t"_a, "+ (2,) at one parameter, (N, 2) at N.")
      .def("tangent", at_parameters(&StrokeElement::tangent), "t"_a, "+ (2,) at one parameter, (N, 2) at N.")
      .def("curvature", &curvature, "t"_a, "+ A float at one parameter, (N,) at N.")
      .def("arc_length", &StrokeElement::arc_length, "t"_a)
      .def("parameter_at", &StrokeElement::parameter_at, "arc_length"_a)
      .def("__repr__", [](const StrokeElement& self) {
        return formatted("StrokeElement(degree {}, length {:.6g})", self.degree(), self.length());
      });

  module.def("nearest_point", &ask, "control_points"_a, "queries"_a, "method"_a = "exact", "tolerance"_a = 1e-9,
             "samples"_a = 16, "refinements"_a = 2,
             "Nearest points of N queries on one element. Releases the GIL.\n\ncontrol_points: (2, 2) to (5, 2), a "
             "Bezier curve of degree 1 to 4, or a prepared StrokeElement; queries: (N, 2), not copied if they are "
             "contiguous float64; both in the same unit. method: a NearestPointMethod or its name; tolerance: relative "
             "to the element's size. A query that is not finite has an infinite distance and is not certified. Raises "
             "InvalidValue naming the argument.");

  add_struct<StrokePlace>(module);
  py::class_<ActiveStroke>(module, "ActiveStroke", "The stroke that is due, as passed to begin() of a guidance law.")
      .def_property_readonly("length", &ActiveStroke::length)
      .def("at", &ActiveStroke::at, "arc"_a);
  module.def("place_elements", &place_elements, "stroke"_a, "placement"_a);
}

}  // namespace calligraphy::python
