#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <opencv2/imgproc.hpp>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "layers/matting/closed_form.h"
#include "layers/matting/coarse_to_fine.h"
#include "layers/matting/colour_clusters.h"
#include "layers/matting/colour_prior.h"
#include "layers/matting/colour_samples.h"
#include "layers/matting/drawn_trimap.h"
#include "layers/matting/foreground.h"
#include "layers/matting/matte.h"

namespace stillwater {
namespace {

using NoGil = py::gil_scoped_release;

// The array itself where it has four channels; three get an alpha of 1.
Rgba colours_of(const FloatArray& picture) {
  if (picture.ndim() != 3 || picture.shape(2) != 3) return as_image<cv::Vec4f>(picture, "picture");
  Rgba opaque;
  cv::cvtColor(as_image<cv::Vec3f>(picture, "picture"), opaque, cv::COLOR_RGB2RGBA);
  return opaque;
}

// The system's rows, in the order of the unknown pixels: (pixel, other pixel, coefficient) and the right-hand side.
py::tuple laplacian_arrays(const FloatArray& picture, const FloatArray& trimap, double epsilon) {
  const MattingSystem system = matting_laplacian(as_image<cv::Vec4f>(picture, "picture"),
                                                 trimap_from_grey(as_image<float>(trimap, "trimap")), epsilon);
  std::vector<int> rows, columns, pixels;
  std::vector<double> values, right;
  const SparseGrid& grid = system.grid;
  for (int y = 0; y < grid.height; ++y)
    for (int node = grid.row[y]; node < grid.row[y + 1]; ++node) {
      const int pixel = y * grid.width + grid.column[node];
      pixels.push_back(pixel);
      right.push_back(system.right[grid.entry(node)]);
      for (int k = 0; k < 25; ++k)
        if (const double value = system.coefficients[static_cast<size_t>(node) * 25 + k]; value != 0) {
          rows.push_back(pixel);
          columns.push_back(pixel + (k / 5 - 2) * grid.width + k % 5 - 2);
          values.push_back(value);
        }
    }
  return py::make_tuple(py::cast(rows), py::cast(columns), py::cast(values), py::cast(pixels), py::cast(right));
}

py::tuple closed_form_arrays(const FloatArray& picture, const FloatArray& trimap, double epsilon, double tolerance,
                             const std::optional<FloatArray>& prior_alpha,
                             const std::optional<FloatArray>& prior_weight, int spacing) {
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  const Trimap labels = trimap_from_grey(as_image<float>(trimap, "trimap"));
  ClosedFormOptions options{.epsilon = epsilon, .tolerance = tolerance, .spacing = spacing};
  if (prior_alpha && prior_weight)
    options.prior = {as_image<float>(*prior_alpha, "prior_alpha"), as_image<float>(*prior_weight, "prior_weight")};
  ClosedFormMatte matte;
  {
    const NoGil released;
    matte = closed_form_matte(image, labels, options);
  }
  return py::make_tuple(as_array(matte.alpha), matte.iterations);
}

Stroke stroke_of(const std::vector<std::array<double, 3>>& points, double width) {
  Stroke stroke{{}, width};
  for (const auto& [x, y, pressure] : points) stroke.points.push_back({x, y, pressure});
  return stroke;
}

py::array_t<float> drawn(const std::array<int, 2>& size, const Stroke& stroke, const std::string& name) {
  Mask mask = Mask::zeros(size[1], size[0]);
  draw(stroke, name, mask);
  Plane plane;
  mask.convertTo(plane, CV_32F, 1 / 255.0);
  return as_array(plane);
}

py::array_t<float> scribbled(const std::array<int, 2>& size, const std::vector<Stroke>& foreground,
                             const std::vector<Stroke>& background) {
  return as_array(grey_of(trimap_from_scribbles(cv::Size(size[0], size[1]), {foreground, background})));
}

py::array_t<float> lassoed(const FloatArray& picture, const std::vector<std::array<double, 2>>& outline, double feather,
                           double snap) {
  Lasso lasso{{}, feather, snap};
  for (const auto& [x, y] : outline) lasso.outline.push_back({x, y});
  const Rgba image = colours_of(picture);
  Plane trimap;
  {
    const NoGil released;
    trimap = grey_of(trimap_from_lasso(image, lasso));
  }
  return as_array(trimap);
}

py::array_t<float> checked_trimap(const FloatArray& grey) {
  return as_array(grey_of(trimap_from_grey(as_image<float>(grey, "trimap"))));
}

py::tuple colour_sample_arrays(const FloatArray& picture, const FloatArray& trimap, int iterations, double nearness) {
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  const Trimap labels = trimap_from_grey(as_image<float>(trimap, "trimap"));
  ColourSamples samples;
  {
    const NoGil released;
    samples = sample_colours(image, labels, cv::Mat_<unsigned char>(labels == known::unknown),
                             {.iterations = iterations, .nearness = nearness});
  }
  return py::make_tuple(as_array(samples.foreground), as_array(samples.background), as_array(samples.misfit));
}

py::tuple colour_prior_arrays(const FloatArray& picture, const FloatArray& trimap) {
  const MattePrior prior =
      colour_prior(as_image<cv::Vec4f>(picture, "picture"), trimap_from_grey(as_image<float>(trimap, "trimap")));
  return py::make_tuple(as_array(prior.alpha), as_array(prior.weight));
}

// The clusters' means and covariances.
py::list cluster_list(const FloatArray& colours, const std::vector<double>& weights, const ClusterOptions& options) {
  const auto image = as_image<cv::Vec3f>(colours, "colours");
  std::vector<WeightedColour> given;
  for (size_t i = 0; i < weights.size() && i < image.total(); ++i) {
    const cv::Vec3f& c = image(static_cast<int>(i));
    given.push_back({{c[0], c[1], c[2]}, weights[i]});
  }
  py::list clusters;
  for (const ColourCluster& cluster : colour_clusters(given, options))
    clusters.append(py::make_tuple(cluster.mean, cluster.covariance));
  return clusters;
}

py::array_t<float> enlarged(const FloatArray& matte, const FloatArray& half, const FloatArray& picture) {
  return as_array(enlarge_matte(as_image<float>(matte, "matte"), as_image<cv::Vec4f>(half, "half"),
                                as_image<cv::Vec4f>(picture, "picture")));
}

py::array_t<float> matte_array(const FloatArray& picture, const FloatArray& trimap, const MatteOptions& options,
                               const Progress::Listener& progress) {
  const Rgba image = colours_of(picture);
  const Trimap labels = trimap_from_grey(as_image<float>(trimap, "trimap"));
  Plane alpha;
  {
    const NoGil released;
    alpha = matte(image, labels, options, Progress(progress));
  }
  return as_array(alpha);
}

py::tuple foreground_arrays(const FloatArray& picture, const FloatArray& alpha, const ForegroundOptions& options,
                            const Progress::Listener& progress) {
  const Rgba image = colours_of(picture);
  const Plane matte = as_image<float>(alpha, "alpha");
  ForegroundAndBackground colours;
  {
    const NoGil released;
    colours = foreground_and_background(image, matte, options, Progress(progress));
  }
  return py::make_tuple(as_array(colours.foreground), as_array(colours.background));
}

}  // namespace

void bind_matting(py::module_& module) {
  py::enum_<MattingMethod>(module, "MattingMethod")
      .value("closed_form", MattingMethod::closed_form)
      .value("bayesian", MattingMethod::bayesian);
  py::class_<MatteOptions>(module, "MatteOptions")
      .def(py::init<>())
      .def_readwrite("method", &MatteOptions::method)
      .def_readwrite("colour", &MatteOptions::colour)
      .def_readwrite("at_once", &MatteOptions::at_once)
      .def_readwrite("at_once_scribbled", &MatteOptions::at_once_scribbled)
      .def_readwrite("finest", &MatteOptions::finest)
      .def_readwrite("haze", &MatteOptions::haze)
      .def_readwrite("tolerance", &MatteOptions::tolerance);
  py::class_<ForegroundOptions>(module, "ForegroundOptions")
      .def(py::init<>())
      .def_readwrite("regularization", &ForegroundOptions::regularization)
      .def_readwrite("gradient_weight", &ForegroundOptions::gradient_weight)
      .def_readwrite("small_iterations", &ForegroundOptions::small_iterations)
      .def_readwrite("big_iterations", &ForegroundOptions::big_iterations)
      .def_readwrite("small_size", &ForegroundOptions::small_size);
  py::class_<Stroke>(module, "Stroke").def(py::init(&stroke_of), py::arg("points"), py::arg("width"));
  module.def("drawn", &drawn, py::arg("size"), py::arg("stroke"), py::arg("name") = "stroke");
  module.def("trimap_from_scribbles", &scribbled, py::arg("size"), py::arg("foreground"), py::arg("background"));
  module.def("trimap_from_lasso", &lassoed, py::arg("picture"), py::arg("outline"), py::arg("feather"),
             py::arg("snap"));
  module.def("trimap_from_grey", &checked_trimap, py::arg("grey"));
  py::class_<ClusterOptions>(module, "ClusterOptions")
      .def(py::init<>())
      .def_readwrite("variance", &ClusterOptions::variance)
      .def_readwrite("most", &ClusterOptions::most)
      .def_readwrite("noise", &ClusterOptions::noise);
  module.def("colour_clusters", &cluster_list, py::arg("colours"), py::arg("weights"),
             py::arg("options") = ClusterOptions());
  module.def(
      "half_of", [](const FloatArray& picture) { return as_array(half_of(as_image<cv::Vec4f>(picture, "picture"))); },
      py::arg("picture"));
  module.def("half_of_trimap", [](const FloatArray& trimap) {
    return as_array(grey_of(half_of(trimap_from_grey(as_image<float>(trimap, "trimap")))));
  }, py::arg("trimap"));
  module.def("enlarge_matte", &enlarged, py::arg("matte"), py::arg("half"), py::arg("picture"));
  module.def("matting_laplacian", &laplacian_arrays, py::arg("picture"), py::arg("trimap"), py::arg("epsilon"));
  module.def("sample_colours", &colour_sample_arrays, py::arg("picture"), py::arg("trimap"), py::arg("iterations") = 8,
             py::arg("nearness") = 1.0);
  module.def("colour_prior", &colour_prior_arrays, py::arg("picture"), py::arg("trimap"));
  module.def("closed_form_matte", &closed_form_arrays, py::arg("picture"), py::arg("trimap"), py::arg("epsilon") = 1e-7,
             py::arg("tolerance") = 1e-6, py::arg("prior_alpha") = std::nullopt, py::arg("prior_weight") = std::nullopt,
             py::arg("spacing") = 8);
  module.def("matte", &matte_array, py::arg("picture"), py::arg("trimap"), py::arg("options") = MatteOptions(),
             py::arg("progress") = Progress::Listener());
  module.def("foreground_and_background", &foreground_arrays, py::arg("picture"), py::arg("alpha"),
             py::arg("options") = ForegroundOptions(), py::arg("progress") = Progress::Listener());
}

}  // namespace stillwater
