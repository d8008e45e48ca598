#pragma once

#include <string>

#include "core/image.h"

/// Flow fields in files, px per frame, x right, y down; the extension says how:
///
/// - .flo, of the Middlebury benchmark (Baker et al. 2011): "PIEH", width, height as 32-bit integers, then x and y as floats,
///   pixel by pixel, all little-endian. A number above 1e9 there means "unknown", and counts as 0.
/// - .exr: the channels X and Y, floats; or the first layer's NAME.X and NAME.Y (the frames of the render loop have
///   Stillwater.Flow.X and .Y). Other channels are ignored.
namespace stillwater {

/// Throws FileError for a file that is missing, a folder, empty, no flow, or cut short; BadInput for another extension, an EXR
/// file without such channels, more than largest_side pixels a side, and a number that is not finite.
Field read_flow(const std::string& path);

/// Written under a temporary name beside `path` and renamed. Throws BadInput for another extension, FileError where the file
/// can't be written.
void write_flow(const std::string& path, const Field& flow);

}  // namespace stillwater
