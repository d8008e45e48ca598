#pragma once

/// `over`, seen from the front: `drawn` (premultiplied rgba, `count` pixels) goes under what is composed so far.
/// Pixels whose `needed` is 0 are passed by; it becomes 0 where less than 1/10000 of what lies behind would be seen.
/// The layer `index` becomes the owner of a pixel whose coverage from the front it brings to one half; until then
/// the layer that contributes most owns it. Answers how many pixels are needed no more.
static inline int stillwater_lay_under(const float* drawn, float opacity, float moves, int index, int count,
                                       float* combined, float* through, float* moving, float* most, int* owner,
                                       unsigned char* needed) {
  typedef float v4 __attribute__((vector_size(16), aligned(4)));
  int closed = 0;
  for (int i = 0; i < count; ++i) {
    if (!needed[i]) continue;
    const float behind = through[i], share = behind * opacity;
    const float contribution = share * drawn[4 * i + 3];
    if (contribution > 0) {
      *(v4*)(combined + 4 * i) += share * *(const v4*)(drawn + 4 * i);
      moving[i] += moves * contribution;
      if (behind > 0.5f && (behind - contribution <= 0.5f || contribution > most[i])) {
        most[i] = contribution;
        owner[i] = index;
      }
      through[i] = behind - contribution;
      needed[i] = through[i] > 1e-4f;
      closed += !needed[i];
    }
  }
  return closed;
}
