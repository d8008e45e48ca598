#include "picture/whole_jpeg.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/error.h"

namespace stillwater {
namespace {

/// Where the entropy-coded data begin: after the segments, each of which holds its own length (ITU T.81, B.1.1.4).
/// So markers within an embedded thumbnail are stepped over. The file's size where there is no scan.
std::size_t first_scan(const std::vector<unsigned char>& file) {
  std::size_t at = 2;
  while (at + 4 <= file.size()) {
    if (file[at] != 0xff) return file.size();
    const unsigned char marker = file[at + 1];
    if (marker == 0xff) {
      ++at;  // fill byte
      continue;
    }
    if (marker == 0xda) return at;
    at += 2 + (file[at + 2] << 8 | file[at + 3]);
  }
  return file.size();
}

}  // namespace

void require_whole_jpeg(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::vector<unsigned char> file{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const unsigned char end_of_image[] = {0xff, 0xd9};
  const auto scan = file.begin() + static_cast<std::ptrdiff_t>(first_scan(file));
  if (std::search(scan, file.end(), std::begin(end_of_image), std::end(end_of_image)) == file.end())
    throw FileError(path + ": is cut short or damaged (its end is missing)");
}

}  // namespace stillwater
