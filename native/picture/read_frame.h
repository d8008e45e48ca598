#pragma once

#include <string>

#include "core/image.h"

namespace stillwater {

/// The picture of a frame that write_frame() wrote (Stillwater.Combined), whatever layers stand beside it:
/// premultiplied, display-referred. Throws FileError where it can't be read, BadInput where it is no such frame.
Rgba read_frame(const std::string& path);

}  // namespace stillwater
