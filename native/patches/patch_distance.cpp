#include "patches/patch_distance.h"

#include "core/cpu.h"
#include "patches/patch_distance_avx2.h"

namespace stillwater {
namespace {

int plain(const unsigned char* target, std::ptrdiff_t target_stride, const unsigned char* source,
          std::ptrdiff_t source_stride, int patch, int limit) {
  int sum = 0;
  for (int row = 0; row < patch && sum < limit; ++row, target += target_stride, source += source_stride)
    for (int i = 0; i < 4 * patch; ++i) {
      const int difference = target[i] - source[i];
      sum += difference * difference;
    }
  return sum;
}

}  // namespace

PatchDistance::PatchDistance(const PatchImage& target, const PatchImage& source, int patch)
    : target_(target),
      source_(source),
      half_(patch / 2),
      kernel_(has_avx2() ? stillwater_patch_distance_avx2 : plain) {}

}  // namespace stillwater
