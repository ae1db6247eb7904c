// One function a component: it adds the component's names to the module.
#pragma once

#include <pybind11/pybind11.h>

namespace calligraphy::python {

void add_errors(pybind11::module_& module);
void add_model(pybind11::module_& module);
void add_collision(pybind11::module_& module);
void add_devices(pybind11::module_& module);
void add_kinematics(pybind11::module_& module);
void add_phantom(pybind11::module_& module);
void add_openhaptics(pybind11::module_& module);
void add_render(pybind11::module_& module);
void add_practice(pybind11::module_& module);
void add_live(pybind11::module_& module);
void add_trials(pybind11::module_& module);

}  // namespace calligraphy::python
