// SPDX-License-Identifier: Apache-2.0
// PoCL's kernel cache: PoCL writes every kernel to a folder before it runs it, and where it cannot, it shows no device at all
// (no HOME) or fails later with an unrelated code. So the folder is looked at before PoCL is first called.
#include "compute/state.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace nephroid::compute {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name)
{
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Where PoCL 3 looks, in its order (pocl_cache_init_topdir). Empty: it has no place.
fs::path cache_folder()
{
  if (const std::string folder = environment("POCL_CACHE_DIR"); !folder.empty()) return folder;
  if (const std::string folder = environment("XDG_CACHE_HOME"); !folder.empty()) return fs::path(folder) / "pocl/kcache";
  if (const std::string folder = environment("HOME"); !folder.empty()) return fs::path(folder) / ".cache/pocl/kcache";
  return {};
}

/// Makes the folder and writes as much as a large kernel takes into it. Returns the system's reason where that fails.
std::string write_problem(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return error.message();
  std::string name = folder / "nephroid-XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0) return std::strerror(errno);
  constexpr std::size_t kernel_bytes = 1 << 20;
  const std::vector<char> bytes(kernel_bytes);
  errno = ENOSPC; // what a short write without a code of its own means
  const bool written = ::write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  const std::string reason = written ? "" : std::strerror(errno);
  close(file);
  unlink(name.c_str());
  return reason;
}

/// A folder of this user alone among the temporary files: kernels found there are run, so nobody else may write to it.
/// Its name stays the same, so that kernels are kept for the next run. Empty where there is none.
fs::path private_folder()
{
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  if (error) return {};
  const fs::path folder = temporary / fmt::format("nephroid-kernels-{}", getuid());
  mkdir(folder.c_str(), S_IRWXU);
  struct stat status = {};
  if (lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != getuid()) return {};
  if (status.st_mode & (S_IRWXG | S_IRWXO)) return {};
  return write_problem(folder).empty() ? folder : fs::path();
}

} // namespace

std::string detail::kernel_cache_problem()
{
  const fs::path folder = cache_folder();
  if (folder.empty()) return "PoCL has no folder for its kernels: HOME is not set";
  const std::string reason = write_problem(folder);
  return reason.empty() ? "" : fmt::format("PoCL's kernel cache {} cannot be written: {}", folder.string(), reason);
}

std::string prepare_kernel_cache()
{
  const std::string problem = detail::kernel_cache_problem();
  if (problem.empty()) return {};
  const fs::path folder = private_folder();
  if (folder.empty()) return problem + "; set POCL_CACHE_DIR to a folder that can be written";
  setenv("POCL_CACHE_DIR", folder.c_str(), 1);
  return fmt::format("{}; kernels are kept in {} instead", problem, folder.string());
}

} // namespace nephroid::compute
