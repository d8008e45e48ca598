#include "picture/flow_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "core/process.h"
#include "picture/channels.h"
#include "picture/open_picture.h"
#include "picture/picture_file.h"

namespace stillwater {
namespace {

constexpr char flo_mark[4] = {'P', 'I', 'E', 'H'};
constexpr float unknown = 1e9f;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

bool is_flo(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".flo") return true;
  if (extension == ".exr") return false;
  throw BadInput(path + ": its extension is not .flo or .exr");
}

void require_finite(const std::string& path, const Field& flow) {
  for (int y = 0; y < flow.rows; ++y)
    for (int x = 0; x < flow.cols; ++x)
      if (!std::isfinite(flow(y, x)[0]) || !std::isfinite(flow(y, x)[1]))
        throw BadInput(path + ": pixel [" + std::to_string(y) + ", " + std::to_string(x) + "] is not finite numbers");
}

Field read_flo(const std::string& path) {
  require_readable_file(path);
  const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  char mark[4];
  std::int32_t size[2];
  if (!file || std::fread(mark, 1, 4, file.get()) != 4 || std::memcmp(mark, flo_mark, 4) != 0)
    throw FileError(path + ": is not a flow file (it does not begin with PIEH)");
  if (std::fread(size, 4, 2, file.get()) != 2) throw FileError(path + ": is cut short or damaged");
  check::size(path, size[0], size[1]);
  const auto bytes = static_cast<std::uintmax_t>(size[0]) * size[1] * sizeof(cv::Vec2f) + 12;
  if (std::filesystem::file_size(path) < bytes) throw FileError(path + ": is cut short or damaged");
  Field flow(size[1], size[0]);
  if (std::fread(flow.data, sizeof(cv::Vec2f), flow.total(), file.get()) != flow.total())
    throw FileError(path + ": is cut short or damaged");
  for (cv::Vec2f& v : flow)
    if (std::abs(v[0]) > unknown || std::abs(v[1]) > unknown) v = {};
  return flow;
}

/// The prefix before X and Y: none, or the first layer's that has both.
std::string flow_layer(const std::string& path, const std::vector<std::string>& names) {
  const auto has = [&](const std::string& layer) {
    return channel_named(names, layer + "X") >= 0 && channel_named(names, layer + "Y") >= 0;
  };
  if (has("")) return "";
  std::string listed;
  for (const std::string& name : names) {
    const auto dot = name.rfind('.');
    if (dot != std::string::npos && has(name.substr(0, dot + 1))) return name.substr(0, dot + 1);
    listed += (listed.empty() ? "" : ", ") + name;
  }
  throw BadInput(path + ": its channels (" + listed + ") are not X and Y");
}

Field read_exr(const std::string& path) {
  OpenPicture file = open_picture(path);
  const std::string layer = flow_layer(path, file.spec.channelnames);
  Plane parts[2];
  for (int c = 0; c < 2; ++c) {
    const int channel = channel_named(file.spec.channelnames, layer + "XY"[c]);
    const Plane data = stored_channels(file, channel, channel + 1, OIIO::TypeFloat);
    parts[c] = Plane::zeros(file.size);
    const cv::Rect window = cv::Rect(file.data, data.size()) & cv::Rect({0, 0}, file.size);
    if (!window.empty()) data(window - file.data).copyTo(parts[c](window));
  }
  Field flow;
  cv::merge(parts, 2, flow);
  return flow;
}

void write_flo(const std::string& path, const Field& flow) {
  const auto refuse = [&] { fail(path, "cannot be written", std::generic_category().message(errno)); };
  const std::string temporary = temporary_name(path);
  TemporaryFile keeper(temporary);
  File file(std::fopen(temporary.c_str(), "wb"), &std::fclose);
  if (!file) refuse();
  const std::int32_t size[2] = {flow.cols, flow.rows};
  bool good = std::fwrite(flo_mark, 1, 4, file.get()) == 4 && std::fwrite(size, 4, 2, file.get()) == 2;
  for (int y = 0; y < flow.rows && good; ++y)
    good = std::fwrite(flow[y], sizeof(cv::Vec2f), flow.cols, file.get()) == static_cast<std::size_t>(flow.cols);
  if (!good || std::fclose(file.release()) != 0) refuse();
  keeper.keep_as(path);
}

void write_exr(const std::string& path, const Field& flow) {
  OIIO::ImageSpec spec(flow.cols, flow.rows, 2, OIIO::TypeFloat);
  spec.channelnames = {"X", "Y"};
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // else the time of writing: never the same bytes
  PictureFile file(path, "exr", spec);
  const Field whole = flow.isContinuous() ? flow : flow.clone();
  file.write([&](OIIO::ImageOutput& output) { return output.write_image(OIIO::TypeFloat, whole.data); });
  file.finish();
}

}  // namespace

Field read_flow(const std::string& path) {
  const Field flow = is_flo(path) ? read_flo(path) : read_exr(path);
  require_finite(path, flow);
  return flow;
}

void write_flow(const std::string& path, const Field& flow) {
  check::not_empty("flow", flow);
  check::size("flow", flow.cols, flow.rows);
  if (is_flo(path)) return write_flo(path, flow);
  write_exr(path, flow);
}

}  // namespace stillwater
