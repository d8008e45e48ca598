#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <variant>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "frame/frame_renderer.h"

namespace stillwater {
namespace {

using Size = std::pair<int, int>;

using Axes = std::pair<bool, bool>;
using Plates = std::shared_ptr<LayerPlates>;  // pybind11 keeps no pointer to const
using ExactArray = py::array_t<float, py::array::c_style>;
using ByteArray = py::array_t<unsigned char, py::array::c_style>;

LayerSetup layer_setup(const std::variant<LayerImage, Plates>& image, const MotionNumbers& motion, int water,
                       int follows, bool mirror, bool visible, Axes endless) {
  LayerSetup layer;
  if (const auto* plates = std::get_if<Plates>(&image)) layer.plates = *plates;
  else layer.image = std::get<LayerImage>(image);
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
                                              const std::optional<std::vector<LayerImage>>& alpha, bool has_alpha) {
  if (alpha) {
    if (alpha->size() != layers.size()) throw BadInput("alpha: not one image for each layer");
    for (size_t i = 0; i < layers.size(); ++i) layers[i].alpha = (*alpha)[i];
  }
  const PictureSetup picture{{size.first, size.second}, scale, view, wind, has_alpha || alpha};
  const py::gil_scoped_release release;
  return std::make_unique<FrameRenderer>(picture, layers);
}

Frame render(const FrameRenderer& renderer, const Moment& now, const Moment& after, std::vector<LayerState> states_now,
             std::vector<LayerState> states_after, bool flow, bool layers) {
  const FrameNumbers numbers{now, std::move(states_now)}, next{after, std::move(states_after)};
  const py::gil_scoped_release release;
  return renderer.render(numbers, next, {.flow = flow, .matte = true, .layers = layers});
}

using Endlesses = std::vector<std::pair<FloatArray, FloatArray>>;  // pixels and mean, of colours and of alpha

// Of arrays of moments x height x width: views, which keep them.
Outlines outlines_of(const std::vector<ByteArray>& arrays) {
  Outlines outlines;
  for (const ByteArray& array : arrays) {
    if (array.ndim() != 3) throw BadInput("outlines: not arrays of moments x height x width");
    outlines.memory.push_back(kept_alive(array));
    for (py::ssize_t i = 0; i < array.shape(0); ++i)
      outlines.coverage.emplace_back(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(2)),
                                     const_cast<unsigned char*>(array.data(i, 0, 0)));
  }
  return outlines;
}

Plates plates_of(const LayerImage& colour, const std::optional<LayerImage>& alpha, Size size, double scale,
                 std::optional<Axes> drifting, const Endlesses& made, const std::vector<FloatArray>& flow, double longest,
                 const ExampleSetup* example, const ExampleLook* look, const std::vector<ByteArray>& outlines) {
  std::vector<EndlessPixels> before;
  for (const auto& [pixels, mean] : made)
    before.push_back({as_image<cv::Vec4f>(pixels, "endless"), as_image<cv::Vec4f>(mean, "endless")});
  FlowFields fields{{}, longest};
  for (const FloatArray& field : flow) fields.velocities.push_back(as_image<cv::Vec2f>(field, "flow"));
  Outlines followed = outlines_of(outlines);
  const py::gil_scoped_release release;
  std::optional<Endless> endless;
  if (drifting) endless = Endless{drifting->first, drifting->second};
  return std::const_pointer_cast<LayerPlates>(
      make_plates(colour, alpha.value_or(LayerImage()), {size.first, size.second}, scale, endless,
                  {before.empty() ? nullptr : &before[0], before.size() < 2 ? nullptr : &before[1]}, fields,
                  {example, look}, std::move(followed)));
}

ExampleLook look_of(const LayerPlates& plates, const Progress::Listener& progress) {
  if (!plates.colour_example) throw BadInput("plates: made without a clip");
  const py::gil_scoped_release release;
  return plates.colour_example->make_look(Progress(progress));
}

void render_for_screen(const FrameRenderer& renderer, ExactArray& out, const Moment& now,
                       std::vector<LayerState> states, int layer, bool coverage) {
  if (as_image<cv::Vec4f>(out, "out").size() != renderer.size()) throw BadInput("out: not of the renderer's size");
  const FrameNumbers numbers{now, std::move(states)};
  float* rgba = out.mutable_data();
  const py::gil_scoped_release release;
  renderer.render_for_screen(numbers, {layer, coverage}, rgba);
}

std::vector<std::pair<float, float>> moved(const FrameRenderer& renderer, int layer, const Moment& now,
                                           std::vector<LayerState> states, std::vector<std::pair<float, float>> points) {
  const FrameNumbers numbers{now, std::move(states)};
  std::vector<float> x, y;
  for (const auto& point : points) x.push_back(point.first), y.push_back(point.second);
  {
    const py::gil_scoped_release release;
    renderer.move(layer, numbers, x.data(), y.data(), static_cast<int>(points.size()));
  }
  for (size_t i = 0; i < points.size(); ++i) points[i] = {x[i], y[i]};
  return points;
}

std::vector<std::optional<py::array_t<float>>> layers_of(const Frame& frame) {
  std::vector<std::optional<py::array_t<float>>> arrays;
  for (const Rgba& layer : frame.layers) arrays.push_back(layer.empty() ? std::nullopt : std::optional(as_array(layer)));
  return arrays;
}

}  // namespace

void bind_frame(py::module_& module) {
  module.def(
      "scaled_layer",
      [](const LayerImage& layer, Size size, double scale) {
        return scaled_layer(layer, {size.first, size.second}, scale);
      },
      py::arg("layer"), py::arg("size"), py::arg("scale"), py::keep_alive<0, 1>(),
      py::call_guard<py::gil_scoped_release>());
  py::class_<LayerPlates, Plates>(module, "LayerPlates", "A layer ready for any moment.");
  module.def("make_plates", &plates_of, py::arg("colour"), py::arg("alpha"), py::arg("size"), py::arg("scale"),
             py::arg("drifting"), py::arg("endless") = Endlesses(), py::arg("flow") = std::vector<FloatArray>(),
             py::arg("longest") = 0.0, py::arg("example") = nullptr, py::arg("look") = nullptr,
             py::arg("outlines") = std::vector<ByteArray>());
  module.def("make_look", &look_of, py::arg("plates"), py::arg("progress") = Progress::Listener());
  module.def(
      "make_endless",
      [](const LayerImage& layer, Size size, double scale, Axes along, const Progress::Listener& progress) {
        EndlessPixels made;
        {
          const py::gil_scoped_release release;
          made = make_endless(layer, {size.first, size.second}, scale, {along.first, along.second}, Progress(progress));
        }
        return std::pair(as_array(made.pixels), as_array(made.mean));
      },
      py::arg("layer"), py::arg("size"), py::arg("scale"), py::arg("along"),
      py::arg("progress") = Progress::Listener());
  py::class_<LayerSetup>(module, "Layer")
      .def(py::init(&layer_setup), py::arg("image"), py::arg("motion") = MotionNumbers(), py::arg("water") = -1,
           py::arg("follows") = -1, py::arg("mirror") = false, py::arg("visible") = true,
           py::arg("endless") = std::pair(true, true));
  py::class_<LayerState>(module, "LayerState")
      .def(py::init<double, MotionNumbers, int>(), py::arg("opacity") = 1.0, py::arg("motion") = MotionNumbers(),
           py::arg("outline") = 0);
  py::class_<Frame>(module, "Frame")
      .def_property_readonly("combined", [](const Frame& frame) { return as_array(frame.combined); })
      .def_property_readonly("flow", [](const Frame& frame) { return as_array(frame.flow); })
      .def_property_readonly("matte", [](const Frame& frame) { return as_array(frame.matte); })
      .def_property_readonly("layers", &layers_of);
  py::class_<FrameRenderer>(module, "FrameRenderer")
      .def(py::init(&frame_renderer), py::arg("size"), py::arg("scale"), py::arg("view"), py::arg("wind"),
           py::arg("layers"), py::arg("alpha") = std::nullopt, py::arg("has_alpha") = false)
      .def_property_readonly("size", [](const FrameRenderer& r) { return std::pair(r.size().width, r.size().height); })
      .def("render", &render, py::arg("now"), py::arg("after"), py::arg("states_now"), py::arg("states_after"),
           py::arg("flow") = true, py::arg("layers") = false)
      .def("render_for_screen", &render_for_screen, py::arg("out").noconvert(), py::arg("now"), py::arg("states"),
           py::arg("layer") = -1, py::arg("coverage") = false)
      .def("moved", &moved, py::arg("layer"), py::arg("now"), py::arg("states"), py::arg("points"));
}

}  // namespace stillwater
