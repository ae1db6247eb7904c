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

/// A force that is not finite counts as zero in C++, where a servo loop must not throw; here the author is told.
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
  py::dict statistics() const { return servo_statistics(servo_.statistics()); }
  py::object error() const { return law_->error; }
  std::size_t errors() const { return law_->errors; }

 private:
  void refuse_inside_a_tick() const {
    if (!stepping_) return;
    throw Error("this Servo is already inside a tick: step or reset it from one thread only, and not from its force law");
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

/// At the end of Python too, before its threads are: a device written in Python can still be told.
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
  add_enum(module, "DeviceStatus", "Validity of a sample.", DeviceStatus::fault,
           "ok stale disconnected warm_motors needs_calibration fault");
  std::string faults;
  for (std::size_t i = 0; i < device_fault_count; ++i) {
    std::string name = to_string(static_cast<DeviceFault>(i));
    std::replace(name.begin(), name.end(), ' ', '_');
    faults += name + ' ';
  }
  add_enum(module, "DeviceFault", "Cause of a fault in a device, its link or its servo loop.",
           DeviceFault::device_error, faults);
  add_struct<PenOrientation>(module, "PenOrientation", "Orientation of the pen in device axes; NaN if not measured.",
                             &PenOrientation::tilt, "tilt: from the z axis, 0 to pi [rad]", &PenOrientation::azimuth,
                             "azimuth: from the x axis towards the y axis, -pi to pi [rad]");
  add_struct<DeviceState>(
      module, "DeviceState", "One sample of a device.", &DeviceState::time, "time: since the device was opened [s]",
      &DeviceState::position, "position: (3,), device axes [m]", &DeviceState::velocity,
      "velocity: (3,); NaN only if the device neither measures nor estimates it; a Servo fills it "
      "in [m/s]",
      &DeviceState::velocity_estimated, "velocity_estimated: from positions, not measured", &DeviceState::force,
      "force: (3,), the force at work when the sample is read, after every limit, guard and ramp; "
      "NaN if the device does not say; a Servo fills it in [N]",
      &DeviceState::force_settling,
      "force_settling: how long after the last sample that the force law was asked about a force other than `force` "
      "may have been at work; a Servo fills it in, 0 also if nobody knows [s]",
      &DeviceState::buttons, "buttons: one bit per button", &DeviceState::status, "status: DeviceStatus",
      &DeviceState::fault, "fault: DeviceFault: cause of a status other than ok, if known", &DeviceState::orientation,
      "orientation: PenOrientation");
  add_enum(
      module, "VelocitySource",
      "How a device has DeviceState.velocity: true at the time of the sample, or filtered differences of positions.",
      VelocitySource::estimated, "measured estimated");
  add_struct<DeviceAxes>(
      module, "DeviceAxes", "Degrees of freedom of a device.", &DeviceAxes::x, "x: translation along this device axis",
      &DeviceAxes::y, "y: translation along this device axis", &DeviceAxes::z, "z: translation along this device axis",
      &DeviceAxes::rotations, "rotations: pen orientation, sensed as DeviceState.orientation");
  add_struct<Capabilities>(
      module, "Capabilities", "Limits and physics of a device.", &Capabilities::name,
      "name: name of the built-in profile; may be empty", &Capabilities::model,
      "model: display name, such as Phantom Omni", &Capabilities::simulated,
      "simulated: unstable stiffnesses may be tried (StiffnessCheck.off)", &Capabilities::sensed,
      "sensed: DeviceAxes: axes that read() measures", &Capabilities::driven,
      "driven: DeviceAxes: axes that write() drives", &Capabilities::workspace,
      "workspace: extent along each device axis, centred on zero, (3,) [m]", &Capabilities::peak_force,
      "peak_force [N]", &Capabilities::continuous_force, "continuous_force [N]", &Capabilities::usable_stiffness,
      "usable_stiffness: maximum stiffness reported by users [N/m]", &Capabilities::force_step,
      "force_step: of the DAC; 0: unknown, or not quantised [N]", &Capabilities::encoder_step,
      "encoder_step: 0: unknown, or not quantised [m]", &Capabilities::velocity, "velocity: VelocitySource",
      &Capabilities::velocity_cutoff, "velocity_cutoff: of the filter of an estimated velocity [Hz]",
      &Capabilities::update_rate, "update_rate [Hz]", &Capabilities::apparent_mass,
      "apparent_mass: at the tip; 0: unknown [kg]", &Capabilities::viscous_friction, "viscous_friction [N s/m]",
      &Capabilities::coulomb_friction, "coulomb_friction: back-drive friction [N]", &Capabilities::sample_delay,
      "sample_delay: age of a sample when it is read [ticks]");
  add_struct<GripImpedance>(module, "GripImpedance",
                            "Impedance of the grip. Soft (0.05, 1, 100), normal (0.1, 3, 300), firm (0.15, 5, 500).",
                            &GripImpedance::mass, "mass [kg]", &GripImpedance::damping, "damping [N s/m]",
                            &GripImpedance::stiffness, "stiffness [N/m]");
  add_struct<Intention>(module, "Intention", "Intended position and velocity of the pen, in device axes.",
                        &Intention::position, "position: (3,) [m]", &Intention::velocity, "velocity: (3,) [m/s]");
  add_enum(module, "SimulatedFaultKind",
           "What happens: no new sample; samples older by `ticks`; position and velocity NaN; disconnected, without "
           "force; `status` and `fault` reported with fresh samples.",
           SimulatedFaultKind::reported, "stale late garbage unplugged reported");
  add_struct<SimulatedFault>(
      module, "SimulatedFault", "A fault that a simulated device shows for a while.", &SimulatedFault::begin,
      "begin: virtual time [s]", &SimulatedFault::duration, "duration: infinity: for good [s]", &SimulatedFault::kind,
      "kind: SimulatedFaultKind", &SimulatedFault::ticks, "ticks: late: 1 to 1000", &SimulatedFault::status,
      "status: DeviceStatus: reported", &SimulatedFault::fault, "fault: DeviceFault: stale, reported");
  py::class_<VelocityEstimator>(module, "VelocityEstimator",
                                "Velocity from sampled positions: backward differences, smoothed by a first-order "
                                "low-pass; what built-in devices and Servo do without a measured velocity.")
      .def(py::init<double>(), "cutoff"_a = VelocityEstimator::default_cutoff)
      .def(
          "update",
          [](VelocityEstimator& self, const ArrayLike& position, double elapsed) {
            return array_of(self.update(vector(position, "position"), elapsed));
          },
          "position"_a, "elapsed"_a,
          "Takes the next position (3,) [m], `elapsed` [s] after the previous one; returns the estimate (3,) [m/s].")
      .def_property_readonly(
          "velocity", [](const VelocityEstimator& self) { return array_of(self.velocity()); },
          "(3,), the last estimate [m/s]")
      .def("restart", &VelocityEstimator::restart, "Forgets the position and the estimate.");
  module.def(
      "device_profiles",
      [] {
        const auto profiles = device_profiles();
        return std::vector<Capabilities>(profiles.begin(), profiles.end());
      },
      "The built-in profiles: omni, touch, desktop, premium-1.5, ideal. Apparent masses are estimates.");
  module.def("device_profile", &device_profile, py::return_value_policy::copy, "name"_a,
             "The built-in profile with this name. Raises InvalidValue naming the available ones.");

  py::class_<HapticDevice, PythonDevice>(
      module, "HapticDevice",
      "A force-feedback device. A subclass defines capabilities(), read(), write(force) and close(). Their exceptions "
      "are passed to sys.unraisablehook, once until the method works again, and the sample has status `fault`. A "
      "`with` block closes the device. While a loop runs on a C++ device, any use outside the force law of that loop "
      "raises Error.")
      .def(py::init<>())
      .def(
          "capabilities", [](const HapticDevice& self) { return self.capabilities(); }, "Capabilities of the device.")
      .def(
          "read", [](HapticDevice& self) { return idle(self).read(); }, "The newest sample.")
      .def(
          "write", [](HapticDevice& self, const ArrayLike& force) { write(idle(self), vector(force, "force")); },
          "force"_a,
          "Commands a force in device axes (3,) [N], held until the next call. If it is not finite, commands zero and "
          "raises InvalidValue.")
      .def("close", when_idle(&HapticDevice::close), "Sets the force to zero; later reads return `disconnected`.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](const py::object& self, const py::args&) { self.attr("close")(); });

  py::class_<SimulatedDevice, HapticDevice>(module, "SimulatedDevice", py::is_final(),
                                            "A simulated device and the hand that holds it, in virtual time; the "
                                            "motion between samples is integrated exactly. By default nobody holds it.")
      .def(py::init([](const Capabilities& profile, const GripImpedance& grip, const ArrayLike& position) {
             return SimulatedDevice(profile, grip, vector(position, "position"));
           }),
           "profile"_a, "grip"_a = GripImpedance{0.0, 0.0, 0.0}, "position"_a = py::make_tuple(0.0, 0.0, 0.0))
      .def("set_intention", when_idle(&SimulatedDevice::set_intention), "intention"_a,
           "Sets the intended motion of the hand, which advance() continues at its velocity.")
      .def("set_grip", when_idle(&SimulatedDevice::set_grip), "grip"_a,
           "Sets the grip of the hand that holds the device.")
      .def("set_buttons", when_idle(&SimulatedDevice::set_buttons), "buttons"_a, "One bit per pressed button.")
      .def("advance", when_idle(&SimulatedDevice::advance), "seconds"_a,
           "Advances virtual time [s]; takes a sample. Raises InvalidValue for a time that is negative or not finite.")
      .def("schedule", when_idle(&SimulatedDevice::schedule), "faults"_a,
           "Replaces the list of SimulatedFault; of several that are active at once the first counts.")
      .def_property_readonly("true_position", when_idle(&SimulatedDevice::true_position), "(3,), not quantised [m]")
      .def_property_readonly("true_velocity", when_idle(&SimulatedDevice::true_velocity), "(3,) [m/s]")
      .def_property_readonly("applied_force", when_idle(&SimulatedDevice::applied_force), "(3,) [N]")
      .def_property_readonly("refused_forces", when_idle(&SimulatedDevice::refused_forces),
                             "number of forces written that were not finite")
      .def_property_readonly("time", when_idle(&SimulatedDevice::time), "[s]");

  py::class_<ReplayDevice, HapticDevice>(module, "ReplayDevice", py::is_final(),
                                         "Returns the recorded samples in order, then `disconnected`.")
      .def(py::init<std::vector<DeviceState>, Capabilities>(), "samples"_a, "capabilities"_a)
      .def_property_readonly("finished", when_idle(&ReplayDevice::finished), "whether no sample is left")
      .def_property_readonly("last_force", when_idle(&ReplayDevice::last_force), "(3,) [N]");

  add_struct<PointerOptions>(
      module, "PointerOptions", "How the simulated hand follows a pointer.", &PointerOptions::rate,
      "rate: of read() [Hz]", &PointerOptions::smoothing_time, "smoothing_time: lag behind the pointer [s]",
      &PointerOptions::max_speed, "max_speed: speed limit along the paper [m/s]", &PointerOptions::lifting_speed,
      "lifting_speed: speed limit perpendicular to the paper [m/s]", &PointerOptions::hover_height,
      "hover_height: height while the pointer is not pressed [m]", &PointerOptions::press_depth,
      "press_depth: depth of the intended position at full pressure [m]", &PointerOptions::paper,
      "paper: (4, 4), from the paper (x, y on it, z out of it) to device axes; translation [m]");
  py::class_<PointerDevice, HapticDevice>(
      module, "PointerDevice", py::is_final(),
      "A mouse, tablet or finger that moves the hand of a simulated device, for users without a haptic device. Each "
      "read() advances virtual time by one period; move() may be called from any thread.")
      .def(py::init<const Capabilities&, const GripImpedance&, const PointerOptions&>(), "profile"_a,
           "grip"_a = GripImpedance{}, "options"_a = PointerOptions{})
      .def("move", &PointerDevice::move, "x"_a, "y"_a, "pressure"_a, "buttons"_a = 0,
           "Sets the position of the pointer on the paper [m] and its pressure, from 0 (not pressed) to 1.")
      .def_property_readonly("intention", when_idle(&PointerDevice::intention),
                             "Intention: intended position of the hand, in device axes, copied");

  module.def(
      "install_emergency_stop", &install_for_python,
      "Takes the force from every open device when the program ends: at exit, at a crash and at every signal that "
      "ends or stops it. What was installed before follows, so that Ctrl-C still raises KeyboardInterrupt. "
      "Call it once, in the main thread, after any signal.signal(). At a signal a device written in Python gets "
      "its zero only from the next tick of its loop, if there is one.");
  module.def("emergency_stop", &emergency_stop, py::call_guard<py::gil_scoped_release>(),
             "Takes the force from every open device at once and keeps it at zero.");
  module.def("emergency_stopped", &emergency_stopped,
             "Whether emergency_stop() was called and the force has not been permitted again.");
  module.def("clear_emergency_stop", &clear_emergency_stop, "Permits forces again; a running loop ramps up from zero.");

  using T = ServoThreadOptions;
  add_struct<ServoOptions>(
      module, "ServoOptions", "Rate and safety limits of a servo loop.", &ServoOptions::rate, "rate [Hz]",
      &ServoOptions::timeout,
      "timeout: without a fresh sample, a tick or a result of the law before the force ramps down [s]",
      &ServoOptions::ramp_down, "ramp_down: from the last force to zero [s]", &ServoOptions::ramp_up,
      "ramp_up: of the gain on the force from 0 to 1 [s]");
  add_struct<T>(module, "ServoThreadOptions", "The thread of a servo loop.", &T::priority,
                "priority: real-time priority, 1 to 99; 0: a normal thread", &T::lock_memory,
                "lock_memory: lock the memory of the whole process into RAM", &T::core,
                "core: processor core that the thread is bound to; -1: any");
  add_struct<ServoLoopOptions>(module, "ServoLoopOptions", "Options of a real-time loop.", &ServoLoopOptions::servo,
                               "servo: ServoOptions", &ServoLoopOptions::thread, "thread: ServoThreadOptions");

  add_enum(module, "ServoPhase", "Phase of the force output.", ServoPhase::falling, "zero rising running falling");
  add_struct<ServoStatus>(module, "ServoStatus", "Current state of a servo loop.", &ServoStatus::phase,
                          "phase: ServoPhase", &ServoStatus::fault,
                          "fault: cause of the ramp-down, until the force has ramped up again", &ServoStatus::device,
                          "device: DeviceStatus of the last sample", &ServoStatus::gain,
                          "gain: on the desired or, while it ramps down, the held force [1]");
  py::class_<VirtualServo>(module, "Servo",
                           "A servo loop in virtual time: step(now) reads the device, calls the force law, which maps "
                           "a DeviceState to a force (3,) [N] in device axes, guards the force and writes it. If the "
                           "law raises, the force ramps down to zero and the exception is in `error`; the first is "
                           "also passed to sys.unraisablehook. About 400 times as fast as real time at 1 kHz.")
      .def(py::init(&make_servo), py::keep_alive<1, 2>(), "device"_a, "law"_a, py::kw_only(), "rate"_a = 0.0,
           "timeout"_a = 4e-3, "ramp_down"_a = 10e-3, "ramp_up"_a = 0.2)
      .def("step", &VirtualServo::step, "now"_a, "Runs one tick at the time `now` [s].")
      .def("release", &VirtualServo::release, "From the next tick on, ramps the force down to zero and keeps it there.")
      .def("reset", &VirtualServo::reset,
           "Sets the force to zero immediately and resets everything except the statistics.")
      .def_property_readonly("error", &VirtualServo::error,
                             "the last exception of the force law since construction or reset(), or None")
      .def_property_readonly("errors", &VirtualServo::errors, "number of exceptions of the force law")
      .def_property_readonly("status", &VirtualServo::status, "ServoStatus")
      .def_property_readonly(
          "statistics", &VirtualServo::statistics,
          "A dict: `period` from tick to tick and `work` per tick (0 in virtual time), each with count, p50, p99, "
          "p99_9 and worst [s]; ticks that reached the device; missed_deadlines; stale_samples, ticks without a fresh "
          "sample; stalled_clock, ticks no later than the previous one; watchdog_takeovers of the device; idle_ticks, "
          "which wrote nothing; faults, by DeviceFault.");
}

}  // namespace calligraphy::python
