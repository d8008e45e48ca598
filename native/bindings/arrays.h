#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/image.h"

/// numpy <-> image types. Arrays are C-contiguous float32 (labels: int32) H x W x C; pybind11 converts what is not.
namespace stillwater {

namespace py = pybind11;
using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// A view of the array's memory, which must outlive it. Throws BadInput where the array is not H x W x channels
/// (or H x W where there is one channel), or empty.
template <class Pixel>
cv::Mat_<Pixel> as_image(const FloatArray& array, const std::string& name) {
  constexpr int channels = cv::DataType<Pixel>::channels;
  const bool fits = (channels == 1 && array.ndim() == 2) || (array.ndim() == 3 && array.shape(2) == channels);
  if (!fits || array.size() == 0) {
    std::string given;
    for (py::ssize_t i = 0; i < array.ndim(); ++i) given += (i ? " x " : "") + std::to_string(array.shape(i));
    throw BadInput(name + ": an array of " + (given.empty() ? "one number" : given) + " is not height x width" +
                   (channels > 1 ? " x " + std::to_string(channels) : ""));
  }
  return cv::Mat_<Pixel>(static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)),
                         reinterpret_cast<Pixel*>(const_cast<float*>(array.data())));
}

/// An array that shares the image's memory and keeps it alive.
template <class Pixel>
py::array_t<typename cv::DataType<Pixel>::channel_type> as_array(const cv::Mat_<Pixel>& image) {
  using Number = typename cv::DataType<Pixel>::channel_type;
  constexpr py::ssize_t channels = cv::DataType<Pixel>::channels;
  auto* kept = new cv::Mat(image.isContinuous() ? image : image.clone());
  const py::capsule owner(kept, [](void* p) { delete static_cast<cv::Mat*>(p); });
  std::vector<py::ssize_t> shape{kept->rows, kept->cols};
  if (channels > 1) shape.push_back(channels);
  return py::array_t<Number>(shape, reinterpret_cast<const Number*>(kept->data), owner);
}

/// Keeps the array's memory; may be let go by any thread.
inline std::shared_ptr<const void> kept_alive(const py::array& array) {
  return {new py::array(array), [](py::array* kept) {
            const py::gil_scoped_acquire gil;
            delete kept;
          }};
}

}  // namespace stillwater
