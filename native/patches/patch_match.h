#pragma once

#include <cstdint>
#include <functional>

#include "patches/match_field.h"

namespace stillwater {

struct PatchSearch {
  int patch = 9;       ///< odd, pixels a side
  int rounds = 4;      ///< each passes over all patches once, forwards and backwards in turn
  double radius = 0;   ///< how far a match may lie from its patch, pixels; 0 = anywhere
  double nearest = 0;  ///< how far it must lie at least: an image is not matched with itself in place
  std::uint64_t seed = 0;
};

/// Finds better matches for all patches of `field` (whose offsets are where the search begins): each tries what its
/// neighbours found, then random places ever closer to its best.
///
/// Barnes, Shechtman, Finkelstein, Goldman 2009, "PatchMatch", 3.1 - 3.2. In-place as there, but within tiles of fixed
/// size that read each other's last round: the same field for any number of threads. The first of equally good places
/// in the order tried wins.
///
/// `target`, `source`: images; all wanted patches lie inside the target. `source_centres` (of the source's size): where
/// matches may be. A patch whose offset leads elsewhere begins at a place by chance; it stays unmatched only where none
/// is near enough. No distance is above the one that the field's offsets had.
///
/// `at`: is called with 0..1 by the calling thread, again and again; what it throws ends the search.
void patch_match(const PatchImage& target, const PatchImage& source, const Mask& source_centres, MatchField& field,
                 const PatchSearch& search, const std::function<void(double)>& at = {});

}  // namespace stillwater
