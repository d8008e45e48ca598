#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "bindings/rooms.h"
#include "core/cpu.h"
#include "core/parallel.h"
#include "core/process.h"
#include "core/random.h"

namespace py = pybind11;

namespace stillwater {
namespace {

// As a context manager.
struct HeldInside {
  std::unique_ptr<EndHeld> now;
};

}  // namespace

void bind_core(py::module_& module) {
  module.def("set_threads", &set_threads, py::arg("threads"));
  module.def("threads", &threads);
  module.def("has_avx2", &has_avx2);
  module.def("install_signal_handler", &install_signal_handler);
  module.def("end_with_standard_input", &end_with_standard_input);
  module.def("listen_to_standard_input", &listen_to_standard_input);
  module.def(
      "next_line",
      [](double seconds) -> std::optional<py::bytes> {
        std::optional<std::string> line;
        {
          const py::gil_scoped_release released;
          line = next_line(seconds);
        }
        return line ? std::optional<py::bytes>(*line) : std::nullopt;
      },
      py::arg("seconds"));
  module.def("process_runs", &process_runs, py::arg("id"));
  py::class_<HeldInside>(module, "EndHeld")
      .def(py::init<>())
      .def("__enter__", [](HeldInside& held) { held.now = std::make_unique<EndHeld>(); })
      .def("__exit__", [](HeldInside& held, const py::args&) { held.now.reset(); });
  py::class_<TemporaryFile>(module, "TemporaryFile")
      .def(py::init<const std::string&>(), py::arg("path"))
      .def("keep_as", &TemporaryFile::keep_as, py::arg("path"));
  module.def(
      "random_uniform",
      [](std::uint64_t seed, std::int64_t a, std::int64_t b, std::int64_t c) { return random_uniform(seed, {a, b, c}); },
      py::arg("seed"), py::arg("a") = 0, py::arg("b") = 0, py::arg("c") = 0);
  module.def(
      "random_gaussian",
      [](std::uint64_t seed, std::int64_t a, std::int64_t b, std::int64_t c) {
        return random_gaussian(seed, {a, b, c});
      },
      py::arg("seed"), py::arg("a") = 0, py::arg("b") = 0, py::arg("c") = 0);
}

}  // namespace stillwater
