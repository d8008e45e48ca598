#pragma once

#include <cstdint>

#include "core/image.h"

/// The one wind of a picture, and what it does to one element (METHODS.md 1; Chuang et al. 2005, 3.2).
namespace stillwater {

/// The recipe's `wind`, with its animated numbers resolved for one moment.
struct Wind {
  double speed = 5;         ///< m/s, 0 .. 40
  double direction = 0;     ///< degrees, where it blows to over the ground: 0 = picture's right, 90 = away from the viewer
  double gusts = 0;         ///< 0 .. 1, share of the speed that comes as moving gusts
  double gust_size = 0.25;  ///< of the picture's width
  std::uint64_t seed = 0;

  /// Resolved from speed and direction: how far the gusts have travelled over the ground since frame 1, in metres (right, away).
  Point travel;
};

/// A moment of the timeline. Numbers of one frame, the same for all layers.
struct Moment {
  double frame = 1;        ///< may be fractional
  double fps = 24;
  int loop_frames = 0;     ///< period of the loop in frames, 0 = no loop
  int first_frame = 1;     ///< of the recipe's range: where the loop starts
  Wind wind;
  Point loop_travel;       ///< wind.travel gained over one loop (looping only)

  double seconds() const { return (frame - 1) / fps; }
};

}  // namespace stillwater
