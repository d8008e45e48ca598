#pragma once

#include "core/image.h"

namespace stillwater {

/// The front laid over the back, both premultiplied and of one size (Porter and Duff 1984). Throws BadInput where
/// sizes differ.
Rgba over(const Rgba& front, const Rgba& back);

}  // namespace stillwater
