// A haptic device that is written in Python.
#pragma once

#include <pybind11/pybind11.h>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy::python {

/// Calls the methods of a Python subclass. What they raise cannot pass through the servo loop: it goes to
/// sys.unraisablehook, once until the method works again, and the sample says `fault`, also when it is write() that
/// raised. A call costs about a microsecond and the GIL.
class PythonDevice final : public HapticDevice {
 public:
  const Capabilities& capabilities() const noexcept override;
  DeviceState read() noexcept override;
  void write(const Eigen::Vector3d& force) noexcept override;
  void close() noexcept override;

  /// As capabilities(), for those whom what it raises can reach. @throws what the subclass raises, or TypeError
  void ask_capabilities() const;

 private:
  mutable Capabilities capabilities_;  ///< as last told
  // Whether the last call failed; under the GIL.
  mutable bool no_capabilities_ = false;
  bool no_read_ = false;
  bool no_write_ = false;
};

/// While it lives, what a device in Python raises to end the program (Ctrl-C, SystemExit) is kept for whoever steps a
/// Servo in this thread. Under the GIL.
class InStep {
 public:
  InStep() noexcept;
  ~InStep();
  InStep(const InStep&) = delete;
  InStep& operator=(const InStep&) = delete;

  /// False: nobody steps here.
  static bool keep(const pybind11::error_already_set& error) noexcept;
  /// @throws error_already_set what was kept
  void raise() const;

 private:
  pybind11::object kept_;
  InStep* outer_;
};

/// A device in Python is asked before a loop relies on it. @throws what it raises, or TypeError
void refuse_without_capabilities(const HapticDevice& device);

}  // namespace calligraphy::python
