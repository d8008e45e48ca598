#include <pybind11/pybind11.h>

#include "bindings/rooms.h"
#include "core/error.h"

namespace py = pybind11;

PYBIND11_MODULE(_stillwater, module) {
  module.doc() = "The engine of Stillwater. Use the package `stillwater`, which documents what is public.";
  module.attr("__version__") = STILLWATER_VERSION;
  py::register_exception<stillwater::BadInput>(module, "BadInput", PyExc_ValueError);
  py::register_exception<stillwater::FileError>(module, "FileError", PyExc_OSError);
  py::register_exception<stillwater::Cancelled>(module, "Cancelled", PyExc_RuntimeError);
  py::register_exception<stillwater::NotConverged>(module, "NotConverged", PyExc_RuntimeError);
  stillwater::bind_core(module);
  stillwater::bind_picture(module);
  stillwater::bind_patches(module);
  stillwater::bind_layers(module);
  stillwater::bind_peel(module);
  stillwater::bind_matting(module);
  stillwater::bind_inpaint(module);
  stillwater::bind_motion(module);
  stillwater::bind_water(module);
  stillwater::bind_flow(module);
  stillwater::bind_flow_painting(module);
  stillwater::bind_appearance(module);
  stillwater::bind_example(module);
  stillwater::bind_frame(module);
}
