// The arm of a Phantom, one set of joints at a time or many.
#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/phantom/kinematics.hpp>

#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {
namespace {

using phantom::JointLimits;
using phantom::Linkage;

/// (3,) or (n, 3) as rows, and the shape that goes before that of each answer.
struct Rows {
  Rows(const ArrayLike& value, const char* name) {
    const bool one = py::module_::import("numpy").attr("ndim")(value).equal(py::int_(1)) && py::len(value) == 3;
    numbers = one ? fixed_doubles(value, name, 3) : doubles(value, name, 3);
    if (!one) shape.push_back(numbers.shape(0));
    count = one ? 1 : numbers.shape(0);
  }

  Eigen::Map<const Eigen::Vector3d> operator[](py::ssize_t i) const { return vector_at(numbers.data(), i); }

  Doubles numbers;
  std::vector<py::ssize_t> shape;
  py::ssize_t count = 0;
};

/// An array of `function(row)` for every row, each a number or an Eigen object of the shape given.
template <class Function>
Doubles for_each(const Rows& rows, const std::vector<py::ssize_t>& each, Function&& function) {
  std::vector<py::ssize_t> shape = rows.shape;
  shape.insert(shape.end(), each.begin(), each.end());
  Doubles result(shape);
  double* to = result.mutable_data();
  const py::gil_scoped_release release;
  for (py::ssize_t i = 0; i < rows.count; ++i) to = function(to, i);
  return result;
}

double* put(double* to, const Eigen::Vector3d& value) {
  Eigen::Map<Eigen::Vector3d>{to} = value;
  return to + 3;
}

/// Joints that put the tip where it was asked for, an array each.
struct Inverse {
  Doubles joints;
  py::array_t<bool> reachable;
};

Inverse inverse(const Linkage& linkage, const ArrayLike& positions) {
  const Rows rows(positions, "position");
  Inverse result{Doubles(0), py::array_t<bool>(rows.shape)};
  bool* reachable = result.reachable.mutable_data();
  result.joints = for_each(rows, {3}, [&](double* to, py::ssize_t i) {
    const phantom::InverseKinematics found = inverse_kinematics(linkage, rows[i]);
    *reachable++ = found.reachable;
    return put(to, found.joints);
  });
  return result;
}

void add_arms(py::module_& module) {
  Record<JointLimits>(module, "JointLimits", "How far the joints of an arm turn.")
      .field("waist", &JointLimits::waist, "to either side [rad]")
      .field("shoulder_least", &JointLimits::shoulder_least, "[rad]")
      .field("shoulder_most", &JointLimits::shoulder_most, "[rad]")
      .field("elbow_least", &JointLimits::elbow_least, "elbow less shoulder [rad]")
      .field("elbow_most", &JointLimits::elbow_most, "elbow less shoulder [rad]");
  Record<Linkage>(
      module, "Linkage",
      "An arm of two links on a waist, x right, y up, z to the user: with r = l1 cos q2 + l2 sin q3 the tip "
      "is at\n"
      "p = (s r sin q1, l1 sin q2 - l2 cos q3 + l2, r cos q1 - l1). Joints are the angles of waist, "
      "shoulder and\n"
      "elbow, the last two both measured against the base.")
      .field("upper_arm", &Linkage::upper_arm, "l1 [m]")
      .field("forearm", &Linkage::forearm, "l2 [m]")
      .field("waist_sense", &Linkage::waist_sense, "s: 1 or -1")
      .field("limits", &Linkage::limits, "JointLimits")
      .field("centre", &Linkage::centre, "p of the origin of the device's axes (3,) [m]");
  module.def("linkage", &phantom::linkage, py::return_value_policy::copy, py::arg("model"),
             "Of omni, touch or premium-1.5.");
  py::class_<Inverse>(module, "InverseKinematics", "Joints of an arm for places of its tip.")
      .def_readonly("joints", &Inverse::joints, "(3,) or (n, 3) [rad]")
      .def_readonly("reachable", &Inverse::reachable,
                    "() or (n,), bool; False: the joints lead as near as the arm can reach from the shoulder")
      .def("__repr__",
           [](const Inverse& self) {
             return told("InverseKinematics({} of {} reachable)", self.reachable.attr("sum")(), self.reachable.size());
           })
      .def(py::pickle([](const Inverse& self) { return py::make_tuple(self.joints, self.reachable); },
                      [](const py::tuple& state) {
                        return Inverse{state[0].cast<Doubles>(), state[1].cast<py::array_t<bool>>()};
                      }));
}

void add_functions(py::module_& module) {
  module.def(
      "tip_position",
      [](const Linkage& linkage, const ArrayLike& joints) {
        const Rows rows(joints, "joints");
        return for_each(rows, {3}, [&](double* to, py::ssize_t i) { return put(to, tip_position(linkage, rows[i])); });
      },
      py::arg("linkage"), py::arg("joints"), "p of joints (3,) or (n, 3) [rad]: as many [m].");
  module.def(
      "tip_jacobian",
      [](const Linkage& linkage, const ArrayLike& joints) {
        const Rows rows(joints, "joints");
        return for_each(rows, {3, 3}, [&](double* to, py::ssize_t i) {
          Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{to} = tip_jacobian(linkage, rows[i]);
          return to + 9;
        });
      },
      py::arg("linkage"), py::arg("joints"), "dp/dq at joints (3,) or (n, 3) [rad]: (3, 3) or (n, 3, 3) [m/rad].");
  module.def("inverse_kinematics", &inverse, py::arg("linkage"), py::arg("position"),
             "The joints that put the tip at p, (3,) or (n, 3) [m]; with the elbow up and the waist in front. Their "
             "limits\n"
             "are not asked. A place that is not finite is not reachable, the joints then zero.");
  module.def(
      "within_limits",
      [](const Linkage& linkage, const ArrayLike& joints, double margin) {
        const Rows rows(joints, "joints");
        py::array_t<bool> result(rows.shape);
        bool* to = result.mutable_data();
        for (py::ssize_t i = 0; i < rows.count; ++i) *to++ = within_limits(linkage, rows[i], margin);
        return result;
      },
      py::arg("linkage"), py::arg("joints"), py::arg("margin") = 0.0,
      "Whether every joint of (3,) or (n, 3) [rad] keeps its limits to within `margin` [rad]: bool, () or (n,).");
  module.def(
      "dexterity",
      [](const Linkage& linkage, const ArrayLike& joints) {
        const Rows rows(joints, "joints");
        return for_each(rows, {}, [&](double* to, py::ssize_t i) {
          *to = dexterity(linkage, rows[i]);
          return to + 1;
        });
      },
      py::arg("linkage"), py::arg("joints"),
      "r cos(q2 - q3) / (l1 + l2) at joints (3,) or (n, 3) [rad], up to 1 and 0 where the arm is singular: () or "
      "(n,).");
  module.def(
      "joint_torque",
      [](const Linkage& linkage, const ArrayLike& joints, const ArrayLike& force) {
        const Rows rows(joints, "joints"), forces(force, "force");
        if (rows.shape != forces.shape) {
          throw ValueError("force: the shape of joints is expected, " +
                           py::str(rows.numbers.attr("shape")).cast<std::string>() + ", not " +
                           py::str(forces.numbers.attr("shape")).cast<std::string>());
        }
        return for_each(rows, {3},
                        [&](double* to, py::ssize_t i) { return put(to, joint_torque(linkage, rows[i], forces[i])); });
      },
      py::arg("linkage"), py::arg("joints"), py::arg("force"),
      "Torques J^T F of forces at the tip [N], both (3,) or (n, 3): as many [N m].");
  module.def(
      "gravity_torque",
      [](const ArrayLike& gravity, const ArrayLike& joints) {
        const Eigen::Vector2d weight = point(gravity, "gravity");
        const Rows rows(joints, "joints");
        return for_each(rows, {3},
                        [&](double* to, py::ssize_t i) { return put(to, phantom::gravity_torque(weight, rows[i])); });
      },
      py::arg("gravity"), py::arg("joints"),
      "Torques that hold the arm against its weight, for joints (3,) or (n, 3) [rad]: as many [N m]. gravity: (2,), "
      "what\n"
      "holds the upper arm when it is level (q2 = 0), and the forearm when it is level (q3 = pi/2) [N m].");
}

}  // namespace

void add_kinematics(py::module_& module) {
  add_arms(module);
  add_functions(module);
}

}  // namespace calligraphy::python
