// Kinematics of a Phantom, for one pose or many, and real devices: on USB, and through the vendor's runtime.
#include <calligraphy/devices/phantom/kinematics.hpp>
#ifdef CALLIGRAPHY_HAS_PHANTOM
#include <calligraphy/base/file.hpp>
#include <calligraphy/devices/phantom/device_list.hpp>
#include <calligraphy/devices/phantom/packet_capture.hpp>
#include <calligraphy/devices/phantom/phantom_device.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>
#endif
#ifdef CALLIGRAPHY_HAS_OPENHAPTICS
#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>
#endif

#include "components.hpp"

namespace calligraphy::python {
namespace {

using phantom::JointLimits;
using phantom::Linkage;

/// Applies `function` to each row of (3,) or (n, 3) and its index; the result has one number, vector or matrix per row.
template <class Function>
auto per_row(const ArrayLike& value, const char* name, Function&& function) {
  using Answer = std::invoke_result_t<Function, Eigen::Vector3d, py::ssize_t>;
  constexpr bool is_number = std::is_arithmetic_v<Answer>;
  bool one = false;
  const Doubles rows = one_or_many(value, name, 3, one);
  std::vector<py::ssize_t> shape(one ? 0 : 1, rows.shape(0));
  if (!is_number) shape.insert(shape.end(), sizeof(Answer) == sizeof(Eigen::Vector3d) ? 1 : 2, 3);
  py::array_t<std::conditional_t<is_number, Answer, double>> result(shape);
  auto* const answers = reinterpret_cast<Answer*>(result.mutable_data());
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) answers[i] = function(vector_at(rows.data(), i), i);
  return result;
}

/// A function of an arm, its joints and more; a matrix is stored row by row.
template <class Answer, class... More>
auto of_joints(Answer (*function)(const Linkage&, const phantom::Joints&, More...) noexcept) {
  using InRows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  using Stored = std::conditional_t<std::is_same_v<Answer, Eigen::Matrix3d>, InRows, Answer>;
  return [function](const Linkage& arm, const ArrayLike& joints, More... more) {
    return per_row(joints, "joints",
                   [&](const auto& row, py::ssize_t) -> Stored { return function(arm, row, more...); });
  };
}

}  // namespace

void add_kinematics(py::module_& module) {
  add_types<JointLimits, Linkage>(module);
  module.def("linkage", &phantom::linkage, py::return_value_policy::copy, "model"_a);
  module.def("tip_position", of_joints(&phantom::tip_position), "linkage"_a, "joints"_a,
             "+ For joints (3,) or (n, 3) [rad]; same shape [m].");
  module.def("tip_jacobian", of_joints(&phantom::tip_jacobian), "linkage"_a, "joints"_a,
             "+ For joints (3,) or (n, 3) [rad]: (3, 3) or (n, 3, 3) [m/rad].");
  module.def("manipulability", of_joints(&phantom::manipulability), "linkage"_a, "joints"_a,
             "+ For joints (3,) or (n, 3) [rad]: () or (n,).");
  module.def(
      "inverse_kinematics",
      [](const Linkage& arm, const ArrayLike& position) {
        const auto joints = [&](const auto& place, py::ssize_t) -> Eigen::Vector3d {
          return inverse_kinematics(arm, place).joints;
        };
        const auto reachable = [&](const auto& place, py::ssize_t) { return inverse_kinematics(arm, place).reachable; };
        return std::tuple(per_row(position, "position", joints), per_row(position, "position", reachable));
      },
      "linkage"_a, "position"_a, "+ Returns the joints and whether each is reachable, for (3,) or (n, 3).");
  module.def("within_limits", of_joints(&phantom::within_limits), "linkage"_a, "joints"_a, "margin"_a = 0.0,
             "+ For joints (3,) or (n, 3) [rad]: bool, () or (n,).");
  module.def(
      "joint_torque",
      [](const Linkage& arm, const ArrayLike& joints, const ArrayLike& force) {
        const py::array rows = real_numbers(joints, "joints"), forces = real_numbers(force, "force");
        if (!rows.attr("shape").equal(forces.attr("shape")))
          refuse_shape("force", shape_of(rows) + " of the joints", forces);
        const Doubles numbers = contiguous(forces, "force");
        return per_row(joints, "joints", [&](const auto& row, py::ssize_t i) -> Eigen::Vector3d {
          return joint_torque(arm, row, vector_at(numbers.data(), i));
        });
      },
      "linkage"_a, "joints"_a, "force"_a, "+ Joints [rad], force [N] and torque [N m] are all (3,) or all (n, 3).");
  module.def(
      "gravity_torque",
      [](const ArrayLike& gravity, const ArrayLike& joints) {
        const Eigen::Vector2d weight = point(gravity, "gravity");
        return per_row(joints, "joints", [&](const auto& row, py::ssize_t) -> Eigen::Vector3d {
          return phantom::gravity_torque(weight, row);
        });
      },
      "gravity"_a, "joints"_a, "+ For gravity (2,) [N m] and joints (3,) or (n, 3) [rad]; the shape of these [N m].");
}

#ifdef CALLIGRAPHY_HAS_PHANTOM
namespace {

using Stop = std::optional<std::function<bool()>>;

/// The capture as an array; also written to the file, if one is given.
py::array captured(const PluggedDevice& device, std::size_t transfers, double seconds, const Stop& stop,
                   const std::optional<std::filesystem::path>& path) {
  CaptureOptions options{transfers, seconds, nullptr};
  options.stop = [interrupt = Interrupt(), stop]() mutable {
    interrupt.check();
    return stop && (*stop)();
  };
  const PacketCapture result = released(&capture_packets)(device, options);
  const auto write = to_file(&write_packet_capture);
  if (path) write(*path, result);
  py::list rows;
  for (const CapturedTransfer& transfer : result.transfers) {
    const auto* const bytes = reinterpret_cast<const char*>(transfer.bytes.data());
    rows.append(py::dict("time"_a = transfer.time, "bytes"_a = py::bytes(bytes, transfer.bytes.size())));
  }
  return in_tables("table", rows, "time bytes:O");
}

}  // namespace

void add_phantom(py::module_& module) {
  add_types<LinkKind, PhantomOptions>(module);
  add_struct<PluggedDevice>(module).def("__str__", &describe_device);
  module.def("plugged_devices", released(&plugged_devices));
  module.def("dump_descriptors", released(&dump_descriptors), "device"_a);
  module.def("capture_packets", &captured, "device"_a, "transfers"_a = CaptureOptions{}.transfers,
             "seconds"_a = CaptureOptions{}.seconds, "stop"_a = py::none(), "path"_a = py::none(),
             "+ Ends after `transfers`, after `seconds` [s], or when stop(), polled ten times a second, returns True. "
             "Returns a structured array: time [s] and bytes, which it also writes to the text file `path`.");

  module.def(
      "read_wire_profile",
      [](const std::filesystem::path& path) {
        const auto read = +[](const std::filesystem::path& from) {
          const std::vector<std::string> shipped = phantom::wire_profile_names();
          const bool known = std::find(shipped.begin(), shipped.end(), from.string()) != shipped.end();
          return known ? phantom::wire_profile(from.string()) : phantom::read_wire_profile(from.string());
        };
        const phantom::WireProfile profile = released(read)(path);
        return py::dict("name"_a = profile.name, "source"_a = profile.source, "licence"_a = profile.licence,
                        "rate"_a = profile.rate, "report_size"_a = profile.report_size,
                        "command_size"_a = profile.command_size,
                        "missing_for_position"_a = missing_for_position(profile),
                        "missing_for_force"_a = missing_for_force(profile));
      },
      "path"_a,
      "+ `path` may be the name of a built-in profile. Returns a dict, with the lines missing_for_position and "
      "missing_for_force.");

  py::class_<PhantomDevice, HapticDevice>(module, "PhantomDevice", py::is_final())
      .def(py::init(released(+[](const PhantomOptions& options) { return std::make_unique<PhantomDevice>(options); })),
           "options"_a)
      .def(
          "calibrate", [](PhantomDevice& self, const ArrayLike& joints) { self.calibrate(vector(joints, "joints")); },
          "joints"_a)
      .def_property_readonly("joints", when_idle(&PhantomDevice::joints))
      .def_property_readonly("docked", when_idle(&PhantomDevice::docked))
      .def_property_readonly(
          "statistics", [](const PhantomDevice& self) { return as_dict(self.statistics()); },
          fields_text<PhantomStatistics>().c_str())
      .def_property_readonly("description", &PhantomDevice::description);
}
#endif

#ifdef CALLIGRAPHY_HAS_OPENHAPTICS
void add_openhaptics(py::module_& module) {
  add_types<CalibrationStyle, OpenHapticsOptions>(module);
  module.def(
      "openhaptics_runtime",
      [](const std::string& library) { return as_dict(released(&openhaptics_runtime)(library)); }, "library"_a = "",
      "+ Returns a dict.");
  module.def("openhaptics_error_name", &openhaptics_error_name, "code"_a);
  py::class_<OpenHapticsDevice, HapticDevice>(module, "OpenHapticsDevice", py::is_final())
      .def(py::init(released(
               +[](const OpenHapticsOptions& options) { return std::make_unique<OpenHapticsDevice>(options); })),
           "options"_a = OpenHapticsOptions{})
      .def_property_readonly("serial", &OpenHapticsDevice::serial)
      .def_property_readonly("library", &OpenHapticsDevice::library)
      .def_property_readonly("last_error", &OpenHapticsDevice::last_error);
}
#endif

}  // namespace calligraphy::python
