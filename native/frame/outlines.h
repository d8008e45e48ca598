#pragma once

#include <memory>
#include <vector>

#include "core/image.h"

namespace stillwater {

using Bytes = cv::Mat_<unsigned char>;

/// The outlines of a layer, moment after moment, as they were followed before (flow/moving_outline.h): coverage of the
/// plate's pixels, 0..255. Views of memory that is kept.
struct Outlines {
  std::vector<Bytes> coverage;
  std::vector<std::shared_ptr<const void>> memory;

  bool empty() const { return coverage.empty(); }
};

}  // namespace stillwater
