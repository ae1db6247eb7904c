// Devices and force laws that are written in Python.
#pragma once

#include <memory>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <calligraphy/devices/servo.hpp>

#include "arrays.hpp"
#include "threads.hpp"

namespace calligraphy::python {

/// While it lives, what a device in Python raises to end the program (Ctrl-C, SystemExit) is kept for whoever steps a
/// Servo in this thread. Under the GIL.
class InStep {
 public:
  InStep() noexcept : outer_(std::exchange(innermost, this)) {}
  ~InStep() { innermost = outer_; }
  InStep(const InStep&) = delete;
  InStep& operator=(const InStep&) = delete;

  /// False: nobody steps here.
  static bool keep(const py::error_already_set& error) noexcept {
    if (innermost == nullptr) return false;
    innermost->kept_ = with_traceback(error);
    return true;
  }
  /// @throws error_already_set what was kept
  void raise() const {
    if (kept_) raise(kept_);
  }

  [[noreturn]] static void raise(const py::object& error) {
    PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr());
    throw py::error_already_set();
  }
  static py::object with_traceback(const py::error_already_set& error) {
    if (error.trace()) PyException_SetTraceback(error.value().ptr(), error.trace().ptr());
    return error.value();
  }

 private:
  static inline thread_local InStep* innermost = nullptr;

  py::object kept_;
  InStep* outer_;
};

/// Calls the methods of a Python subclass. What they raise cannot pass through the servo loop: it goes to
/// sys.unraisablehook, once until the method works again, and the sample says `fault`, also when it is write() that
/// raised. A call costs about a microsecond and the GIL.
class PythonDevice final : public HapticDevice {
 public:
  const Capabilities& capabilities() const noexcept override {
    call("capabilities", no_capabilities_,
         [this](const py::object& result) { capabilities_ = checked<Capabilities>(result, "capabilities"); });
    return capabilities_;
  }

  DeviceState read() noexcept override {
    keep_thread_state();
    const py::gil_scoped_acquire gil;
    DeviceState state;
    const bool answered =
        call("read", no_read_, [&state](const py::object& result) { state = checked<DeviceState>(result, "read"); });
    if (!answered || no_write_) {
      state.status = DeviceStatus::fault;
      state.fault = DeviceFault::device_error;
    }
    return state;
  }

  void write(const Eigen::Vector3d& force) noexcept override {
    keep_thread_state();
    const py::gil_scoped_acquire gil;
    call(
        "write", no_write_, [](const py::object&) {}, array_of(force));
  }

  void close() noexcept override {
    bool failed = false;
    call("close", failed, [](const py::object&) {});
  }

  /// A device in Python is asked before a loop relies on it. @throws what it raises, or TypeError
  static void refuse_without_capabilities(const HapticDevice& device) {
    if (const auto* const self = dynamic_cast<const PythonDevice*>(&device)) {
      self->capabilities_ = checked<Capabilities>(self->method("capabilities")(), "capabilities");
    }
  }

 private:
  template <class Answer>
  static Answer checked(const py::object& answer, const char* method) {
    if (py::isinstance<Answer>(answer)) return answer.cast<Answer>();
    throw py::type_error(std::string(method) + "() returned " + py::repr(answer).cast<std::string>() +
                         ", a calligraphy." + py::type::of<Answer>().attr("__name__").template cast<std::string>() +
                         " is expected");
  }

  py::function method(const char* name) const {
    py::function found = py::get_override(static_cast<const HapticDevice*>(this), name);
    if (!found) throw py::type_error(std::string("HapticDevice.") + name + " must be defined by the subclass");
    return found;
  }

  /// Calls a method of the subclass and hands what it returns to `take`; false when that is missing or raises, which is
  /// told unless it `failed` before: a device that is broken is so a thousand times a second.
  template <class Take, class... Arguments>
  bool call(const char* name, bool& failed, Take&& take, Arguments&&... arguments) const noexcept {
    keep_thread_state();
    const py::gil_scoped_acquire gil;
    const bool known = std::exchange(failed, true);
    try {
      take(method(name)(std::forward<Arguments>(arguments)...));
      failed = false;
      return true;
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_Exception) && InStep::keep(error)) {
        failed = known;
      } else if (!known) {
        error.discard_as_unraisable(name);
      }
      return false;
    } catch (const py::builtin_exception& error) {
      error.set_error();
    } catch (const std::exception& error) {
      PyErr_SetString(PyExc_RuntimeError, error.what());
    }
    known ? PyErr_Clear() : PyErr_WriteUnraisable(py::str(name).ptr());
    return false;
  }

  mutable Capabilities capabilities_;  ///< as last told
  // Whether the last call failed; under the GIL.
  mutable bool no_capabilities_ = false;
  bool no_read_ = false;
  bool no_write_ = false;
};

using Law = py::typing::Callable<ArrayLike(const DeviceState&)>;

/// A callable from DeviceState to a force (3,) [N], and what it raised. Under the GIL, which its end takes.
class PythonLaw {
 public:
  static std::shared_ptr<PythonLaw> make(py::function law) {
    return {new PythonLaw(std::move(law)), [](PythonLaw* made) {
              const py::gil_scoped_acquire gil;
              delete made;
            }};
  }

  /// Takes the GIL whenever it is called, from any thread. `own_thread`: only from threads of Python or of a
  /// ServoThread.
  static ForceLaw force_law(std::shared_ptr<PythonLaw> law, bool own_thread) {
    return [law = std::move(law), own_thread](const DeviceState& state) {
      if (own_thread) keep_thread_state();
      const py::gil_scoped_acquire gil;
      return law->ask(state);
    };
  }

  /// As if it had raised nothing.
  void forget_errors() { errors = 0, error = py::none(); }

  std::size_t errors = 0;         ///< how often it raised
  py::object error = py::none();  ///< what it raised last, or None

 private:
  explicit PythonLaw(py::function law) : law_(std::move(law)) {}

  /// @throws Error when it raised, so that the force falls. The first time that is told to sys.unraisablehook as well:
  /// a law that fails does so a thousand times a second. Ctrl-C is raised by Servo.step().
  Eigen::Vector3d ask(const DeviceState& state) {
    const InLaw here(this);
    try {
      try {
        return vector(law_(state), "force");
      } catch (const ValueError& wrong) {
        PyErr_SetString(PyExc_ValueError, wrong.what());
        throw py::error_already_set();
      }
    } catch (py::error_already_set& raised) {
      error = InStep::with_traceback(raised);
      if (errors++ == 0 && !raised.matches(PyExc_KeyboardInterrupt)) raised.discard_as_unraisable("force law");
      throw Error("the force law raised");
    }
  }

  py::function law_;
};

}  // namespace calligraphy::python
