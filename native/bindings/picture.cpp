#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "core/process.h"
#include "picture/clip.h"
#include "picture/colour.h"
#include "picture/flow_file.h"
#include "picture/read.h"
#include "picture/read_frame.h"
#include "picture/write_frame.h"
#include "picture/write_picture.h"

namespace stillwater {
namespace {

using NoGil = py::call_guard<py::gil_scoped_release>;
using Layers = std::vector<std::pair<std::string, FloatArray>>;

template <class Work>
auto without_gil(Work&& work) {
  const py::gil_scoped_release released;
  return work();
}

py::array_t<float> through(void (*curve)(const float*, float*, std::size_t), const FloatArray& array) {
  py::array_t<float> result(std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()));
  const float* in = array.data();
  float* out = result.mutable_data();
  const auto count = static_cast<std::size_t>(array.size());
  without_gil([&] { curve(in, out, count); });
  return result;
}

py::array_t<float> pixels_through(void (*curve)(const float*, float*, std::size_t), const FloatArray& array) {
  const Rgba image = as_image<cv::Vec4f>(array, "rgba");
  Rgba result(image.size());
  curve(image[0]->val, result[0]->val, image.total());
  return as_array(result);
}

py::array_t<std::uint16_t> halves_of(const FloatArray& array) {
  py::array_t<std::uint16_t> halves(std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()));
  to_half(array.data(), halves.mutable_data(), static_cast<std::size_t>(array.size()));
  return halves;
}

void write_frame_of_arrays(const std::string& path, const FloatArray& combined, const std::optional<FloatArray>& flow,
                           const std::optional<FloatArray>& matte, const Layers& layers, const FrameOptions& options) {
  FrameImages images;
  images.combined = as_image<cv::Vec4f>(combined, "combined");
  if (flow) images.flow = as_image<cv::Vec2f>(*flow, "flow");
  if (matte) images.matte = as_image<float>(*matte, "matte");
  for (const auto& [name, image] : layers) images.layers.push_back({name, as_image<cv::Vec4f>(image, name)});
  without_gil([&] { write_frame(path, images, options); });
}

}  // namespace

void bind_picture(py::module_& module) {
  module.def(
      "srgb_to_linear", [](const FloatArray& a) { return through(&srgb_to_linear, a); }, py::arg("a"));
  module.def(
      "linear_to_srgb", [](const FloatArray& a) { return through(&linear_to_srgb, a); }, py::arg("a"));

  module.def(
      "display_to_scene", [](const FloatArray& a) { return pixels_through(&display_to_scene, a); }, py::arg("rgba"));
  module.def(
      "display_to_screen", [](const FloatArray& a) { return pixels_through(&display_to_screen, a); }, py::arg("rgba"));
  module.def(
      "scene_to_display", [](const FloatArray& a) { return pixels_through(&scene_to_display, a); }, py::arg("rgba"));
  module.def(
      "round_mantissa", [](const FloatArray& a) { return through(&round_mantissa, a); }, py::arg("a"));
  module.def("to_half", &halves_of, py::arg("a"), "The bits of half floats, as uint16.");

  py::class_<Picture>(module, "Picture", "A picture as read: image (premultiplied), has_alpha, bad_pixels.")
      .def_property_readonly("image", [](const Picture& picture) { return as_array(picture.image); })
      .def_readonly("has_alpha", &Picture::has_alpha)
      .def_readonly("bad_pixels", &Picture::bad_pixels);
  py::class_<FileFacts>(module, "FileFacts", "What a picture's header says, its orientation applied.")
      .def_readonly("width", &FileFacts::width)
      .def_readonly("height", &FileFacts::height)
      .def_readonly("channels", &FileFacts::channels)
      .def_readonly("pixel_type", &FileFacts::pixel_type)
      .def_readonly("format", &FileFacts::format)
      .def_readonly("channel_names", &FileFacts::channel_names);

  py::enum_<ColourSpace>(module, "ColourSpace")
      .value("automatic", ColourSpace::automatic)
      .value("srgb", ColourSpace::srgb)
      .value("linear", ColourSpace::linear);
  module.def("colour_space_named", &colour_space_named, py::arg("name"));
  module.def("read_picture", &read_picture, py::arg("path"), py::arg("colour_space") = ColourSpace::automatic, NoGil());
  module.def(
      "read_matte",
      [](const std::string& path, const std::string& channel) {
        return as_array(without_gil([&] { return read_matte(path, channel); }));
      },
      py::arg("path"), py::arg("channel") = "");
  module.def(
      "read_labels", [](const std::string& path) { return as_array(without_gil([&] { return read_labels(path); })); },
      py::arg("path"));
  module.def("inspect_picture", &inspect_picture, py::arg("path"), NoGil());

  py::class_<FrameOptions>(module, "FrameOptions", "How a frame is written: half, compression, key.")
      .def(py::init([](bool half, const std::string& compression, const std::string& key) {
             return FrameOptions{half, compression, key};
           }),
           py::kw_only(), py::arg("half") = FrameOptions().half, py::arg("compression") = FrameOptions().compression,
           py::arg("key") = FrameOptions().key);
  module.def("write_frame", &write_frame_of_arrays, py::arg("path"), py::arg("combined"),
             py::arg("flow") = std::nullopt, py::arg("matte") = std::nullopt, py::arg("layers") = Layers(),
             py::arg("options") = FrameOptions());
  module.def("read_frame", [](const std::string& path) { return as_array(read_frame(path)); }, py::arg("path"));
  module.def("read_frame_key", &read_frame_key, py::arg("path"), NoGil());
  module.def("layer_names", &layer_names, py::arg("names"));
  module.def(
      "write_picture",
      [](const std::string& path, const FloatArray& image, int bits) {
        const Rgba picture = as_image<cv::Vec4f>(image, "image");
        without_gil([&] { write_picture(path, picture, bits); });
      },
      py::arg("path"), py::arg("image"), py::arg("bits") = 0);
  py::class_<Clip>(module, "Clip", "A clip of footage: frames, fps, width, height, frame(number, width, height).")
      .def(py::init<const std::string&>(), py::arg("path"), NoGil())
      .def_property_readonly("frames", &Clip::frames)
      .def_property_readonly("fps", &Clip::fps)
      .def_property_readonly("longest_gap", &Clip::longest_gap)
      .def_property_readonly("seen_transparent", &Clip::seen_transparent)
      .def_property_readonly("width", &Clip::width)
      .def_property_readonly("height", &Clip::height)
      .def(
          "frame",
          [](Clip& clip, int number, int width, int height) {
            return as_array(without_gil([&] { return clip.frame(number, width, height); }));
          },
          py::arg("number"), py::arg("width"), py::arg("height"));

  module.def(
      "read_flow", [](const std::string& path) { return as_array(without_gil([&] { return read_flow(path); })); },
      py::arg("path"));
  module.def(
      "write_flow",
      [](const std::string& path, const FloatArray& flow) {
        const Field field = as_image<cv::Vec2f>(flow, "flow");
        without_gil([&] { write_flow(path, field); });
      },
      py::arg("path"), py::arg("flow"));

  module.def("temporary_name", &temporary_name, py::arg("path"));
  module.def("sweep_temporaries", &sweep_temporaries, py::arg("folder"), NoGil());
}

}  // namespace stillwater
