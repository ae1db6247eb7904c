// Interface through which a test controls the stub of the vendor's runtime.
#pragma once

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace calligraphy_test {

/// Filled in by `stand_in_control` of the library. Devices are numbered in the order in which they were plugged in.
struct StandInControl {
  /// Resets everything: no device, no error, stepped by the test.
  void (*reset)();
  /// "Default Device" is what a null name opens.
  void (*plug_in)(const char* name, const char* model, const char* profile);
  /// From the next start of the scheduler, run in its own thread with one tick per ms; otherwise stepped.
  void (*run_in_real_time)(bool);
  /// One tick: every callback, then 1 ms of physics. Does nothing unless the scheduler runs.
  void (*step)();
  double (*time)();  ///< virtual [s]

  /// The error occurs `count` times, once per frame of the device.
  void (*inject)(int device, unsigned code, int count);
  /// One error, immediately.
  void (*report)(unsigned code);
  /// The next call of this function, by its name, leaves the error behind ("hdStartScheduler").
  void (*fail)(const char* function, unsigned code);
  /// The next call of this function succeeds, and leaves the error behind nevertheless.
  void (*leave)(const char* function, unsigned code);
  void (*set_calibration)(int device, unsigned state);
  void (*set_motor_temperature)(int device, double);  ///< of its second motor; NaN: the device does not tell it
  void (*put_into_inkwell)(int device, bool);
  void (*set_buttons)(int device, int);
  void (*set_intention)(int device, const double position[3], const double velocity[3]);  ///< [m], [m/s]
  void (*true_position)(int device, double position[3]);                                  ///< [m]
  void (*commanded_force)(int device, double force[3]);                                   ///< as set last [N]
  void (*applied_force)(int device, double force[3]);                                     ///< at the motors [N]
  bool (*is_open)(int device);
  bool (*output_enabled)(int device);
  bool (*scheduler_runs)();
  int (*callbacks)();
  /// Number of calls since the reset that violate the vendor's rules (a value outside a frame, a frame left open).
  int (*broken_rules)();
};

/// Keeps the library loaded during its lifetime.
class StandIn {
 public:
  explicit StandIn(const std::string& library) : file_(dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (file_ == nullptr) throw std::runtime_error(dlerror());
    const auto control = reinterpret_cast<void (*)(StandInControl*)>(dlsym(file_, "stand_in_control"));
    control(&control_);
    control_.reset();
  }
  ~StandIn() { dlclose(file_); }
  StandIn(const StandIn&) = delete;
  StandIn& operator=(const StandIn&) = delete;

  const StandInControl* operator->() const { return &control_; }

 private:
  void* file_;
  StandInControl control_ = {};
};

}  // namespace calligraphy_test
