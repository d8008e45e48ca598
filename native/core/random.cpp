#include "core/random.h"

#include <cmath>
#include <numbers>

namespace stillwater {
namespace {

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double to_unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

}  // namespace

std::uint64_t random_bits(std::uint64_t seed, Place place) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = mixed(seed + golden);
  for (const std::int64_t word : {place.a, place.b, place.c}) z = mixed((z ^ static_cast<std::uint64_t>(word)) + golden);
  return z;
}

double random_uniform(std::uint64_t seed, Place place) { return to_unit(random_bits(seed, place)); }

std::complex<double> random_gaussian(std::uint64_t seed, Place place) {
  const std::uint64_t first = random_bits(seed, place);
  const std::uint64_t second = mixed(first ^ 0xd1b54a32d192ed03ULL);
  const double radius = std::sqrt(-2.0 * std::log(1.0 - to_unit(first)));
  const double angle = 2.0 * std::numbers::pi * to_unit(second);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace stillwater
