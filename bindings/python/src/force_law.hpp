// A force law that is written in Python.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include <pybind11/pybind11.h>

#include <calligraphy/devices/servo.hpp>

namespace calligraphy::python {

/// A callable from DeviceState to a force (3,) [N], and what it raised. Under the GIL, which its end takes.
class PythonLaw {
 public:
  static std::shared_ptr<PythonLaw> make(pybind11::function law);

  /// @throws Error when it raised, so that the force falls. The first time that is told to sys.unraisablehook as well:
  /// a law that fails does so a thousand times a second.
  Eigen::Vector3d operator()(const DeviceState& state);

  /// As if it had raised nothing.
  void forget_errors();
  std::size_t errors() const noexcept { return errors_; }            ///< how often it raised
  const pybind11::object& error() const noexcept { return error_; }  ///< what it raised last, or None

 private:
  explicit PythonLaw(pybind11::function law) : law_(std::move(law)) {}

  void note(pybind11::error_already_set& error);

  pybind11::function law_;
  pybind11::object error_ = pybind11::none();
  std::size_t errors_ = 0;
};

/// Takes the GIL whenever it is called, from any thread. `own_thread`: only from threads of Python or of a ServoThread.
ForceLaw force_law(std::shared_ptr<PythonLaw> law, bool own_thread);

}  // namespace calligraphy::python
