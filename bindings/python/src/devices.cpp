// Samples, simulated devices and devices written in Python, servo loops in virtual time.
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/emergency_stop.hpp>
#include <calligraphy/devices/pointer_device.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/devices/servo_loop.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

double no_time() noexcept { return 0.0; }

/// A force that is not finite counts as zero in C++, where a servo loop must not throw; here it raises too.
void write(HapticDevice& device, const Eigen::Vector3d& force) {
  device.write(force);
  if (force.allFinite()) return;
  throw ValueError("force: got " + py::str(array_of(force)).cast<std::string>() +
                   " N, expected finite numbers; the force is now zero");
}

/// A servo in virtual time: the force law takes no virtual time, however slow Python is.
class VirtualServo {
 public:
  VirtualServo(HapticDevice& device, py::function law, const ServoOptions& options)
      : device_(device),
        law_(PythonLaw::make(std::move(law))),
        servo_(device, PythonLaw::force_law(law_, true), options) {}

  /// One tick. While a law in Python runs, other threads may run; they must not start another tick. An exception of the
  /// law is stored; Ctrl-C and the like, also from a device, are raised to the caller.
  void step(double now) {
    refuse_inside_a_tick();
    const AtWork at_work({AtWork::User::tick, law_.get()}, &device_);
    const std::size_t errors = law_->errors;
    stepping_ = true;
    const InStep here;
    servo_.step(now);
    stepping_ = false;
    here.raise();
    const py::object& error = law_->error;
    if (law_->errors == errors || PyErr_GivenExceptionMatches(error.ptr(), PyExc_Exception) != 0) return;
    InStep::raise(error);
  }

  void reset() {
    refuse_inside_a_tick();
    idle(device_);
    servo_.reset();
    law_->forget_errors();
  }

  void release() { servo_.release(); }
  ServoStatus status() const { return servo_.status(); }
  py::dict statistics() const { return as_dict(servo_.statistics()); }
  py::object error() const { return law_->error; }
  std::size_t errors() const { return law_->errors; }

 private:
  void refuse_inside_a_tick() const {
    if (!stepping_) return;
    throw Error(
        "this Servo is already inside a tick: step or reset it from one thread only, and not from its force law");
  }

  HapticDevice& device_;
  std::shared_ptr<PythonLaw> law_;
  Servo servo_;
  bool stepping_ = false;
};

std::unique_ptr<VirtualServo> make_servo(HapticDevice& device, Law law, double rate, double timeout, double ramp_down,
                                         double ramp_up) {
  PythonDevice::refuse_without_capabilities(device);
  ServoOptions options;
  options.rate = rate;
  options.timeout = timeout;
  options.ramp_down = ramp_down;
  options.ramp_up = ramp_up;
  options.work_clock = no_time;
  return std::make_unique<VirtualServo>(device, std::move(law), options);
}

/// Also at exit, before Python ends its threads: a device written in Python can still be called.
void install_for_python() {
  install_emergency_stop();
  static const bool registered = [] {
    py::module_::import("atexit").attr("register")(py::cpp_function([] {
      const py::gil_scoped_release release;
      emergency_stop();
    }));
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace

void add_devices(py::module_& module) {
  add_types<DeviceState, Capabilities, GripImpedance, Intention, SimulatedFault, PointerOptions, ServoLoopOptions,
            ServoStatus>(module);
  py::class_<VelocityEstimator>(module, "VelocityEstimator")
      .def(py::init<double>(), "cutoff"_a = VelocityEstimator::default_cutoff)
      .def(
          "update",
          [](VelocityEstimator& self, const ArrayLike& position, double elapsed) {
            return array_of(self.update(vector(position, "position"), elapsed));
          },
          "position"_a, "elapsed"_a, "+ (3,) [m] to (3,) [m/s].")
      .def_property_readonly("velocity", [](const VelocityEstimator& self) { return array_of(self.velocity()); })
      .def("restart", &VelocityEstimator::restart);
  module.def("device_profiles", [] {
    const auto profiles = device_profiles();
    return std::vector<Capabilities>(profiles.begin(), profiles.end());
  });
  module.def("device_profile", &device_profile, py::return_value_policy::copy, "name"_a);

  py::class_<HapticDevice, PythonDevice>(
      module, "HapticDevice",
      "+ A subclass defines capabilities(), read(), write(force) and close(). Their exceptions are passed to "
      "sys.unraisablehook, once until the method works again, and the sample has status `fault`. A `with` block closes "
      "the device. While a loop runs on a C++ device, any use outside the force law of that loop raises Error.")
      .def(py::init<>())
      .def("capabilities", [](const HapticDevice& self) { return self.capabilities(); })
      .def("read", [](HapticDevice& self) { return idle(self).read(); })
      .def(
          "write", [](HapticDevice& self, const ArrayLike& force) { write(idle(self), vector(force, "force")); },
          "force"_a, "+ (3,). If it is not finite, also raises InvalidValue.")
      .def("close", when_idle(&HapticDevice::close))
      .def_property_readonly("warnings", &HapticDevice::warnings)
      .def("advice", &HapticDevice::advice, "+ A subclass may define it.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](const py::object& self, const py::args&) { self.attr("close")(); });

  py::class_<SimulatedDevice, HapticDevice>(module, "SimulatedDevice", py::is_final())
      .def(py::init([](const Capabilities& profile, const GripImpedance& grip, const ArrayLike& position) {
             return SimulatedDevice(profile, grip, vector(position, "position"));
           }),
           "profile"_a, "grip"_a = GripImpedance{0.0, 0.0, 0.0}, "position"_a = py::make_tuple(0.0, 0.0, 0.0))
      .def("set_intention", when_idle(&SimulatedDevice::set_intention), "intention"_a)
      .def("set_grip", when_idle(&SimulatedDevice::set_grip), "grip"_a)
      .def("set_buttons", when_idle(&SimulatedDevice::set_buttons), "buttons"_a)
      .def("advance", when_idle(&SimulatedDevice::advance), "seconds"_a)
      .def("schedule", when_idle(&SimulatedDevice::schedule), "faults"_a)
      .def_property_readonly("true_position", when_idle(&SimulatedDevice::true_position))
      .def_property_readonly("true_velocity", when_idle(&SimulatedDevice::true_velocity))
      .def_property_readonly("applied_force", when_idle(&SimulatedDevice::applied_force))
      .def_property_readonly("refused_forces", when_idle(&SimulatedDevice::refused_forces))
      .def_property_readonly("time", when_idle(&SimulatedDevice::time));

  py::class_<ReplayDevice, HapticDevice>(module, "ReplayDevice", py::is_final())
      .def(py::init<std::vector<DeviceState>, Capabilities>(), "samples"_a, "capabilities"_a)
      .def_property_readonly("finished", when_idle(&ReplayDevice::finished))
      .def_property_readonly("last_force", when_idle(&ReplayDevice::last_force));

  py::class_<PointerDevice, HapticDevice>(module, "PointerDevice", py::is_final())
      .def(py::init<const Capabilities&, const GripImpedance&, const PointerOptions&>(), "profile"_a,
           "grip"_a = GripImpedance{}, "options"_a = PointerOptions{})
      .def("move", &PointerDevice::move, "x"_a, "y"_a, "pressure"_a, "buttons"_a = 0, "stylus"_a = StylusState{})
      .def_property_readonly("intention", when_idle(&PointerDevice::intention));

  module.def("install_emergency_stop", &install_for_python,
             "+ After any signal.signal(). A device written in Python gets its zero at a signal only from the next "
             "tick of its loop, if there is one.");
  module.def("emergency_stop", &emergency_stop, py::call_guard<py::gil_scoped_release>());
  module.def("emergency_stopped", &emergency_stopped);
  module.def("clear_emergency_stop", &clear_emergency_stop);

  py::class_<VirtualServo>(
      module, "Servo",
      "A servo loop in virtual time: step(now) reads the device, calls the force law, which maps a DeviceState to a "
      "force (3,) [N] in device axes, guards the force and writes it. If the law raises, the force ramps down to zero "
      "and the exception is in `error`; the first is also passed to sys.unraisablehook.")
      .def(py::init(&make_servo), py::keep_alive<1, 2>(), "device"_a, "law"_a, py::kw_only(), "rate"_a = 0.0,
           "timeout"_a = 4e-3, "ramp_down"_a = 10e-3, "ramp_up"_a = 0.2)
      .def("step", &VirtualServo::step, "now"_a)
      .def("release", &VirtualServo::release)
      .def("reset", &VirtualServo::reset)
      .def_property_readonly("error", &VirtualServo::error,
                             "the last exception of the force law since construction or reset(), or None")
      .def_property_readonly("errors", &VirtualServo::errors, "number of exceptions of the force law")
      .def_property_readonly("status", &VirtualServo::status)
      .def_property_readonly("statistics", &VirtualServo::statistics, fields_text<ServoStatistics>().c_str());
}

}  // namespace calligraphy::python
