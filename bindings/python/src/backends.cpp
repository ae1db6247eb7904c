// The arm of a Phantom, one set of joints at a time or many, and real devices: on USB, and by the vendor's runtime.
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

/// `function` of every row of (3,) or (n, 3), and of its index: an array in the shape of the rows, and of each answer.
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
  add_struct<JointLimits>(module, "JointLimits", "How far the joints of an arm turn.", &JointLimits::waist,
                          "waist: to either side [rad]", &JointLimits::shoulder_min, "shoulder_min [rad]",
                          &JointLimits::shoulder_max, "shoulder_max [rad]", &JointLimits::elbow_min,
                          "elbow_min: elbow less shoulder [rad]", &JointLimits::elbow_max,
                          "elbow_max: elbow less shoulder [rad]");
  add_struct<Linkage>(module, "Linkage",
                      "An arm of two links on a waist, x right, y up, z to the user: with r = l1 cos q2 + l2 sin q3 "
                      "the tip is at p = (s r sin q1, l1 sin q2 - l2 cos q3 + l2, r cos q1 - l1). Joints are the "
                      "angles of waist, shoulder and elbow, the last two both measured against the base.",
                      &Linkage::upper_arm, "upper_arm: l1 [m]", &Linkage::forearm, "forearm: l2 [m]",
                      &Linkage::waist_sense, "waist_sense: s: 1 or -1", &Linkage::limits, "limits: JointLimits",
                      &Linkage::centre, "centre: p of the origin of the device's axes (3,) [m]");
  module.def("linkage", &phantom::linkage, py::return_value_policy::copy, "model"_a,
             "Of omni, touch or premium-1.5. Raises InvalidValue naming those that exist.");
  module.def("tip_position", of_joints(&phantom::tip_position), "linkage"_a, "joints"_a,
             "p of joints (3,) or (n, 3) [rad]: as many [m].");
  module.def("tip_jacobian", of_joints(&phantom::tip_jacobian), "linkage"_a, "joints"_a,
             "dp/dq at joints (3,) or (n, 3) [rad]: (3, 3) or (n, 3, 3) [m/rad].");
  module.def("manipulability", of_joints(&phantom::manipulability), "linkage"_a, "joints"_a,
             "r cos(q2 - q3) / (l1 + l2) at joints (3,) or (n, 3) [rad], up to 1 and 0 where the arm is singular: () "
             "or (n,).");
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
      "The joints (3,) or (n, 3) [rad] that put the tip at as many p [m], with the elbow up and the waist in front, "
      "and whether each p is reachable, () or (n,), bool: where not, the joints lead as near as the arm can reach from "
      "the shoulder. Limits are not asked. A place that is not finite is not reachable, the joints then zero.");
  module.def(
      "within_limits",
      [](const Linkage& arm, const ArrayLike& joints, double margin) {
        return per_row(joints, "joints", [&](const auto& row, py::ssize_t) { return within_limits(arm, row, margin); });
      },
      "linkage"_a, "joints"_a, "margin"_a = 0.0,
      "Whether every joint of (3,) or (n, 3) [rad] keeps its limits to within `margin` [rad]: bool, () or (n,).");
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
      "Torques J^T F of forces at the tip [N], both (3,) or (n, 3): as many [N m].");
  module.def(
      "gravity_torque",
      [](const ArrayLike& gravity, const ArrayLike& joints) {
        const Eigen::Vector2d weight = point(gravity, "gravity");
        return per_row(joints, "joints", [&](const auto& row, py::ssize_t) -> Eigen::Vector3d {
          return phantom::gravity_torque(weight, row);
        });
      },
      "gravity"_a, "joints"_a,
      "Torques that hold the arm against its weight, for joints (3,) or (n, 3) [rad]: as many [N m]. gravity: (2,), "
      "what holds the upper arm when it is level (q2 = 0), and the forearm when it is level (q3 = pi/2) [N m].");
}

#ifdef CALLIGRAPHY_HAS_PHANTOM
namespace {

using Stop = std::optional<std::function<bool()>>;

/// What was captured, as an array; in the file too, if there is one.
py::array captured(const PluggedDevice& device, std::size_t transfers, double seconds, const Stop& stop,
                   const std::optional<std::filesystem::path>& path) {
  const auto capture_all =
      +[](const PluggedDevice& from, const CaptureOptions& options, const std::optional<std::filesystem::path>& file) {
        PacketCapture result = capture(from, options);
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
  add_enum(module, "LinkKind", "How a Phantom speaks on the bus.", LinkKind::hid, "usb hid");
  using P = PluggedDevice;
  add_struct<P>(module, "PluggedDevice", "A device on the bus, open or not. str() names it, its bus and its port.",
                &P::vendor_id, "vendor_id: of USB", &P::product_id, "product_id: of USB", &P::model,
                "model: what these ids stand for, in words", &P::link, "link: LinkKind", &P::bus, "bus: its number",
                &P::port, "port: from the root of the bus, 2 or 1.4", &P::nodes, "nodes: list of paths, copied",
                &P::serial, "serial: empty: it has none, or it cannot be read", &P::may_open,
                "may_open: this user may read and write the node that would be opened", &P::advice,
                "advice: what to do when it may not be opened")
      .def("__str__", &describe_device);
  module.def("plugged_devices", released(&plugged_devices),
             "Every Phantom, by bus and port. Opens none of them. Raises DeviceError when the bus cannot be read.");
  module.def("dump_descriptors", released(&dump_descriptors), "device"_a,
             "What a PluggedDevice says of itself: its descriptors, as hexadecimal bytes and in words. Opens nothing.");
  module.def("capture_packets", &captured, "device"_a, "transfers"_a = CaptureOptions{}.transfers,
             "seconds"_a = CaptureOptions{}.seconds, "stop"_a = py::none(), "path"_a = py::none(),
             "Opens a PluggedDevice, sends it nothing and listens, until so many transfers, for so long [s], or until "
             "stop(), asked ten times a second, says True. A structured array of the transfers: time since the device "
             "was opened [s], and bytes. path: a text file that is written too: the device after #, then time and "
             "hexadecimal bytes, a line each. Raises DeviceError when it cannot be opened.");

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
      "Reads and validates a shipped profile, by its name, or the format of docs/wire-profile.md: its name, source and "
      "licence, rate of reports [Hz], report_size and command_size [bytes], and the lines that are "
      "missing_for_position and missing_for_force. Raises FileError; FormatError names line and value.");

  using O = PhantomOptions;
  add_struct<O>(module, "PhantomOptions", "Which Phantom, and how it is driven.", &O::serial,
                "serial: empty: the only one that is plugged in", &O::wire_profile,
                "wire_profile: name of a shipped one, or a file", &O::model,
                "model: omni, touch or premium-1.5: arm and capabilities", &O::drive,
                "drive: False: positions alone, the motors stay off", &O::gravity,
                "gravity: motors bear the weight of the arm", &O::velocity_cutoff,
                "velocity_cutoff: of the filter of the velocity, 1 to 1000 [Hz]", &O::limit_heat,
                "limit_heat: lowers the torque of warm motors; False: cuts it when they are too warm",
                &O::keep_calibration, "keep_calibration: the encoders go on counting while the device is unplugged",
                &O::priority, "priority: of the threads that carry reports and commands, 1 to 99; 0: ordinary threads");
  py::class_<PhantomDevice, HapticDevice>(
      module, "PhantomDevice", py::is_final(),
      "A Phantom or Touch on USB, opened. Reports are judged in a thread of C++; without a write() for 20 ms it "
      "switches the motors off. Nothing of this has been run on hardware. Raises DeviceError naming device, reason and "
      "what can be done.")
      .def(py::init(released(+[](const O& options) { return std::make_unique<PhantomDevice>(options); })), "options"_a)
      .def(
          "calibrate", [](PhantomDevice& self, const ArrayLike& joints) { self.calibrate(vector(joints, "joints")); },
          "joints"_a, "The joints are at these angles now (3,) [rad], instead of the inkwell.")
      .def_property_readonly("joints", when_idle(&PhantomDevice::joints),
                             "(3,), of the sample that read() gave last [rad]")
      .def_property_readonly("docked", when_idle(&PhantomDevice::docked), "the pen is in the inkwell")
      .def_property_readonly(
          "statistics", [](const PhantomDevice& self) { return as_dict(self.statistics()); },
          "Counts since the device was opened, at any time: reports, good and bad; used_reports, that gave a position; "
          "lost_reports and repeated_reports, by the sequence number; skipped_bytes of a stream; commands handed to "
          "the link, refused_commands, commands_replaced by a newer one; released, times that the motors were switched "
          "off because no command came; faults by DeviceFault; transfers_failed; opened, times that the device was "
          "found; warmest_motor, 0 cold, 1 what it bears for ever.")
      .def_property_readonly("description", &PhantomDevice::description, "ids, bus, port and serial number")
      .def_property_readonly("warnings", &PhantomDevice::warnings,
                             "what the system did not permit to the device's threads, each with what to do");
}
#endif

#ifdef CALLIGRAPHY_HAS_OPENHAPTICS
void add_openhaptics(py::module_& module) {
  add_enum(module, "CalibrationStyle", "How the runtime brings joint encoders to absolute angles.",
           CalibrationStyle::inkwell, "encoder_reset automatic inkwell");
  using O = OpenHapticsOptions;
  add_struct<O>(module, "OpenHapticsOptions", "Which device of the vendor's runtime.", &O::library,
                "library: file of the runtime; empty: CALLIGRAPHY_LIBHD, else libHD.so", &O::device,
                "device: as the vendor's setup program calls it; empty: the default device", &O::calibration,
                "calibration: CalibrationStyle");
  module.def(
      "openhaptics_runtime",
      [](const std::string& library) {
        const OpenHapticsRuntime runtime = released(&openhaptics_runtime)(library);
        return py::dict("found"_a = runtime.found, "library"_a = runtime.library, "advice"_a = runtime.advice);
      },
      "library"_a = "",
      "Looks for the runtime without opening a device: whether it is found and complete, its file in `library`, and "
      "`advice`, what to do when it is not found.");
  module.def("openhaptics_error_name", &openhaptics_error_name, "code"_a, "'warm motors' for 0x0200.");
  py::class_<OpenHapticsDevice, HapticDevice>(
      module, "OpenHapticsDevice", py::is_final(),
      "A Touch, Phantom or Omni by way of the vendor's runtime, loaded while a device is open. Its scheduler is the "
      "clock of a ServoLoop and of write_with_device; outside of one, read() gives the last sample as stale. Never run "
      "on hardware. Raises DeviceError when the runtime or the device is not there; the message says what to do.")
      .def(py::init(released(+[](const O& options) { return std::make_unique<OpenHapticsDevice>(options); })),
           "options"_a = O{})
      .def_property_readonly("serial", &OpenHapticsDevice::serial, "serial number")
      .def_property_readonly("library", &OpenHapticsDevice::library, "the file of the runtime")
      .def_property_readonly("last_error", &OpenHapticsDevice::last_error, "newest error code; 0: none so far")
      .def("advice", &OpenHapticsDevice::advice, "What a person has to do, or empty.");
}
#endif

}  // namespace calligraphy::python
