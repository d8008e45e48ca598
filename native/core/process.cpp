#include "core/process.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

#include "core/error.h"

#if defined(_WIN32)
#include <io.h>
#include <process.h>
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

std::atomic<int> holders{0};
constexpr int longest_hold = 100;  // ms

// In a signal handler, on any thread but those that hold: sleeping is safe there.
[[noreturn]] void leave(int code) {
  for (int i = 0; i < longest_hold && holders > 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  for (int i = 0; i < slots; ++i)
    if (taken[i]) STILLWATER_UNLINK(paths[i]);
  std::_Exit(code);
}

extern "C" void leave_at_once(int signal_number) { leave(128 + signal_number); }

/// Reads standard input to its end; `take(bytes, count)`.
template <class Take>
void read_all(const Take& take) {
  char bytes[4096];
  for (long count = 1; count > 0 || (count < 0 && errno == EINTR);) {
    count = STILLWATER_READ(0, bytes, sizeof bytes);
    if (count > 0) take(bytes, count);
  }
}

// Lines that were read and not asked for. Never destroyed: the thread that fills them runs until the process ends.
struct Heard {
  std::mutex mutex;
  std::condition_variable came;
  std::deque<std::string> lines;
};
Heard& heard() {
  static Heard* const lines = new Heard;
  return *lines;
}

#if defined(_WIN32)

long own_id() { return _getpid(); }

std::string host_name() {
  char name[MAX_COMPUTERNAME_LENGTH + 1];
  DWORD length = sizeof name;
  return GetComputerNameA(name, &length) ? std::string(name, length) : "localhost";
}

#else

long own_id() { return getpid(); }

std::string host_name() {
  char name[256];
  if (gethostname(name, sizeof name) != 0) return "localhost";
  name[sizeof name - 1] = '\0';
  return name;
}

#endif

/// The process that wrote a temporary file of this machine under this name; 0 for any other name.
long writer_of(const std::string& name) {
  const std::string host = host_name().insert(0, 1, '.') + '.', end = ".tmp.";
  const auto tail = name.rfind(end);
  if (name.front() != '.' || tail == std::string::npos) return 0;
  if (name.find('.', tail + end.size()) != std::string::npos) return 0;
  const auto dot = name.rfind('.', tail - 1);
  if (tail == 0 || dot == std::string::npos || dot < host.size() + 1) return 0;
  if (name.compare(dot + 1 - host.size(), host.size(), host) != 0) return 0;
  long id = 0;
  const char* last = name.data() + tail;
  const auto read = std::from_chars(name.data() + dot + 1, last, id);
  return read.ec == std::errc() && read.ptr == last && id > 0 ? id : 0;
}

bool is_registered(const std::filesystem::path& file) {
  const std::lock_guard lock(slot_mutex);
  std::error_code gone;
  for (int i = 0; i < slots; ++i)
    if (taken[i] && std::filesystem::equivalent(file, paths[i], gone)) return true;
  return false;
}

/// A process may have had our own number before us: what we have not registered is not ours.
bool is_left_over(const std::filesystem::path& file) {
  const long writer = writer_of(file.filename().string());
  return writer > 0 && (writer == own_id() ? !is_registered(file) : !process_runs(writer));
}

}  // namespace

void install_signal_handler() {
  std::signal(SIGINT, leave_at_once);
  std::signal(SIGTERM, leave_at_once);
}

void end_with_standard_input() {
  std::thread([] {
    read_all([](const char*, long) {});
    leave_at_once(SIGTERM);
  }).detach();
}

void listen_to_standard_input() {
  std::thread([&all = heard()] {
    std::string line;
    read_all([&](const char* bytes, long count) {
      for (long i = 0; i < count; ++i) {
        if (bytes[i] != '\n') {
          line += bytes[i];
          continue;
        }
        const std::lock_guard lock(all.mutex);
        all.lines.push_back(std::exchange(line, {}));
        all.came.notify_one();
      }
    });
    leave(0);
  }).detach();
}

std::optional<std::string> next_line(double seconds) {
  Heard& all = heard();
  std::unique_lock lock(all.mutex);
  const auto any = [&] { return !all.lines.empty(); };
  if (!all.came.wait_for(lock, std::chrono::duration<double>(seconds), any)) return std::nullopt;
  std::string line = std::move(all.lines.front());
  all.lines.pop_front();
  return line;
}

bool process_runs(long id) {
#if defined(_WIN32)
  const HANDLE process = OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(id));
  if (!process) return GetLastError() == ERROR_ACCESS_DENIED;
  DWORD code = 0;
  const bool running = GetExitCodeProcess(process, &code) && code == STILL_ACTIVE;
  CloseHandle(process);
  return running;
#else
  return kill(static_cast<pid_t>(id), 0) == 0 || errno == EPERM;
#endif
}

// The thread that holds takes no signal: it would wait for itself.
struct EndHeld::Mask {
#if !defined(_WIN32)
  Mask() {
    sigset_t ours;
    sigemptyset(&ours);
    sigaddset(&ours, SIGINT);
    sigaddset(&ours, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ours, &before);
  }
  ~Mask() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }
  sigset_t before;
#endif
};

EndHeld::EndHeld() : before_(std::make_unique<Mask>()) { ++holders; }
EndHeld::~EndHeld() { --holders; }

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

std::string temporary_name(const std::string& path) {
  const std::filesystem::path file(path);
  std::string name = file.stem().string().insert(0, 1, '.');
  name.append(1, '.').append(host_name()).append(1, '.').append(std::to_string(own_id())).append(".tmp");
  return (file.parent_path() / name.append(file.extension().string())).string();
}

std::vector<std::string> sweep_temporaries(const std::string& folder) {
  std::vector<std::string> swept;
  std::error_code failure;
  std::filesystem::directory_iterator entry(folder, failure);
  for (; !failure && entry != std::filesystem::directory_iterator(); entry.increment(failure))
    if (is_left_over(entry->path()) && std::filesystem::remove(entry->path(), failure))
      swept.push_back(entry->path().string());
  if (failure && failure != std::errc::no_such_file_or_directory)
    throw FileError(folder + ": cannot be swept (" + failure.message() + ")");
  std::sort(swept.begin(), swept.end());
  return swept;
}

}  // namespace stillwater
