#include "picture/picture_file.h"

#include <OpenImageIO/filesystem.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/error.h"
#include "core/process.h"
#include "picture/openimageio.h"

namespace stillwater {
namespace {

/// What OpenImageIO writes to. Keeps the system's error number of the first thing that fails.
class CheckedFile : public OIIO::Filesystem::IOProxy {
 public:
  explicit CheckedFile(const std::string& path) : IOProxy(path, Write), file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) failure_ = errno;
  }
  ~CheckedFile() override { close(); }

  const char* proxytype() const override { return "stillwater"; }

  // Buffered bytes may fail wherever they leave the buffer: at a write, a seek or the end. tell() and flush() are the
  // base's, since OpenImageIO 2 and 3 declare them differently: tell() gives m_pos, flush() leaves all to the end.
  void close() override {
    if (file_) note(std::fclose(file_) == 0);
    file_ = nullptr;
  }

  bool seek(int64_t offset) override {
    if (!note(OIIO::Filesystem::fseek(file_, offset, SEEK_SET) == 0)) return false;
    m_pos = offset;
    return true;
  }

  /// For writing only, as OpenImageIO's own files are.
  std::size_t read(void*, std::size_t) override { return 0; }
  std::size_t write(const void* buffer, std::size_t size) override {
    const std::size_t written = std::fwrite(buffer, 1, size, file_);
    note(written == size);
    m_pos += static_cast<int64_t>(written);
    return written;
  }

  std::size_t size() const override {
    const int64_t here = OIIO::Filesystem::ftell(file_);
    note(OIIO::Filesystem::fseek(file_, 0, SEEK_END) == 0);
    const int64_t end = OIIO::Filesystem::ftell(file_);
    note(OIIO::Filesystem::fseek(file_, here, SEEK_SET) == 0);
    return static_cast<std::size_t>(end);
  }

  /// 0 where all went well.
  int failure() const { return failure_; }

 private:
  bool note(bool good) const {
    if (!good && !failure_) failure_ = errno;
    return good;
  }

  std::FILE* file_;
  mutable int failure_ = 0;
};

}  // namespace

struct PictureFile::State {
  State(const std::string& final_path, const std::string& temporary)
      : path(final_path), keeper(temporary), file(temporary) {}

  [[noreturn]] void refuse(const std::string& reason) const {
    fail(path, "cannot be written", file.failure() ? std::generic_category().message(file.failure()) : reason);
  }

  // In this order: OpenImageIO is closed before the file is, and the file before its temporary name is removed.
  std::string path;
  TemporaryFile keeper;
  CheckedFile file;
  std::unique_ptr<OIIO::ImageOutput> output;
};

PictureFile::PictureFile(const std::string& path, const std::string& format, const OIIO::ImageSpec& spec)
    : state_(std::make_unique<State>(path, temporary_name(path))) {
  if (state_->file.failure()) state_->refuse("");
  give_threads_to_openimageio();
  state_->output = OIIO::ImageOutput::create(format);
  if (!state_->output) state_->refuse(OIIO::geterror());
  state_->output->set_ioproxy(&state_->file);
  write([&](OIIO::ImageOutput& output) { return output.open(state_->file.filename(), spec); });
}

PictureFile::~PictureFile() = default;

void PictureFile::write(const std::function<bool(OIIO::ImageOutput&)>& call) {
  const bool good = call(*state_->output);
  if (!good || state_->file.failure()) state_->refuse(state_->output->geterror());
}

void PictureFile::finish() {
  write([](OIIO::ImageOutput& output) { return output.close(); });
  state_->output.reset();
  state_->file.close();
  if (state_->file.failure()) state_->refuse("");
  state_->keeper.keep_as(state_->path);
}

}  // namespace stillwater
