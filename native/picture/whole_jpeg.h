#pragma once

#include <string>

namespace stillwater {

/// JPEG libraries fill what is missing of a file that was cut short with grey and say nothing that OpenImageIO
/// passes on. A whole file has an "end of image" marker (FFD9) after its first scan begins (ITU T.81, B.1.1.3).
/// Throws FileError where it doesn't.
void require_whole_jpeg(const std::string& path);

}  // namespace stillwater
