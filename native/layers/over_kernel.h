#pragma once

#include <string.h>

/// `over`, seen from the front: a run of a layer's pixels goes under what is composed so far.

/// A run of pixels as far as they are composed. Up to three places behind its end are read, and written as they are;
/// not those of `combined` and `needed`.
struct StillwaterComposedRun {
  float* combined;        // premultiplied rgba
  float* through;         // share of what lies behind that is still seen
  float* moving;          // share that comes from layers that move; null: this and the two below are not asked for
  float* most;            // largest contribution so far
  int* owner;             // the layer at which coverage from the front reached one half, until then that of `most`
  unsigned char* needed;  // 0 where less than 1/10000 of what lies behind would be seen
};

typedef float stillwater_four __attribute__((vector_size(16), aligned(4)));
typedef int stillwater_lanes __attribute__((vector_size(16), aligned(4)));  // as a mask: all bits of a lane, or none

static inline int stillwater_any(stillwater_lanes mask) {
  long long half[2];
  memcpy(half, &mask, sizeof half);
  return (half[0] | half[1]) != 0;
}

static inline int stillwater_all(stillwater_lanes mask) {
  long long half[2];
  memcpy(half, &mask, sizeof half);
  return (half[0] & half[1]) == -1;
}

static inline stillwater_four stillwater_coverage(const float* colour) {
  const stillwater_four coverage = {colour[3], colour[7], colour[11], colour[15]};
  return coverage;
}

/// Four pixels, wholly covered, of which nothing is composed so far.
static inline void stillwater_cover_four(const float* colour, stillwater_four coverage, float moves, int index, int i,
                                         const StillwaterComposedRun& run) {
  const stillwater_four one = {1, 1, 1, 1};
  memcpy(run.combined + 4 * i, colour, 16 * sizeof *colour);
  memset(run.needed + i, 0, 4);
  *(stillwater_four*)(run.through + i) = one - coverage;
  if (!run.moving) return;
  *(stillwater_four*)(run.moving + i) = moves * coverage;
  *(stillwater_four*)(run.most + i) = coverage;
  *(stillwater_lanes*)(run.owner + i) = (stillwater_lanes){0, 0, 0, 0} + index;
}

/// `drawn` (premultiplied rgba, `count` pixels, three more may be read) goes under the run. Pixels that are not needed
/// are passed by. The layer `index` becomes the owner of a pixel whose coverage from the front it brings to one half;
/// until then the layer that contributes most owns it. Answers how many pixels are needed no more.
static inline int stillwater_lay_under(const float* drawn, float opacity, float moves, int index, int count,
                                       const StillwaterComposedRun& run) {
  const stillwater_lanes lane = {0, 1, 2, 3};
  const stillwater_four none = {0, 0, 0, 0};
  const float closed_below = 1e-4f;
  int closed = 0;
  for (int i = 0; i < count; i += 4) {
    stillwater_four& through = *(stillwater_four*)(run.through + i);
    const stillwater_four behind = through;
    const float* colour = drawn + 4 * i;
    const stillwater_four coverage = stillwater_coverage(colour);
    if (!stillwater_any(coverage > 0.0f)) continue;
    if (count - i >= 4 && opacity == 1.0f &&
        stillwater_all((behind == 1.0f) & (behind - coverage <= closed_below))) {
      stillwater_cover_four(colour, coverage, moves, index, i, run);
      closed += 4;
      continue;
    }
    const stillwater_lanes open = (behind > closed_below) & (lane < count - i);
    const stillwater_four share = behind * opacity, covered = share * coverage;
    const stillwater_lanes seen = open & (covered > 0.0f);
    if (!stillwater_any(seen)) continue;
    float* combined = run.combined + 4 * i;
    for (int k = 0; k < 4; ++k)
      if (seen[k]) *(stillwater_four*)(combined + 4 * k) += share[k] * *(const stillwater_four*)(colour + 4 * k);

    const stillwater_four contribution = seen ? covered : none;
    const stillwater_four left = behind - contribution;
    through = left;
    if (run.moving) {
      stillwater_four& most = *(stillwater_four*)(run.most + i);
      stillwater_lanes& owner = *(stillwater_lanes*)(run.owner + i);
      const stillwater_lanes owns = seen & (behind > 0.5f) & ((left <= 0.5f) | (contribution > most));
      *(stillwater_four*)(run.moving + i) += moves * contribution;
      most = owns ? contribution : most;
      owner = owns ? lane - lane + index : owner;
    }
    const stillwater_lanes done = open & (left <= closed_below);
    if (!stillwater_any(done)) continue;
    for (int k = 0; k < 4; ++k)
      if (done[k]) run.needed[i + k] = 0, ++closed;
  }
  return closed;
}
