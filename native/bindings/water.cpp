#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "motion/bob.h"
#include "motion/ripple.h"
#include "motion/waves.h"

namespace stillwater {
namespace {

py::array_t<float> wave_heights(const WaveTile& tile, double seconds, double period, double speed, double direction) {
  cv::Mat_<float> heights(tile.resolution, tile.resolution);
  {
    const py::gil_scoped_release release;
    Waves waves(tile, period);
    waves.blow(speed, direction);
    const InverseFft2& filled = waves.at(period > 0 ? seconds / period : seconds);
    for (int y = 0; y < tile.resolution; ++y) std::copy_n(filled.tile_row(y), tile.resolution, heights[y]);
  }
  return as_array(heights);
}

}  // namespace

void bind_water(py::module_& module) {
  py::enum_<Spectrum>(module, "Spectrum")
      .value("phillips", Spectrum::phillips)
      .value("pierson-moskowitz", Spectrum::pierson_moskowitz)
      .value("jonswap", Spectrum::jonswap)
      .value("tma", Spectrum::tma);
  py::enum_<RippleMode>(module, "RippleMode").value("height", RippleMode::height).value("normal", RippleMode::normal);
  py::class_<WaveTile>(module, "WaveTile")
      .def(py::init([](double side, int resolution, Spectrum spectrum, double fetch, double depth, std::uint64_t seed) {
             return WaveTile{side, resolution, spectrum, fetch, depth, seed};
           }),
           py::kw_only(), py::arg("side") = 60.0, py::arg("resolution") = 256, py::arg("spectrum") = Spectrum::phillips,
           py::arg("fetch") = 100.0, py::arg("depth") = 200.0, py::arg("seed") = 0);
  module.def("wave_heights", &wave_heights);
  module.def("rawmap", [](const Ripple& r, const View& v, const Wind& w, const Moment& m, int W, int H, bool forward){
    RippleMotion motion(r, v, w, cv::Size(W,H), cv::Rect(0,0,W,H));
    auto d = motion.at(m, r);
    return as_array(forward ? forward_map(*d, W, H) : displacement_map(*d, W, H));
  });
  py::class_<Wind>(module, "Wind").def(py::init<>()).def_readwrite("speed",&Wind::speed).def_readwrite("direction",&Wind::direction);
  py::class_<Moment>(module, "Moment").def(py::init<>()).def_readwrite("frame",&Moment::frame).def_readwrite("fps",&Moment::fps).def_readwrite("loop_frames",&Moment::loop_frames).def_readwrite("wind",&Moment::wind);
  py::class_<View>(module, "View").def(py::init([](double x0,double y0,double x1,double y1,double fov,double height){ return View{Segment{{x0,y0},{x1,y1}},fov,height};}));
  py::class_<Ripple>(module, "Ripple").def(py::init<>()).def_readwrite("amplitude",&Ripple::amplitude).def_readwrite("roughness",&Ripple::roughness).def_readwrite("tile",&Ripple::tile).def_readwrite("resolution",&Ripple::resolution).def_readwrite("mode",&Ripple::mode).def_readwrite("spectrum",&Ripple::spectrum).def_readwrite("seed",&Ripple::seed);
  py::class_<RippleMotion>(module, "RippleMotion").def(py::init([](const Ripple& r, const View& v, const Wind& w, int W, int H){ return RippleMotion(r,v,w,cv::Size(W,H),cv::Rect(0,0,W,H));}))
    .def("at", [](const RippleMotion& m, const Moment& t, const Ripple& r){ m.at(t, r); });
}

}  // namespace stillwater
