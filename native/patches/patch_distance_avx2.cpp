#include "patches/patch_distance_avx2.h"

#include <immintrin.h>
#include <stdint.h>

namespace {

inline __m256i squares(__m256i a, __m256i b) {
  const __m256i apart = _mm256_or_si256(_mm256_subs_epu8(a, b), _mm256_subs_epu8(b, a)), zero = _mm256_setzero_si256();
  const __m256i low = _mm256_unpacklo_epi8(apart, zero), high = _mm256_unpackhi_epi8(apart, zero);
  return _mm256_add_epi32(_mm256_madd_epi16(low, low), _mm256_madd_epi16(high, high));
}

inline __m256i bytes(const unsigned char* from) { return _mm256_loadu_si256((const __m256i*)from); }

inline int total(__m256i sums) {
  const __m128i half = _mm_add_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
  const __m128i pair = _mm_add_epi32(half, _mm_shuffle_epi32(half, 0x4e));
  return _mm_cvtsi128_si32(_mm_add_epi32(pair, _mm_shuffle_epi32(pair, 0xb1)));
}

// All but the first `count` of 32 bytes are dropped.
inline __m256i first_bytes(int count) {
  static const unsigned char kept[64] = {255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255,
                                         255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255,
                                         255, 255, 255, 255, 255, 255, 255, 255, 255, 255};
  return bytes(kept + 32 - count);
}

const int rows_between_looks = 3;

}  // namespace

int stillwater_patch_distance_avx2(const unsigned char* target, ptrdiff_t target_stride, const unsigned char* source,
                                   ptrdiff_t source_stride, int patch, int limit) {
  const int whole = 4 * patch / 32 * 32, rest = 4 * patch - whole;
  const __m256i tail = first_bytes(rest);
  __m256i sums = _mm256_setzero_si256();
  for (int row = 0; row < patch; ++row, target += target_stride, source += source_stride) {
    for (int i = 0; i < whole; i += 32) sums = _mm256_add_epi32(sums, squares(bytes(target + i), bytes(source + i)));
    if (rest) {
      const __m256i a = _mm256_and_si256(bytes(target + whole), tail),
                    b = _mm256_and_si256(bytes(source + whole), tail);
      sums = _mm256_add_epi32(sums, squares(a, b));
    }
    if (row % rows_between_looks == rows_between_looks - 1) {
      const int so_far = total(sums);
      if (so_far >= limit) return so_far;
    }
  }
  return total(sums);
}
