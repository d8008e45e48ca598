#include "core/process.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <thread>

#include "core/error.h"

#if defined(_WIN32)
#include <io.h>
#include <windows.h>
#define STILLWATER_UNLINK _unlink
#define STILLWATER_READ _read
#else
#include <unistd.h>
#define STILLWATER_UNLINK unlink
#define STILLWATER_READ read
#endif

namespace stillwater {
namespace {

constexpr int slots = 64;
constexpr int longest_path = 4096;

// Read by the signal handler: plain memory, a slot counts only while its flag is set.
char paths[slots][longest_path];
std::atomic<bool> taken[slots];
std::mutex slot_mutex;

static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void leave_at_once(int signal_number) {
  for (int i = 0; i < slots; ++i)
    if (taken[i]) STILLWATER_UNLINK(paths[i]);
  std::_Exit(128 + signal_number);
}

}  // namespace

void install_signal_handler() {
  std::signal(SIGINT, leave_at_once);
  std::signal(SIGTERM, leave_at_once);
}

void end_with_standard_input() {
  std::thread([] {
    char thrown_away[256];
    long count = 1;
    while (count > 0 || (count < 0 && errno == EINTR)) count = STILLWATER_READ(0, thrown_away, sizeof thrown_away);
    leave_at_once(SIGTERM);
  }).detach();
}

bool process_runs(long id) {
#if defined(_WIN32)
  const HANDLE process = OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(id));
  if (process == nullptr) return GetLastError() == ERROR_ACCESS_DENIED;
  DWORD code = 0;
  const bool runs = GetExitCodeProcess(process, &code) && code == STILL_ACTIVE;
  CloseHandle(process);
  return runs;
#else
  return kill(static_cast<pid_t>(id), 0) == 0 || errno == EPERM;
#endif
}

TemporaryFile::TemporaryFile(const std::string& path) : slot_(-1) {
  if (path.size() >= longest_path) throw BadInput("temporary file: its path is longer than 4095 bytes: " + path);
  const std::lock_guard lock(slot_mutex);
  for (int i = 0; i < slots && slot_ < 0; ++i)
    if (!taken[i]) slot_ = i;
  if (slot_ < 0) throw BadInput("temporary file: more than 64 at a time");
  std::memcpy(paths[slot_], path.c_str(), path.size() + 1);
  taken[slot_] = true;
}

TemporaryFile::~TemporaryFile() {
  if (slot_ < 0) return;
  std::remove(paths[slot_]);
  taken[slot_] = false;
}

void TemporaryFile::keep_as(const std::string& path) {
  std::error_code failure;
  std::filesystem::rename(paths[slot_], path, failure);
  if (failure) throw FileError(path + ": cannot be written (" + failure.message() + ")");
  taken[slot_] = false;
  slot_ = -1;
}

}  // namespace stillwater
