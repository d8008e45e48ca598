#pragma once

#include <pybind11/pybind11.h>

/// One function a room, each in the file of the room's name; module.cpp calls them in the rooms' order.
namespace stillwater {

void bind_core(pybind11::module_& module);
void bind_picture(pybind11::module_& module);
void bind_patches(pybind11::module_& module);
void bind_layers(pybind11::module_& module);
void bind_peel(pybind11::module_& module);
void bind_matting(pybind11::module_& module);
void bind_inpaint(pybind11::module_& module);
void bind_motion(pybind11::module_& module);
void bind_water(pybind11::module_& module);
void bind_flow(pybind11::module_& module);
void bind_flow_painting(pybind11::module_& module);
void bind_appearance(pybind11::module_& module);
void bind_example(pybind11::module_& module);
void bind_frame(pybind11::module_& module);

}  // namespace stillwater
