#pragma once

#include <cstdint>
#include <optional>

#include "core/image.h"
#include "core/progress.h"
#include "layers/inpainting/blend_seams.h"

namespace stillwater {

struct InpaintParameters {
  int patch = 9;                 ///< pixels a side, odd, 3 .. 63
  std::optional<double> radius;  ///< how far a patch may come from, pixels; none = from anywhere
  std::uint64_t seed = 0;
  int grow = 2;  ///< pixels; patches come from no nearer to the hole's edge than this
  /// 0..1, patches come from where it is at least one half; none = from the whole picture.
  std::optional<Plane> source = std::nullopt;
  /// How seams are blended; without, every pixel of the hole is a copy of one of the source.
  std::optional<BlendParameters> blend = BlendParameters();
};

/// Fills a hole with what the rest of the picture is made of.
///
/// Coarse to fine. On the coarsest level structure comes first: patches are copied in the order of Criminisi's
/// priority (FillFront). Then on each level the filling is improved in a few rounds of search and vote
/// (patch_match(), vote()); on the finest it becomes a shift map (every pixel a copy, seams where they are seen
/// least), and what differs along the seams is spread by a Poisson equation.
///
/// `picture`: premultiplied. `hole` (of its size, 0..1): filled where it is at least one half; what the picture holds
/// there is not read. All other pixels come back as they are. A hole without pixels gives the picture.
///
/// Throws BadInput where sizes differ, a parameter is out of its range, a number is not finite, the hole covers
/// everything, the patch is larger than the picture, or nothing can be copied from (within `radius`); Cancelled where
/// `progress` says so.
///
/// Criminisi, Perez, Toyama 2003, "Object removal by exemplar-based inpainting"; Wexler, Shechtman, Irani 2007,
/// "Space-time completion of video"; Barnes et al. 2009, "PatchMatch"; Pritch, Kav-Venaki, Peleg 2009, "Shift-map
/// image editing"; Perez, Gangnet, Blake 2003, "Poisson image editing".
Rgba inpaint(const Rgba& picture, const Plane& hole, const InpaintParameters& parameters = {}, Progress progress = {});

}  // namespace stillwater
