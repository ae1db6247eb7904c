// The devices room: samples, the simulated device, devices and force laws written in Python.
#include <memory>
#include <utility>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/pointer_device.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/devices/servo_loop.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "at_work.hpp"
#include "enumeration.hpp"
#include "force_law.hpp"
#include "python_device.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {
namespace {

void add_states(py::module_& module) {
  Enumeration<DeviceStatus>(module, "DeviceStatus", "How a sample may be trusted.")
      .value("ok", DeviceStatus::ok)
      .value("stale", DeviceStatus::stale)
      .value("disconnected", DeviceStatus::disconnected)
      .value("warm_motors", DeviceStatus::warm_motors)
      .value("needs_calibration", DeviceStatus::needs_calibration)
      .value("fault", DeviceStatus::fault);
  Enumeration<DeviceFault> faults(module, "DeviceFault", "What is wrong with a device, its link or its loop.");
  for (std::size_t i = 0; i < device_fault_count; ++i) {
    const auto fault = static_cast<DeviceFault>(i);
    std::string name = fault_name(fault);
    for (char& letter : name) letter = letter == ' ' ? '_' : letter;
    faults.value(name.c_str(), fault);
  }
  module.def("fault_name", &fault_name, py::arg("fault"), "In words, such as 'bad force'.");
  Record<DeviceState>(module, "DeviceState", "One sample of a device.")
      .field("time", &DeviceState::time, "since the device was opened [s]")
      .field("position", &DeviceState::position, "(3,), device axes [m]")
      .field("velocity", &DeviceState::velocity, "(3,); NaN when the device does not measure it [m/s]")
      .field("buttons", &DeviceState::buttons, "one bit per button")
      .field("status", &DeviceState::status, "DeviceStatus")
      .field("fault", &DeviceState::fault, "DeviceFault: the reason, where one is known");
  Record<Capabilities>(module, "Capabilities", "What a device can do.")
      .field("name", &Capabilities::name, "of the shipped profile that it came from")
      .field("model", &Capabilities::model, "who made it, and what")
      .field("workspace", &Capabilities::workspace, "extent along each device axis, centred on zero, (3,) [m]")
      .field("peak_force", &Capabilities::peak_force, "[N]")
      .field("continuous_force", &Capabilities::continuous_force, "[N]")
      .field("usable_stiffness", &Capabilities::usable_stiffness, "largest that users report [N/m]")
      .field("encoder_step", &Capabilities::encoder_step, "of positions; 0: not known, or not rounded [m]")
      .field("update_rate", &Capabilities::update_rate, "[Hz]")
      .field("apparent_mass", &Capabilities::apparent_mass, "at the tip; 0: not known [kg]")
      .field("viscous_friction", &Capabilities::viscous_friction, "[N s/m]")
      .field("coulomb_friction", &Capabilities::coulomb_friction, "along each axis [N]")
      .field("sample_delay", &Capabilities::sample_delay, "age of a sample when it is read [ticks]");
  Record<Hand>(module, "Hand", "Impedance of the grip. Soft (0.05, 1, 100), normal (0.1, 3, 300), firm (0.15, 5, 500).")
      .field("mass", &Hand::mass, "[kg]")
      .field("damping", &Hand::damping, "[N s/m]")
      .field("stiffness", &Hand::stiffness, "[N/m]");
  Record<Intention>(module, "Intention", "Where the person means the pen to be.")
      .field("position", &Intention::position, "(3,) [m]")
      .field("velocity", &Intention::velocity, "(3,) [m/s]");
  module.def(
      "device_profiles",
      [] {
        const auto profiles = device_profiles();
        return std::vector<Capabilities>(profiles.begin(), profiles.end());
      },
      "The shipped profiles: omni, touch, desktop, premium-1.5, ideal. Apparent masses are estimates.");
  module.def("device_profile", &device_profile, py::return_value_policy::copy, py::arg("name"),
             "The shipped profile of this name.");
}

void add_devices_of_all_kinds(py::module_& module) {
  py::class_<HapticDevice, PythonDevice>(
      module, "HapticDevice",
      "A force-feedback device. A subclass defines capabilities(), read(), write(force) and close(), and works "
      "wherever\n"
      "a device does. A call from C++ costs about 1 us and the GIL; what it raises goes to sys.unraisablehook, once "
      "until it\n"
      "works again, and the sample says `fault`. A `with` block closes it at its end. While a loop runs on a device of "
      "C++, only the "
      "loop's\n"
      "force law may use it: others get an Error.")
      .def(py::init<>())
      .def("capabilities", [](const HapticDevice& self) { return self.capabilities(); })
      .def(
          "read", [](HapticDevice& self) { return idle(self).read(); }, "The newest sample.")
      .def(
          "write", [](HapticDevice& self, const ArrayLike& force) { idle(self).write(vector(force, "force")); },
          py::arg("force"), "Commands a force in device axes (3,) [N], held until the next call.")
      .def(
          "close", [](HapticDevice& self) { idle(self).close(); }, "Force to zero; later reads say `disconnected`.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](const py::object& self, const py::args&) { self.attr("close")(); });

  py::class_<SimulatedDevice, HapticDevice>(
      module, "SimulatedDevice", py::is_final(),
      "A simulated device and the hand that holds it, in virtual time: the motion between samples is solved exactly.\n"
      "Without a hand nobody holds it.")
      .def(py::init([](const Capabilities& profile, const Hand& hand, const ArrayLike& position) {
             return SimulatedDevice(profile, hand, vector(position, "position"));
           }),
           py::arg("profile"), py::arg("hand") = Hand{0.0, 0.0, 0.0},
           py::arg("position") = py::make_tuple(0.0, 0.0, 0.0))
      .def(
          "set_intention",
          [](SimulatedDevice& self, const Intention& intention) { idle(self).set_intention(intention); },
          py::arg("intention"), "Where the hand pulls to from now on; moves on along its line with every advance().")
      .def(
          "set_hand", [](SimulatedDevice& self, const Hand& hand) { idle(self).set_hand(hand); }, py::arg("hand"))
      .def(
          "set_buttons", [](SimulatedDevice& self, std::uint32_t buttons) { idle(self).set_buttons(buttons); },
          py::arg("buttons"))
      .def(
          "advance", [](SimulatedDevice& self, double seconds) { idle(self).advance(seconds); }, py::arg("seconds"),
          "Lets virtual time pass and takes a sample.")
      .def_property_readonly(
          "true_position", [](const SimulatedDevice& self) { return array_of(idle(self).true_position()); },
          "(3,), what no encoder sees [m]")
      .def_property_readonly(
          "true_velocity", [](const SimulatedDevice& self) { return array_of(idle(self).true_velocity()); },
          "(3,) [m/s]")
      .def_property_readonly(
          "applied_force", [](const SimulatedDevice& self) { return array_of(idle(self).applied_force()); }, "(3,) [N]")
      .def_property_readonly(
          "time", [](const SimulatedDevice& self) { return idle(self).time(); }, "[s]");

  py::class_<ReplayDevice, HapticDevice>(module, "ReplayDevice", py::is_final(),
                                         "Plays recorded samples back one after the other, then says `disconnected`.")
      .def(py::init<std::vector<DeviceState>, Capabilities>(), py::arg("samples"), py::arg("capabilities"))
      .def_property_readonly("finished", [](const ReplayDevice& self) { return idle(self).finished(); })
      .def_property_readonly(
          "last_force", [](const ReplayDevice& self) { return array_of(idle(self).last_force()); }, "(3,) [N]");
}

/// (4, 4), as one multiplies with it.
Eigen::Isometry3d isometry(const ArrayLike& value, const char* name) {
  const Doubles rows = doubles(value, name, 4);
  const bool square = rows.shape(0) == 4;
  if (!square || rows.at(3, 0) != 0.0 || rows.at(3, 1) != 0.0 || rows.at(3, 2) != 0.0 || rows.at(3, 3) != 1.0) {
    throw ValueError(std::string(name) + ": shape (4, 4) with the last row (0, 0, 0, 1) is expected");
  }
  Eigen::Isometry3d result;
  result.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows.data());
  return result;
}

void add_pointer(py::module_& module) {
  Record<PointerOptions>(module, "PointerOptions", "How a simulated hand follows a pointer.")
      .field("rate", &PointerOptions::rate, "of read() [Hz]")
      .field("smoothing_time", &PointerOptions::smoothing_time, "how late the intention is behind the pointer [s]")
      .field("largest_speed", &PointerOptions::largest_speed, "of the intention along the paper [m/s]")
      .field("lifting_speed", &PointerOptions::lifting_speed, "of the intention towards the paper and away [m/s]")
      .field("hover_height", &PointerOptions::hover_height, "of a pointer that is not pressed [m]")
      .field("press_depth", &PointerOptions::press_depth, "where a hand at full pressure means to be [m]")
      .property(
          "paper",
          [](const PointerOptions& self) {
            py::array_t<double> result({4, 4});
            Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(result.mutable_data()) = self.paper.matrix();
            return result;
          },
          [](PointerOptions& self, const ArrayLike& value) { self.paper = isometry(value, "paper"); },
          "(4, 4), copied: from the paper (x, y on it, z out of it) to device axes, the shift [m]");
  py::class_<PointerDevice, HapticDevice>(
      module, "PointerDevice", py::is_final(),
      "A mouse, tablet or finger as the intention of a simulated hand, for people who have no haptic device. Each\n"
      "read() lets one period of virtual time pass; move() says where the pointer is, from any thread.")
      .def(py::init<const Capabilities&, const Hand&, const PointerOptions&>(), py::arg("profile"),
           py::arg("hand") = Hand{}, py::arg("options") = PointerOptions{})
      .def("move", &PointerDevice::move, py::arg("x"), py::arg("y"), py::arg("pressure"), py::arg("buttons") = 0,
           "Where the pointer is from now on: a place on the paper [m], a pressure from 0, not pressed, to 1.")
      .def_property_readonly(
          "intention", [](const PointerDevice& self) { return idle(self).intention(); },
          "Intention: where the hand means the pen to be, in device axes, copied");
}

double no_time() noexcept { return 0.0; }

/// A servo in virtual time: a force law takes none of it, however slow Python is.
class VirtualServo {
 public:
  VirtualServo(HapticDevice& device, py::function law, const ServoOptions& options)
      : device_(device), law_(PythonLaw::make(std::move(law))), servo_(device, force_law(law_, true), options) {}

  /// One tick. A law in Python lets other threads run, which must not begin another meanwhile. What the law raises is
  /// kept, but for Ctrl-C and the like, which are for whoever runs the loop, from a device as well.
  void step(double now) {
    refuse_at_work(device_);
    if (stepping_) throw Error("this Servo is within a tick already: one thread steps it, and not from its law");
    const std::size_t errors = law_->errors();
    stepping_ = true;
    const InStep here;
    servo_.step(now);
    stepping_ = false;
    here.raise();
    const py::object& error = law_->error();
    if (law_->errors() == errors || PyErr_GivenExceptionMatches(error.ptr(), PyExc_Exception) != 0) return;
    PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr());
    throw py::error_already_set();
  }

  void reset() {
    servo_.reset();
    law_->forget_errors();
  }

  Servo& servo() noexcept { return servo_; }
  const PythonLaw& law() const noexcept { return *law_; }

 private:
  HapticDevice& device_;
  std::shared_ptr<PythonLaw> law_;
  Servo servo_;
  bool stepping_ = false;
};

std::unique_ptr<VirtualServo> make_servo(HapticDevice& device, py::function law, double rate, double patience,
                                         double fall_time, double rise_time) {
  refuse_without_capabilities(device);
  ServoOptions options;
  options.rate = rate;
  options.patience = patience;
  options.fall_time = fall_time;
  options.rise_time = rise_time;
  options.work_clock = no_time;
  return std::make_unique<VirtualServo>(device, std::move(law), options);
}

void add_servo_options(py::module_& module) {
  using T = ServoThreadOptions;
  Record<ServoOptions>(module, "ServoOptions", "How a servo loop guards the force.")
      .field("rate", &ServoOptions::rate, "[Hz]")
      .field("patience", &ServoOptions::patience,
             "without a fresh sample, a tick or an answer of the force law, before the force falls [s]")
      .field("fall_time", &ServoOptions::fall_time, "of the force, from what it was to zero [s]")
      .field("rise_time", &ServoOptions::rise_time, "of the share of the force, from 0 to 1 [s]");
  Record<T>(module, "ServoThreadOptions", "The thread of a servo loop.")
      .field("rate", &T::rate, "a ServoLoop takes that of its servo [Hz]")
      .field("priority", &T::priority, "real-time priority, 1 to 99; 0: an ordinary thread")
      .field("lock_memory", &T::lock_memory, "keep the memory of the whole process from being swapped out")
      .field("core", &T::core, "the only processor core that the thread runs on; -1: any");
  Record<ServoLoopOptions>(module, "ServoLoopOptions", "Of a loop in real time.")
      .field("servo", &ServoLoopOptions::servo, "ServoOptions")
      .field("thread", &ServoLoopOptions::thread, "ServoThreadOptions");
}

void add_servo(py::module_& module) {
  Enumeration<ServoPhase>(module, "ServoPhase", "Where the force of a servo loop stands.")
      .value("zero", ServoPhase::zero)
      .value("rising", ServoPhase::rising)
      .value("running", ServoPhase::running)
      .value("falling", ServoPhase::falling);
  Record<ServoStatus>(module, "ServoStatus", "Where a servo loop stands.")
      .field("phase", &ServoStatus::phase, "ServoPhase")
      .field("fault", &ServoStatus::fault, "why the force fell, until it has risen again")
      .field("device", &ServoStatus::device, "DeviceStatus of the last sample")
      .field("gain", &ServoStatus::gain, "share of the wanted force that is sent");
  Record<DurationFigures>(module, "DurationFigures", "Percentiles of durations [s].")
      .field("count", &DurationFigures::count, "how many")
      .field("p50", &DurationFigures::p50, "[s]")
      .field("p99", &DurationFigures::p99, "[s]")
      .field("p99_9", &DurationFigures::p99_9, "[s]")
      .field("worst", &DurationFigures::worst, "[s]");
  Record<ServoStatistics>(module, "ServoStatistics", "What a servo loop has done so far.")
      .field("period", &ServoStatistics::period, "from one tick to the next")
      .field("work", &ServoStatistics::work, "of a tick; 0 in virtual time")
      .field("ticks", &ServoStatistics::ticks, "that reached the device")
      .field("missed_deadlines", &ServoStatistics::missed_deadlines, "ticks that should have been")
      .field("stale_samples", &ServoStatistics::stale_samples, "ticks on which the device had nothing new")
      .field("standing_clock", &ServoStatistics::standing_clock, "ticks whose time was not later than before")
      .field("taken_over", &ServoStatistics::taken_over, "times that the watchdog took the device")
      .field("idle_ticks", &ServoStatistics::idle_ticks, "ticks that wrote nothing")
      .field("faults", &ServoStatistics::faults, "times that each DeviceFault began, by its number");
  py::class_<VirtualServo>(
      module, "Servo",
      "A servo loop in virtual time: step(now) reads the device, asks the force law, guards the force and writes it.\n"
      "The force law is a Python callable from DeviceState to a force (3,) [N] in device axes; a tick with one costs\n"
      "about 2.5 us, so it runs some 400 times as fast as real time at 1 kHz, but is no real-time loop. What the law "
      "raises\n"
      "makes the force fall to zero, as in C++, and is in `error`; the first goes to sys.unraisablehook too.")
      .def(py::init(&make_servo), py::keep_alive<1, 2>(), py::arg("device"), py::arg("law"), py::kw_only(),
           py::arg("rate") = 1000.0, py::arg("patience") = 4e-3, py::arg("fall_time") = 10e-3,
           py::arg("rise_time") = 0.2)
      .def("step", &VirtualServo::step, py::arg("now"), "One tick at a time [s].")
      .def(
          "release", [](VirtualServo& self) { self.servo().release(); },
          "From the next tick on the force falls to zero and stays there.")
      .def("reset", &VirtualServo::reset, "Zero at once, and as new but for the statistics.")
      .def_property_readonly(
          "error", [](const VirtualServo& self) { return self.law().error(); },
          "the last exception of the law since it was new, or None")
      .def_property_readonly(
          "errors", [](const VirtualServo& self) { return self.law().errors(); }, "how often the law raised")
      .def_property_readonly("status", [](VirtualServo& self) { return self.servo().status(); })
      .def_property_readonly("statistics", [](VirtualServo& self) { return self.servo().statistics(); });
}

}  // namespace

void add_devices(py::module_& module) {
  add_states(module);
  add_devices_of_all_kinds(module);
  add_pointer(module);
  add_servo_options(module);
  add_servo(module);
}

}  // namespace calligraphy::python
