// Samples, devices simulated and written in Python, servo loops in virtual time.
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/pointer_device.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/devices/servo_loop.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

double no_time() noexcept { return 0.0; }

/// A servo in virtual time: a force law takes none of it, however slow Python is.
class VirtualServo {
 public:
  VirtualServo(HapticDevice& device, py::function law, const ServoOptions& options)
      : device_(device),
        law_(PythonLaw::make(std::move(law))),
        servo_(device, PythonLaw::force_law(law_, true), options) {}

  /// One tick. A law in Python lets other threads run, which must not begin another meanwhile. What the law raises is
  /// kept, but for Ctrl-C and the like, which are for whoever runs the loop, from a device as well.
  void step(double now) {
    idle(device_);
    if (stepping_) throw Error("this Servo is within a tick already: one thread steps it, and not from its law");
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
    servo_.reset();
    law_->forget_errors();
  }

  void release() { servo_.release(); }
  ServoStatus status() const { return servo_.status(); }
  py::dict statistics() const { return servo_statistics(servo_.statistics()); }
  py::object error() const { return law_->error; }
  std::size_t errors() const { return law_->errors; }

 private:
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

py::dict as_dict(const DurationSummary& figures) {
  return py::dict("count"_a = figures.count, "p50"_a = figures.p50, "p99"_a = figures.p99, "p99_9"_a = figures.p99_9,
                  "worst"_a = figures.worst);
}

}  // namespace

py::dict fault_counts(const std::array<std::uint64_t, device_fault_count>& faults) {
  py::dict result;
  for (std::size_t i = 0; i < faults.size(); ++i) result[py::cast(static_cast<DeviceFault>(i))] = faults[i];
  return result;
}

py::dict servo_statistics(const ServoStatistics& statistics) {
  return py::dict("period"_a = as_dict(statistics.period), "work"_a = as_dict(statistics.work),
                  "ticks"_a = statistics.ticks, "missed_deadlines"_a = statistics.missed_deadlines,
                  "stale_samples"_a = statistics.stale_samples, "stalled_clock"_a = statistics.stalled_clock,
                  "watchdog_takeovers"_a = statistics.watchdog_takeovers, "idle_ticks"_a = statistics.idle_ticks,
                  "faults"_a = fault_counts(statistics.faults));
}

void add_devices(py::module_& module) {
  add_enum(module, "DeviceStatus", "How a sample may be trusted.", DeviceStatus::fault,
           "ok stale disconnected warm_motors needs_calibration fault");
  std::string faults;
  for (std::size_t i = 0; i < device_fault_count; ++i) {
    std::string name = to_string(static_cast<DeviceFault>(i));
    std::replace(name.begin(), name.end(), ' ', '_');
    faults += name + ' ';
  }
  add_enum(module, "DeviceFault", "What is wrong with a device, its link or its loop.", DeviceFault::device_error,
           faults);
  add_struct<PenOrientation>(module, "PenOrientation",
                             "Where the pen points, in device axes; NaN where it is not measured.",
                             &PenOrientation::tilt, "tilt: from the z axis, 0 to pi [rad]", &PenOrientation::azimuth,
                             "azimuth: from the x axis towards the y axis, -pi to pi [rad]");
  add_struct<DeviceState>(
      module, "DeviceState", "One sample of a device.", &DeviceState::time, "time: since the device was opened [s]",
      &DeviceState::position, "position: (3,), device axes [m]", &DeviceState::velocity,
      "velocity: (3,); NaN when the device does not measure it [m/s]", &DeviceState::buttons,
      "buttons: one bit per button", &DeviceState::status, "status: DeviceStatus", &DeviceState::fault,
      "fault: DeviceFault: the reason, where one is known", &DeviceState::orientation, "orientation: PenOrientation");
  add_struct<DeviceAxes>(
      module, "DeviceAxes", "Degrees of freedom of a device.", &DeviceAxes::x, "x: translation along this device axis",
      &DeviceAxes::y, "y: translation along this device axis", &DeviceAxes::z, "z: translation along this device axis",
      &DeviceAxes::rotations, "rotations: of the pen: sensed as the orientation of a sample");
  add_struct<Capabilities>(
      module, "Capabilities", "What a device can do, and its physics as a point mass.", &Capabilities::name,
      "name: of the shipped profile that it came from", &Capabilities::model, "model: manufacturer and model",
      &Capabilities::sensed, "sensed: DeviceAxes: what read() measures", &Capabilities::driven,
      "driven: DeviceAxes: where write() exerts a force", &Capabilities::workspace,
      "workspace: extent along each device axis, centred on zero, (3,) [m]", &Capabilities::peak_force,
      "peak_force [N]", &Capabilities::continuous_force, "continuous_force [N]", &Capabilities::usable_stiffness,
      "usable_stiffness: largest that users report [N/m]", &Capabilities::encoder_step,
      "encoder_step: of positions; 0: not known, or not rounded [m]", &Capabilities::update_rate, "update_rate [Hz]",
      &Capabilities::apparent_mass, "apparent_mass: at the tip; 0: not known [kg]", &Capabilities::viscous_friction,
      "viscous_friction [N s/m]", &Capabilities::coulomb_friction, "coulomb_friction: along each axis [N]",
      &Capabilities::sample_delay, "sample_delay: age of a sample when it is read [ticks]");
  add_struct<GripImpedance>(module, "GripImpedance",
                            "Impedance of the grip. Soft (0.05, 1, 100), normal (0.1, 3, 300), firm (0.15, 5, 500).",
                            &GripImpedance::mass, "mass [kg]", &GripImpedance::damping, "damping [N s/m]",
                            &GripImpedance::stiffness, "stiffness [N/m]");
  add_struct<Intention>(module, "Intention", "Where the person means the pen to be.", &Intention::position,
                        "position: (3,) [m]", &Intention::velocity, "velocity: (3,) [m/s]");
  module.def(
      "device_profiles",
      [] {
        const auto profiles = device_profiles();
        return std::vector<Capabilities>(profiles.begin(), profiles.end());
      },
      "The shipped profiles: omni, touch, desktop, premium-1.5, ideal. Apparent masses are estimates.");
  module.def("device_profile", &device_profile, py::return_value_policy::copy, "name"_a,
             "The shipped profile of this name. Raises InvalidValue naming those that exist.");

  py::class_<HapticDevice, PythonDevice>(
      module, "HapticDevice",
      "A force-feedback device. A subclass defines capabilities(), read(), write(force) and close(); what they raise "
      "goes to sys.unraisablehook, once until they work again, and the sample says `fault`. A `with` block closes it. "
      "While a loop runs on a device of C++, only the loop's force law may use it: others get an Error.")
      .def(py::init<>())
      .def(
          "capabilities", [](const HapticDevice& self) { return self.capabilities(); }, "What it can do.")
      .def(
          "read", [](HapticDevice& self) { return idle(self).read(); }, "The newest sample.")
      .def(
          "write", [](HapticDevice& self, const ArrayLike& force) { idle(self).write(vector(force, "force")); },
          "force"_a, "Commands a force in device axes (3,) [N], held until the next call.")
      .def("close", when_idle(&HapticDevice::close), "Force to zero; later reads say `disconnected`.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](const py::object& self, const py::args&) { self.attr("close")(); });

  py::class_<SimulatedDevice, HapticDevice>(module, "SimulatedDevice", py::is_final(),
                                            "A simulated device and the hand that holds it, in virtual time: the "
                                            "motion between samples is solved exactly. Without a hand nobody holds it.")
      .def(py::init([](const Capabilities& profile, const GripImpedance& grip, const ArrayLike& position) {
             return SimulatedDevice(profile, grip, vector(position, "position"));
           }),
           "profile"_a, "grip"_a = GripImpedance{0.0, 0.0, 0.0}, "position"_a = py::make_tuple(0.0, 0.0, 0.0))
      .def("set_intention", when_idle(&SimulatedDevice::set_intention), "intention"_a,
           "Where the hand pulls to from now on; moves on along its line with every advance().")
      .def("set_grip", when_idle(&SimulatedDevice::set_grip), "grip"_a, "The hand that holds it from now on.")
      .def("set_buttons", when_idle(&SimulatedDevice::set_buttons), "buttons"_a, "One bit per button that is pressed.")
      .def("advance", when_idle(&SimulatedDevice::advance), "seconds"_a,
           "Lets virtual time pass [s] and takes a sample.")
      .def_property_readonly("true_position", when_idle(&SimulatedDevice::true_position),
                             "(3,), what no encoder sees [m]")
      .def_property_readonly("true_velocity", when_idle(&SimulatedDevice::true_velocity), "(3,) [m/s]")
      .def_property_readonly("applied_force", when_idle(&SimulatedDevice::applied_force), "(3,) [N]")
      .def_property_readonly("time", when_idle(&SimulatedDevice::time), "[s]");

  py::class_<ReplayDevice, HapticDevice>(module, "ReplayDevice", py::is_final(),
                                         "Plays recorded samples back one after the other, then says `disconnected`.")
      .def(py::init<std::vector<DeviceState>, Capabilities>(), "samples"_a, "capabilities"_a)
      .def_property_readonly("finished", when_idle(&ReplayDevice::finished), "no sample is left")
      .def_property_readonly("last_force", when_idle(&ReplayDevice::last_force), "(3,) [N]");

  add_struct<PointerOptions>(
      module, "PointerOptions", "How a simulated hand follows a pointer.", &PointerOptions::rate,
      "rate: of read() [Hz]", &PointerOptions::smoothing_time,
      "smoothing_time: how late the intention is behind the pointer [s]", &PointerOptions::max_speed,
      "max_speed: of the intention along the paper [m/s]", &PointerOptions::lifting_speed,
      "lifting_speed: of the intention towards the paper and away [m/s]", &PointerOptions::hover_height,
      "hover_height: of a pointer that is not pressed [m]", &PointerOptions::press_depth,
      "press_depth: where a hand at full pressure means to be [m]", &PointerOptions::paper,
      "paper: (4, 4), from the paper (x, y on it, z out of it) to device axes, the shift [m]");
  py::class_<PointerDevice, HapticDevice>(
      module, "PointerDevice", py::is_final(),
      "A mouse, tablet or finger as the intention of a simulated hand, for people who have no haptic device. Each "
      "read() lets one period of virtual time pass; move() says where the pointer is, from any thread.")
      .def(py::init<const Capabilities&, const GripImpedance&, const PointerOptions&>(), "profile"_a,
           "grip"_a = GripImpedance{}, "options"_a = PointerOptions{})
      .def("move", &PointerDevice::move, "x"_a, "y"_a, "pressure"_a, "buttons"_a = 0,
           "Where the pointer is from now on: a place on the paper [m], a pressure from 0, not pressed, to 1.")
      .def_property_readonly("intention", when_idle(&PointerDevice::intention),
                             "Intention: where the hand means the pen to be, in device axes, copied");

  using T = ServoThreadOptions;
  add_struct<ServoOptions>(
      module, "ServoOptions", "How a servo loop guards the force.", &ServoOptions::rate, "rate [Hz]",
      &ServoOptions::timeout,
      "timeout: without a fresh sample, a tick or an answer of the force law, before the force falls [s]",
      &ServoOptions::ramp_down, "ramp_down: of the force, from what it was to zero [s]", &ServoOptions::ramp_up,
      "ramp_up: of the share of the force, from 0 to 1 [s]");
  add_struct<T>(module, "ServoThreadOptions", "The thread of a servo loop.", &T::rate,
                "rate: a ServoLoop takes that of its servo [Hz]", &T::priority,
                "priority: real-time priority, 1 to 99; 0: an ordinary thread", &T::lock_memory,
                "lock_memory: keep the memory of the whole process from being swapped out", &T::core,
                "core: the only processor core that the thread runs on; -1: any");
  add_struct<ServoLoopOptions>(module, "ServoLoopOptions", "Of a loop in real time.", &ServoLoopOptions::servo,
                               "servo: ServoOptions", &ServoLoopOptions::thread, "thread: ServoThreadOptions");

  add_enum(module, "ServoPhase", "Where the force of a servo loop stands.", ServoPhase::falling,
           "zero rising running falling");
  add_struct<ServoStatus>(module, "ServoStatus", "Where a servo loop stands.", &ServoStatus::phase, "phase: ServoPhase",
                          &ServoStatus::fault, "fault: why the force fell, until it has risen again",
                          &ServoStatus::device, "device: DeviceStatus of the last sample", &ServoStatus::gain,
                          "gain: share of the wanted force that is sent");
  py::class_<VirtualServo>(module, "Servo",
                           "A servo loop in virtual time: step(now) reads the device, asks the force law, a callable "
                           "from DeviceState to a force (3,) [N] in device axes, guards the force and writes it. What "
                           "the law raises makes the force fall to zero, as in C++, and is in `error`; the first goes "
                           "to sys.unraisablehook too. Some 400 times as fast as real time at 1 kHz.")
      .def(py::init(&make_servo), py::keep_alive<1, 2>(), "device"_a, "law"_a, py::kw_only(), "rate"_a = 1000.0,
           "timeout"_a = 4e-3, "ramp_down"_a = 10e-3, "ramp_up"_a = 0.2)
      .def("step", &VirtualServo::step, "now"_a, "One tick at a time [s].")
      .def("release", &VirtualServo::release, "From the next tick on the force falls to zero and stays there.")
      .def("reset", &VirtualServo::reset, "Zero at once, and as new but for the statistics.")
      .def_property_readonly("error", &VirtualServo::error, "the last exception of the law since it was new, or None")
      .def_property_readonly("errors", &VirtualServo::errors, "how often the law raised")
      .def_property_readonly("status", &VirtualServo::status, "ServoStatus")
      .def_property_readonly(
          "statistics", &VirtualServo::statistics,
          "What it has done so far: `period` from tick to tick and `work` of a tick (0 in virtual time), each with "
          "count, p50, p99, p99_9 and worst [s]; ticks that reached the device; missed_deadlines; stale_samples, ticks "
          "on which the device had nothing new; stalled_clock, ticks whose time was not later than before; "
          "watchdog_takeovers, times that the watchdog took the device; idle_ticks, that wrote nothing; faults, how "
          "often each "
          "DeviceFault began.");
}

}  // namespace calligraphy::python
