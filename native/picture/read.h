#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "picture/colour.h"

/// Still pictures, mattes and label maps in, through OpenImageIO: PNG, JPEG, TIFF, OpenEXR, PSD, Radiance HDR and
/// whatever else it knows. The picture of a file is its first one; of an OpenEXR file the whole display window,
/// transparent where there are no data. Orientations that a camera wrote (EXIF) are applied.
///
/// All functions throw FileError for a file that is missing, a folder, empty, not to be read, no picture, or cut
/// short, and BadInput for a picture of more than largest_side pixels a side, found in the header before any memory
/// is taken.
namespace stillwater {

/// What the file's header says, after the orientation is applied.
struct FileFacts {
  int width = 0, height = 0, channels = 0;
  std::string pixel_type;  ///< "uint8", "uint16", "half", "float", ...
  std::string format;      ///< "png", "openexr", ...
  std::vector<std::string> channel_names;
};

FileFacts inspect_picture(const std::string& path);

struct Picture {
  Rgba image;                ///< premultiplied, display-referred
  bool has_alpha = false;    ///< the file has alpha, and it is below 1 somewhere
  long long bad_pixels = 0;  ///< had a value that is not a finite number; their colour was set to 0
};

/// Grey, grey and alpha, RGB, RGBA; of named layers (OpenEXR) the one without a name, else the first. An 8- or
/// 16-bit value v comes as v/255, v/65535 exactly. A linear picture is un-premultiplied (where its file holds
/// premultiplied colours), goes through the sRGB curve, and is premultiplied again.
Picture read_picture(const std::string& path, ColourSpace colour_space = ColourSpace::automatic);

/// The channel of that name ("A", "R", "layer.A", capitals or not); without a name grey, or the Rec.709 luma of
/// the colours. "A" means grey too where the file has no alpha, or one that is 1 everywhere (a mask saved with an
/// opaque alpha). No colour curve; clamped to 0..1, not-a-number is 0. Throws BadInput where no channel has the name.
Plane read_matte(const std::string& path, const std::string& channel = "");

/// The numbers as they stand in the file: 8, 16 or 32 bit integers, or whole numbers in a float file. Throws BadInput
/// where a value is not a whole number from 0 to 2147483647, and for a coloured picture: what a palette's numbers
/// were is not known once it is read.
Labels read_labels(const std::string& path);

}  // namespace stillwater
