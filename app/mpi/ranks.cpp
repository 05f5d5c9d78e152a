// SPDX-License-Identifier: Apache-2.0
#include "mpi/ranks.h"

#include "base/files.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <thread>

namespace nephroid::mpi {
namespace {

/// How many processes were started together, as Open MPI's mpirun or a srun says it; 1 where nobody does.
int started_together() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* value = std::getenv(variable)) return std::atoi(value);
  // srun --mpi=pmix names the ranks alone, and the job says how many there are.
  const char *rank = std::getenv("PMIX_RANK"), *tasks = std::getenv("SLURM_NTASKS");
  return rank && tasks ? std::atoi(tasks) : 1;
}

/// Throws failed where this build has none: several processes would write into one folder.
std::filesystem::path module_file(int count) {
  try {
    return library_file(module_name);
  } catch (const Error&) {
    throw failed("mpirun",
                 fmt::format("nephroid was started as one of {} processes, and this build knows no MPI", count), {},
                 "install libopenmpi-dev and build it anew, or start one process");
  }
}

} // namespace

std::shared_ptr<Ranks> open_ranks() {
  const int count = started_together();
  if (count <= 1) return nullptr;
  const std::filesystem::path file = module_file(count);
  // MPI loads plug-ins of its own, which look for its symbols.
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!library) throw failed(file.string(), fmt::format("cannot be loaded: {}", ::dlerror()), {}, "install Open MPI");
  std::shared_ptr<Ranks> ranks(reinterpret_cast<OpenRanks>(::dlsym(library, open_symbol))());
  if (ranks->size() != count)
    throw failed("mpirun",
                 fmt::format("it has started {} processes, and Open MPI knows {} of them", count, ranks->size()), {},
                 "start them by Open MPI's mpirun, or by srun --mpi=pmix");
  return ranks;
}

void require_all(Ranks& ranks, const std::optional<Error>& error) {
  std::int64_t errors = error ? 1 : 0;
  ranks.all_reduce_sum({&errors, 1});
  if (error) throw *error;
  if (errors == 0) return;
  std::this_thread::sleep_for(std::chrono::seconds(60)); // they say why, and end all
  throw failed(ranks.name(), "another rank has failed");
}

void require_same(Ranks& ranks, const std::string& what, const std::string& mine) {
  std::uint64_t size = mine.size();
  ranks.broadcast(std::as_writable_bytes(std::span(&size, 1)));
  std::string first = mine;
  first.resize(size);
  ranks.broadcast(std::as_writable_bytes(std::span(first)));
  std::optional<Error> error;
  if (first != mine)
    error = bad_input(ranks.name(), fmt::format("has another {} than rank 0: {}, and not {}", what, mine, first), {},
                      "all ranks need the same program, device, preset, options and files");
  require_all(ranks, error);
}

} // namespace nephroid::mpi
