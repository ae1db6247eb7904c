// A haptic device that is written in Python.
#include "python_device.hpp"

#include <utility>

#include "arrays.hpp"
#include "thread_state.hpp"

namespace calligraphy::python {
namespace {

/// Calls a method of the subclass and hands what it returns to `take`; false when that is missing or raises, which is
/// told unless it `failed` before: a device that is broken is so a thousand times a second.
template <class Take, class... Arguments>
bool call(const PythonDevice& device, const char* method, bool& failed, Take&& take,
          Arguments&&... arguments) noexcept {
  keep_thread_state();
  const py::gil_scoped_acquire gil;
  const bool known = std::exchange(failed, true);
  try {
    const py::function found = py::get_override(static_cast<const HapticDevice*>(&device), method);
    if (!found) {
      throw py::type_error(std::string("HapticDevice.") + method + " must be defined by the subclass");
    }
    take(found(std::forward<Arguments>(arguments)...));
    failed = false;
    return true;
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception) && InStep::keep(error)) {
      failed = known;
      return false;
    }
    if (!known) error.discard_as_unraisable(method);
  } catch (const py::builtin_exception& error) {
    if (!known) {
      error.set_error();
      PyErr_WriteUnraisable(py::str(method).ptr());
    }
  } catch (const std::exception& error) {
    if (!known) {
      PyErr_SetString(PyExc_RuntimeError, error.what());
      PyErr_WriteUnraisable(py::str(method).ptr());
    }
  }
  return false;
}

thread_local InStep* stepping = nullptr;

}  // namespace

InStep::InStep() noexcept : outer_(std::exchange(stepping, this)) {}
InStep::~InStep() { stepping = outer_; }

bool InStep::keep(const py::error_already_set& error) noexcept {
  if (stepping == nullptr) return false;
  stepping->kept_ = error.value();
  if (error.trace()) PyException_SetTraceback(stepping->kept_.ptr(), error.trace().ptr());
  return true;
}

void InStep::raise() const {
  if (!kept_) return;
  PyErr_SetObject(py::type::handle_of(kept_).ptr(), kept_.ptr());
  throw py::error_already_set();
}

const Capabilities& PythonDevice::capabilities() const noexcept {
  call(*this, "capabilities", no_capabilities_,
       [this](const py::object& result) { capabilities_ = result.cast<Capabilities>(); });
  return capabilities_;
}

void PythonDevice::ask_capabilities() const {
  const py::function found = py::get_override(static_cast<const HapticDevice*>(this), "capabilities");
  if (!found) throw py::type_error("HapticDevice.capabilities must be defined by the subclass");
  const py::object answer = found();
  if (!py::isinstance<Capabilities>(answer)) {
    throw py::type_error("capabilities() returned " + py::repr(answer).cast<std::string>() +
                         ", a calligraphy.Capabilities is expected");
  }
  capabilities_ = answer.cast<Capabilities>();
}

void refuse_without_capabilities(const HapticDevice& device) {
  if (const auto* const written_in_python = dynamic_cast<const PythonDevice*>(&device)) {
    written_in_python->ask_capabilities();
  }
}

DeviceState PythonDevice::read() noexcept {
  keep_thread_state();
  const py::gil_scoped_acquire gil;
  DeviceState state;
  const bool answered = call(*this, "read", no_read_, [&state](const py::object& result) {
    if (!py::isinstance<DeviceState>(result)) {
      throw py::type_error("read() returned " + py::repr(result).cast<std::string>() +
                           ", a calligraphy.DeviceState is expected");
    }
    state = result.cast<DeviceState>();
  });
  if (!answered || no_write_) {
    state.status = DeviceStatus::fault;
    state.fault = DeviceFault::device_error;
  }
  return state;
}

void PythonDevice::write(const Eigen::Vector3d& force) noexcept {
  keep_thread_state();
  const py::gil_scoped_acquire gil;
  call(
      *this, "write", no_write_, [](const py::object&) {}, array_of(force));
}

void PythonDevice::close() noexcept {
  bool failed = false;
  call(*this, "close", failed, [](const py::object&) {});
}

}  // namespace calligraphy::python
