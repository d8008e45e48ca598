#include "picture/openimageio.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
// Finds out what OpenImageIO would not say clearly.
void require_readable_file(const std::string& path) {
  std::error_code failure;
  const auto status = std::filesystem::status(path, failure);
  if (status.type() == std::filesystem::file_type::not_found) throw FileError(path + ": there is no such file");
  if (failure) throw FileError(path + ": cannot be read (" + failure.message() + ")");
  if (std::filesystem::is_directory(status)) throw FileError(path + ": is a folder, not a file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw FileError(path + ": cannot be read (" + std::generic_category().message(errno) + ")");
  if (std::fgetc(file.get()) == EOF) throw FileError(path + ": the file is empty");
}

void give_threads_to_openimageio() {
  OIIO::attribute("threads", threads());
  OIIO::attribute("exr_threads", threads());
}

std::unique_ptr<OIIO::ImageInput> open_file(const std::string& path) {
  require_readable_file(path);
  give_threads_to_openimageio();
  OIIO::ImageSpec hints;
  hints["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::open(path, &hints);
  if (input) return input;
  const std::string reason = OIIO::geterror();
  const bool no_format_fits = reason.find("could not find a format reader") != std::string::npos;
  fail(path, "is not a picture or clip that can be read", no_format_fits ? "" : reason);
}

void fail(const std::string& path, const std::string& sentence, const std::string& reason) {
  std::string line;
  for (const char c : reason) {
    if (c != '\n' && c != '\r')
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  throw FileError(path + ": " + sentence + (line.empty() ? "" : " (" + line + ")"));
}

}  // namespace stillwater
