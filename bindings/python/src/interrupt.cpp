// Ctrl-C while C++ works without the GIL.
#include "interrupt.hpp"

#include <pybind11/pybind11.h>

#include <utility>

namespace calligraphy::python {

void Interrupt::check() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + interval;
  const pybind11::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

std::function<void(double)> interruptible(std::function<void(double)> progress) {
  return [interrupt = Interrupt(), progress = std::move(progress)](double share) mutable {
    interrupt.check();
    if (progress) progress(share);
  };
}

}  // namespace calligraphy::python
