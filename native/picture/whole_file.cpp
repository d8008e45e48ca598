#include "picture/whole_file.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

namespace stillwater {
namespace {

std::vector<unsigned char> bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  std::vector<unsigned char> bytes(static_cast<std::size_t>(std::max<std::streamoff>(0, stream.tellg())));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

/// Where the entropy-coded data begin: after the segments, each of which holds its own length (ITU T.81, B.1.1.4).
/// So markers within an embedded thumbnail are stepped over. The file's size where there is no scan.
std::size_t first_scan(const std::vector<unsigned char>& file) {
  std::size_t at = 2;
  while (at + 4 <= file.size() && file[at] == 0xff) {
    const unsigned char marker = file[at + 1];
    if (marker == 0xda) return at;
    at += marker == 0xff ? 1 : 2 + (file[at + 2] << 8 | file[at + 3]);  // FF FF: a fill byte
  }
  return file.size();
}

/// Numbers of a TIFF file in its own byte order; throws nothing, gives 0 beyond the end.
class TiffBytes {
 public:
  explicit TiffBytes(std::vector<unsigned char> bytes) : bytes_(std::move(bytes)) {
    big_endian_ = number(0, 1) == 'M';
    big_ = number(2, 2) == 43;
  }

  std::uint64_t size() const { return bytes_.size(); }
  bool is_big() const { return big_; }

  std::uint64_t number(std::uint64_t at, int bytes) const {
    if (at > size() || size() - at < static_cast<std::uint64_t>(bytes)) return 0;
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | bytes_[at + (big_endian_ ? i : bytes - 1 - i)];
    return value;
  }

  /// All values of an entry of the directory (section 2: tag, type, count, value or where the values stand).
  std::vector<std::uint64_t> values(std::uint64_t entry) const {
    const int word = big_ ? 8 : 4;
    const std::uint64_t type = number(entry + 2, 2), count = std::min(number(entry + 4, word), size());
    const int bytes = type == 3 ? 2 : (type == 16 ? 8 : 4);
    const std::uint64_t slot = entry + 4 + word;
    const std::uint64_t from = count * bytes <= static_cast<std::uint64_t>(word) ? slot : number(slot, word);
    std::vector<std::uint64_t> list;
    for (std::uint64_t i = 0; i < count; ++i) list.push_back(number(from + i * bytes, bytes));
    return list;
  }

 private:
  std::vector<unsigned char> bytes_;
  bool big_endian_ = false, big_ = false;
};

}  // namespace

bool is_whole_jpeg(const std::string& path) {
  const std::vector<unsigned char> file = bytes_of(path);
  const unsigned char end_of_image[] = {0xff, 0xd9};
  const auto scan = file.begin() + static_cast<std::ptrdiff_t>(std::min(first_scan(file), file.size()));
  return std::search(scan, file.end(), std::begin(end_of_image), std::end(end_of_image)) != file.end();
}

bool is_whole_tiff(const std::string& path) {
  const TiffBytes file(bytes_of(path));
  const int word = file.is_big() ? 8 : 4, entry_bytes = file.is_big() ? 20 : 12, count_bytes = file.is_big() ? 8 : 2;
  const std::uint64_t directory = file.number(file.is_big() ? 8 : 4, word);
  const std::uint64_t entries = std::min(file.number(directory, count_bytes), file.size());
  std::vector<std::uint64_t> offsets, lengths;
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::uint64_t entry = directory + count_bytes + i * entry_bytes, tag = file.number(entry, 2);
    if (tag == 273 || tag == 324) offsets = file.values(entry);  // StripOffsets, TileOffsets
    if (tag == 279 || tag == 325) lengths = file.values(entry);  // StripByteCounts, TileByteCounts
  }
  for (std::size_t i = 0; i < std::min(offsets.size(), lengths.size()); ++i)
    if (offsets[i] > file.size() || lengths[i] > file.size() - offsets[i]) return false;
  return true;
}

}  // namespace stillwater
