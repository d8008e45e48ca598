// The reference of picture.py: OpenImageIO is handed float arrays and writes them as a frame's channels.
//   openimageio_frame WIDTH HEIGHT FLOATS OUTPUT
// FLOATS: height x width x 12, scene-linear. Each line on standard input is one frame written; its seconds go out.
#include <OpenImageIO/imageio.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int, char** argv) {
  const int width = std::atoi(argv[1]), height = std::atoi(argv[2]);
  std::vector<float> pixels(static_cast<std::size_t>(width) * height * 12);
  std::FILE* file = std::fopen(argv[3], "rb");
  if (!file || std::fread(pixels.data(), sizeof(float), pixels.size(), file) != pixels.size()) return 1;
  std::fclose(file);

  OIIO::ImageSpec spec(width, height, 12, OIIO::TypeHalf);
  spec.channelnames = {"R", "G", "B", "A",
                       "Stillwater.Combined.R", "Stillwater.Combined.G", "Stillwater.Combined.B",
                       "Stillwater.Combined.A", "Stillwater.Flow.X",     "Stillwater.Flow.Y",
                       "Stillwater.Flow.Z",     "Stillwater.Matte.V"};
  const OIIO::TypeDesc half = OIIO::TypeHalf, whole = OIIO::TypeFloat;
  spec.channelformats = {half, half, half, half, half, half, half, half, whole, whole, whole, half};
  spec.attribute("compression", "zip");
  for (int c = std::getchar(); c != EOF; c = std::getchar()) {
    const auto start = std::chrono::steady_clock::now();
    const auto output = OIIO::ImageOutput::create("exr");
    if (!output->open(argv[4], spec) || !output->write_image(OIIO::TypeFloat, pixels.data()) || !output->close())
      return 1;
    std::printf("%f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    std::fflush(stdout);
  }
}
