#pragma once

#include <OpenImageIO/imageio.h>

#include <functional>
#include <memory>
#include <string>

namespace stillwater {

/// A picture's file that is being written, under a temporary name (core/process.h): it comes to its own name whole or
/// not at all, and leaves nothing behind. Every byte goes through a check of its own, because some of OpenImageIO's
/// formats do not notice a full disk.
class PictureFile {
 public:
  /// `format` "exr", "png", ... Throws FileError where the file can't be made.
  PictureFile(const std::string& path, const std::string& format, const OIIO::ImageSpec& spec);
  ~PictureFile();
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;

  /// Calls one of OpenImageIO's functions, which answers false where it fails. Throws FileError then.
  void write(const std::function<bool(OIIO::ImageOutput&)>& call);

  /// Ends the file and gives it its name. Throws FileError.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stillwater
