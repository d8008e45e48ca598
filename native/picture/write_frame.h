#pragma once

#include <string>
#include <vector>

#include "core/image.h"

/// A finished frame to one OpenEXR file, scene-linear Rec.709, premultiplied:
///
///     R/G/B/A                       half or float: the picture, for all that looks for plain channels (OpenCV, viewers)
///     Stillwater.Combined.R/G/B/A   the same again, as a pass of Blender's Image node
///     Stillwater.Flow.X/Y/Z         float, mantissa rounded to 12 bits; Z = 0: Blender 5.2 misreads two channels
///     Stillwater.Matte.V            half or float
///     NAME.Combined.R/G/B/A         half or float, each layer that is given: Blender shows a layer NAME, as of its own
///
/// The second copy costs few bytes under zip: it lies within deflate's window of the first.
/// The bytes depend on the arguments alone, not on the number of threads. A value beyond a half's largest (65504) is
/// written as that.
namespace stillwater {

struct NamedImage {
  std::string name;
  Rgba image;  ///< premultiplied, display-referred
};

struct FrameImages {
  Rgba combined;                   ///< premultiplied, display-referred
  Field flow;                      ///< output pixels to the next frame; empty: zeros
  Plane matte;                     ///< 0..1; empty: zeros
  std::vector<NamedImage> layers;  ///< of combined's size
};

struct FrameOptions {
  bool half = true;                 ///< else float: Combined, Matte and layers
  std::string compression = "zip";  ///< none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa, dwab
  std::string key;                  ///< kept in the file's metadata as "stillwater:key"
};

/// Writes beside `path` under core/process.h's temporary_name() and renames: no half-written file is ever seen under
/// `path`, and a failure leaves what was there. Throws BadInput for images of different sizes, an unknown compression
/// or a layer without a name, FileError where the file can't be written (folder not there or not writable, disk
/// full).
void write_frame(const std::string& path, const FrameImages& images, const FrameOptions& options = {});

/// The key of a frame on disk; empty where there is no such file, or none that has a key.
std::string read_frame_key(const std::string& path);

/// Names of layers as OpenEXR has them: "." (which would part it), "%" and control characters as %2E and the like;
/// cut at 63 bytes (Blender's limit), at a whole UTF-8 character; two that would be the same get ~2, ~3, ... at
/// their ends, and so does "Stillwater", whose layer is the whole frame. Throws BadInput where a name is empty.
std::vector<std::string> layer_names(const std::vector<std::string>& names);

}  // namespace stillwater
