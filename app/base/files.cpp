// SPDX-License-Identifier: Apache-2.0
// C's files rather than streams: they say why a write failed, and reach the disk (fsync).
#include "base/files.h"

#include "base/bytes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace nephroid {
namespace fs = std::filesystem;
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason(int error) { return std::generic_category().message(error); }

std::string remedy_for(int error) {
  if (error == ENOSPC || error == EDQUOT) return "free some space or choose another folder";
  if (error == EACCES || error == EPERM || error == EROFS) return "choose a folder that you may write to";
  return error == ENOENT ? "make the folder first" : "";
}

[[noreturn]] void give_up(const fs::path& path, int error) {
  throw failed(path.string(), fmt::format("cannot be written: {}", reason(error)), {}, remedy_for(error));
}

Error unreadable(const fs::path& path, const std::string& why) {
  return bad_input(path.string(), "cannot be read: " + why);
}

/// Opens regular files only: reading a device or a pipe might never end.
File open_to_read(const fs::path& path, struct stat& status) {
  // Without O_NONBLOCK, open() would wait for a named pipe. For a regular file the flag does nothing.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  File file(descriptor < 0 ? nullptr : ::fdopen(descriptor, "rb"));
  if (!file || ::fstat(descriptor, &status) != 0) throw unreadable(path, reason(errno));
  if (S_ISDIR(status.st_mode)) throw unreadable(path, "it is a folder");
  if (!S_ISREG(status.st_mode)) throw unreadable(path, "it is not a regular file");
  return file;
}

/// Returns the number of bytes read, which is below `count` only at the end of the file.
std::size_t read_some(std::FILE* file, const fs::path& path, void* into, std::size_t count) {
  const std::size_t filled = std::fread(into, 1, count, file);
  if (std::ferror(file)) throw unreadable(path, reason(errno));
  return filled;
}

class FileSource final : public ByteSource {
public:
  explicit FileSource(const fs::path& path) : path_(path) {
    struct stat status {};
    file_ = open_to_read(path, status);
    left_ = static_cast<std::uint64_t>(status.st_size);
  }
  void read(std::span<std::byte> into) override {
    if (into.size() > left_ || read_some(file_.get(), path_, into.data(), into.size()) < into.size())
      throw unreadable(path_, "it ends early");
    left_ -= into.size();
  }
  std::uint64_t left() const override { return left_; }

private:
  fs::path path_;
  File file_;
  std::uint64_t left_ = 0;
};

/// path: the name in errors. mode: the mode of the file that is replaced; 0: none. close() is the last call and flushes
/// to disk.
class FileSink final : public ByteSink {
public:
  FileSink(const fs::path& temporary, const fs::path& path, mode_t mode) : path_(path), mode_(mode & 07777) {
    const int descriptor =
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode ? mode & 0777 : 0666);
    if (descriptor >= 0) file_.reset(::fdopen(descriptor, "wb"));
    if (!file_) give_up(path_, errno);
  }
  void write(std::span<const std::byte> bytes) override {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) < bytes.size()) give_up(path_, errno);
  }
  void close() {
    if (std::fflush(file_.get()) != 0) give_up(path_, errno);
    if (mode_ != 0) ::fchmod(::fileno(file_.get()), mode_); // some file systems have no modes
    if (::fsync(::fileno(file_.get())) != 0 || std::fclose(file_.release()) != 0) give_up(path_, errno);
  }

private:
  fs::path path_;
  mode_t mode_;
  File file_;
};

/// The regular file that path names or links to, and its status; path itself if there is none.
fs::path file_to_replace(const fs::path& path, struct stat& status) {
  if (::stat(path.c_str(), &status) != 0) {
    status.st_mode = 0;
    return path;
  }
  if (S_ISDIR(status.st_mode)) give_up(path, EISDIR);
  if (!S_ISREG(status.st_mode)) throw failed(path.string(), "cannot be written: it is not a regular file");
  std::error_code ignored;
  const fs::path there = fs::canonical(path, ignored);
  return ignored ? path : there;
}

/// ".STEM.PROCESS-COUNT.tmp.EXTENSION" beside path, a name that no other writer uses.
fs::path temporary_name(const fs::path& path) {
  static std::atomic<unsigned> count{0}; // two threads may write the same file
  return path.parent_path() /
         fmt::format(".{}.{}-{}.tmp{}", path.stem().string(), ::getpid(), count++, path.extension().string());
}

/// Renames a temporary file, which is already on disk, to path.
void commit_file(const fs::path& temporary, const fs::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) != 0) give_up(path, errno);
  // The new name reaches the disk with its folder. Some file systems refuse to sync folders; the file itself is safe by
  // then.
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int entry = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (entry >= 0) ::fsync(entry), ::close(entry);
}

/// The folder of the running program, empty where /proc is not mounted.
fs::path program_folder() {
  std::error_code ignored;
  // This gives the program that contains this code, or the library in another program such as Python.
  Dl_info here{};
  const bool is_library =
      ::dladdr(reinterpret_cast<void*>(&program_folder), &here) != 0 && fs::path(here.dli_fname).extension() == ".so";
  return is_library ? fs::weakly_canonical(here.dli_fname, ignored).parent_path()
                    : fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

/// Where a file of the project may lie. An installation has bin/nephroid, lib/nephroid and share/nephroid; a build
/// folder has the same layout. Test programs lie up to two folders deeper.
std::vector<fs::path> candidates(const fs::path& name) {
  std::vector<fs::path> result;
  fs::path folder = program_folder();
  for (int level = 0; level < 3 && folder.has_relative_path(); ++level) {
    folder = folder.parent_path();
    result.push_back(folder / name);
  }
  return result;
}

/// The system's folders of models, from the data folders of the XDG base directory specification.
std::vector<fs::path> model_folders() {
  const char* variable = std::getenv("XDG_DATA_DIRS");
  std::string_view list = variable && *variable ? variable : "/usr/local/share:/usr/share";
  std::vector<fs::path> folders;
  while (!list.empty()) {
    const std::size_t colon = std::min(list.find(':'), list.size());
    if (const fs::path data = list.substr(0, colon); data.is_absolute())
      for (const char* models : {"nephroid/models", "glmark2/models"}) folders.push_back(data / models);
    list.remove_prefix(std::min(colon + 1, list.size()));
  }
  return folders;
}

/// The folder nephroid in the folder that a variable of the XDG base directory specification names, else in `in_home`
/// of the user's home; empty without HOME.
fs::path user_folder(const char* variable, const char* in_home) {
  const auto value = [](const char* key) {
    const char* text = std::getenv(key);
    return fs::path(text ? text : "");
  };
  if (const fs::path folder = value(variable); !folder.empty()) return folder / "nephroid";
  if (const fs::path home = value("HOME"); !home.empty()) return home / in_home / "nephroid";
  return {};
}

} // namespace

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

std::string read_file(const fs::path& path) {
  struct stat status {};
  const File file = open_to_read(path, status);
  std::string bytes;
  std::size_t filled = 0;
  while (true) { // the size is a hint: files in /proc have none
    bytes.resize(std::max<std::size_t>(filled + 65536, static_cast<std::size_t>(status.st_size) + 1));
    filled += read_some(file.get(), path, bytes.data() + filled, bytes.size() - filled);
    if (filled < bytes.size()) break;
  }
  bytes.resize(filled);
  return bytes;
}

std::unique_ptr<ByteSource> open_file(const fs::path& path) { return std::make_unique<FileSource>(path); }

void write_file_whole(const fs::path& path, std::string_view bytes) {
  write_file_whole(path, [bytes](ByteSink& file) { file.write(std::as_bytes(std::span(bytes))); });
}

void write_file_whole(const fs::path& path, const std::function<void(ByteSink&)>& write) {
  struct stat status {};
  const fs::path target = file_to_replace(path, status), temporary = temporary_name(target);
  try {
    FileSink file(temporary, path, status.st_mode);
    write(file);
    file.close();
    commit_file(temporary, target);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

bool is_temporary_name(const fs::path& path) {
  const auto has_form = [](const fs::path& name) { // ".FILE.12-3.tmp", as temporary_name makes it
    const std::string numbers = name.stem().extension().string(), digits = "0123456789";
    const std::size_t dash = std::min(numbers.find_first_not_of(digits, 1), numbers.size());
    return name.extension() == ".tmp" && name.string().front() == '.' && name.stem().stem().string().size() > 1 &&
           dash > 1 && numbers.size() > dash + 1 && numbers[dash] == '-' &&
           numbers.find_first_not_of(digits, dash + 1) == std::string::npos;
  };
  return has_form(path.filename()) || has_form(path.filename().stem()); // the file's own ending may follow
}

fs::path cache_folder(const std::string& name) {
  const fs::path folder = user_folder("XDG_CACHE_HOME", ".cache");
  return folder.empty() ? folder : folder / name;
}

fs::path state_folder() { return user_folder("XDG_STATE_HOME", ".local/state"); }

fs::path presets_folder() {
  if (const char* variable = std::getenv("NEPHROID_PRESETS"); variable && *variable) {
    if (!is_folder(variable))
      throw failed("NEPHROID_PRESETS", fmt::format("'{}' is no folder", variable), "the folder of the presets");
    return variable;
  }
  std::vector<std::string> names;
  for (const fs::path& candidate : candidates("share/nephroid/presets")) {
    if (is_folder(candidate)) return candidate;
    names.push_back(candidate.string());
  }
  throw failed("presets", fmt::format("not found in {}", fmt::join(names, ", ")), {},
               "set NEPHROID_PRESETS to their folder");
}

fs::path presets_folder_if_any() {
  try {
    return presets_folder();
  } catch (const Error&) {
    return {};
  }
}

fs::path library_file(const std::string& name) {
  for (const fs::path& candidate : candidates(fs::path("lib/nephroid") / name))
    if (is_there(candidate)) return candidate;
  throw failed(name, fmt::format("not found in lib/nephroid beside {}", program_folder().string()), {},
               "build or install Nephroid again");
}

FileLock lock_open_file(int descriptor, bool alone) {
  if (descriptor < 0) return nullptr;
  FileLock lock(new int(descriptor), [](const int* open) {
    ::flock(*open, LOCK_UN); // a forked process may also hold it open
    ::close(*open);
    delete open;
  });
  if (::flock(descriptor, (alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return lock;
  const int why = errno;
  lock.reset();
  errno = why;
  return nullptr;
}

FileNotFound::FileNotFound(Location where, const std::string& name, const std::string& looked_in)
    : Error(ErrorKind::bad_input, std::move(where), fmt::format("'{}' not found", name), "looked in " + looked_in),
      name_(name), looked_in_(looked_in) {}

FileFinder::FileFinder(fs::path beside) {
  folders_.push_back(beside.empty() ? fs::path(".") : std::move(beside));
  if (fs::path presets = presets_folder_if_any(); !presets.empty()) add(std::move(presets));
  for (fs::path& folder : model_folders())
    if (is_folder(folder)) add(std::move(folder));
}

void FileFinder::add(fs::path folder) {
  if (std::find(folders_.begin(), folders_.end(), folder) == folders_.end()) folders_.push_back(std::move(folder));
}

fs::path FileFinder::find(const std::string& name, const Location& where) const {
  if (name.empty()) throw bad_input(where, "the file name is empty");
  std::string other_kind; // has the name but cannot be read; a file of that name in a later folder still counts
  const auto is_file = [&](const fs::path& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status) && other_kind.empty())
      other_kind =
          fmt::format("'{}' is {}", path.string(), fs::is_directory(status) ? "a folder" : "not a regular file");
    return fs::is_regular_file(status);
  };
  std::vector<std::string> names;
  if (fs::path(name).is_absolute()) {
    if (is_file(name)) return name;
    if (other_kind.empty()) throw bad_input(where, fmt::format("there is no file '{}'", name));
  } else {
    for (const fs::path& folder : folders_) {
      if (is_file(folder / name)) return folder / name;
      names.push_back(folder.string());
    }
  }
  if (!other_kind.empty()) throw bad_input(where, other_kind, "expected a file");
  throw FileNotFound(where, name, fmt::format("{}", fmt::join(names, ", ")));
}

} // namespace nephroid
