// Common includes of the extension module, and its components in the order in which their types depend on each other.
// All sources are compiled as one unit, because the headers take longer to compile than the sources.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>
#include <thread>
#include <variant>

#include <pybind11/functional.h>
#include <pybind11/stl/filesystem.h>

#include "callbacks.hpp"
#include "fields.hpp"
#include "laws.hpp"

namespace calligraphy::python {

void add_model(py::module_& module);
void add_judge(py::module_& module);
void add_collision(py::module_& module);
void add_devices(py::module_& module);
void add_kinematics(py::module_& module);
void add_phantom(py::module_& module);
void add_openhaptics(py::module_& module);
void add_render(py::module_& module);
void add_practice(py::module_& module);
void add_lesson(py::module_& module);
void add_live(py::module_& module);
void add_experiments(py::module_& module);
/// Documentation and signatures of everything in the module.
void finish(const py::module_& module);

}  // namespace calligraphy::python
