#include "layers/inpaint.h"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/rooms.h"

namespace stillwater {
namespace {

py::array_t<float> inpaint_arrays(const FloatArray& picture, const FloatArray& hole, int patch, std::optional<double> radius,
                                  std::uint64_t seed, int grow, const std::optional<FloatArray>& source, bool blend,
                                  const Progress::Listener& progress) {
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  const Plane open = as_image<float>(hole, "hole");
  InpaintParameters parameters{.patch = patch, .radius = radius, .seed = seed, .grow = grow, .source = {}, .blend = blend};
  if (source) parameters.source = as_image<float>(*source, "source");
  const py::gil_scoped_release release;
  const Rgba filled = inpaint(image, open, parameters, Progress(progress));
  const py::gil_scoped_acquire acquire;
  return as_array(filled);
}

}  // namespace

void bind_inpaint(py::module_& module) {
  module.def("inpaint", &inpaint_arrays, py::arg("picture"), py::arg("hole"), py::kw_only(), py::arg("patch") = 9,
             py::arg("radius") = std::nullopt, py::arg("seed") = 0, py::arg("grow") = 2, py::arg("source") = std::nullopt,
             py::arg("blend") = true, py::arg("progress") = Progress::Listener());
}

}  // namespace stillwater
