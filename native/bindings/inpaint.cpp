#include "layers/inpainting/inpaint.h"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "layers/inpainting/cyclic_by_exemplars.h"

namespace stillwater {
namespace {

py::array_t<float> inpaint_arrays(const FloatArray& picture, const FloatArray& hole, int patch,
                                  std::optional<double> radius, std::uint64_t seed, int grow,
                                  const std::optional<FloatArray>& source, bool blend,
                                  const Progress::Listener& progress) {
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  const Plane open = as_image<float>(hole, "hole");
  InpaintParameters parameters{.patch = patch, .radius = radius, .seed = seed, .grow = grow, .source = {}, .blend = {}};
  if (blend) parameters.blend = BlendParameters();
  if (source) parameters.source = as_image<float>(*source, "source");
  const py::gil_scoped_release release;
  const Rgba filled = inpaint(image, open, parameters, Progress(progress));
  const py::gil_scoped_acquire acquire;
  return as_array(filled);
}

py::array_t<float> make_cyclic_arrays(const FloatArray& image, bool along_x, bool along_y,
                                      const std::optional<FloatArray>& known, int patch, std::uint64_t seed,
                                      const Progress::Listener& progress) {
  const Rgba given = as_image<cv::Vec4f>(image, "image");
  CyclicParameters parameters{.along_x = along_x, .along_y = along_y, .known = {}, .patch = patch, .seed = seed};
  if (known) parameters.known = as_image<float>(*known, "known");
  const py::gil_scoped_release release;
  const Rgba cyclic = make_cyclic_by_exemplars(given, parameters, Progress(progress));
  const py::gil_scoped_acquire acquire;
  return as_array(cyclic);
}

}  // namespace

void bind_inpaint(py::module_& module) {
  module.def("inpaint", &inpaint_arrays, py::arg("picture"), py::arg("hole"), py::kw_only(), py::arg("patch") = 9,
             py::arg("radius") = std::nullopt, py::arg("seed") = 0, py::arg("grow") = 2,
             py::arg("source") = std::nullopt, py::arg("blend") = true, py::arg("progress") = Progress::Listener());
  module.def("make_cyclic_by_exemplars", &make_cyclic_arrays, py::arg("image"), py::kw_only(), py::arg("along_x"),
             py::arg("along_y"), py::arg("known") = std::nullopt, py::arg("patch") = 9, py::arg("seed") = 0,
             py::arg("progress") = Progress::Listener());
}

}  // namespace stillwater
