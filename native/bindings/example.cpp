#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/example_arrays.h"
#include "bindings/rooms.h"
#include "example/analyse_clip.h"
#include "example/camera.h"
#include "example/carried_residuals.h"
#include "example/local_contrast.h"
#include "example/match_patches.h"
#include "example/sample_differences.h"
#include "frame/example_plate.h"

namespace stillwater {

HalfFrames as_half_frames(const py::array& array, const std::string& name) {
  const bool half = array.dtype().kind() == 'f' && array.itemsize() == 2;
  if (!half || array.ndim() != 4 || array.shape(3) != 3 || !(array.flags() & py::array::c_style))
    throw BadInput(name + ": not an array of half floats, frames x height x width x 3");
  return {const_cast<void*>(array.data()), static_cast<int>(array.shape(0)),
          cv::Size(static_cast<int>(array.shape(2)), static_cast<int>(array.shape(1)))};
}

std::vector<PlacedPatch> as_patches(const FloatArray& array) {
  if (array.size() == 0) return {};
  if (array.ndim() != 2 || array.shape(1) != 5) throw BadInput("patches: not an array of count x 5");
  std::vector<PlacedPatch> patches;
  const auto numbers = array.unchecked<2>();
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i)
    patches.push_back({{numbers(i, 0), numbers(i, 1)}, {numbers(i, 2), numbers(i, 3)}, numbers(i, 4)});
  return patches;
}

namespace {

using Size = std::pair<int, int>;

py::array_t<float> patches_array(const std::vector<PlacedPatch>& patches) {
  py::array_t<float> array({static_cast<py::ssize_t>(patches.size()), py::ssize_t{5}});
  auto numbers = array.mutable_unchecked<2>();
  for (size_t i = 0; i < patches.size(); ++i) {
    const PlacedPatch& p = patches[i];
    const std::array<float, 5> row{p.target[0], p.target[1], p.source[0], p.source[1], p.turn};
    for (py::ssize_t k = 0; k < 5; ++k) numbers(static_cast<py::ssize_t>(i), k) = row[k];
  }
  return array;
}

ClipAnalysis analyse(py::array frames, const std::string& flow, const std::string& quality,
                     const Progress::Listener& progress) {
  if (!frames.writeable()) throw BadInput("frames: not an array that may be written");
  HalfFrames halves = as_half_frames(frames, "frames");
  const AnalyseParameters parameters{clip_flow_named(flow), flow_quality_named(quality)};
  const py::gil_scoped_release release;
  return analyse_clip(halves, parameters, Progress(progress));
}

double held(py::array frames, const Progress::Listener& listener) {
  if (!frames.writeable()) throw BadInput("frames: not an array that may be written");
  HalfFrames halves = as_half_frames(frames, "frames");
  const py::gil_scoped_release release;
  Progress progress(listener);
  progress.phase("finding the camera's way", 1);
  return hold_camera(halves, camera_path(halves, progress));
}

py::array_t<float> matched(const FloatArray& velocity, const FloatArray& clip_velocity, const FloatArray& energy,
                           const TransferParameters& parameters) {
  const Field flow = as_image<cv::Vec2f>(velocity, "velocity");
  const ClipMotion clip{as_image<cv::Vec2f>(clip_velocity, "clip_velocity"), as_image<float>(energy, "energy")};
  std::vector<PlacedPatch> patches;
  {
    const py::gil_scoped_release release;
    patches = match_patches(flow, clip, parameters);
  }
  return patches_array(patches);
}

/// Residuals carried over a picture; keeps their memory.
struct Carried {
  py::array kept;
  CarriedResiduals residuals;
};

std::unique_ptr<Carried> carried(const py::array& residuals, const SourceMap& map, const FloatArray& velocity, int life,
                                 double fade, bool endless, int period, bool mirrored) {
  const Field flow = as_image<cv::Vec2f>(velocity, "velocity");
  return std::make_unique<Carried>(
      residuals, CarriedResiduals(as_half_frames(residuals, "residuals"), map, {flow},
                                  {life, fade, {endless, period}, mirrored ? Beyond() : repeated}));
}

py::array_t<float> carried_at(const Carried& carried, double moment) {
  Rgb colours;
  {
    const py::gil_scoped_release release;
    colours = carried.residuals.at({.moment = moment});
  }
  return as_array(colours);
}

std::tuple<py::array_t<float>, py::array_t<float>, py::array_t<float>> contrast(const FloatArray& difference, const std::vector<FloatArray>& moments,
                                                           const FloatArray& weight, double around) {
  const Rgb own = as_image<cv::Vec3f>(difference, "difference");
  std::vector<Rgb> film;
  for (const FloatArray& moment : moments) film.push_back(as_image<cv::Vec3f>(moment, "moments"));
  const Plane counts = as_image<float>(weight, "weight");
  LocalContrast found;
  {
    const py::gil_scoped_release release;
    found = local_contrast(own, film, counts, around);
  }
  return {as_array(found.slope), as_array(found.mean), as_array(found.hold)};
}

ExampleSetup example_setup(const py::array& residuals, const FloatArray& patches, const std::vector<CloneStroke>& strokes,
                           const TransferParameters& transfer, double reach, const std::optional<FloatArray>& moving,
                           const std::vector<FloatArray>& velocities,
                           const std::optional<FloatArray>& freeze, int life, bool endless, int period,
                           const LookParameters& look) {
  ExampleSetup setup{as_half_frames(residuals, "residuals"), kept_alive(residuals), as_patches(patches), strokes, transfer, reach, {}, {}, {}, {}, look};
  if (moving) setup.moving = as_image<cv::Vec3f>(*moving, "moving").clone();
  for (const FloatArray& velocity : velocities) setup.velocities.push_back(as_image<cv::Vec2f>(velocity, "velocities").clone());
  if (freeze) setup.freeze = as_image<float>(*freeze, "freeze").clone();
  setup.carried.life = life;
  setup.carried.sequence = {endless, period};
  return setup;
}

LookParameters look_parameters(double shutter, double fps, double average_blur, Size grid, int repetitions,
                               const std::string& matching, double stylize) {
  LookParameters look{{shutter, fps, average_blur}, {grid.first, grid.second}, repetitions};
  look.matched = matching != "none";
  look.matching = matching == "laplacian" ? TextureMatching::laplacian : TextureMatching::steerable;
  look.stylize = stylize;
  return look;
}

// Curves one after the other, and how many numbers each has; those of pixels come first.
std::tuple<py::array_t<float>, std::vector<size_t>, size_t> flat_curves(const ExampleLook& look) {
  std::vector<float> numbers;
  std::vector<size_t> lengths;
  for (const auto* curves : {&look.curves.pixels, &look.curves.bands})
    for (const CellCurves& curve : *curves) {
      numbers.insert(numbers.end(), curve.begin(), curve.end());
      lengths.push_back(curve.size());
    }
  return {py::array_t<float>(static_cast<py::ssize_t>(numbers.size()), numbers.data()), lengths, look.curves.pixels.size()};
}

ExampleLook look_of(const FloatArray& base, const FloatArray& slope, const FloatArray& hold, const FloatArray& numbers,
                    const std::vector<size_t>& lengths, size_t pixels) {
  ExampleLook look{as_image<cv::Vec3f>(base, "base").clone(), as_image<cv::Vec3f>(slope, "slope").clone(),
                   as_image<float>(hold, "hold").clone(), {}};
  const float* next = numbers.data();
  size_t left = static_cast<size_t>(numbers.size());
  for (size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] > left) throw BadInput("curves: not as long as their lengths say");
    (i < pixels ? look.curves.pixels : look.curves.bands).emplace_back(next, next + lengths[i]);
    next += lengths[i], left -= lengths[i];
  }
  return look;
}

}  // namespace

void bind_example(py::module_& module) {
  py::class_<ClipAnalysis>(module, "ClipAnalysis")
      .def_property_readonly("average", [](const ClipAnalysis& a) { return as_array(a.average); })
      .def_property_readonly("velocity", [](const ClipAnalysis& a) { return as_array(a.velocity); })
      .def_property_readonly("energy", [](const ClipAnalysis& a) { return as_array(a.energy); })
      .def_readonly("reach", &ClipAnalysis::reach)
      .def_property_readonly("moving", [](const ClipAnalysis& found) { return as_array(found.moving); })
      .def_readonly("explained", &ClipAnalysis::explained);
  module.def("analyse_clip", &analyse, py::arg("frames").noconvert(), py::arg("flow"), py::arg("quality"),
             py::arg("progress") = Progress::Listener());
  module.def("moves_as_one", [](const py::array& frames) {
    const HalfFrames halves = as_half_frames(frames, "frames");
    const py::gil_scoped_release release;
    return moves_as_one(halves);
  });
  module.def("hold_camera", &held, py::arg("frames").noconvert(), py::arg("progress") = Progress::Listener());
  const TransferParameters usual;
  py::class_<TransferParameters>(module, "TransferParameters")
      .def(py::init<int, double, bool>(), py::kw_only(), py::arg("patch") = usual.patch,
           py::arg("clip_scale") = usual.clip_scale, py::arg("best_last") = usual.best_last);
  py::class_<CloneStroke>(module, "CloneStroke")
      .def(py::init([](const std::vector<std::pair<double, double>>& source,
                       const std::vector<std::pair<double, double>>& target, double width, double alpha) {
             CloneStroke stroke{{}, {}, width, alpha};
             for (const auto& [x, y] : source) stroke.source.push_back({x, y});
             for (const auto& [x, y] : target) stroke.target.push_back({x, y});
             return stroke;
           }),
           py::arg("source"), py::arg("target"), py::arg("width") = CloneStroke().width, py::arg("alpha") = CloneStroke().alpha);
  module.def("match_patches", &matched, py::arg("velocity"), py::arg("clip_velocity"), py::arg("energy"),
             py::arg("parameters") = TransferParameters());
  py::class_<SourceMap>(module, "SourceMap")
      .def(py::init([](Size size, const FloatArray& patches, const std::vector<CloneStroke>& strokes,
                       const TransferParameters& parameters, double reach) {
             return SourceMap({{size.first, size.second}}, as_patches(patches), strokes, parameters, reach);
           }),
           py::arg("size"), py::arg("patches"), py::arg("strokes") = std::vector<CloneStroke>(),
           py::arg("parameters") = TransferParameters(), py::arg("reach") = 1.0)
      .def("gather", [](const SourceMap& map, const FloatArray& residual) {
        return as_array(map.gather(as_image<cv::Vec3f>(residual, "residual")));
      });
  module.def("identical_map", [](Size clip) { return identical_map({clip.first, clip.second}); }, py::arg("clip"));
  py::class_<Carried>(module, "CarriedResiduals")
      .def(py::init(&carried), py::arg("residuals"), py::arg("map"), py::arg("velocity"), py::arg("life") = 16,
           py::arg("fade") = 0.5, py::arg("endless") = true, py::arg("period") = 0, py::arg("mirrored") = true)
      .def("at", &carried_at, py::arg("moment"));
  py::class_<LookParameters>(module, "LookParameters")
      .def(py::init(&look_parameters), py::kw_only(), py::arg("shutter"), py::arg("fps"), py::arg("average_blur"),
           py::arg("grid") = Size{0, 0}, py::arg("repetitions"), py::arg("matching"), py::arg("stylize"));
  py::class_<ExampleSetup>(module, "ExampleSetup")
      .def(py::init(&example_setup), py::kw_only(), py::arg("residuals"), py::arg("patches"), py::arg("strokes"),
           py::arg("transfer"), py::arg("reach"), py::arg("moving") = std::nullopt, py::arg("velocities"), py::arg("freeze"), py::arg("life"),
           py::arg("endless"), py::arg("period"), py::arg("look"));
  py::class_<ExampleLook>(module, "ExampleLook")
      .def(py::init(&look_of), py::arg("base"), py::arg("slope"), py::arg("hold"), py::arg("numbers"), py::arg("lengths"), py::arg("pixels"))
      .def_property_readonly("base", [](const ExampleLook& look) { return as_array(look.base); })
      .def_property_readonly("slope", [](const ExampleLook& look) { return as_array(look.slope); })
      .def_property_readonly("hold", [](const ExampleLook& look) { return as_array(look.hold); })
      .def_property_readonly("curves", &flat_curves);
  const ExampleNow still;
  py::class_<ExampleNow>(module, "Example")
      .def(py::init([](double moment, double step, int field, int next_field, double next_share) {
             return ExampleNow{moment, step, field, next_field, next_share};
           }),
           py::kw_only(), py::arg("moment") = still.moment, py::arg("step") = still.step, py::arg("field") = still.field,
           py::arg("next_field") = still.next_field, py::arg("next_share") = still.next_share);
  module.def("local_contrast", &contrast, py::arg("difference"), py::arg("moments"), py::arg("weight"), py::arg("around"));
}

}  // namespace stillwater
