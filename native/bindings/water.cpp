#include <pybind11/stl.h>

#include <array>
#include <optional>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "motion/bob.h"
#include "motion/ripple.h"
#include "motion/waves.h"

namespace stillwater {
namespace {

using Pair = std::array<double, 2>;

Point as_point(Pair pair) { return {pair[0], pair[1]}; }
Pair as_pair(Point point) { return {point.x, point.y}; }
cv::Size as_size(std::array<int, 2> size) { return {size[0], size[1]}; }
cv::Rect as_rect(std::array<int, 4> rect) { return {rect[0], rect[1], rect[2], rect[3]}; }

std::vector<Point> as_points(const std::vector<Pair>& pairs) {
  std::vector<Point> points;
  for (const Pair& pair : pairs) points.push_back(as_point(pair));
  return points;
}

std::vector<Pair> as_pairs(const std::vector<Point>& points) {
  std::vector<Pair> pairs;
  for (const Point& point : points) pairs.push_back(as_pair(point));
  return pairs;
}

std::array<Pair, 2> as_ends(const Segment& segment) { return {as_pair(segment.from), as_pair(segment.to)}; }

void bind_view(py::module_& module) {
  const View usual;
  py::class_<View>(module, "View")
      .def(py::init([](const std::optional<std::array<Pair, 2>>& horizon, double fov, double height) {
             View view{std::nullopt, fov, height};
             if (horizon) view.horizon = Segment{as_point((*horizon)[0]), as_point((*horizon)[1])};
             return view;
           }),
           py::kw_only(), py::arg("horizon") = py::none(), py::arg("fov") = usual.fov, py::arg("height") = usual.height)
      .def_property_readonly("horizon",
                             [](const View& view) { return view.horizon ? std::optional(as_ends(*view.horizon)) : std::nullopt; })
      .def_readonly("fov", &View::fov)
      .def_readonly("height", &View::height)
      .def(
          "any_water", [](const View& view, std::array<int, 4> box) { return view.any_water(as_rect(box)); }, py::arg("box"));

  py::class_<WaterPlane>(module, "WaterPlane")
      .def(py::init([](const View& view, std::array<int, 2> picture) { return WaterPlane(view, as_size(picture)); }),
           py::arg("view"), py::arg("picture"))
      .def(
          "ground", [](const WaterPlane& plane, Pair place) { return as_pair(plane.ground(as_point(place))); },
          py::arg("picture"))
      .def(
          "seen", [](const WaterPlane& plane, Pair ground, double rise) { return as_pair(plane.seen(as_point(ground), rise)); },
          py::arg("ground"), py::arg("rise") = 0.0);
}

void bind_waves(py::module_& module) {
  module.def(
      "wave_heights",
      [](double tile, int resolution, const std::string& spectrum, double fetch, double depth, std::uint64_t seed, double speed,
         double direction, double seconds, double period) {
        Plane heights;
        {
          const WaveTile given{tile, resolution, spectrum_named(spectrum), fetch, depth, seed};
          const py::gil_scoped_release released;
          heights = wave_heights(given, speed, direction, seconds, period);
        }
        return as_array(heights);
      },
      py::kw_only(), py::arg("tile"), py::arg("resolution"), py::arg("spectrum"), py::arg("fetch"), py::arg("depth"),
      py::arg("seed"), py::arg("speed"), py::arg("direction"), py::arg("seconds"), py::arg("period"));
  py::class_<Waves>(module, "Waves")
      .def(py::init([](double tile, int resolution) { return Waves(WaveTile{tile, resolution}); }), py::arg("tile"),
           py::arg("resolution"))
      .def("blow", &Waves::blow, py::arg("speed"), py::arg("direction"))
      .def(
          "fill", [](Waves& waves, double seconds) { waves.at(seconds); }, py::arg("seconds"),
          py::call_guard<py::gil_scoped_release>());
  module.def(
      "radial_density",
      [](const std::string& spectrum, double wind_speed, double fetch, double depth, double wave_number) {
        return radial_density({spectrum_named(spectrum), wind_speed, fetch, depth}, wave_number);
      },
      py::arg("spectrum"), py::arg("wind_speed"), py::arg("fetch"), py::arg("depth"), py::arg("wave_number"));
  module.def("spreading", &spreading, py::arg("cosine_to_wind"));
}

void bind_ripple(py::module_& module) {
  const Ripple usual;
  py::class_<Ripple>(module, "Ripple")
      .def(py::init([](double amplitude, double roughness, double tile, int resolution, const std::string& mode,
                       const std::string& spectrum, double fetch, double depth, std::uint64_t seed) {
             return Ripple{amplitude, roughness, tile, resolution, ripple_mode_named(mode), spectrum_named(spectrum), fetch,
                           depth, seed};
           }),
           py::kw_only(), py::arg("amplitude") = usual.amplitude, py::arg("roughness") = usual.roughness,
           py::arg("tile") = usual.tile, py::arg("resolution") = usual.resolution, py::arg("mode") = name_of(usual.mode),
           py::arg("spectrum") = name_of(usual.spectrum), py::arg("fetch") = usual.fetch, py::arg("depth") = usual.depth,
           py::arg("seed") = usual.seed)
      .def_readonly("amplitude", &Ripple::amplitude)
      .def_readonly("roughness", &Ripple::roughness)
      .def_readonly("tile", &Ripple::tile)
      .def_readonly("resolution", &Ripple::resolution)
      .def_property_readonly("mode", [](const Ripple& ripple) { return name_of(ripple.mode); })
      .def_property_readonly("spectrum", [](const Ripple& ripple) { return name_of(ripple.spectrum); })
      .def_readonly("fetch", &Ripple::fetch)
      .def_readonly("depth", &Ripple::depth)
      .def_readonly("seed", &Ripple::seed);

  py::class_<RippleMotion>(module, "RippleMotion")
      .def(py::init([](const Ripple& ripple, const View& view, const Wind& wind, std::array<int, 2> picture,
                       std::optional<std::array<int, 4>> region) {
             const std::array<int, 4> whole{0, 0, picture[0], picture[1]};
             return RippleMotion(ripple, view, wind, as_size(picture), as_rect(region.value_or(whole)));
           }),
           py::arg("ripple"), py::arg("view"), py::arg("wind"), py::arg("picture"), py::arg("region") = py::none())
      .def(
          "at",
          [](const RippleMotion& motion, const Moment& moment, const Ripple& now) {
            return std::const_pointer_cast<Displacement>(motion.at(moment, now));
          },
          py::arg("moment"), py::arg("now"), py::call_guard<py::gil_scoped_release>());
  module.attr("pixels_per_slope") = pixels_per_slope;
}

void bind_bob(py::module_& module) {
  const Bob usual;
  py::class_<Bob>(module, "Bob")
      .def(py::init([](const std::vector<Pair>& waterline, double amount) { return Bob{as_points(waterline), amount}; }),
           py::kw_only(), py::arg("waterline"), py::arg("amount") = usual.amount)
      .def_property_readonly("waterline", [](const Bob& bob) { return as_pairs(bob.waterline); })
      .def_readonly("amount", &Bob::amount);
  module.def(
      "fitted_waterline", [](const Bob& bob) { return as_ends(fitted_waterline(bob)); }, py::arg("bob"));
  module.def(
      "waterline_samples", [](const Bob& bob) { return as_pairs(waterline_samples(bob)); }, py::arg("bob"));
  module.def(
      "fitted_motion",
      [](const Bob& bob, const std::vector<Pair>& moved, std::array<int, 2> picture) {
        return std::const_pointer_cast<RigidMotion>(fitted_motion(bob, as_points(moved), as_size(picture)));
      },
      py::arg("bob"), py::arg("moved"), py::arg("picture"));
  module.def(
      "bob",
      [](const Bob& given, const Displacement& water, std::array<int, 2> picture) {
        return std::const_pointer_cast<RigidMotion>(bob(given, water, as_size(picture)));
      },
      py::arg("bob"), py::arg("water"), py::arg("picture"));
}

}  // namespace

void bind_water(py::module_& module) {
  bind_view(module);
  bind_waves(module);
  bind_ripple(module);
  bind_bob(module);
}

}  // namespace stillwater
