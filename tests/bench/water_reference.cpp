// The bare transform that the water's height field is measured against, in a process of its own: FFTW's complex to real
// plan of a square, FFTW_MEASURE, one thread. For each line of standard input: the seconds of one run.
//   water_reference SIDE
#include <fftw3.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

int main(int, char** arguments) {
  const int n = std::atoi(arguments[1]);
  fftwf_complex* spectrum = fftwf_alloc_complex(static_cast<size_t>(n) * (n / 2 + 1));
  float* tile = fftwf_alloc_real(static_cast<size_t>(n) * n);
  const fftwf_plan plan = fftwf_plan_dft_c2r_2d(n, n, spectrum, tile, FFTW_MEASURE);
  while (std::getchar() != EOF) {
    for (int i = 0; i < n * (n / 2 + 1); ++i) spectrum[i][0] = static_cast<float>(i % 7), spectrum[i][1] = static_cast<float>(i % 5);
    const auto start = std::chrono::steady_clock::now();
    fftwf_execute(plan);
    std::printf("%.9f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    std::fflush(stdout);
  }
}
