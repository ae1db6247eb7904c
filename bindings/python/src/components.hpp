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

namespace calligraphy::python {

void add_model(Module& module);
void add_collision(Module& module);
void add_devices(Module& module);
void add_kinematics(Module& module);
void add_phantom(Module& module);
void add_openhaptics(Module& module);
void add_render(Module& module);
void add_practice(Module& module);
void add_live(Module& module);
void add_experiments(Module& module);

}  // namespace calligraphy::python
