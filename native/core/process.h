#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What the engine needs of the operating system; the only file with system calls of one kind of machine.
namespace stillwater {

/// From now on SIGINT and SIGTERM remove every registered temporary file and end the process at once, with exit
/// code 130 or 143: safe at any moment, also in the middle of a long write. For the command line, not for a
/// process that somebody else owns (Blender).
void install_signal_handler();

/// From now on the process ends as SIGTERM ends it, temporary files removed, when its standard input ends: whoever
/// started it is gone. What is read is thrown away. Watches from a thread of its own, which never touches Python.
void end_with_standard_input();

/// From now on lines of standard input are kept for next_line(), by a thread of its own, which never touches Python. When
/// the input ends, so does the process, at once, temporary files removed, with exit code 0: whoever asked is gone.
void listen_to_standard_input();

/// The next line, without its end; nothing where none came within so many seconds. For one thread.
std::optional<std::string> next_line(double seconds);

/// True where a process of this id runs on this machine, whoever owns it.
bool process_runs(long id);

/// While one of these lives, the end of the process waits, a tenth of a second at most: for a file that exists already and is not
/// registered yet.
class EndHeld {
 public:
  EndHeld();
  ~EndHeld();
  EndHeld(const EndHeld&) = delete;
  EndHeld& operator=(const EndHeld&) = delete;

 private:
  struct Mask;
  std::unique_ptr<Mask> before_;
};

/// A file that the signal handler removes. At most 64 at a time, paths up to 4095 bytes; throws BadInput beyond.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& path);
  ~TemporaryFile();  ///< forgets the path and removes the file where it is still there
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Renames it to its final name, in one step, over whatever was there. Throws FileError.
  void keep_as(const std::string& path);

 private:
  int slot_;
};

/// The name under which a file (with an extension) is written before it is renamed: ".NAME.HOST.PID.tmp.EXTENSION"
/// beside "NAME.EXTENSION". Host and process tell a sweeper whose it is.
std::string temporary_name(const std::string& path);

/// Removes what processes of this machine that no longer run have left in a folder under names of
/// temporary_name(), and gives those paths, sorted. A folder that is not there holds nothing. Throws FileError.
std::vector<std::string> sweep_temporaries(const std::string& folder);

}  // namespace stillwater
