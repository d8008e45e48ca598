#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "layers/cyclic.h"
#include "layers/displace.h"
#include "layers/extend_colours.h"
#include "layers/over.h"
#include "layers/push_pull.h"

namespace stillwater {
namespace {

using ExactArray = py::array_t<float, py::array::c_style>;

py::array_t<float> push_pull_array(const FloatArray& known) { return as_array(push_pull(as_image<cv::Vec4f>(known, "known"))); }

py::array_t<float> make_cyclic_array(const FloatArray& image, bool along_x, bool along_y) {
  return as_array(make_cyclic(as_image<cv::Vec4f>(image, "image"), along_x, along_y));
}

py::array_t<float> displace_array(const FloatArray& image, const FloatArray& map, bool wraps_x, bool wraps_y) {
  const Rgba picture = as_image<cv::Vec4f>(image, "image");
  const Field where = as_image<cv::Vec2f>(map, "map");
  const py::gil_scoped_release release;
  const Rgba displaced = displace(picture, where, {.wraps = wraps_x}, {.wraps = wraps_y});
  const py::gil_scoped_acquire acquire;
  return as_array(displaced);
}

py::array_t<float> over_arrays(const FloatArray& front, const FloatArray& back) {
  return as_array(over(as_image<cv::Vec4f>(front, "front"), as_image<cv::Vec4f>(back, "back")));
}

void displace_over_array(const Source& image, const FloatArray& map, ExactArray& back) {
  Rgba under(as_image<cv::Vec4f>(back, "back"));
  const Field where = as_image<cv::Vec2f>(map, "map");
  const py::gil_scoped_release release;
  displace_over(image, where, under);
}

Source source_of(const FloatArray& image) { return Source(as_image<cv::Vec4f>(image, "image")); }

}  // namespace

void bind_layers(py::module_& module) {
  py::class_<Source>(module, "Source").def(py::init(&source_of), py::arg("image"));
  module.def("displace_over", &displace_over_array, py::arg("image"), py::arg("map"), py::arg("back").noconvert());
  module.def("over", &over_arrays, py::arg("front"), py::arg("back"));
  module.def("extend_colours",
             [](const FloatArray& layer) { return as_array(extend_colours(as_image<cv::Vec4f>(layer, "layer"))); },
             py::arg("layer"));
  module.def("push_pull", &push_pull_array, py::arg("known"));
  module.def("make_cyclic", &make_cyclic_array, py::arg("image"), py::arg("along_x"), py::arg("along_y"));
  module.def("displace", &displace_array, py::arg("image"), py::arg("map"), py::arg("wraps_x") = false,
             py::arg("wraps_y") = false);
}

}  // namespace stillwater
