// A force law that is written in Python.
#include "force_law.hpp"

#include <utility>

#include <calligraphy/base/error.hpp>

#include "arrays.hpp"
#include "at_work.hpp"
#include "thread_state.hpp"

namespace calligraphy::python {

std::shared_ptr<PythonLaw> PythonLaw::make(py::function law) {
  return {new PythonLaw(std::move(law)), [](PythonLaw* made) {
            const py::gil_scoped_acquire gil;
            delete made;
          }};
}

Eigen::Vector3d PythonLaw::operator()(const DeviceState& state) {
  const InLaw here(this);
  try {
    try {
      return vector(law_(state), "force");
    } catch (const ValueError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
      throw py::error_already_set();
    }
  } catch (py::error_already_set& error) {
    note(error);
    throw Error("the force law raised");
  }
}

void PythonLaw::note(py::error_already_set& error) {
  error_ = error.value();
  if (error.trace()) PyException_SetTraceback(error_.ptr(), error.trace().ptr());
  // Ctrl-C is raised by Servo.step().
  if (errors_++ == 0 && !error.matches(PyExc_KeyboardInterrupt)) error.discard_as_unraisable("force law");
}

void PythonLaw::forget_errors() {
  errors_ = 0;
  error_ = py::none();
}

ForceLaw force_law(std::shared_ptr<PythonLaw> law, bool own_thread) {
  return [law = std::move(law), own_thread](const DeviceState& state) {
    if (own_thread) keep_thread_state();
    const py::gil_scoped_acquire gil;
    return (*law)(state);
  };
}

}  // namespace calligraphy::python
