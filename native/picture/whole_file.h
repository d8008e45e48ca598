#pragma once

#include <string>

/// Files that were cut short, where the library behind OpenImageIO fills what is missing and says nothing.
namespace stillwater {

/// True where a JPEG file has an "end of image" marker (FFD9) after its first scan begins (ITU T.81, B.1.1.3).
bool is_whole_jpeg(const std::string& path);

/// True where every strip or tile of a TIFF file's first picture ends within the file (TIFF 6.0, section 2; BigTIFF
/// too).
bool is_whole_tiff(const std::string& path);

}  // namespace stillwater
