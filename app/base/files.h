// SPDX-License-Identifier: Apache-2.0
// Reading files whole or piece by piece, writing them whole or not at all, locking them among
// processes, and finding the files that a preset names.
#pragma once
#include "base/error.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace nephroid {

class ByteSink;
class ByteSource;

/// Whether a file or folder exists; false also if that cannot be known, as in a folder without read permission.
bool is_there(const std::filesystem::path& path);

/// The file's bytes. Throws bad_input if it cannot be read (missing, a folder, a device or a pipe, no permission).
std::string read_file(const std::filesystem::path& path);

/// Reads the file's bytes in sequence. Throws as read_file does, and if the file ends while it is read.
std::unique_ptr<ByteSource> open_file(const std::filesystem::path& path);

/// Writes a temporary file beside path, flushes it to disk and renames it, so that the file is written whole or not at
/// all. Follows links and keeps the mode of a file that it replaces. Throws failed (full disk, no permission, not a
/// regular file) and removes the temporary file.
void write_file_whole(const std::filesystem::path& path, std::string_view bytes);
/// Writes whole what `write` writes. Passes on what `write` throws; then there is no file.
void write_file_whole(const std::filesystem::path& path, const std::function<void(ByteSink&)>& write);
/// Whether write_file_whole gives this name to a temporary file. One stays behind if the process is killed while it
/// writes.
bool is_temporary_name(const std::filesystem::path& path);

/// The folder of the shipped presets and materials: NEPHROID_PRESETS from the environment, else ../presets beside the
/// program's build folder or installed share folder. Throws failed if none is found.
std::filesystem::path presets_folder();
/// The same folder, or empty if none is found: a path to a preset still works then.
std::filesystem::path presets_folder_if_any();

/// nephroid/NAME in the user's cache folder: XDG_CACHE_HOME, else ~/.cache. It need not exist. Empty if HOME is not set
/// either.
std::filesystem::path cache_folder(const std::string& name);

/// nephroid in the user's folder for state kept between runs: XDG_STATE_HOME, else ~/.local/state. It need not exist;
/// empty as with cache_folder().
std::filesystem::path state_folder();

/// lib/nephroid/NAME of the build or installation folder of the program: a module or a helper. Throws failed if it does
/// not exist.
std::filesystem::path library_file(const std::string& name);

/// The lock lasts as long as this pointer has owners, and ends with the process. Null: no lock.
using FileLock = std::shared_ptr<const int>;

/// Locks an open file or folder and does not wait. The lock takes over the descriptor. Unless `alone`, others may take
/// the same shared lock. Returns null with the system's errno if it fails: EWOULDBLOCK if another process has the lock,
/// another errno if the file system has no locks.
FileLock lock_open_file(int descriptor, bool alone = true);

/// A file is in none of the folders searched.
class FileNotFound : public Error {
public:
  /// looked_in: the folders searched, joined by commas.
  FileNotFound(Location where, const std::string& name, const std::string& looked_in);
  const std::string& name() const { return name_; }
  const std::string& looked_in() const { return looked_in_; }

private:
  std::string name_, looked_in_;
};

/// Searches for the files that a preset names: beside the preset, then in presets/, then in the system's model folders.
class FileFinder {
public:
  explicit FileFinder(std::filesystem::path beside = {});
  /// The first existing match; an absolute name is its own match. Throws FileNotFound at `where`, or bad_input if the
  /// match is no regular file.
  std::filesystem::path find(const std::string& name, const Location& where) const;
  const std::vector<std::filesystem::path>& folders() const { return folders_; }

private:
  void add(std::filesystem::path folder);

  std::vector<std::filesystem::path> folders_; ///< each folder once
};

} // namespace nephroid
