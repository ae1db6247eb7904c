// Nearest points in batches, and the rules of the active stroke.
#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/collision/nearest_stroke_point.hpp>

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

/// Allocates the results, then writes them without the GIL.
class NearestPointWriter {
 public:
  explicit NearestPointWriter(py::ssize_t count)
      : NearestPointWriter(count, Doubles(6 * count), py::array_t<std::uint8_t>(count)) {}

  void write(py::ssize_t at, const NearestPoint& found) {
    parameter_[at] = found.parameter;
    distance_[at] = found.distance;
    point_.col(at) = found.point;
    tangent_.col(at) = found.tangent;
    status_[at] = static_cast<std::uint8_t>(found.status);
  }
  const NearestPoints& results() const { return results_; }

 private:
  NearestPointWriter(py::ssize_t count, Doubles all, py::array_t<std::uint8_t> status)
      : parameter_(all.mutable_data(), count),
        distance_(parameter_.data() + 3 * count, count),
        point_(parameter_.data() + count, 2, count),
        tangent_(parameter_.data() + 4 * count, 2, count),
        status_(status.mutable_data()),
        results_{Doubles(std::vector{count}, parameter_.data(), all),
                 Doubles(std::vector{count, py::ssize_t{2}}, point_.data(), all),
                 Doubles(std::vector{count}, distance_.data(), all),
                 Doubles(std::vector{count, py::ssize_t{2}}, tangent_.data(), all), std::move(status)} {}

  Eigen::Map<Eigen::VectorXd> parameter_, distance_;
  Eigen::Map<Eigen::Matrix2Xd> point_, tangent_;
  std::uint8_t* status_;
  NearestPoints results_;
};

/// Calls `find` with blocks of queries and results that stay in the processor's cache, and `store` with the index of
/// each query and its result; without the GIL if there are many.
template <class Result, class Find, class Store>
void find_all(std::span<const Point> queries, const Find& find, const Store& store) {
  std::optional<py::gil_scoped_release> release;
  if (queries.size() >= few) release.emplace();
  Interrupt interrupt;
  std::array<Result, 256> block;
  for (std::size_t done = 0; done < queries.size(); done += block.size()) {
    if (release) interrupt.check();
    const std::size_t size = std::min(block.size(), queries.size() - done);
    find(queries.subspan(done, size), std::span(block).first(size));
    for (std::size_t i = 0; i < size; ++i) store(static_cast<py::ssize_t>(done + i), block[i]);
  }
}

NearestPointOptions options_of(const Given<NearestPointMethod>& method, double tolerance, int samples,
                               int refinements) {
  const NearestPointOptions options = {converted(method, "method"), tolerance, samples, refinements};
  validate(options);
  return options;
}

std::span<const Point> rows_of(const Doubles& array) {
  return {reinterpret_cast<const Point*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

NearestPoints ask(const std::variant<const StrokeElement*, ArrayLike>& control_points, const ArrayLike& queries,
                  const Given<NearestPointMethod>& method, double tolerance, int samples, int refinements) {
  const NearestPointOptions options = options_of(method, tolerance, samples, refinements);
  const auto* const prepared = std::get_if<const StrokeElement*>(&control_points);
  const StrokeElement element = prepared != nullptr ? **prepared : element_of(std::get<ArrayLike>(control_points));
  const Doubles array = doubles(queries, "queries", 2);
  NearestPointWriter nearest(array.shape(0));
  find_all<NearestPoint>(
      rows_of(array), [&](auto asked, auto found) { nearest_points(element, asked, found, options); },
      [&](py::ssize_t i, const NearestPoint& found) { nearest.write(i, found); });
  return nearest.results();
}

/// As CharacterPoint.
struct CharacterPoints {
  py::array_t<int> stroke, element;
  NearestPoints closest;
};

CharacterPoints ask_strokes(const std::variant<Character, Stroke>& character, const ArrayLike& queries,
                            const Placement& placement, const Given<NearestPointMethod>& method, double tolerance,
                            int samples, int refinements) {
  const NearestPointOptions options = options_of(method, tolerance, samples, refinements);
  std::vector<std::vector<StrokeElement>> elements;
  if (const auto* const whole = std::get_if<Character>(&character)) {
    elements = place_elements({*whole, placement});
  } else {
    elements.push_back(place_elements(std::get<Stroke>(character), placement));
  }
  const Doubles array = doubles(queries, "queries", 2);
  NearestPointWriter nearest(array.shape(0));
  py::array_t<int> strokes(array.shape(0)), indices(array.shape(0));
  int *const stroke = strokes.mutable_data(), *const index = indices.mutable_data();
  find_all<CharacterPoint>(
      rows_of(array), [&](auto asked, auto found) { nearest_points(elements, asked, found, options); },
      [&](py::ssize_t i, const CharacterPoint& found) {
        stroke[i] = found.stroke;
        index[i] = found.element;
        nearest.write(i, found.closest);
      });
  return {strokes, indices, nearest.results()};
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

  py::class_<CharacterPoints>(module, "CharacterPoints", "Results of N queries to a character or stroke.")
      .def(py::init<py::array_t<int>, py::array_t<int>, NearestPoints>(), "stroke"_a, "element"_a, "closest"_a)
      .def_readonly("stroke", &CharacterPoints::stroke, "(N,), indices of strokes; 0 for a single stroke")
      .def_readonly("element", &CharacterPoints::element, "(N,), indices of elements within their stroke")
      .def_readonly("closest", &CharacterPoints::closest, "NearestPoints, on those elements [m]")
      .def("__len__", [](const CharacterPoints& self) { return self.stroke.size(); });

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

  module.def("nearest_points", &ask_strokes, "character"_a, "queries"_a, "placement"_a = Placement{},
             "method"_a = "exact", "tolerance"_a = 1e-9, "samples"_a = 16, "refinements"_a = 2,
             "Nearest points of N queries on all strokes of a Character, or on a single Stroke. Releases the GIL."
             "\n\nqueries: (N, 2) [m, page]; the others as for nearest_point. Of distances that are equal within "
             "rounding the earlier stroke wins, and within a stroke the earlier element. A query that is not finite "
             "has an infinite distance and is not certified. Raises InvalidValue naming the argument.");

  add_struct<StrokePlace>(module);
  py::class_<ActiveStroke>(module, "ActiveStroke", "The stroke that is due, as passed to begin() of a guidance law.")
      .def_property_readonly("length", &ActiveStroke::length)
      .def("at", &ActiveStroke::at, "arc"_a);
  module.def("place_elements", py::overload_cast<const Stroke&, const Placement&>(&place_elements), "stroke"_a,
             "placement"_a);
}

}  // namespace calligraphy::python
