#include <pybind11/stl.h>

#include "appearance/laplacian_pyramid.h"
#include "appearance/match_histogram.h"
#include "appearance/match_texture.h"
#include "appearance/motion_blur.h"
#include "appearance/steerable_pyramid.h"
#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "core/fft.h"

namespace stillwater {
namespace {

using Arrays = std::vector<py::array_t<float>>;

template <class Work>
auto without_gil(const Work& work) {
  const py::gil_scoped_release released;
  return work();
}

Arrays as_arrays(const std::vector<Plane>& planes) {
  Arrays arrays;
  for (const Plane& plane : planes) arrays.push_back(as_array(plane));
  return arrays;
}

std::vector<Arrays> as_arrays(const std::vector<std::vector<Plane>>& bands) {
  std::vector<Arrays> arrays;
  for (const auto& scale : bands) arrays.push_back(as_arrays(scale));
  return arrays;
}

std::vector<Plane> as_planes(const std::vector<FloatArray>& arrays, const std::string& name) {
  std::vector<Plane> planes;
  for (const FloatArray& array : arrays) planes.push_back(as_image<float>(array, name));
  return planes;
}

py::tuple steerable_arrays(const FloatArray& image, int scales, int orientations, bool complex) {
  const Plane plane = as_image<float>(image, "image");
  const SteerablePyramid pyramid = without_gil([&] { return steerable_pyramid(plane, {scales, orientations, complex}); });
  return py::make_tuple(as_array(pyramid.highpass), as_arrays(pyramid.bands), as_arrays(pyramid.quadrature),
                        as_array(pyramid.lowpass));
}

py::array_t<float> collapsed_steerable(const FloatArray& highpass, const std::vector<std::vector<FloatArray>>& bands,
                                       const FloatArray& lowpass) {
  SteerablePyramid pyramid{as_image<float>(highpass, "highpass"), {}, {}, as_image<float>(lowpass, "lowpass")};
  for (const auto& scale : bands) pyramid.bands.push_back(as_planes(scale, "bands"));
  return as_array(without_gil([&] { return collapse(pyramid); }));
}

TextureMatching matching_of(const std::string& name) {
  if (name == "steerable") return TextureMatching::steerable;
  if (name == "laplacian") return TextureMatching::laplacian;
  throw BadInput("matching: \"" + name + "\" is not \"steerable\" or \"laplacian\"");
}

TextureTarget described(const FloatArray& picture, std::array<int, 2> grid, int scales, int orientations,
                        const std::string& matching) {
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  const DescribeParameters parameters{{grid[0], grid[1]}, scales, orientations, matching_of(matching)};
  return without_gil([&] { return describe(image, parameters); });
}

py::array_t<float> there_and_back(const FloatArray& plane) {
  Plane image = as_image<float>(plane, "plane").clone();
  const RealFft2 transform(image.size());
  const size_t height = image.rows;
  const FftSpectrum spectrum = fft_spectrum(transform.numbers());
  transform.forward(image[0], image.cols, [&](const FftColumns& columns) {
    for (int j = 0; j < columns.count; ++j) std::copy_n(columns[j], height, &spectrum[(columns.first + j) * height]);
  });
  transform.inverse(
      [&](const FftColumns& columns) {
        for (int j = 0; j < columns.count; ++j) std::copy_n(&spectrum[(columns.first + j) * height], height, columns[j]);
      },
      image[0], image.cols);
  return as_array(image);
}

}  // namespace

void bind_appearance(py::module_& module) {
  module.def("fft_there_and_back", &there_and_back, py::arg("plane"));
  module.def("steerable_pyramid", &steerable_arrays, py::arg("image"), py::arg("scales"), py::arg("orientations"),
             py::arg("complex"));
  module.def("collapse_steerable", &collapsed_steerable, py::arg("highpass"), py::arg("bands"), py::arg("lowpass"));
  module.def(
      "laplacian_pyramid",
      [](const FloatArray& image, int scales) { return as_arrays(laplacian_pyramid(as_image<float>(image, "image"), scales)); },
      py::arg("image"), py::arg("scales"));
  module.def(
      "collapse_laplacian",
      [](const std::vector<FloatArray>& levels) { return as_array(collapse(as_planes(levels, "levels"))); },
      py::arg("levels"));

  py::class_<Histogram>(module, "Histogram")
      .def_readonly("values", &Histogram::values)
      .def_readonly("ranks", &Histogram::ranks);
  module.def(
      "histogram",
      [](const FloatArray& plane, int points) { return histogram(as_image<float>(plane, "plane"), points); },
      py::arg("plane"), py::arg("points"));
  module.def(
      "match_histogram",
      [](const FloatArray& plane, const Histogram& reference) {
        const Plane image = as_image<float>(plane, "image");
        return as_array(without_gil([&] { return match_histogram(image, reference); }));
      },
      py::arg("plane"), py::arg("reference"));

  py::class_<TextureTarget>(module, "TextureTarget")
      .def(py::init(&described), py::arg("picture"), py::arg("grid"), py::arg("scales"), py::arg("orientations"),
           py::arg("matching"))
      .def_property_readonly("grid", [](const TextureTarget& t) { return std::array<int, 2>{t.grid.width, t.grid.height}; })
      .def_readonly("scales", &TextureTarget::scales)
      .def_readonly("orientations", &TextureTarget::orientations);
  py::class_<TextureCurves>(module, "TextureCurves")
      .def("mix", &mix, py::arg("other"), py::arg("share"));
  module.def(
      "texture_curves",
      [](const FloatArray& frame, const TextureTarget& target, int repetitions) {
        const Rgba image = as_image<cv::Vec4f>(frame, "frame");
        return without_gil([&] { return texture_curves(image, target, repetitions); });
      },
      py::arg("frame"), py::arg("target"), py::arg("repetitions"));
  module.def(
      "match_texture",
      [](const FloatArray& frame, const TextureTarget& target, int repetitions, double stylize) {
        const Rgba image = as_image<cv::Vec4f>(frame, "frame");
        return as_array(without_gil([&] { return match_texture(image, target, repetitions, stylize); }));
      },
      py::arg("frame"), py::arg("target"), py::arg("repetitions"), py::arg("stylize"));
  module.def(
      "match_texture_by",
      [](const FloatArray& frame, const TextureTarget& target, const TextureCurves& curves, double stylize) {
        const Rgba image = as_image<cv::Vec4f>(frame, "frame");
        return as_array(without_gil([&] { return match_texture(image, target, curves, stylize); }));
      },
      py::arg("frame"), py::arg("target"), py::arg("curves"), py::arg("stylize"));
  module.def(
      "motion_blur",
      [](const FloatArray& picture, const FloatArray& velocity, double shutter, double fps, double average_blur) {
        const Rgba image = as_image<cv::Vec4f>(picture, "picture");
        const Field field = as_image<cv::Vec2f>(velocity, "velocity");
        return as_array(without_gil([&] { return motion_blur(image, field, {shutter, fps, average_blur}); }));
      },
      py::arg("picture"), py::arg("velocity"), py::arg("shutter"), py::arg("fps"), py::arg("average_blur"));
}

}  // namespace stillwater
