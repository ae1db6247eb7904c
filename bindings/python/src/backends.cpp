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

/// Applies `function` to each row of (3,) or (n, 3) and its index; the result has one entry per row.
template <class Function>
auto per_row(const ArrayLike& value, const char* name, Function&& function) {
  using Answer = std::invoke_result_t<Function, Eigen::Vector3d, py::ssize_t>;
  bool one = false;
  const Doubles rows = one_or_many(value, name, 3, one);
  std::vector<py::ssize_t> shape;
  if (!one) shape.push_back(rows.shape(0));
  if constexpr (std::is_arithmetic_v<Answer>) {
    py::array_t<Answer> result(shape);
    for (py::ssize_t i = 0; i < rows.shape(0); ++i) result.mutable_data()[i] = function(vector_at(rows.data(), i), i);
    return result;
  } else {
    shape.insert(shape.end(), Answer::ColsAtCompileTime == 3 ? 2 : 1, 3);
    Doubles result(shape);
    double* to = result.mutable_data();
    for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
      const Answer answer = function(vector_at(rows.data(), i), i);
      for (const auto& row : answer.rowwise()) to = std::copy(row.begin(), row.end(), to);
    }
    return result;
  }
}

/// A function of an arm and its joints.
template <class Answer>
auto of_joints(Answer (*function)(const Linkage&, const phantom::Joints&) noexcept) {
  return [function](const Linkage& arm, const ArrayLike& joints) {
    return per_row(joints, "joints", [&](const auto& row, py::ssize_t) -> Answer { return function(arm, row); });
  };
}

}  // namespace

void add_kinematics(py::module_& module) {
  add_struct<JointLimits>(module, "JointLimits", "Joint limits of an arm.", &JointLimits::waist,
                          "waist: in both directions [rad]", &JointLimits::shoulder_min, "shoulder_min [rad]",
                          &JointLimits::shoulder_max, "shoulder_max [rad]", &JointLimits::elbow_min,
                          "elbow_min: elbow minus shoulder [rad]", &JointLimits::elbow_max,
                          "elbow_max: elbow minus shoulder [rad]");
  add_struct<Linkage>(module, "Linkage",
                      "An arm of two links on a waist joint; x right, y up, z towards the user. With r = l1 cos q2 + "
                      "l2 sin q3 the tip is at p = (s r sin q1, l1 sin q2 - l2 cos q3 + l2, r cos q1 - l1). Joints are "
                      "the angles of waist, shoulder and elbow, the last two both measured relative to the base.",
                      &Linkage::upper_arm, "upper_arm: l1 [m]", &Linkage::forearm, "forearm: l2 [m]",
                      &Linkage::waist_sense, "waist_sense: s: 1 or -1", &Linkage::limits, "limits: JointLimits",
                      &Linkage::centre, "centre: p of the origin of the device axes (3,) [m]");
  module.def("linkage", &phantom::linkage, py::return_value_policy::copy, "model"_a,
             "The linkage of omni, touch or premium-1.5. Raises InvalidValue naming the available models.");
  module.def("tip_position", of_joints(&phantom::tip_position), "linkage"_a, "joints"_a,
             "Forward kinematics p for joints (3,) or (n, 3) [rad]; same shape [m].");
  module.def("tip_jacobian", of_joints(&phantom::tip_jacobian), "linkage"_a, "joints"_a,
             "Jacobian dp/dq for joints (3,) or (n, 3) [rad]: (3, 3) or (n, 3, 3) [m/rad].");
  module.def(
      "manipulability", of_joints(&phantom::manipulability), "linkage"_a, "joints"_a,
      "r cos(q2 - q3) / (l1 + l2) for joints (3,) or (n, 3) [rad]: at most 1, and 0 in singular poses; () or (n,).");
  module.def(
      "inverse_kinematics",
      [](const Linkage& arm, const ArrayLike& position) {
        const auto joints = [&](const auto& place, py::ssize_t) -> Eigen::Vector3d {
          return inverse_kinematics(arm, place).joints;
        };
        const auto reachable = [&](const auto& place, py::ssize_t) { return inverse_kinematics(arm, place).reachable; };
        return std::tuple(per_row(position, "position", joints), per_row(position, "position", reachable));
      },
      "linkage"_a, "position"_a,
      "Joint angles (3,) or (n, 3) [rad] that put the tip at p [m], elbow up and tip in front of the waist, and "
      "whether p is reachable: () or (n,), bool. If not, the joints give the nearest pose on the ray from the "
      "shoulder. Limits are not checked. A position that is not finite is unreachable, all angles zero.");
  module.def(
      "within_limits",
      [](const Linkage& arm, const ArrayLike& joints, double margin) {
        return per_row(joints, "joints", [&](const auto& row, py::ssize_t) { return within_limits(arm, row, margin); });
      },
      "linkage"_a, "joints"_a, "margin"_a = 0.0,
      "Whether every joint of (3,) or (n, 3) [rad] is within its limits plus `margin` [rad]: bool, () or (n,).");
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
      "linkage"_a, "joints"_a, "force"_a,
      "Joint torques J^T F [N m] for forces at the tip [N]; joints and forces both (3,) or (n, 3).");
  module.def(
      "gravity_torque",
      [](const ArrayLike& gravity, const ArrayLike& joints) {
        const Eigen::Vector2d weight = point(gravity, "gravity");
        return per_row(joints, "joints", [&](const auto& row, py::ssize_t) -> Eigen::Vector3d {
          return phantom::gravity_torque(weight, row);
        });
      },
      "gravity"_a, "joints"_a,
      "Joint torques that compensate the weight of the arm, for joints (3,) or (n, 3) [rad]; same shape [N m]. "
      "gravity: (2,), torques that hold the upper arm level (q2 = 0) and the forearm (q3 = pi/2) [N m].");
}

#ifdef CALLIGRAPHY_HAS_PHANTOM
namespace {

using Stop = std::optional<std::function<bool()>>;

/// The capture as an array; also written to the file, if one is given.
py::array captured(const PluggedDevice& device, std::size_t transfers, double seconds, const Stop& stop,
                   const std::optional<std::filesystem::path>& path) {
  const auto capture_all =
      +[](const PluggedDevice& from, const CaptureOptions& options, const std::optional<std::filesystem::path>& file) {
        PacketCapture result = capture_packets(from, options);
        if (file) {
          std::ostringstream out;
          write_packet_capture(out, result);
          write_file(*file, out.str());
        }
        return result;
      };
  CaptureOptions options{transfers, seconds, nullptr};
  options.stop = [interrupt = Interrupt(), stop]() mutable {
    interrupt.check();
    return stop && (*stop)();
  };
  const PacketCapture result = released(capture_all)(device, options, path);
  py::list rows;
  for (const CapturedTransfer& transfer : result.transfers) {
    const auto* const bytes = reinterpret_cast<const char*>(transfer.bytes.data());
    rows.append(py::make_tuple(transfer.time, py::bytes(bytes, transfer.bytes.size())));
  }
  return table(rows, dtype_of("time:f8 bytes:O"));
}

py::dict as_dict(const PhantomStatistics& s) {
  return py::dict("reports"_a = s.reports, "used_reports"_a = s.used_reports, "lost_reports"_a = s.lost_reports,
                  "repeated_reports"_a = s.repeated_reports, "skipped_bytes"_a = s.skipped_bytes,
                  "commands"_a = s.commands, "refused_commands"_a = s.refused_commands, "released"_a = s.released,
                  "faults"_a = fault_counts(s.faults), "transfers_failed"_a = s.transfers_failed,
                  "commands_replaced"_a = s.commands_replaced, "opened"_a = s.opened,
                  "warmest_motor"_a = s.warmest_motor);
}

}  // namespace

void add_phantom(py::module_& module) {
  add_enum(module, "LinkKind", "How a Phantom communicates on the bus.", LinkKind::hid, "usb hid");
  using P = PluggedDevice;
  add_struct<P>(module, "PluggedDevice", "A device on the bus, open or not. str() gives its ids, bus and port.",
                &P::vendor_id, "vendor_id: USB vendor id", &P::product_id, "product_id: USB product id", &P::model,
                "model: display name for these ids", &P::link, "link: LinkKind", &P::bus, "bus: bus number", &P::port,
                "port: path from the root of the bus, 2 or 1.4", &P::nodes, "nodes: list of device node paths, copied",
                &P::serial, "serial: serial number; empty: none, or not readable", &P::may_open,
                "may_open: this user may read and write the node that would be opened", &P::advice,
                "advice: what to do if it may not be opened")
      .def("__str__", &describe_device);
  module.def("plugged_devices", released(&plugged_devices),
             "All connected Phantoms, by bus and port, unopened. Raises DeviceError when the bus cannot be read.");
  module.def("dump_descriptors", released(&dump_descriptors), "device"_a,
             "The descriptors of a PluggedDevice, as hexadecimal bytes and decoded. Does not open the device.");
  module.def("capture_packets", &captured, "device"_a, "transfers"_a = CaptureOptions{}.transfers,
             "seconds"_a = CaptureOptions{}.seconds, "stop"_a = py::none(), "path"_a = py::none(),
             "Opens a PluggedDevice and listens without sending packets. Ends after `transfers`, after `seconds` [s], "
             "or when stop(), polled ten times a second, returns True. Returns a structured array: time since the "
             "device was opened [s], and bytes. path: text file to write as well: the device after #, then a line per "
             "transfer with time and hexadecimal bytes. Raises DeviceError.");

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
      "Reads and validates a built-in profile, by name, or a file as described in docs/wire-profile.md. Returns a "
      "dict: name, source, licence, rate of reports [Hz], report_size and command_size [bytes], and the lines "
      "missing_for_position and missing_for_force. Raises FileError, or FormatError naming the line and the value.");

  using O = PhantomOptions;
  add_struct<O>(module, "PhantomOptions", "Selects a Phantom and how it is driven.", &O::serial,
                "serial: serial number; empty: the only connected device", &O::wire_profile,
                "wire_profile: name of a built-in profile, or a file", &O::model,
                "model: omni, touch or premium-1.5: selects linkage and capabilities", &O::drive,
                "drive: False: positions only, the motors stay off", &O::gravity,
                "gravity: motors carry the weight of the arm", &O::velocity_cutoff,
                "velocity_cutoff: cut-off frequency of the velocity filter, 1 to 1000 [Hz]", &O::limit_heat,
                "limit_heat: reduce the torque of warm motors; False: cut it off when they are too warm",
                &O::keep_calibration, "keep_calibration: the encoders keep counting while unplugged", &O::priority,
                "priority: real-time priority of the device's threads, 1 to 99; 0: normal threads");
  py::class_<PhantomDevice, HapticDevice>(
      module, "PhantomDevice", py::is_final(),
      "An open Phantom or Touch on USB. A C++ thread receives and checks reports; after 20 ms without a write() it "
      "switches the motors off. Never run on hardware. Raises DeviceError naming device, cause and remedy.")
      .def(py::init(released(+[](const O& options) { return std::make_unique<PhantomDevice>(options); })), "options"_a)
      .def(
          "calibrate", [](PhantomDevice& self, const ArrayLike& joints) { self.calibrate(vector(joints, "joints")); },
          "joints"_a, "Calibrates without the inkwell: the joints are at these angles (3,) [rad] at the next report.")
      .def_property_readonly("joints", when_idle(&PhantomDevice::joints),
                             "(3,), joint angles of the sample last returned by read() [rad]")
      .def_property_readonly("docked", when_idle(&PhantomDevice::docked), "whether the pen is in the inkwell")
      .def_property_readonly(
          "statistics", [](const PhantomDevice& self) { return as_dict(self.statistics()); },
          "A dict of counts since the device was opened: reports, good and bad; used_reports, which gave a position; "
          "lost_reports and repeated_reports, by the sequence number; skipped_bytes of a stream; commands passed to "
          "the link, refused_commands, commands_replaced by a newer one; released, times that the motors were switched "
          "off for lack of a command; faults by DeviceFault; transfers_failed; opened, times that the device was "
          "found; warmest_motor, 0 cold, 1 the limit that it sustains indefinitely.")
      .def_property_readonly("description", &PhantomDevice::description, "ids, bus, port and serial number")
      .def_property_readonly("warnings", &PhantomDevice::warnings,
                             "privileges that the system refused to the device's threads, each with a remedy");
}
#endif

#ifdef CALLIGRAPHY_HAS_OPENHAPTICS
void add_openhaptics(py::module_& module) {
  add_enum(module, "CalibrationStyle", "How the runtime calibrates the joint encoders to absolute angles.",
           CalibrationStyle::inkwell, "encoder_reset automatic inkwell");
  using O = OpenHapticsOptions;
  add_struct<O>(module, "OpenHapticsOptions", "Selects a device of the vendor's runtime.", &O::library,
                "library: of the runtime; empty: CALLIGRAPHY_LIBHD, otherwise libHD.so", &O::device,
                "device: name given in the vendor's setup program; empty: the default device", &O::calibration,
                "calibration: CalibrationStyle");
  module.def(
      "openhaptics_runtime",
      [](const std::string& library) {
        const OpenHapticsRuntime runtime = released(&openhaptics_runtime)(library);
        return py::dict("found"_a = runtime.found, "library"_a = runtime.library, "advice"_a = runtime.advice);
      },
      "library"_a = "",
      "Looks for the runtime without opening a device. Returns a dict: `found`, installed and complete; `library`, its "
      "file name; `advice`, a remedy.");
  module.def("openhaptics_error_name", &openhaptics_error_name, "code"_a,
             "Display text of an error code: 'warm motors' for 0x0200.");
  py::class_<OpenHapticsDevice, HapticDevice>(
      module, "OpenHapticsDevice", py::is_final(),
      "A Touch, Phantom or Omni through the vendor's runtime, which is loaded while a device is open. The runtime's "
      "scheduler clocks ServoLoop and write_with_device; while no loop runs, read() returns the last sample as stale. "
      "Never run on hardware. Raises DeviceError with a remedy.")
      .def(py::init(released(+[](const O& options) { return std::make_unique<OpenHapticsDevice>(options); })),
           "options"_a = O{})
      .def_property_readonly("serial", &OpenHapticsDevice::serial, "serial number")
      .def_property_readonly("library", &OpenHapticsDevice::library, "file name of the runtime")
      .def_property_readonly("last_error", &OpenHapticsDevice::last_error, "most recent error code; 0: none so far")
      .def("advice", &OpenHapticsDevice::advice, "What the user has to do; otherwise empty.");
}
#endif

}  // namespace calligraphy::python
