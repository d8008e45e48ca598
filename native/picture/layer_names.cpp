#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "picture/write_frame.h"

namespace stillwater {
namespace {

constexpr std::size_t longest_name = 63;  // bytes

std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f && c != '.' && c != '%') {
      text += c;
      continue;
    }
    char code[4];
    std::snprintf(code, sizeof code, "%%%02X", byte);
    text += code;
  }
  return text;
}

/// At most so many bytes, and no part of a UTF-8 character at the end.
std::string cut(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xc0) == 0x80) --bytes;
  return text.substr(0, bytes);
}

}  // namespace

std::vector<std::string> layer_names(const std::vector<std::string>& names) {
  std::vector<std::string> given{"Stillwater"};
  for (const std::string& name : names) {
    if (name.empty()) throw BadInput("layers: an empty name is not a layer's name");
    const std::string whole = escaped(name);
    std::string candidate = cut(whole, longest_name);
    for (int copy = 2; std::find(given.begin(), given.end(), candidate) != given.end(); ++copy) {
      const std::string tail = std::to_string(copy).insert(0, 1, '~');
      candidate = cut(whole, longest_name - tail.size()) + tail;
    }
    given.push_back(candidate);
  }
  given.erase(given.begin());
  return given;
}

}  // namespace stillwater
