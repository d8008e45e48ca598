#pragma once

#include "core/image.h"

namespace stillwater {

/// The layer's colours without its outline: where it covers half as much as anywhere or more, its
/// straight colour; beyond, what lies as far
/// inside of the nearest such place (so that texture goes on, mirrored at the outline), and where that is outside too,
/// colours that go on smoothly (push_pull()). Opaque everywhere.
///
/// `layer`: premultiplied. Throws BadInput where it covers nothing.
Rgba extend_colours(const Rgba& layer);

}  // namespace stillwater
