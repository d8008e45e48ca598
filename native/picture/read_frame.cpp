#include "picture/read_frame.h"

#include "core/error.h"
#include "core/parallel.h"
#include "picture/channels.h"
#include "picture/colour.h"
#include "picture/open_picture.h"

namespace stillwater {

Rgba read_frame(const std::string& path) {
  OpenPicture file = open_picture(path);
  Rgba image(file.spec.height, file.spec.width);
  const char* names[] = {"R", "G", "B", "A"};
  for (int c = 0; c < 4; ++c) {
    const int index = channel_named(file.spec.channelnames, std::string("Stillwater.Combined.") + names[c]);
    if (index < 0) throw BadInput(path + ": is not a frame (it has no Stillwater.Combined)");
    const cv::Mat_<float> channel = float_channels(file, index, index + 1);
    auto from = channel.begin();
    for (cv::Vec4f& pixel : image) pixel[c] = *from++;
  }
  parallel_rows(image.rows, 16, [&](int first, int last) {
    for (int y = first; y < last; ++y) scene_to_display(image[y]->val, image[y]->val, image.cols);
  });
  return image;
}

}  // namespace stillwater
