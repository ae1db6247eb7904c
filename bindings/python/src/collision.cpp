// The collision room: nearest points, many at a time, and where a stroke attracts the pen.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include <pybind11/stl.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/collision/placed_character.hpp>
#include <calligraphy/collision/stroke_tracker.hpp>

#include "enumeration.hpp"
#include "interrupt.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {
namespace {

/// Fewer queries than this are answered without letting other Python threads run: that alone costs some 0.1 us.
constexpr py::ssize_t few = 64;

StrokeElement element_of(const ArrayLike& control_points, const char* name = "control_points") {
  const Doubles array = doubles(control_points, name, 2);
  const py::ssize_t count = array.shape(0);
  if (count < 2 || count > max_curve_degree + 1) {
    throw ValueError(std::string(name) + ": shape (2, 2) to (5, 2) is expected, not (" + std::to_string(count) +
                     ", 2)");
  }
  return prepare_element({reinterpret_cast<const Point*>(array.data()), static_cast<std::size_t>(count)});
}

/// The name of a method, or one of NearestPointMethod.
NearestPointMethod method_of(const py::object& method) {
  if (py::isinstance<NearestPointMethod>(method)) return method.cast<NearestPointMethod>();
  const py::dict members =
      py::module_::import("calligraphy._calligraphy").attr("NearestPointMethod").attr("__members__");
  const auto complaint = [&] {
    return "method: one of " + py::str(", ").attr("join")(members).cast<std::string>() + " is expected, not " +
           py::repr(method).cast<std::string>();
  };
  if (!py::isinstance<py::str>(method)) throw py::type_error(complaint());
  if (!members.contains(method)) throw ValueError(complaint());
  return members[method].cast<NearestPointMethod>();
}

/// Answers to many queries, an array each: parts of one, as large ones are slow to get and to give back.
struct NearestPoints {
  Doubles parameter, point, distance, tangent;
  py::array_t<std::uint8_t> status;

  explicit NearestPoints(py::ssize_t count) : NearestPoints(count, Doubles(6 * count)) {}

 private:
  NearestPoints(py::ssize_t count, Doubles all)
      : parameter({count}, all.data(), all),
        point({count, py::ssize_t{2}}, all.data() + count, all),
        distance({count}, all.data() + 3 * count, all),
        tangent({count, py::ssize_t{2}}, all.data() + 4 * count, all),
        status(count) {}
};

/// Asks in blocks that stay in the processor's cache, and lays the answers out as arrays.
void answer(const StrokeElement& element, std::span<const Point> queries, const NearestPointOptions& options,
            double* parameter, double* point, double* distance, double* tangent, std::uint8_t* status,
            Interrupt* interrupt) {
  std::array<NearestPoint, 256> block;
  for (std::size_t first = 0; first < queries.size(); first += block.size()) {
    if (interrupt != nullptr) interrupt->check();
    const std::size_t count = std::min(block.size(), queries.size() - first);
    const std::span<NearestPoint> results = std::span(block).first(count);
    nearest_points(element, queries.subspan(first, count), results, options);
    for (const NearestPoint& result : results) {
      *parameter++ = result.parameter;
      *distance++ = result.distance;
      *point++ = result.point.x();
      *point++ = result.point.y();
      *tangent++ = result.tangent.x();
      *tangent++ = result.tangent.y();
      *status++ = static_cast<std::uint8_t>(result.status);
    }
  }
}

NearestPoints ask(const StrokeElement& element, const ArrayLike& queries, const NearestPointOptions& options) {
  const Doubles array = doubles(queries, "queries", 2);
  const py::ssize_t count = array.shape(0);
  NearestPoints result(count);
  const auto run = [&, asked = std::span(reinterpret_cast<const Point*>(array.data()), static_cast<std::size_t>(count)),
                    parameter = result.parameter.mutable_data(), point = result.point.mutable_data(),
                    distance = result.distance.mutable_data(), tangent = result.tangent.mutable_data(),
                    status = result.status.mutable_data()](Interrupt* interrupt) {
    answer(element, asked, options, parameter, point, distance, tangent, status, interrupt);
  };
  if (count < few) {
    run(nullptr);
  } else {
    const py::gil_scoped_release release;
    Interrupt interrupt;
    run(&interrupt);
  }
  return result;
}

NearestPointOptions options_of(const py::object& method, double tolerance, int samples, int refinements) {
  NearestPointOptions options;
  options.method = method_of(method);
  options.tolerance = tolerance;
  options.samples = samples;
  options.refinements = refinements;
  validate(options);
  return options;
}

/// A function of the parameter at one value or at many.
template <class Function>
py::object at(const py::object& t, Function&& function) {
  if (py::isinstance<py::float_>(t) || py::isinstance<py::int_>(t)) return array_of(function(t.cast<double>()));
  if (py::hasattr(t, "ndim") && t.attr("ndim").cast<int>() == 0) return at(t.attr("reshape")(1), function)[py::int_(0)];
  const Doubles parameters = doubles(t, "t");
  Doubles result({parameters.size(), py::ssize_t{2}});
  double* to = result.mutable_data();
  for (py::ssize_t i = 0; i < parameters.size(); ++i) {
    const Point value = function(parameters.data()[i]);
    *to++ = value.x(), *to++ = value.y();
  }
  return result;
}

void add_nearest_point(py::module_& module) {
  Enumeration<NearestPointMethod>(module, "NearestPointMethod")
      .value("exact", NearestPointMethod::exact, "the global nearest point, certified")
      .value("tracked", NearestPointMethod::tracked, "the same point, found from the last one")
      .value("sampled", NearestPointMethod::sampled, "the best of some samples, refined: may take the wrong branch")
      .value("wang2006", NearestPointMethod::wang2006, "subdivision as printed in sec. 4.3.2: misses branches");
  Enumeration<NearestPointStatus>(module, "NearestPointStatus")
      .value("certified", NearestPointStatus::certified)
      .value("approximate", NearestPointStatus::approximate)
      .value("unsafe_stop", NearestPointStatus::unsafe_stop)
      .value("not_finite", NearestPointStatus::not_finite);
  Record<NearestPointOptions>(module, "NearestPointOptions", "How a nearest point is found.")
      .field("method", &NearestPointOptions::method, "NearestPointMethod")
      .field("tolerance", &NearestPointOptions::tolerance, "error of the point relative to the element's size (0, 1]")
      .field("samples", &NearestPointOptions::samples, "sampled: points at even distances of the parameter, 2 to 64")
      .field("refinements", &NearestPointOptions::refinements, "sampled: steps of Halley's method, 0 to 8");

  py::class_<NearestPoints>(module, "NearestPoints", "Answers to N queries, an array each.")
      .def_readonly("parameter", &NearestPoints::parameter, "(N,) in [0, 1]")
      .def_readonly("point", &NearestPoints::point, "(N, 2), on the element, in the unit of the control points")
      .def_readonly("distance", &NearestPoints::distance, "(N,), from query to point; infinite where not finite")
      .def_readonly("tangent", &NearestPoints::tangent, "(N, 2), unit vectors in writing direction")
      .def_readonly("status", &NearestPoints::status, "(N,), values of NearestPointStatus, uint8")
      .def_property_readonly(
          "certified",
          [](const NearestPoints& self) {
            py::array_t<bool> result(self.status.size());
            std::transform(
                self.status.data(), self.status.data() + self.status.size(), result.mutable_data(),
                [](std::uint8_t s) { return s == static_cast<std::uint8_t>(NearestPointStatus::certified); });
            return result;
          },
          "(N,), bool: no other point of the element is nearer, up to the tolerance and rounding")
      .def("__len__", [](const NearestPoints& self) { return self.parameter.size(); })
      .def("__repr__",
           [](const py::object& self) {
             return told("NearestPoints({} queries, {} certified)", py::len(self),
                         self.attr("certified").attr("sum")());
           })
      .def(py::pickle(
          [](const NearestPoints& self) {
            return py::make_tuple(self.parameter, self.point, self.distance, self.tangent, self.status);
          },
          [](const py::tuple& state) {
            NearestPoints result(0);
            result.parameter = state[0].cast<Doubles>();
            result.point = state[1].cast<Doubles>();
            result.distance = state[2].cast<Doubles>();
            result.tangent = state[3].cast<Doubles>();
            result.status = state[4].cast<py::array_t<std::uint8_t>>();
            return result;
          }));

  py::class_<StrokeElement>(
      module, "StrokeElement",
      "A Bezier curve of degree 1 to 4, prepared for queries. Control points (2, 2) to (5, 2), in "
      "any unit; other lengths are in the same.")
      .def(py::init([](const ArrayLike& control_points) { return element_of(control_points); }),
           py::arg("control_points"))
      .def_property_readonly("degree", &StrokeElement::degree)
      .def_property_readonly("size", &StrokeElement::size, "diagonal of the control points' box; 0 for a point")
      .def_property_readonly("length", &StrokeElement::length)
      .def(
          "point",
          [](const StrokeElement& self, const py::object& t) {
            return at(t, [&self](double value) -> Point { return self.point(value); });
          },
          py::arg("t"), "(2,) at one parameter, (N, 2) at N.")
      .def(
          "derivative",
          [](const StrokeElement& self, const py::object& t) {
            return at(t, [&self](double value) -> Point { return self.derivative(value); });
          },
          py::arg("t"), "dB/dt")
      .def(
          "tangent",
          [](const StrokeElement& self, const py::object& t) {
            return at(t, [&self](double value) -> Point { return self.tangent(value); });
          },
          py::arg("t"), "Unit tangent in writing direction.")
      .def("arc_length", &StrokeElement::arc_length, py::arg("t"), "From 0 to t, to 3e-3 of the size.")
      .def("parameter_at", &StrokeElement::parameter_at, py::arg("arc_length"))
      .def("__repr__", [](const StrokeElement& self) {
        return told("StrokeElement(degree {}, length {:.6g})", self.degree(), self.length());
      });

  const char* const documentation =
      "Nearest points of N queries on one element, GIL released.\n\n"
      "control_points: (2, 2) to (5, 2), a Bezier curve of degree 1 to 4, or a StrokeElement prepared before;\n"
      "queries: (N, 2), taken without a copy where they are contiguous float64; both in the same unit.\n"
      "method: 'exact', 'tracked', 'sampled', 'wang2006' or a NearestPointMethod; tolerance: relative to the\n"
      "element's size. A query that is not finite has an infinite distance and is not certified.";
  module.def(
      "nearest_point",
      [](const StrokeElement& element, const ArrayLike& queries, const py::object& method, double tolerance,
         int samples,
         int refinements) { return ask(element, queries, options_of(method, tolerance, samples, refinements)); },
      py::arg("control_points"), py::arg("queries"), py::arg("method") = "exact", py::arg("tolerance") = 1e-9,
      py::arg("samples") = 16, py::arg("refinements") = 2, documentation);
  module.def(
      "nearest_point",
      [](const ArrayLike& control_points, const ArrayLike& queries, const py::object& method, double tolerance,
         int samples, int refinements) {
        return ask(element_of(control_points), queries, options_of(method, tolerance, samples, refinements));
      },
      py::arg("control_points"), py::arg("queries"), py::arg("method") = "exact", py::arg("tolerance") = 1e-9,
      py::arg("samples") = 16, py::arg("refinements") = 2, documentation);
}

/// A tracker with the elements that it looks at.
struct Tracker {
  Tracker(std::vector<StrokeElement> own, double tolerance) : elements(std::move(own)), tracker(elements, tolerance) {}

  std::vector<StrokeElement> elements;
  StrokeTracker tracker;
};

void add_tracker(py::module_& module) {
  py::class_<StrokePoint>(module, "StrokePoint", "A point of a stroke.")
      .def_readonly("element", &StrokePoint::element, "index")
      .def_property_readonly(
          "parameter", [](const StrokePoint& self) { return self.foot.parameter; }, "in [0, 1]")
      .def_property_readonly(
          "point", [](const StrokePoint& self) { return array_of(self.foot.point); }, "(2,)")
      .def_property_readonly(
          "tangent", [](const StrokePoint& self) { return array_of(self.foot.tangent); }, "(2,)")
      .def_property_readonly("distance", [](const StrokePoint& self) { return self.foot.distance; })
      .def_property_readonly("certified", [](const StrokePoint& self) { return self.foot.certified(); })
      .def("__repr__", [](const StrokePoint& self) {
        return told("StrokePoint(element {}, parameter {:.6g}, distance {:.6g})", self.element, self.foot.parameter,
                    self.foot.distance);
      });
  py::class_<Tracker>(module, "StrokeTracker",
                      "Finds for each position of a pen the nearest point of a whole stroke, certified, and quickly "
                      "where the pen moves\n"
                      "little. Takes at most 5 elements, as place_elements() gives them.")
      .def(py::init([](std::vector<StrokeElement> elements, double tolerance) {
             if (elements.size() > max_elements_per_stroke) {
               throw ValueError("elements: at most " + std::to_string(max_elements_per_stroke) + " are expected, not " +
                                std::to_string(elements.size()));
             }
             return std::make_unique<Tracker>(std::move(elements), tolerance);
           }),
           py::arg("elements"), py::arg("tolerance") = 1e-9)
      .def(
          "update", [](Tracker& self, const ArrayLike& query) { return self.tracker.update(point(query, "query")); },
          py::arg("query"), "(2,), in the unit of the elements; a query that is not finite is not remembered.");
}

void add_strokes(py::module_& module) {
  Enumeration<ConstraintSpaceRule>(module, "ConstraintSpaceRule")
      .value("tube", ConstraintSpaceRule::tube)
      .value("wang2006", ConstraintSpaceRule::wang2006);
  Enumeration<FeaturePlaneRule>(module, "FeaturePlaneRule")
      .value("bounded", FeaturePlaneRule::bounded)
      .value("wang2006", FeaturePlaneRule::wang2006);
  Enumeration<AttractionRule>(module, "AttractionRule")
      .value("interpolated", AttractionRule::interpolated)
      .value("wang2006", AttractionRule::wang2006);
  Record<ConstraintSpace>(module, "ConstraintSpace", "Where a stroke element attracts the pen.")
      .field("rule", &ConstraintSpace::rule, "ConstraintSpaceRule")
      .field("radius", &ConstraintSpace::radius, "[m]")
      .field("edge", &ConstraintSpace::edge, "over which the attraction fades out, at most the radius [m]");
  Record<StrokeRules>(module, "StrokeRules", "How a pen is followed along the active stroke.")
      .field("nearest", &StrokeRules::nearest, "NearestPointOptions")
      .field("space", &StrokeRules::space, "ConstraintSpace")
      .field("plane", &StrokeRules::plane, "FeaturePlaneRule")
      .field("attraction", &StrokeRules::attraction, "AttractionRule")
      .field("plane_tolerance", &StrokeRules::plane_tolerance, "[m]")
      .field("window", &StrokeRules::window, "arc length within which the foot is sought; 0: everywhere [m]");
  Record<Placement>(module, "Placement", "em coordinates to metres: page point = origin + em * point.")
      .field("origin", &Placement::origin, "lower left corner of the em square, (2,) [m]")
      .field("em", &Placement::em, "edge of the em square [m]")
      .type()
      .def(
          "to_page",
          [](const Placement& self, const ArrayLike& value) {
            std::vector<Point> result = points(value, "points");
            for (Point& p : result) p = self.to_page(p);
            return array_of_points(result);
          },
          py::arg("points"), "(n, 2) [em] to (n, 2) [m]");
  py::class_<PlacedCharacter> placed(module, "PlacedCharacter", "A character at its place on the page.");
  compare(placed, [](py::handle self, py::handle other) {
    return self.attr("character").equal(other.attr("character")) &&
           self.attr("placement").equal(other.attr("placement"));
  });
  placed
      .def(py::init([](const Character& character, const Placement& placement) {
             return PlacedCharacter{character, placement};
           }),
           py::arg("character"), py::arg("placement") = Placement{})
      .def_readonly("character", &PlacedCharacter::character)
      .def_readonly("placement", &PlacedCharacter::placement)
      .def("__repr__",
           [](const py::object& self) {
             return py::str("PlacedCharacter({!r}, {!r})").format(self.attr("character"), self.attr("placement"));
           })
      .def(py::pickle([](const PlacedCharacter& self) { return py::make_tuple(self.character, self.placement); },
                      [](const py::tuple& state) {
                        return PlacedCharacter{state[0].cast<Character>(), state[1].cast<Placement>()};
                      }));
  module.def("place_elements", &place_elements, py::arg("stroke"), py::arg("placement"),
             "The elements of a stroke at its place, in writing order, prepared for queries [m].");

  py::class_<StrokeContact>(module, "StrokeContact", "Where the pen is with respect to the active stroke.")
      .def_readonly("element", &StrokeContact::element, "index of the active element")
      .def_property_readonly("parameter", [](const StrokeContact& self) { return self.foot.parameter; })
      .def_property_readonly(
          "foot", [](const StrokeContact& self) { return array_of(self.foot.point); }, "(2,) [m]")
      .def_property_readonly(
          "tangent", [](const StrokeContact& self) { return array_of(self.foot.tangent); }, "(2,)")
      .def_property_readonly(
          "distance", [](const StrokeContact& self) { return self.foot.distance; }, "[m]")
      .def_property_readonly("certified", [](const StrokeContact& self) { return self.foot.certified(); })
      .def_readonly("share", &StrokeContact::share, "of the guidance force, 0 outside the constraint space")
      .def_readonly("attraction", &StrokeContact::attraction, "attraction factor at the foot")
      .def_readonly("arc", &StrokeContact::arc, "of the foot from the start of the stroke [m]")
      .def_readonly("backwards", &StrokeContact::backwards, "by which the foot is behind the furthest one [m]")
      .def_readonly("passed_feature", &StrokeContact::passed_feature)
      .def_readonly("finished", &StrokeContact::finished)
      .def("__repr__", [](const StrokeContact& self) {
        return told("StrokeContact(element {}, distance {:.6g} m, arc {:.6g} m)", self.element, self.foot.distance,
                    self.arc);
      });
  py::class_<ActiveStroke>(module, "ActiveStroke", "The stroke that is being written.")
      .def(py::init([](const Stroke& stroke, const Placement& placement) {
             ActiveStroke result;
             result.load(stroke, placement);
             return result;
           }),
           py::arg("stroke"), py::arg("placement"))
      .def("reload", &ActiveStroke::reload, "The pen was lifted before the end: from the start again.")
      .def(
          "update",
          [](ActiveStroke& self, const ArrayLike& tip, const StrokeRules& rules) {
            return self.update(point(tip, "tip"), rules);
          },
          py::arg("tip"), py::arg("rules") = StrokeRules{}, "Moves the pen tip to (2,) [m].")
      .def_property_readonly(
          "start", [](const ActiveStroke& self) { return array_of(self.start()); }, "(2,) [m]")
      .def_property_readonly("length", &ActiveStroke::length, "[m]")
      .def_property_readonly("features_left", &ActiveStroke::features_left);
}

}  // namespace

void add_collision(py::module_& module) {
  add_nearest_point(module);
  add_tracker(module);
  add_strokes(module);
}

}  // namespace calligraphy::python
