#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "frame/frame_renderer.h"

namespace stillwater {
namespace {

using Size = std::pair<int, int>;

LayerSetup layer_setup(const LayerImage& image, const MotionNumbers& motion, int water, int follows, bool mirror,
                       bool visible, std::pair<bool, bool> endless) {
  LayerSetup layer;
  layer.image = image;
  layer.motion = motion;
  layer.water = water;
  layer.follows = follows;
  layer.mirror = mirror;
  layer.visible = visible;
  layer.endless = {endless.first, endless.second};
  return layer;
}

std::unique_ptr<FrameRenderer> frame_renderer(Size size, double scale, const View& view, const Wind& wind,
                                              std::vector<LayerSetup> layers,
                                              const std::optional<std::vector<LayerImage>>& alpha) {
  if (alpha) {
    if (alpha->size() != layers.size()) throw BadInput("alpha: not one image for each layer");
    for (size_t i = 0; i < layers.size(); ++i) layers[i].alpha = (*alpha)[i];
  }
  const PictureSetup picture{{size.first, size.second}, scale, view, wind, alpha.has_value()};
  const py::gil_scoped_release release;
  return std::make_unique<FrameRenderer>(picture, layers);
}

Frame render(const FrameRenderer& renderer, const Moment& now, const Moment& after, std::vector<LayerState> states_now,
             std::vector<LayerState> states_after, bool flow, bool layers) {
  const FrameNumbers numbers{now, std::move(states_now)}, next{after, std::move(states_after)};
  const py::gil_scoped_release release;
  return renderer.render(numbers, next, {.flow = flow, .matte = true, .layers = layers});
}

std::vector<std::optional<py::array_t<float>>> layers_of(const Frame& frame) {
  std::vector<std::optional<py::array_t<float>>> arrays;
  for (const Rgba& layer : frame.layers) arrays.push_back(layer.empty() ? std::nullopt : std::optional(as_array(layer)));
  return arrays;
}

}  // namespace

void bind_frame(py::module_& module) {
  py::class_<LayerSetup>(module, "Layer")
      .def(py::init(&layer_setup), py::arg("image"), py::arg("motion") = MotionNumbers(), py::arg("water") = -1,
           py::arg("follows") = -1, py::arg("mirror") = false, py::arg("visible") = true,
           py::arg("endless") = std::pair(true, true));
  py::class_<LayerState>(module, "LayerState")
      .def(py::init<double, MotionNumbers>(), py::arg("opacity") = 1.0, py::arg("motion") = MotionNumbers());
  py::class_<Frame>(module, "Frame")
      .def_property_readonly("combined", [](const Frame& frame) { return as_array(frame.combined); })
      .def_property_readonly("flow", [](const Frame& frame) { return as_array(frame.flow); })
      .def_property_readonly("matte", [](const Frame& frame) { return as_array(frame.matte); })
      .def_property_readonly("layers", &layers_of);
  py::class_<FrameRenderer>(module, "FrameRenderer")
      .def(py::init(&frame_renderer), py::arg("size"), py::arg("scale"), py::arg("view"), py::arg("wind"),
           py::arg("layers"), py::arg("alpha") = std::nullopt)
      .def_property_readonly("size", [](const FrameRenderer& r) { return std::pair(r.size().width, r.size().height); })
      .def("render", &render, py::arg("now"), py::arg("after"), py::arg("states_now"), py::arg("states_after"),
           py::arg("flow") = true, py::arg("layers") = false);
}

}  // namespace stillwater
