#include "layers/peel.h"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <array>

#include "bindings/arrays.h"
#include "bindings/rooms.h"

namespace stillwater {
namespace {

using ExactArray = py::array_t<float, py::array::c_style>;
using FillGiven = std::variant<Fill, ExemplarFill, FloatArray>;
using MatteGiven = std::variant<MatteInBox, FloatArray>;
using Box = std::array<int, 4>;  // x, y, width, height

cv::Rect rect_of(const Box& box) { return {box[0], box[1], box[2], box[3]}; }

// A LayerImage or a MatteInBox; empty for a layer without coverage.
template <class Part, class Pixel>
Part part_of_picture(const ExactArray& pixels, const Box& box) {
  if (pixels.size() == 0 && box[2] * box[3] == 0) return {};
  const cv::Mat_<Pixel> image(as_image<Pixel>(pixels, "pixels"));
  if (image.cols != box[2] || image.rows != box[3]) throw BadInput("box: its size is not that of the pixels");
  return {image, rect_of(box)};
}

Behind behind_of(const ExactArray& colour, const ExactArray& matte, const Box& box, bool open) {
  if (colour.size() == 0) return {};
  return {as_image<cv::Vec4f>(colour, "colour"), as_image<float>(matte, "matte"), rect_of(box), open};
}

template <class Part>
Box box_of(const Part& part) {
  return {part.box.x, part.box.y, part.box.width, part.box.height};
}

PeelLayer layer_of(const std::optional<MatteGiven>& matte, const FillGiven& fill, double feather, const std::string& place) {
  PeelLayer layer;
  layer.feather = feather;
  if (matte) {
    if (const auto* whole = std::get_if<FloatArray>(&*matte)) layer.matte = as_image<float>(*whole, place + ".matte");
    else layer.matte = std::get<MatteInBox>(*matte);
  }
  if (const auto* painted = std::get_if<FloatArray>(&fill)) layer.fill = as_image<cv::Vec4f>(*painted, place + ".fill");
  else if (const auto* exemplar = std::get_if<ExemplarFill>(&fill)) layer.fill = *exemplar;
  else layer.fill = std::get<Fill>(fill);
  return layer;
}

TouchUp touch_up_of(const FloatArray& region, std::optional<double> radius, std::uint64_t seed) {
  return {as_image<float>(region, "region").clone(), radius, seed};
}

ExemplarFill exemplar_of(int patch, std::optional<double> radius, std::uint64_t seed, int grow,
                         const std::optional<FloatArray>& source, const std::vector<TouchUp>& touch_ups) {
  ExemplarFill fill{{.patch = patch, .radius = radius, .seed = seed, .grow = grow}, touch_ups};
  if (source) fill.search.source = as_image<float>(*source, "source").clone();
  return fill;
}

std::vector<LayerImage> peel_arrays(const FloatArray& picture, const std::vector<std::optional<MatteGiven>>& mattes,
                                    const std::vector<FillGiven>& fills, const std::vector<double>& feathers,
                                    const Progress::Listener& progress) {
  if (fills.size() != mattes.size() || feathers.size() != mattes.size())
    throw BadInput("mattes, fills, feathers: not one of each for every layer");
  std::vector<PeelLayer> layers;
  for (size_t i = 0; i < mattes.size(); ++i)
    layers.push_back(layer_of(mattes[i], fills[i], feathers[i], "layers[" + std::to_string(i) + "]"));
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  const py::gil_scoped_release release;
  return peel(image, layers, Progress(progress));
}

std::pair<LayerImage, Behind> take(Peeling& peeling, const MatteGiven& matte, const FillGiven& fill, double feather,
                                   const std::string& name, const Progress::Listener& progress) {
  const PeelLayer layer = layer_of(matte, fill, feather, name);
  const py::gil_scoped_release release;
  auto [taken, behind] = peeling.take(layer, name, Progress(progress));
  return {taken, behind};
}

}  // namespace

void bind_peel(py::module_& module) {
  py::enum_<Fill>(module, "Fill").value("push_pull", Fill::push_pull).value("none", Fill::none);
  py::class_<TouchUp>(module, "TouchUp")
      .def(py::init(&touch_up_of), py::arg("region"), py::arg("radius"), py::arg("seed"));
  py::class_<ExemplarFill>(module, "ExemplarFill")
      .def(py::init(&exemplar_of), py::kw_only(), py::arg("patch") = 9, py::arg("radius") = std::nullopt, py::arg("seed") = 0,
           py::arg("grow") = 2, py::arg("source") = std::nullopt, py::arg("touch_ups") = std::vector<TouchUp>());
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
  py::class_<Behind>(module, "Behind")
      .def(py::init(&behind_of), py::arg("colour").noconvert(), py::arg("matte").noconvert(), py::arg("box"),
           py::arg("open"), py::keep_alive<1, 2>(), py::keep_alive<1, 3>())
      .def_property_readonly("colour", [](const Behind& behind) { return as_array(behind.colour); })
      .def_property_readonly("matte", [](const Behind& behind) { return as_array(behind.matte); })
      .def_property_readonly("box", &box_of<Behind>)
      .def_readonly("open", &Behind::open);
  py::class_<Peeling>(module, "Peeling")
      .def(py::init([](const FloatArray& picture) { return Peeling(as_image<cv::Vec4f>(picture, "picture")); }),
           py::arg("picture"))
      .def("take", &take, py::arg("matte"), py::arg("fill"), py::arg("feather") = 0.0, py::arg("name") = "layer",
           py::arg("progress") = Progress::Listener())
      .def("leave", &Peeling::leave, py::arg("behind"), py::call_guard<py::gil_scoped_release>())
      .def("left", [](const Peeling& peeling) { return as_array(peeling.left().clone()); })
      .def("rest", &Peeling::rest, py::call_guard<py::gil_scoped_release>());
  module.def("peel", &peel_arrays, py::arg("picture"), py::arg("mattes"), py::arg("fills"), py::arg("feathers"),
             py::arg("progress") = Progress::Listener());
}

}  // namespace stillwater
