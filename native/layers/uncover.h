#pragma once

#include <variant>
#include <vector>

#include "layers/inpainting/inpaint.h"

/// What lies behind a layer that is taken off a picture.
namespace stillwater {

enum class Fill {
  push_pull,  ///< smoothly, from what surrounds the hole at 3 px or more (nearer lies the fringe of what was cut out)
  none,       ///< transparent behind what the layer covers wholly
};

/// A place that is filled once more, with another search.
struct TouchUp {
  Plane region;                  ///< 0..1, picture's size; filled where it is at least one half and the layer was
  std::optional<double> radius;  ///< how far a patch may come from, px; none = from anywhere
  std::uint64_t seed = 1;
};

/// From patches of what is left of the picture: inpaint().
struct ExemplarFill {
  InpaintParameters search;
  std::vector<TouchUp> touch_ups;  ///< one after the other
};

/// How a hole is filled; an Rgba is a painted background of the picture's size.
using Filling = std::variant<Fill, ExemplarFill, Rgba>;

/// The colours of a layer, and of what lies behind it.
struct Uncovered {
  Rgba front, back;  ///< opaque, box.height x box.width
  cv::Rect box;      ///< picture pixels: where the matte is above 0, and what surrounds that
};

/// Takes a layer's colours apart from those behind it.
///
/// - The front's colours are what foreground_and_background() says. Behind something solid (covered more than half
///   somewhere), as far as it covers more than a tenth and 3 px around (there lies the fringe of what was cut out),
///   `filling` paints; behind a veil, and with Fill::none, lies what foreground_and_background() sees through it. A painted
///   background holds everywhere. The picture itself is not changed where the matte is 0.
/// - What then does not fit is borne by the front as far as it is hardly seen there (0.06 of colour times coverage): a
///   matte that is a little wide leaves no outline behind, and one that is right no halo.
/// - Laid over each other they give the picture: what is still missing, r = P - aF - (1-a)B, is split between them,
///   F += a r / (a^2 + (1-a)^2), B += (1-a) r / (a^2 + (1-a)^2).
/// - Patches come from what no layer hides or has hidden, as long as there is any; a patch is never larger than
///   the picture, and where not even 3 px fit, or no whole patch is seen of a background at all, the filling is smooth.
///
/// `left`: opaque, what is left of the picture. `matte`, `hidden`: its size, 0..1; the matte is somewhere above 0.
/// Throws BadInput where a size differs and as inpaint() does; Cancelled.
Uncovered uncover(const Rgba& left, const Plane& matte, const Plane& hidden, const Filling& filling, Progress progress = {});

}  // namespace stillwater
