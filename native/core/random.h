#pragma once

#include <complex>
#include <cstdint>

/// Counter-based random numbers: a number is a pure function of a seed and a place (wave number, pixel, frame,
/// ...), never of what was drawn before. So any part can be computed alone, in any order, on any thread.
/// Source: Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3" (the idea); the mixing is
/// splitmix64's finaliser, applied once for each word of the place.
namespace stillwater {

struct Place {
  std::int64_t a = 0, b = 0, c = 0;
};

std::uint64_t random_bits(std::uint64_t seed, Place place);

/// In [0, 1), 53 bits.
double random_uniform(std::uint64_t seed, Place place);

/// Real and imaginary part independent, mean 0, variance 1 each (Box-Muller).
std::complex<double> random_gaussian(std::uint64_t seed, Place place);

}  // namespace stillwater
