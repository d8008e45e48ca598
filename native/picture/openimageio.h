#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

/// What reading and writing share: opening files, and sentences from what OpenImageIO has to say.
namespace stillwater {

/// Lets OpenImageIO and OpenEXR use as many threads as the engine does.
void give_threads_to_openimageio();

/// Throws FileError where there is no such file, it is a folder, holds nothing or may not be read.
void require_readable_file(const std::string& path);

/// Opens a picture or clip, header only. Alpha is left as the file has it ("oiio:UnassociatedAlpha" tells which).
/// Throws FileError where there is no such file, it is a folder, holds nothing, may not be read, or where nothing
/// that OpenImageIO knows fits it.
std::unique_ptr<OIIO::ImageInput> open_file(const std::string& path);

/// "PATH: SENTENCE (REASON)", reason being what OpenImageIO says, in one line.
[[noreturn]] void fail(const std::string& path, const std::string& sentence, const std::string& reason);

}  // namespace stillwater
