#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "layers/cyclic.h"
#include "layers/displace.h"
#include "layers/over.h"
#include "layers/peel.h"
#include "layers/push_pull.h"

namespace stillwater {
namespace {

using FillGiven = std::variant<Fill, FloatArray>;
using ExactArray = py::array_t<float, py::array::c_style>;

using MatteGiven = std::variant<MatteInBox, FloatArray>;
using Box = std::array<int, 4>;  // x, y, width, height

// A LayerImage or a MatteInBox; empty for a layer without coverage.
template <class Part, class Pixel>
Part part_of_picture(const ExactArray& pixels, const Box& box) {
  if (pixels.size() == 0 && box[2] * box[3] == 0) return {};
  const cv::Mat_<Pixel> image(as_image<Pixel>(pixels, "pixels"));
  if (image.cols != box[2] || image.rows != box[3]) throw BadInput("box: its size is not that of the pixels");
  return {image, {box[0], box[1], box[2], box[3]}};
}

template <class Part>
Box box_of(const Part& part) {
  return {part.box.x, part.box.y, part.box.width, part.box.height};
}

std::vector<LayerImage> peel_arrays(const FloatArray& picture, const std::vector<std::optional<MatteGiven>>& mattes,
                                    const std::vector<FillGiven>& fills, const std::vector<double>& feathers,
                                    const Progress::Listener& progress) {
  if (fills.size() != mattes.size() || feathers.size() != mattes.size())
    throw BadInput("mattes, fills, feathers: not one of each for every layer");
  std::vector<PeelLayer> layers(mattes.size());
  for (size_t i = 0; i < mattes.size(); ++i) {
    const std::string place = "layers[" + std::to_string(i) + "]";
    if (mattes[i]) {
      if (const auto* whole = std::get_if<FloatArray>(&*mattes[i])) layers[i].matte = as_image<float>(*whole, place + ".matte");
      else layers[i].matte = std::get<MatteInBox>(*mattes[i]);
    }
    if (const auto* painted = std::get_if<FloatArray>(&fills[i])) layers[i].fill = as_image<cv::Vec4f>(*painted, place + ".fill");
    else layers[i].fill = std::get<Fill>(fills[i]);
    layers[i].feather = feathers[i];
  }
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  const py::gil_scoped_release release;
  return peel(image, layers, Progress(progress));
}

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
  py::enum_<Fill>(module, "Fill").value("push_pull", Fill::push_pull).value("none", Fill::none);
  py::class_<LayerImage>(module, "LayerImage")
      .def(py::init(&part_of_picture<LayerImage, cv::Vec4f>), py::arg("pixels").noconvert(), py::arg("box"),
           py::keep_alive<1, 2>())
      .def_property_readonly("pixels", [](const LayerImage& layer) { return as_array(layer.pixels); })
      .def_property_readonly("box", &box_of<LayerImage>);
  py::class_<MatteInBox>(module, "MatteInBox")
      .def(py::init(&part_of_picture<MatteInBox, float>), py::arg("pixels").noconvert(), py::arg("box"),
           py::keep_alive<1, 2>())
      .def_property_readonly("pixels", [](const MatteInBox& matte) { return as_array(matte.pixels); })
      .def_property_readonly("box", &box_of<MatteInBox>);
  py::class_<Source>(module, "Source").def(py::init(&source_of), py::arg("image"));
  module.def("displace_over", &displace_over_array, py::arg("image"), py::arg("map"), py::arg("back").noconvert());
  module.def("over", &over_arrays, py::arg("front"), py::arg("back"));
  module.def("peel", &peel_arrays, py::arg("picture"), py::arg("mattes"), py::arg("fills"), py::arg("feathers"),
             py::arg("progress") = Progress::Listener());
  module.def("push_pull", &push_pull_array, py::arg("known"));
  module.def("make_cyclic", &make_cyclic_array, py::arg("image"), py::arg("along_x"), py::arg("along_y"));
  module.def("displace", &displace_array, py::arg("image"), py::arg("map"), py::arg("wraps_x") = false,
             py::arg("wraps_y") = false);
}

}  // namespace stillwater
