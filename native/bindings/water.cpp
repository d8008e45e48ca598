#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "motion/bob.h"
#include "motion/ripple.h"
#include "motion/waves.h"

namespace stillwater {
namespace {
using Pair = std::array<double, 2>;
Point as_point(Pair p) { return {p[0], p[1]}; }
}  // namespace

void bind_water(py::module_& module) {
  py::enum_<Spectrum>(module, "Spectrum")
      .value("phillips", Spectrum::phillips)
      .value("pierson-moskowitz", Spectrum::pierson_moskowitz)
      .value("jonswap", Spectrum::jonswap)
      .value("tma", Spectrum::tma);
  py::enum_<RippleMode>(module, "RippleMode").value("height", RippleMode::height).value("normal", RippleMode::normal);
  py::class_<View>(module, "View")
      .def(py::init([](const std::optional<std::array<Pair, 2>>& horizon, double fov, double height) {
             View view;
             if (horizon) view.horizon = Segment{as_point((*horizon)[0]), as_point((*horizon)[1])};
             view.fov = fov;
             view.height = height;
             return view;
           }),
           py::arg("horizon") = std::nullopt, py::arg("fov") = 50.0, py::arg("height") = 1.7)
      .def("any_water", [](const View& view, std::array<int, 4> b) { return view.any_water({b[0], b[1], b[2], b[3]}); },
           py::arg("box"));
  py::class_<Ripple>(module, "Ripple")
      .def(py::init([](double amplitude, double roughness, double tile, int resolution, const std::string& mode,
                       const std::string& spectrum, double fetch, double depth, std::uint64_t seed) {
             Ripple r;
             r.amplitude = amplitude; r.roughness = roughness; r.tile = tile; r.resolution = resolution;
             r.mode = mode == "normal" ? RippleMode::normal : RippleMode::height;
             r.spectrum = spectrum == "jonswap" ? Spectrum::jonswap : spectrum == "tma" ? Spectrum::tma
                 : spectrum == "pierson-moskowitz" ? Spectrum::pierson_moskowitz : Spectrum::phillips;
             r.fetch = fetch; r.depth = depth; r.seed = seed;
             return r;
           }),
           py::arg("amplitude") = 1.0, py::arg("roughness") = 1.0, py::arg("tile") = 60.0, py::arg("resolution") = 256,
           py::arg("mode") = "height", py::arg("spectrum") = "phillips", py::arg("fetch") = 100.0, py::arg("depth") = 200.0,
           py::arg("seed") = 0);
  py::class_<Bob>(module, "Bob")
      .def(py::init([](const std::vector<Pair>& waterline, double amount) {
             Bob bob;
             for (Pair p : waterline) bob.waterline.push_back(as_point(p));
             bob.amount = amount;
             return bob;
           }),
           py::arg("waterline"), py::arg("amount") = 1.0);
}

}  // namespace stillwater
