// SPDX-License-Identifier: Apache-2.0
#include "job/distributed_job.h"

#include <exception>
#include <type_traits>

namespace nephroid::job {
namespace {

enum class Call : std::uint8_t { advance, snapshot, save, load, end };

class NullSink final : public ByteSink {
public:
  void write(std::span<const std::byte>) override {}
};

/// Where a disk is full the others go on all the same, and rank 0 has to keep in step with them.
class DeferringSink final : public ByteSink {
public:
  explicit DeferringSink(ByteSink& to) : to_(to) {}
  void write(std::span<const std::byte> bytes) override {
    if (thrown_) return;
    try {
      to_.write(bytes);
    } catch (...) {
      thrown_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

private:
  ByteSink& to_;
  std::exception_ptr thrown_;
};

class DistributedJob final : public Job {
public:
  DistributedJob(std::unique_ptr<Job> job, const Communicator& communicator)
      : job_(std::move(job)), communicator_(communicator) {}
  /// What failed ends all ranks anyway.
  ~DistributedJob() override {
    if (std::uncaught_exceptions() > 0 || thrown_) return;
    try {
      communicator_.broadcast(Call::end);
    } catch (const Error&) {
      // A rank died after its last work.
    }
  }

  /// The other ranks begin with the same, on their own.
  void begin_with(const Beginning& beginning) override { job_->begin_with(beginning); }
  void advance() override {
    call(Call::advance);
    job_->advance();
  }
  bool finished() const override { return job_->finished(); }
  Progress progress() const override { return job_->progress(); }
  Snapshot snapshot() override {
    call(Call::snapshot);
    Snapshot snapshot = remembering_failure([&] { return job_->snapshot(); });
    const Communicator::Traffic traffic = communicator_.traffic();
    snapshot.scalars.insert(snapshot.scalars.end(), {{"ranks", "count", static_cast<double>(communicator_.size())},
                                                     {"ranks", "calls", static_cast<double>(traffic.calls)},
                                                     {"ranks", "bytes", static_cast<double>(traffic.bytes)},
                                                     {"ranks", "waiting_seconds", traffic.seconds}});
    return snapshot;
  }
  bool estimates_error() const override { return job_->estimates_error(); }
  void save(ByteSink& to) override {
    call(Call::save);
    DeferringSink sink(to);
    remembering_failure([&] { job_->save(sink); });
    sink.rethrow();
  }
  void load(ByteSource& from) override {
    call(Call::load);
    std::vector<std::byte> bytes(from.left());
    from.read(bytes);
    bytes = communicator_.broadcast(std::move(bytes));
    StoredBytes all(bytes, "checkpoint.bin");
    job_->load(all);
    if (all.left() > 0) throw bad_input("checkpoint.bin", "has more than the run's state");
  }

private:
  void call(Call next) {
    if (thrown_) std::rethrow_exception(thrown_); // half way through a call: the ranks are no longer in step
    communicator_.broadcast(next);
  }
  template <class Work>
  std::invoke_result_t<Work> remembering_failure(Work work) {
    try {
      return work();
    } catch (...) {
      thrown_ = std::current_exception();
      throw;
    }
  }

  std::unique_ptr<Job> job_;
  Communicator communicator_;
  std::exception_ptr thrown_; ///< by a call whose caller may survive
};

} // namespace

std::unique_ptr<Job> distributed(std::unique_ptr<Job> job, const Communicator& communicator) {
  return std::make_unique<DistributedJob>(std::move(job), communicator);
}

void follow_root(Job& job, const Communicator& communicator) {
  NullSink null_sink;
  while (true) switch (communicator.broadcast(Call::end)) {
    case Call::advance: job.advance(); break;
    case Call::snapshot: job.snapshot(); break;
    case Call::save: job.save(null_sink); break;
    case Call::load: {
      const std::vector<std::byte> bytes = communicator.broadcast(std::vector<std::byte>());
      StoredBytes all(bytes, "checkpoint.bin");
      job.load(all);
      break;
    }
    case Call::end: return;
    }
}

} // namespace nephroid::job
