// SPDX-License-Identifier: Apache-2.0
// Reading files whole or piece by piece, writing them whole or not at all, and finding the files that a preset names.
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

/// Whether a file or folder is there; false also where nobody can tell, as in a folder that may not be read.
bool is_there(const std::filesystem::path& path);

/// The file's bytes. Throws bad_input where it cannot be read (missing, a folder, a device or a pipe, no permission).
std::string read_file(const std::filesystem::path& path);

/// The file's bytes one after the other. Throws as read_file, also where it ends while it is read.
std::unique_ptr<ByteSource> open_file(const std::filesystem::path& path);

/// Writes beside path, flushes to disk, renames: whole or not at all. A link leads on; what is replaced hands on its
/// mode. Throws failed (full disk, no permission, not a regular file); the temporary file is removed.
void write_file_whole(const std::filesystem::path& path, std::string_view bytes);
/// The same of what `write` writes; what it throws goes on, and there is no file.
void write_file_whole(const std::filesystem::path& path, const std::function<void(ByteSink&)>& write);
/// Whether this is the name of a temporary file of write_file_whole, which it leaves where the process is killed at its
/// work.
bool is_temporary_name(const std::filesystem::path& path);

/// The folder of the shipped presets and materials: NEPHROID_PRESETS from the environment, else ../presets beside the
/// program's build folder or installed share folder. Throws failed where none is found.
std::filesystem::path presets_folder();
/// The same, empty where none is found: a path to a preset still works then.
std::filesystem::path presets_folder_if_any();

/// nephroid/NAME in the user's folder of caches: XDG_CACHE_HOME, else ~/.cache. Whether it is there is not asked. Empty
/// where HOME is not set either.
std::filesystem::path cache_folder(const std::string& name);

/// nephroid in the user's folder of what programs keep between their runs: XDG_STATE_HOME, else ~/.local/state. As
/// cache_folder().
std::filesystem::path state_folder();

/// lib/nephroid/NAME of the build or installation folder that the program lies in: a module or a helper of ours.
/// Throws failed where it is not there.
std::filesystem::path library_file(const std::string& name);

/// A file that is in none of the folders that were looked into.
class FileNotFound : public Error {
public:
  /// looked_in: the folders, joined by commas.
  FileNotFound(Place where, const std::string& name, const std::string& looked_in);
  const std::string& name() const { return name_; }
  const std::string& looked_in() const { return looked_in_; }

private:
  std::string name_, looked_in_;
};

/// Where the files that a preset names are looked for, in order: beside the preset, in presets/, in the system's model
/// folders.
class FileFinder {
public:
  explicit FileFinder(std::filesystem::path beside = {});
  /// The first existing match of name (absolute names stand for themselves).
  /// Throws FileNotFound at `where`, or bad_input where something has the name and is no regular file.
  std::filesystem::path find(const std::string& name, const Place& where) const;
  const std::vector<std::filesystem::path>& folders() const { return folders_; }

private:
  void add(std::filesystem::path folder);

  std::vector<std::filesystem::path> folders_; ///< each once
};

} // namespace nephroid
