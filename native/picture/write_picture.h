#pragma once

#include <string>

#include "core/image.h"

namespace stillwater {

/// Writes a picture; the file's extension says how: .png, .jpg/.jpeg, .tif/.tiff, .exr. PNG, JPEG and TIFF are
/// display-referred, clamped to 0..1, with straight alpha where alpha is below 1 somewhere (JPEG has none: the picture
/// lies over black); OpenEXR is scene-linear Rec.709, premultiplied, always with alpha.
///
/// `image`: premultiplied, display-referred. `bits` of a channel: PNG 8 or 16, JPEG 8, TIFF 8, 16 or 32 (float),
/// OpenEXR 16 (half) or 32 (float); 0 = the first of these. Written under a temporary name beside `path` and renamed.
/// Throws BadInput for another extension or number of bits, FileError where the file can't be written.
void write_picture(const std::string& path, const Rgba& image, int bits = 0);

}  // namespace stillwater
