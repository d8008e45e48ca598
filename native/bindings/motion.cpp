#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "motion/drift.h"
#include "motion/gusts.h"
#include "motion/rigid.h"
#include "motion/sway.h"
#include "motion/wind.h"

namespace stillwater {
namespace {

using Pair = std::array<double, 2>;

Point as_point(Pair pair) { return {pair[0], pair[1]}; }
Pair as_pair(Point point) { return {point.x, point.y}; }
Segment as_segment(const std::array<Pair, 2>& ends) { return {as_point(ends[0]), as_point(ends[1])}; }
std::array<Pair, 2> as_ends(const Segment& segment) { return {as_pair(segment.from), as_pair(segment.to)}; }
cv::Size as_size(std::array<int, 2> size) { return {size[0], size[1]}; }

// A Point member as a pair of numbers.
template <class Owner>
auto pair_of(Point Owner::*member) {
  return py::cpp_function([member](const Owner& owner) { return as_pair(owner.*member); });
}

py::array_t<float> evaluated(Field map(const Displacement&, int, int), const Displacement& displacement,
                             std::array<int, 2> size) {
  Field field;
  {
    const py::gil_scoped_release released;
    field = map(displacement, size[0], size[1]);
  }
  return as_array(field);
}

// Points in rows and columns, x and y last, moved by one of a displacement's functions.
py::array_t<float> moved(void (Displacement::*move)(float*, float*, int) const, const Displacement& displacement,
                         const FloatArray& points) {
  Field result = as_image<cv::Vec2f>(points, "points").clone();
  for (cv::Vec2f& point : result) (displacement.*move)(&point[0], &point[1], 1);
  return as_array(result);
}

void bind_wind(py::module_& module) {
  py::class_<Wind>(module, "Wind")
      .def(py::init([](double speed, double direction, double gusts, double gust_size, std::uint64_t seed,
                       Pair travel) { return Wind{speed, direction, gusts, gust_size, seed, as_point(travel)}; }),
           py::kw_only(), py::arg("speed") = Wind().speed, py::arg("direction") = Wind().direction,
           py::arg("gusts") = Wind().gusts, py::arg("gust_size") = Wind().gust_size, py::arg("seed") = Wind().seed,
           py::arg("travel") = Pair{0, 0})
      .def_readonly("speed", &Wind::speed)
      .def_readonly("direction", &Wind::direction)
      .def_readonly("gusts", &Wind::gusts)
      .def_readonly("gust_size", &Wind::gust_size)
      .def_readonly("seed", &Wind::seed)
      .def_property_readonly("travel", pair_of(&Wind::travel));

  py::class_<Moment>(module, "Moment")
      .def(py::init([](double frame, double fps, int loop_frames, int first_frame, const Wind& wind, Pair loop_travel) {
             return Moment{frame, fps, loop_frames, first_frame, wind, as_point(loop_travel)};
           }),
           py::kw_only(), py::arg("frame") = Moment().frame, py::arg("fps") = Moment().fps,
           py::arg("loop_frames") = Moment().loop_frames, py::arg("first_frame") = Moment().first_frame,
           py::arg("wind") = Wind(), py::arg("loop_travel") = Pair{0, 0})
      .def_readonly("frame", &Moment::frame)
      .def_readonly("fps", &Moment::fps)
      .def_readonly("loop_frames", &Moment::loop_frames)
      .def_readonly("first_frame", &Moment::first_frame)
      .def_readonly("wind", &Moment::wind)
      .def_property_readonly("loop_travel", pair_of(&Moment::loop_travel));

  module.def("check_moment", &check_moment, py::arg("moment"));
  module.def("wind_spectrum", py::vectorize(&wind_spectrum), py::arg("frequency"), py::arg("speed"));
  py::class_<TurbulenceNoise>(module, "TurbulenceNoise").def(py::init<std::uint64_t>(), py::arg("seed"));
  module.def("turbulence", &turbulence, py::arg("noise"), py::arg("moment"));

  py::class_<GustField>(module, "GustField")
      .def(py::init([](double gust_size, std::uint64_t seed, std::array<int, 2> picture) {
             return GustField(gust_size, seed, as_size(picture));
           }),
           py::arg("gust_size"), py::arg("seed"), py::arg("picture"))
      .def(
          "factor",
          [](const GustField& gusts, Pair place, const Moment& moment) {
            return gusts.factor(as_point(place), moment);
          },
          py::arg("place"), py::arg("moment"))
      .def(
          "factors",
          [](const GustField& gusts, Pair first, Pair step, int count, const Moment& moment) {
            std::vector<float> factors(count);
            gusts.factors(as_point(first), as_point(step), moment, count, factors.data());
            return factors;
          },
          py::arg("first"), py::arg("step"), py::arg("count"), py::arg("moment"))
      .def(
          "response",
          [](const GustField& gusts, Pair place, const Moment& moment, double frequency, double mass, double damping) {
            return gusts.response(as_point(place), moment, {frequency, mass, damping});
          },
          py::arg("place"), py::arg("moment"), py::arg("frequency"), py::arg("mass"), py::arg("damping"));
  module.attr("plan_width") = plan_width;
  module.attr("turbulence_period") = turbulence_period;
  module.attr("turbulence_intensity") = turbulence_intensity;
}

void bind_displacement(py::module_& module) {
  py::class_<Displacement, std::shared_ptr<Displacement>>(module, "Displacement")
      .def("at_rest", &Displacement::at_rest)
      .def("reach", &Displacement::reach)
      .def(
          "map",
          [](const Displacement& self, const FloatArray& points) { return moved(&Displacement::map, self, points); },
          py::arg("points"))
      .def(
          "unmap",
          [](const Displacement& self, const FloatArray& points) { return moved(&Displacement::unmap, self, points); },
          py::arg("points"))
      .def(
          "displacement_map",
          [](const Displacement& self, std::array<int, 2> size) { return evaluated(displacement_map, self, size); },
          py::arg("size"))
      .def(
          "forward_map",
          [](const Displacement& self, std::array<int, 2> size) { return evaluated(forward_map, self, size); },
          py::arg("size"));
  py::class_<Translation, Displacement, std::shared_ptr<Translation>>(module, "Translation")
      .def(py::init([](Pair offset) { return std::make_shared<Translation>(as_point(offset)); }), py::arg("offset"));
  py::class_<RigidMotion, Displacement, std::shared_ptr<RigidMotion>>(module, "RigidMotion")
      .def(py::init([](Pair pivot, double angle, Pair shift, std::array<int, 2> picture) {
             return std::make_shared<RigidMotion>(as_point(pivot), angle, as_point(shift), as_size(picture));
           }),
           py::arg("pivot"), py::arg("angle"), py::arg("shift"), py::arg("picture"));
}

void bind_sway(py::module_& module) {
  const Sway usual;
  py::class_<Sway>(module, "Sway")
      .def(py::init([](const std::array<Pair, 2>& armature, double frequency, double mass, double damping,
                       double amount, double foreshortening, double shimmer, std::uint64_t seed) {
             return Sway{as_segment(armature), frequency, mass, damping, amount, foreshortening, shimmer, seed};
           }),
           py::kw_only(), py::arg("armature"), py::arg("frequency") = usual.frequency, py::arg("mass") = usual.mass,
           py::arg("damping") = usual.damping, py::arg("amount") = usual.amount,
           py::arg("foreshortening") = usual.foreshortening, py::arg("shimmer") = usual.shimmer,
           py::arg("seed") = usual.seed)
      .def_property_readonly("armature", [](const Sway& sway) { return as_ends(sway.armature); })
      .def_readonly("frequency", &Sway::frequency)
      .def_readonly("mass", &Sway::mass)
      .def_readonly("damping", &Sway::damping)
      .def_readonly("amount", &Sway::amount)
      .def_readonly("foreshortening", &Sway::foreshortening)
      .def_readonly("shimmer", &Sway::shimmer)
      .def_readonly("seed", &Sway::seed);

  py::class_<TipMotion>(module, "TipMotion")
      .def_readonly("across", &TipMotion::across)
      .def_readonly("depth", &TipMotion::depth)
      .def_readonly("force", &TipMotion::force);

  py::class_<SwayMotion>(module, "SwayMotion")
      .def(py::init([](const Sway& sway, const Wind& wind, std::array<int, 2> picture) {
             return SwayMotion(sway, wind, as_size(picture));
           }),
           py::arg("sway"), py::arg("wind"), py::arg("picture"))
      .def(
          "at",
          [](const SwayMotion& motion, const Moment& moment, const Sway& now) {
            return std::const_pointer_cast<Displacement>(motion.at(moment, now));
          },
          py::arg("moment"), py::arg("now"))
      .def("tip", &SwayMotion::tip, py::arg("moment"), py::arg("now"));
}

void bind_drift(py::module_& module) {
  py::class_<Drift>(module, "Drift")
      .def(py::init([](Pair offset, Pair loop_offset) {
             return Drift{as_point(offset), as_point(loop_offset)};
           }),
           py::kw_only(), py::arg("offset") = Pair{0, 0}, py::arg("loop_offset") = Pair{0, 0})
      .def_property_readonly("offset", pair_of(&Drift::offset))
      .def_property_readonly("loop_offset", pair_of(&Drift::loop_offset));
  py::class_<DriftCopies>(module, "DriftCopies")
      .def_property_readonly("first", pair_of(&DriftCopies::first))
      .def_property_readonly("second", pair_of(&DriftCopies::second))
      .def_readonly("second_share", &DriftCopies::second_share);
  module.def(
      "drift",
      [](const Drift& travelled, const Moment& moment, Pair period) {
        return drift(travelled, moment, as_point(period));
      },
      py::arg("drift"), py::arg("moment"), py::arg("period"));
}

}  // namespace

void bind_motion(py::module_& module) {
  bind_wind(module);
  bind_displacement(module);
  bind_sway(module);
  bind_drift(module);
}

}  // namespace stillwater
