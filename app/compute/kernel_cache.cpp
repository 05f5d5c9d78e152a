// SPDX-License-Identifier: Apache-2.0
// PoCL's kernel cache: PoCL writes every kernel to a folder before it runs it, and where it cannot, it shows no device
// at all (no HOME) or fails later with an unrelated code. So the folder is looked at before PoCL is first called.
#include "compute/state.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

namespace nephroid::compute {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// The folders that PoCL 3 tries, in its order (pocl_cache_init_topdir). Empty: PoCL has none.
fs::path cache_folder() {
  if (const std::string folder = environment("POCL_CACHE_DIR"); !folder.empty()) return folder;
  if (const std::string folder = environment("XDG_CACHE_HOME"); !folder.empty())
    return fs::path(folder) / "pocl/kcache";
  if (const std::string folder = environment("HOME"); !folder.empty()) return fs::path(folder) / ".cache/pocl/kcache";
  return {};
}

/// Room for a run's kernels and the compiler's files. LLVM ends the whole process if the disk fills up.
constexpr std::uintmax_t needed_bytes = 64'000'000;

/// Makes the folder and a file in it. Returns why PoCL could not work there; empty if it can.
std::string write_problem(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return error.message();
  std::string name = folder / "nephroid-XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0) return std::strerror(errno);
  const bool written = ::write(file, "x", 1) == 1;
  const std::string reason = written ? "" : std::strerror(errno);
  close(file);
  unlink(name.c_str());
  if (!written) return reason;
  const fs::space_info space = fs::space(folder, error);
  if (error || space.available >= needed_bytes) return {};
  return fmt::format("{:.1f} MB are free there, {:.0f} are needed", static_cast<double>(space.available) * 1e-6,
                     static_cast<double>(needed_bytes) * 1e-6);
}

/// A folder of this user alone: kernels found there are run, so others must not write to it. Its name is constant, so
/// that the next run finds its kernels. Empty if `parent` has no place for one.
fs::path private_folder(const fs::path& parent) {
  if (parent.empty()) return {};
  const fs::path folder = parent / fmt::format("nephroid-kernels-{}", getuid());
  mkdir(folder.c_str(), S_IRWXU);
  struct stat status = {};
  if (lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != getuid()) return {};
  if (status.st_mode & (S_IRWXG | S_IRWXO)) return {};
  return write_problem(folder).empty() ? folder : fs::path();
}

/// A folder in the temporary folder, or in memory if that is full, too.
fs::path private_folder() {
  std::error_code error;
  const fs::path folder = private_folder(fs::temp_directory_path(error));
  return folder.empty() ? private_folder("/dev/shm") : folder;
}

} // namespace

std::string detail::kernel_cache_problem() {
  const fs::path folder = cache_folder();
  if (folder.empty()) return "PoCL has no folder for its kernels: HOME is not set";
  const std::string reason = write_problem(folder);
  return reason.empty() ? "" : fmt::format("PoCL's kernel cache {} cannot be used: {}", folder.string(), reason);
}

std::string prepare_kernel_cache() {
  const std::string problem = detail::kernel_cache_problem();
  if (problem.empty()) return {};
  const fs::path folder = private_folder();
  if (folder.empty()) return problem + "; set POCL_CACHE_DIR to a folder that can be written";
  setenv("POCL_CACHE_DIR", folder.c_str(), 1);
  return fmt::format("{}; kernels are kept in {} instead", problem, folder.string());
}

} // namespace nephroid::compute
