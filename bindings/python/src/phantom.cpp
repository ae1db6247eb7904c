// Phantoms on USB: what is plugged in, what its packets hold, and the device.
#include <filesystem>
#include <functional>
#include <sstream>
#include <utility>

#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <calligraphy/base/file.hpp>
#include <calligraphy/devices/phantom/capture.hpp>
#include <calligraphy/devices/phantom/device_list.hpp>
#include <calligraphy/devices/phantom/phantom_device.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>

#include "at_work.hpp"
#include "enumeration.hpp"
#include "interrupt.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;

void add_bus(py::module_& module) {
  Enumeration<LinkKind>(module, "LinkKind", "How a Phantom speaks on the bus.")
      .value("usb", LinkKind::usb)
      .value("hid", LinkKind::hid);
  using P = PluggedDevice;
  Record<P>(module, "PluggedDevice", "A device on the bus, open or not.")
      .field("vendor_id", &P::vendor_id, "of USB")
      .field("product_id", &P::product_id, "of USB")
      .field("model", &P::model, "what these ids stand for, in words")
      .field("link", &P::link, "LinkKind")
      .field("bus", &P::bus, "its number")
      .field("port", &P::port, "from the root of the bus, 2 or 1.4")
      .field("nodes", &P::nodes, "list of paths, copied")
      .field("serial", &P::serial, "empty: it has none, or it cannot be read")
      .field("may_open", &P::may_open, "this user may read and write the node that would be opened")
      .field("advice", &P::advice, "what to do when it may not be opened");
  module.def("describe", &describe, py::arg("device"), "2988:0302 on bus 1, port 2, serial 540-12345.");
  module.def("dump_descriptors", &dump_descriptors, py::arg("device"), Release(),
             "What a PluggedDevice says of itself: its descriptors, as hexadecimal bytes and in words. Opens nothing.");
  module.def("plugged_devices", &plugged_devices, Release(), "Every Phantom, by bus and port. Opens none of them.");
}

void add_captures(py::module_& module) {
  py::class_<CapturedTransfer>(module, "CapturedTransfer", "One transfer from a device, as it came.")
      .def_readonly("time", &CapturedTransfer::time, "since the device was opened [s]")
      .def_property_readonly("bytes",
                             [](const CapturedTransfer& self) {
                               return py::bytes(reinterpret_cast<const char*>(self.bytes.data()), self.bytes.size());
                             })
      .def("__repr__", [](const py::object& self) {
        return told("CapturedTransfer(time={:.6f}, bytes={!r})", self.attr("time"), self.attr("bytes"));
      });
  py::class_<Capture>(module, "Capture", "What a device sent: the raw material of a wire profile.")
      .def_readonly("device", &Capture::device, "PluggedDevice")
      .def_property_readonly(
          "transfers", [](const Capture& self) { return std::vector<CapturedTransfer>(self.transfers); },
          "list of CapturedTransfer, copied")
      .def("__len__", [](const Capture& self) { return self.transfers.size(); })
      .def("__repr__", [](const Capture& self) {
        return told("Capture({} transfers of {})", self.transfers.size(), describe(self.device));
      });
  module.def(
      "capture",
      [](const PluggedDevice& device, std::size_t transfers, double seconds, std::function<bool()> stop) {
        CaptureOptions options{transfers, seconds, nullptr};
        options.stop = [interrupt = Interrupt(), stop = std::move(stop)]() mutable {
          interrupt.check();
          return stop && stop();
        };
        return capture(device, options);
      },
      py::arg("device"), py::arg("transfers") = CaptureOptions{}.transfers,
      py::arg("seconds") = CaptureOptions{}.seconds, py::arg("stop") = py::none(), Release(),
      "Opens a PluggedDevice, sends it nothing and listens, until so many transfers, for so long [s], or until "
      "stop(),\n"
      "asked ten times a second, says True. Raises DeviceError when it cannot be opened.");
  module.def(
      "write_capture",
      [](const std::filesystem::path& path, const Capture& capture) {
        std::ostringstream out;
        write_capture(out, capture);
        write_file(path, out.str());
      },
      py::arg("path"), py::arg("capture"), Release(),
      "Writes the capture as text: the device after #, then time [s] and hexadecimal bytes, a line each.");
}

void add_wire_profiles(py::module_& module) {
  using phantom::WireProfile;
  py::class_<phantom::Field>(module, "WireField", "Where a number stands in a frame (phantom::Field in C++).")
      .def_readonly("offset", &phantom::Field::offset, "of the integer's first byte")
      .def_readonly("bytes", &phantom::Field::bytes, "of the integer, 1 to 4")
      .def_readonly("low_bit", &phantom::Field::low_bit)
      .def_readonly("bits", &phantom::Field::bits)
      .def_readonly("big_endian", &phantom::Field::big_endian)
      .def_readonly("is_signed", &phantom::Field::is_signed, "two's complement of its bits")
      .def_readonly("inverted", &phantom::Field::inverted, "every bit the other way round");
  const auto angles = [](std::optional<Eigen::Vector3d> WireProfile::*member) {
    return [member](const WireProfile& self) -> std::optional<py::array_t<double>> {
      if (!(self.*member)) return std::nullopt;
      return array_of(*(self.*member));
    };
  };
  py::class_<WireProfile>(module, "WireProfile",
                          "How the bytes of a device are laid out, and what its counts mean; docs/wire-profile.md.")
      .def_readonly("name", &WireProfile::name)
      .def_readonly("source", &WireProfile::source)
      .def_readonly("licence", &WireProfile::licence)
      .def_readonly("rate", &WireProfile::rate, "reports a second [Hz]")
      .def_readonly("report_size", &WireProfile::report_size, "device to host, without framing [bytes]")
      .def_readonly("command_size", &WireProfile::command_size, "host to device, without framing [bytes]")
      .def_readonly("encoders", &WireProfile::encoders, "WireField each, of waist, shoulder and elbow")
      .def_readonly("buttons", &WireProfile::buttons, "list of WireField, copied")
      .def_readonly("docked", &WireProfile::docked, "WireField: the pen is in the inkwell; None: not told")
      .def_readonly("sequence", &WireProfile::sequence, "WireField that grows by one a report; None: not told")
      .def_property_readonly("counts_per_radian", angles(&WireProfile::counts_per_radian),
                             "(3,), negative where an encoder counts the other way; None: not known")
      .def_property_readonly("docked_angles", angles(&WireProfile::docked_angles),
                             "(3,), of the joints in the inkwell; None: not known [rad]")
      .def_property_readonly("torque_per_count", angles(&WireProfile::torque_per_count),
                             "(3,), of the motors' converters; None: not known [N m]");
  module.def("wire_profile_names", &phantom::wire_profile_names, "The shipped profiles.");
  module.def("wire_profile", &phantom::wire_profile, py::return_value_policy::copy, py::arg("name"),
             "The shipped profile of this name.");
  module.def("wire_profile_text", &phantom::wire_profile_text, py::arg("name"),
             "The file of a shipped profile, to begin one's own with.");
  module.def(
      "read_wire_profile", [](const std::filesystem::path& path) { return phantom::read_wire_profile(path.string()); },
      py::arg("path"), Release(),
      "Reads and validates the format of docs/wire-profile.md; FormatError names line and value.");
  module.def("missing_for_position", &phantom::missing_for_position, py::arg("profile"),
             "The lines that are missing before positions can be had; empty: none.");
  module.def("missing_for_force", &phantom::missing_for_force, py::arg("profile"),
             "The lines that are missing before forces can be had; empty: none.");
}

void add_device(py::module_& module) {
  using O = PhantomOptions;
  Record<O>(module, "PhantomOptions", "Which Phantom, and how it is driven.")
      .field("serial", &O::serial, "empty: the only one that is plugged in")
      .field("wire_profile", &O::wire_profile, "name of a shipped one, or a file")
      .field("model", &O::model, "omni, touch or premium-1.5: arm and capabilities")
      .field("drive", &O::drive, "False: positions alone, the motors stay off")
      .field("gravity", &O::gravity, "motors bear the weight of the arm")
      .field("velocity_cutoff", &O::velocity_cutoff, "of the filter of the velocity, 1 to 1000 [Hz]")
      .field("limit_heat", &O::limit_heat, "lowers the torque of warm motors; False: cuts it when they are too warm")
      .field("keep_calibration", &O::keep_calibration, "the encoders go on counting while the device is unplugged")
      .field("priority", &O::priority,
             "real-time priority of the threads that carry reports and commands, 1 to 99; 0: ordinary threads");
  using S = PhantomStatistics;
  Record<S>(module, "PhantomStatistics", "Counts since the device was opened.")
      .field("reports", &S::reports, "frames, good and bad")
      .field("used_reports", &S::used_reports, "that gave a position")
      .field("lost_reports", &S::lost_reports, "by the sequence number")
      .field("repeated_reports", &S::repeated_reports, "by the sequence number: dropped")
      .field("skipped_bytes", &S::skipped_bytes, "of a stream, that were in no frame")
      .field("commands", &S::commands, "handed to the link")
      .field("refused_commands", &S::refused_commands, "that the link did not take")
      .field("released", &S::released, "times that the motors were switched off because no command came")
      .field("faults", &S::faults, "times that each DeviceFault began, by its number")
      .field("transfers_failed", &S::transfers_failed, "on the bus")
      .field("commands_replaced", &S::commands_replaced, "that a newer one overtook")
      .field("opened", &S::opened, "times that the device was found")
      .field("warmest_motor", &S::warmest_motor, "0 cold, 1 what it bears for ever");
  py::class_<PhantomDevice, HapticDevice>(
      module, "PhantomDevice", py::is_final(),
      "A Phantom or Touch on USB, opened. Reports are judged in a thread of C++; without a write() for 20 ms it\n"
      "switches the motors off. Nothing of this has been run on hardware. Raises DeviceError naming device, reason "
      "and\n"
      "what can be done; always so where this module was built without libusb and hidapi.")
      .def(py::init<const PhantomOptions&>(), py::arg("options"), Release())
      .def(
          "calibrate", [](PhantomDevice& self, const ArrayLike& joints) { self.calibrate(vector(joints, "joints")); },
          py::arg("joints"), "The joints are at these angles now (3,) [rad], instead of the inkwell.")
      .def_property_readonly(
          "joints", [](const PhantomDevice& self) { return array_of(idle(self).joints()); },
          "(3,), of the sample that read() gave last [rad]")
      .def_property_readonly(
          "docked", [](const PhantomDevice& self) { return idle(self).docked(); }, "the pen is in the inkwell")
      .def_property_readonly("statistics", &PhantomDevice::statistics, "PhantomStatistics, at any time")
      .def_property_readonly("description", &PhantomDevice::description)
      .def_property_readonly("warnings", &PhantomDevice::warnings,
                             "What the system did not permit to the device's threads, each with what to do.");
}

}  // namespace

void add_phantom(py::module_& module) {
  add_bus(module);
  add_captures(module);
  add_wire_profiles(module);
  add_device(module);
}

}  // namespace calligraphy::python
