#include <pybind11/stl.h>

#include <array>
#include <optional>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "flow/moving_outline.h"
#include "flow/obstacles.h"
#include "flow/paint_flow.h"
#include "flow/propose_flow.h"
#include "flow/radial_fill.h"
#include "flow/refine_flow.h"
#include "flow/streaks.h"
#include "flow/stroke_points.h"

namespace stillwater {
namespace {

using NoGil = py::gil_scoped_release;
using Places = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<Point> points_of(const Places& places) {
  std::vector<Point> points;
  for (py::ssize_t i = 0; i < places.shape(0); ++i) points.push_back({places.at(i, 0), places.at(i, 1)});
  return points;
}

template <class Pixel>
cv::Mat_<Pixel> image_or_none(const std::optional<FloatArray>& array, const std::string& name) {
  return array ? as_image<Pixel>(*array, name) : cv::Mat_<Pixel>();
}

PaintedFlow painted(const std::vector<FlowStroke>& strokes, std::array<int, 2> size, const std::optional<FloatArray>& bound,
                    const std::optional<FloatArray>& freeze) {
  const Plane matte = image_or_none<float>(bound, "bound"), frozen = image_or_none<float>(freeze, "freeze");
  const NoGil released;
  return paint_flow(strokes, cv::Size(size[0], size[1]), matte, frozen);
}

py::array_t<float> refined(const PaintedFlow& flow, const FloatArray& picture, double width, double amount) {
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  Field field;
  {
    const NoGil released;
    field = refine_flow(flow, image, {.width = width, .amount = amount});
  }
  return as_array(field);
}

PaintedFlow proposed(const FloatArray& picture, const std::string& kind, const std::vector<FlowStroke>& strokes,
                     const std::optional<FloatArray>& bound, const std::optional<FloatArray>& freeze) {
  const Rgba image = as_image<cv::Vec4f>(picture, "picture");
  const Plane matte = image_or_none<float>(bound, "bound"), frozen = image_or_none<float>(freeze, "freeze");
  const NoGil released;
  return propose_flow(image, fluid_kind_named(kind), strokes, matte, frozen);
}

py::array_t<float> overlay(const Streaks& streaks, double phase, const std::optional<std::array<int, 2>>& size) {
  const cv::Size wanted = size ? cv::Size((*size)[0], (*size)[1]) : streaks.size();
  Rgba image;
  {
    const NoGil released;
    image = streaks.at(phase, wanted);
  }
  return as_array(image);
}

/// The places (pixel centres) and values that strokes of one kind give to the interpolation.
py::tuple point_arrays(const std::vector<FlowStroke>& strokes, std::array<int, 2> size, bool directed) {
  std::vector<StrokeTrack> tracks;
  for (const FlowStroke& stroke : strokes) tracks.push_back(track_of(stroke, "stroke"));
  std::vector<PaintedTrack> painted;
  for (std::size_t i = 0; i < strokes.size(); ++i)
    painted.push_back({&tracks[i], strokes[i].alpha, directed, strokes[i].speed});
  std::vector<std::array<double, 2>> places, values;
  for (const StrokePixel& pixel : stroke_pixels(painted, cv::Size(size[0], size[1]))) {
    places.push_back({pixel.index.x + 0.5, pixel.index.y + 0.5});
    values.push_back({pixel.value[0], pixel.value[1]});
  }
  return py::make_tuple(py::cast(places), py::cast(values));
}

RadialInterpolation interpolation_of(const Places& places, const Places& values, double tolerance, int most_centres) {
  Eigen::MatrixXd rows(values.shape(0), values.shape(1));
  for (py::ssize_t i = 0; i < values.shape(0); ++i)
    for (py::ssize_t j = 0; j < values.shape(1); ++j) rows(i, j) = values.at(i, j);
  const std::vector<Point> points = points_of(places);
  const NoGil released;
  return {points, rows, {.tolerance = tolerance, .most_centres = most_centres}};
}

std::vector<std::vector<double>> exact(const RadialInterpolation& interpolation, const Places& places) {
  const Eigen::MatrixXd values = interpolation.at(points_of(places));
  std::vector<std::vector<double>> rows(values.rows());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j) rows[i].push_back(values(i, j));
  return rows;
}

}  // namespace

void bind_flow_painting(py::module_& module) {
  const FlowStroke usual;
  py::enum_<FlowStrokeKind>(module, "FlowStrokeKind")
      .value("orientation", FlowStrokeKind::orientation)
      .value("speed", FlowStrokeKind::speed)
      .value("both", FlowStrokeKind::both);
  py::class_<FlowStroke>(module, "FlowStroke")
      .def(py::init([](const std::vector<std::array<float, 3>>& points, double width, FlowStrokeKind kind, double speed,
                       bool local, double alpha) {
             FlowStroke stroke{{}, width, kind, speed, local, alpha};
             for (const auto& [x, y, pressure] : points) stroke.points.emplace_back(x, y, pressure);
             return stroke;
           }),
           py::kw_only(), py::arg("points"), py::arg("width") = usual.width, py::arg("kind") = usual.kind,
           py::arg("speed") = usual.speed, py::arg("local") = usual.local, py::arg("alpha") = usual.alpha)
      .def_readonly("width", &FlowStroke::width)
      .def_readonly("kind", &FlowStroke::kind)
      .def_readonly("speed", &FlowStroke::speed)
      .def_readonly("local", &FlowStroke::local)
      .def_readonly("alpha", &FlowStroke::alpha);
  py::class_<PaintedFlow>(module, "PaintedFlow", "A flow painted in two components: orientation, speed.")
      .def(py::init([](const FloatArray& orientation, const FloatArray& speed) {
             return PaintedFlow{as_image<cv::Vec2f>(orientation, "orientation").clone(), as_image<float>(speed, "speed").clone(), {}};
           }),
           py::arg("orientation"), py::arg("speed"))
      .def_property_readonly("orientation", [](const PaintedFlow& flow) { return as_array(flow.orientation); })
      .def_property_readonly("speed", [](const PaintedFlow& flow) { return as_array(flow.speed); });
  module.def("paint_flow", &painted, py::arg("strokes"), py::arg("size"), py::arg("bound") = std::nullopt,
             py::arg("freeze") = std::nullopt);

  const RefineParameters refine;
  module.def("refine_flow", &refined, py::arg("painted"), py::arg("picture"), py::arg("width") = refine.width,
             py::arg("amount") = refine.amount);
  module.def("propose_flow", &proposed, py::arg("picture"), py::arg("kind"), py::arg("strokes") = std::vector<FlowStroke>(),
             py::arg("bound") = std::nullopt, py::arg("freeze") = std::nullopt);
  const StreakParameters streaks;
  py::class_<Streaks>(module, "Streaks")
      .def(py::init([](const FloatArray& flow, double length, double strength, std::uint64_t seed) {
             const Field field = as_image<cv::Vec2f>(flow, "flow");
             const NoGil released;
             return Streaks(field, {.length = length, .strength = strength, .seed = seed});
           }),
           py::arg("flow"), py::kw_only(), py::arg("length") = streaks.length, py::arg("strength") = streaks.strength,
           py::arg("seed") = streaks.seed)
      .def("at", &overlay, py::arg("phase"), py::arg("size") = std::nullopt);

  module.def("stroke_pixels", &point_arrays, py::arg("strokes"), py::arg("size"), py::arg("directed"));
  py::class_<RadialInterpolation>(module, "RadialInterpolation")
      .def(py::init(&interpolation_of), py::arg("places"), py::arg("values"), py::arg("tolerance") = RadialOptions().tolerance,
           py::arg("most_centres") = RadialOptions().most_centres)
      .def("at", &exact, py::arg("places"))
      .def("fill",
           [](const RadialInterpolation& interpolation, std::array<int, 2> size) -> py::array {
             const cv::Size picture(size[0], size[1]);
             if (interpolation.weights().cols() == 1) return as_array(radial_fill<float>(interpolation, picture));
             return as_array(radial_fill<cv::Vec2f>(interpolation, picture));
           },
           py::arg("size"))
      .def_property_readonly("centres", [](const RadialInterpolation& interpolation) { return interpolation.centres().size(); });
  module.def(
      "moved_outline",
      [](const FloatArray& outline, const FloatArray& matte, const FloatArray& motion, double persistence) {
        const Plane b = as_image<float>(outline, "outline"), alpha = as_image<float>(matte, "matte");
        const Field moved = as_image<cv::Vec2f>(motion, "motion");
        Plane next;
        {
          const NoGil released;
          next = moved_outline(b, alpha, moved, persistence);
        }
        return as_array(next);
      },
      py::arg("outline"), py::arg("matte"), py::arg("motion"), py::arg("persistence"));
  module.def("wall_along", [](const FloatArray& matte) { return as_array(wall_along(as_image<float>(matte, "bound"))); },
             py::arg("matte"));
  module.def("obstacle_reach", [](std::array<int, 2> size) { return obstacle_reach({size[0], size[1]}); }, py::arg("size"));
}

}  // namespace stillwater
