// Devices by way of the vendor's runtime.
#include <pybind11/stl.h>

#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>

#include "enumeration.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {

void add_openhaptics(py::module_& module) {
  using Release = py::call_guard<py::gil_scoped_release>;
  Enumeration<CalibrationStyle>(module, "CalibrationStyle", "How the runtime brings joint encoders to absolute angles.")
      .value("encoder_reset", CalibrationStyle::encoder_reset)
      .value("automatic", CalibrationStyle::automatic)
      .value("inkwell", CalibrationStyle::inkwell);
  using O = OpenHapticsOptions;
  Record<O>(module, "OpenHapticsOptions", "Which device of the vendor's runtime.")
      .field("library", &O::library, "file of the runtime; empty: CALLIGRAPHY_LIBHD, else libHD.so")
      .field("device", &O::device, "as the vendor's setup program calls it; empty: the default device")
      .field("calibration", &O::calibration, "CalibrationStyle");
  Record<OpenHapticsRuntime>(module, "OpenHapticsRuntime", "Whether the runtime is there and complete.")
      .field("found", &OpenHapticsRuntime::found, "it is")
      .field("library", &OpenHapticsRuntime::library, "its file")
      .field("advice", &OpenHapticsRuntime::advice, "what to do when it is not found");
  module.def("openhaptics_runtime", &openhaptics_runtime, py::arg("library") = "", Release(),
             "Looks for the runtime without opening a device.");
  module.def("openhaptics_error_name", &openhaptics_error_name, py::arg("code"), "warm motors for 0x0200.");
  py::class_<OpenHapticsDevice, HapticDevice>(
      module, "OpenHapticsDevice", py::is_final(),
      "A Touch, Phantom or Omni by way of the vendor's runtime, loaded while a device is open. Its scheduler is the\n"
      "clock of a ServoLoop and of write_with_device; outside of one, read() gives the last sample as stale. Never "
      "run\n"
      "on hardware. Raises DeviceError when the runtime or the device is not there; the message says what to do.")
      .def(py::init<const OpenHapticsOptions&>(), py::arg("options") = OpenHapticsOptions{}, Release())
      .def_property_readonly("serial", &OpenHapticsDevice::serial)
      .def_property_readonly("library", &OpenHapticsDevice::library, "the file of the runtime")
      .def_property_readonly("last_error", &OpenHapticsDevice::last_error, "newest error code; 0: none so far")
      .def("advice", &OpenHapticsDevice::advice, "What a person has to do, or empty.");
}

}  // namespace calligraphy::python
