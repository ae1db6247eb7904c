// Devices and force laws written in Python.
#pragma once

#include <memory>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <calligraphy/devices/servo.hpp>

#include "arrays.hpp"
#include "threads.hpp"

namespace calligraphy::python {

/// During its lifetime, an exception of a Python device that ends the program (Ctrl-C, SystemExit) is stored for the
/// caller that steps a Servo in this thread. Requires the GIL.
class InStep {
 public:
  InStep() noexcept : outer_(std::exchange(innermost, this)) {}
  ~InStep() { innermost = outer_; }
  InStep(const InStep&) = delete;
  InStep& operator=(const InStep&) = delete;

  /// False if no Servo is being stepped in this thread.
  static bool keep(const py::error_already_set& error) noexcept {
    if (innermost == nullptr) return false;
    innermost->kept_ = with_traceback(error);
    return true;
  }
  /// @throws error_already_set the stored exception, if any
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

/// Calls the methods of a Python subclass. Their exceptions cannot propagate through the servo loop: they are passed to
/// sys.unraisablehook, once until the method works again, and the status of the sample is `fault`, also after write()
/// raised. A call takes about a microsecond and needs the GIL.
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

  std::string advice() const override {
    const py::gil_scoped_acquire gil;
    std::string text;
    if (py::get_override(static_cast<const HapticDevice*>(this), "advice")) {
      call("advice", no_advice_, [&text](const py::object& result) { text = result.cast<std::string>(); });
    }
    return text;
  }

  /// Reads the capabilities of a Python device before a loop relies on them. @throws its exception, or TypeError
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
                         ", expected a calligraphy." +
                         py::type::of<Answer>().attr("__name__").template cast<std::string>());
  }

  py::function method(const char* name) const {
    py::function found = py::get_override(static_cast<const HapticDevice*>(this), name);
    if (!found) throw py::type_error(std::string("HapticDevice.") + name + " must be defined by the subclass");
    return found;
  }

  /// Calls a method of the subclass and passes its result to `take`. Returns false if the method is missing or raises;
  /// this is reported only the first time, because a broken device fails a thousand times a second.
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

  mutable Capabilities capabilities_;  ///< as last returned
  // Whether the last call failed; protected by the GIL.
  mutable bool no_capabilities_ = false;
  mutable bool no_advice_ = false;
  bool no_read_ = false;
  bool no_write_ = false;
};

using Law = py::typing::Callable<ArrayLike(const DeviceState&)>;

/// A callable that maps a DeviceState to a force (3,) [N], and its exceptions. Requires the GIL; its deleter acquires
/// it.
class PythonLaw {
 public:
  static std::shared_ptr<PythonLaw> make(py::function law) {
    return {new PythonLaw(std::move(law)), [](PythonLaw* made) {
              const py::gil_scoped_acquire gil;
              delete made;
            }};
  }

  /// Acquires the GIL on every call. `own_thread`: called only from Python threads or a ServoThread.
  static ForceLaw force_law(std::shared_ptr<PythonLaw> law, bool own_thread) {
    return [law = std::move(law), own_thread](const DeviceState& state) {
      if (own_thread) keep_thread_state();
      const py::gil_scoped_acquire gil;
      return law->ask(state);
    };
  }

  /// Clears the stored exceptions.
  void forget_errors() { errors = 0, error = py::none(); }

  std::size_t errors = 0;         ///< number of exceptions
  py::object error = py::none();  ///< the last exception, or None

 private:
  explicit PythonLaw(py::function law) : law_(std::move(law)) {}

  /// @throws Error when the law raised, so that the force ramps down. Only the first exception is passed to
  /// sys.unraisablehook: a broken law raises a thousand times a second. Servo.step() raises Ctrl-C.
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
