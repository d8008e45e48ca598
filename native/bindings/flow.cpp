#include <variant>

#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "flow/flow_cycle.h"
#include "flow/flow_map.h"
#include "flow/optical_flow.h"

namespace stillwater {
namespace {

py::array_t<float> flow_map_array(const FloatArray& velocity, const std::variant<double, FloatArray>& frames) {
  const Field flow = as_image<cv::Vec2f>(velocity, "velocity");
  Field map;
  if (const auto* each = std::get_if<FloatArray>(&frames)) {
    const Plane times = as_image<float>(*each, "frames");
    const py::gil_scoped_release release;
    map = flow_map(flow, times);
  } else {
    const py::gil_scoped_release release;
    map = flow_map(flow, std::get<double>(frames));
  }
  return as_array(map);
}

py::array_t<float> advect_array(const FloatArray& image, const FloatArray& velocity, double frames) {
  const Rgba picture = as_image<cv::Vec4f>(image, "image");
  const Field flow = as_image<cv::Vec2f>(velocity, "velocity");
  Rgba carried;
  {
    const py::gil_scoped_release release;
    carried = advect(picture, flow, frames);
  }
  return as_array(carried);
}

py::array_t<float> optical_flow_array(const FloatArray& a, const FloatArray& b, const std::string& quality) {
  const Plane from = as_image<float>(a, "a"), to = as_image<float>(b, "b");
  Field flow;
  {
    const py::gil_scoped_release release;
    flow = optical_flow(from, to, flow_quality_named(quality));
  }
  return as_array(flow);
}

py::array_t<float> luma_array(const FloatArray& colours) { return as_array(luma(as_image<cv::Vec3f>(colours, "colours"))); }

}  // namespace

void bind_flow(py::module_& module) {
  const Flow usual;
  py::class_<Flow>(module, "Flow")
      .def(py::init([](double cycle, const std::vector<double>& ways, double step, int field, int next_field,
                       double next_share) { return Flow{cycle, ways, step, field, next_field, next_share}; }),
           py::kw_only(), py::arg("cycle") = usual.cycle, py::arg("ways") = std::vector<double>{0, 0},
           py::arg("step") = usual.step, py::arg("field") = usual.field, py::arg("next_field") = usual.next_field,
           py::arg("next_share") = usual.next_share);
  module.def("flow_map", &flow_map_array, py::arg("velocity"), py::arg("frames"));
  module.def("optical_flow", &optical_flow_array, py::arg("a"), py::arg("b"), py::arg("quality"));
  module.def("luma", &luma_array, py::arg("colours"));
  module.def("advect", &advect_array, py::arg("image"), py::arg("velocity"), py::arg("frames"));
}

}  // namespace stillwater
