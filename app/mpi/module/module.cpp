// SPDX-License-Identifier: Apache-2.0
// The only file that knows MPI: a module that ranks.cpp loads.
//
// Nobody waits for others' work inside of MPI: its waits spin on a core, which a rank beside it could use, and never
// end where a rank has died. So a call is begun and asked after at times, and the others are looked after.
#include "base/error.h"
#include "base/files.h"
#include "mpi/ranks.h"

#include <mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <exception>
#include <functional>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace nephroid::mpi {
namespace {

using Clock = std::chrono::steady_clock;

struct Rank {
  char host[MPI_MAX_PROCESSOR_NAME] = {};
  std::size_t boot = 0; ///< its machine's kernel's: machines' names may be alike, and containers of one have several
  ino_t processes = 0;  ///< the name space of its process' number: containers have their own
  pid_t process = 0;
};

ino_t own_processes() {
  struct stat status {};
  return ::stat("/proc/self/ns/pid", &status) == 0 ? status.st_ino : 0;
}

std::size_t own_boot() {
  try {
    return std::hash<std::string>()(read_file("/proc/sys/kernel/random/boot_id"));
  } catch (const Error&) {
    return 0; // /proc is not mounted
  }
}

/// How long the other ranks may take to save a run or frame that was interrupted, before this one ends all.
constexpr std::chrono::seconds others_save{5};

constexpr int no_more = -1; ///< in place of a number: nothing is left
constexpr int ask = 1, answer = 2;

class MpiRanks final : public Ranks {
public:
  MpiRanks() {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given); // distribute() talks on a thread of its own
    if (given < MPI_THREAD_SERIALIZED)
      throw failed("MPI", "its threads cannot take turns", {}, "use a build of Open MPI with threads");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    ranks_.resize(static_cast<std::size_t>(size_));
    Rank own;
    int length = 0;
    MPI_Get_processor_name(own.host, &length);
    own.boot = own_boot();
    own.processes = own_processes();
    own.process = ::getpid();
    MPI_Allgather(&own, sizeof own, MPI_BYTE, ranks_.data(), sizeof own, MPI_BYTE, MPI_COMM_WORLD);
  }
  /// A run that failed ends by abort().
  ~MpiRanks() override {
    if (std::uncaught_exceptions() == 0) MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::string name() const override { return name_of(rank_); }
  int number_on_host() const override {
    return static_cast<int>(
        std::count_if(ranks_.begin(), ranks_.begin() + rank_, [&](const Rank& other) { return is_on_host(other); }));
  }

  void all_reduce_sum(std::span<std::int64_t> numbers) override {
    in_pieces(numbers, [](std::int64_t* piece, int count, MPI_Request* request) {
      return MPI_Iallreduce(MPI_IN_PLACE, piece, count, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD, request);
    });
  }
  void all_reduce_or(std::span<std::byte> bytes) override {
    in_pieces(bytes, [](std::byte* piece, int count, MPI_Request* request) {
      return MPI_Iallreduce(MPI_IN_PLACE, piece, count, MPI_BYTE, MPI_BOR, MPI_COMM_WORLD, request);
    });
  }
  void broadcast(std::span<std::byte> bytes) override {
    in_pieces(bytes, [](std::byte* piece, int count, MPI_Request* request) {
      return MPI_Ibcast(piece, count, MPI_BYTE, 0, MPI_COMM_WORLD, request);
    });
  }

  Communicator::Traffic traffic() const override { return traffic_; }

  void distribute(std::int64_t count, const std::function<void(std::int64_t)>& work) override {
    try {
      rank_ == 0 ? distribute_as_root(count, work) : work_for_root(work);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::interrupted) std::this_thread::sleep_for(others_save);
      throw;
    }
  }

  [[noreturn]] void abort(int exit_code) override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

private:
  const Rank& own() const { return ranks_[static_cast<std::size_t>(rank_)]; }
  bool is_on_host(const Rank& other) const {
    return own().boot != 0 ? other.boot == own().boot : std::string_view(other.host) == own().host;
  }
  std::string name_of(int rank) const {
    return fmt::format("rank {} on {}", rank, ranks_[static_cast<std::size_t>(rank)].host);
  }

  /// Rank 0 hands out numbers beside its own work.
  void distribute_as_root(std::int64_t count, const std::function<void(std::int64_t)>& work) {
    std::atomic<std::int64_t> next = 0;
    std::atomic<bool> has_failed = false;
    std::exception_ptr thrown;
    std::jthread others([&] {
      try {
        for (int left = size_ - 1; left > 0;) {
          int has_asked = 0;
          MPI_Status who{};
          wait_until([&] {
            MPI_Iprobe(MPI_ANY_SOURCE, ask, MPI_COMM_WORLD, &has_asked, &who);
            return has_asked != 0 || has_failed;
          });
          if (has_failed) return; // which ends all ranks
          MPI_Recv(nullptr, 0, MPI_BYTE, who.MPI_SOURCE, ask, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
          std::int64_t number = next++;
          if (number >= count) number = no_more, --left;
          MPI_Send(&number, 1, MPI_INT64_T, who.MPI_SOURCE, answer, MPI_COMM_WORLD);
        }
      } catch (...) {
        thrown = std::current_exception();
        next = count;
      }
    });
    try {
      for (std::int64_t number = next++; number < count; number = next++) work(number);
    } catch (...) {
      has_failed = true;
      throw;
    }
    others.join();
    if (thrown) std::rethrow_exception(thrown);
  }

  void work_for_root(const std::function<void(std::int64_t)>& work) {
    while (true) {
      std::int64_t number = no_more;
      MPI_Request request = MPI_REQUEST_NULL;
      MPI_Send(nullptr, 0, MPI_BYTE, 0, ask, MPI_COMM_WORLD);
      MPI_Irecv(&number, 1, MPI_INT64_T, 0, answer, MPI_COMM_WORLD, &request);
      wait(request);
      if (number == no_more) return;
      work(number);
    }
  }

  /// MPI counts in int.
  template <class T, class Begin>
  void in_pieces(std::span<T> items, const Begin& begin) {
    constexpr std::size_t most = 1 << 26;
    traffic_.bytes += items.size_bytes();
    for (std::size_t at = 0; at < items.size(); at += most) {
      MPI_Request request = MPI_REQUEST_NULL;
      const Clock::time_point began = Clock::now();
      begin(items.data() + at, static_cast<int>(std::min(most, items.size() - at)), &request);
      wait(request);
      traffic_.seconds += std::chrono::duration<double>(Clock::now() - began).count();
      ++traffic_.calls;
    }
  }

  void wait(MPI_Request& request) {
    wait_until([&] {
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      return done != 0;
    });
  }

  template <class IsDone>
  void wait_until(const IsDone& is_done) {
    const Clock::time_point began = Clock::now();
    Clock::time_point looked = began;
    while (!is_done()) {
      const Clock::time_point now = Clock::now();
      if (now - began > std::chrono::seconds(1))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      else if (now - began > std::chrono::microseconds(200))
        std::this_thread::sleep_for(std::chrono::microseconds(50));
      if (now - looked < std::chrono::milliseconds(200)) continue;
      looked = now;
      require_others();
    }
  }

  /// Those whose processes this one can see; mpirun itself sees to the others.
  void require_others() const {
    for (int rank = 0; rank < size_; ++rank) {
      const Rank& other = ranks_[static_cast<std::size_t>(rank)];
      if (!is_on_host(other) || other.processes != own().processes || ::kill(other.process, 0) == 0) continue;
      throw failed(name_of(rank),
                   fmt::format("process {} has died, and {} waits for it", other.process, name_of(rank_)), {},
                   "go on with --resume, from the last checkpoint if there is one");
    }
  }

  int rank_ = 0, size_ = 1;
  std::vector<Rank> ranks_;
  Communicator::Traffic traffic_;
};

} // namespace
} // namespace nephroid::mpi

extern "C" __attribute__((visibility("default"))) nephroid::mpi::Ranks* nephroid_open_ranks() {
  return new nephroid::mpi::MpiRanks;
}
