// SPDX-License-Identifier: Apache-2.0
// Every order of three commands while a job works at an adoption: the end is what the newest of them say, and a picture
// is of the preset that it counts as.
#include "job/worker.h"
#include "tests/support/test.h"

#include <future>

namespace nephroid::worker_commands_test {

using namespace nephroid::job;
using namespace std::chrono_literals;

enum class Command { adopt, adopt_refused, adopt_failing, start, cancel, pause, go_on };
constexpr int commands = 7;
const std::map<Command, std::string> names{{Command::adopt, "adopt"},
                                           {Command::adopt_refused, "adopt what is refused"},
                                           {Command::adopt_failing, "adopt what fails"},
                                           {Command::start, "start"},
                                           {Command::cancel, "cancel"},
                                           {Command::pause, "pause"},
                                           {Command::go_on, "go on"}};

bool is_adoption(Command command) { return command <= Command::adopt_failing; }

/// Its picture is the seed of its preset. It never ends. The first adoption lasts until it is let go.
class AdoptingJob : public Job {
public:
  AdoptingJob(std::uint64_t seed, std::promise<void>* entered, std::shared_future<void> let_go)
      : seed_(seed), entered_(entered), let_go_(std::move(let_go)) {}
  void advance() override { std::this_thread::sleep_for(2ms); }
  bool finished() const override { return false; }
  Progress progress() const override { return {}; }
  Snapshot snapshot() override {
    auto picture = std::make_shared<job::Picture>();
    picture->rgb = {static_cast<float>(seed_)};
    return {.picture = std::move(picture)};
  }
  void save(ByteSink&) override {}
  void load(ByteSource&) override {}
  bool adopt(const preset::Preset& preset) override {
    if (entered_) std::exchange(entered_, nullptr)->set_value();
    let_go_.wait();
    if (preset.name == names.at(Command::adopt_failing)) throw failed("adopt", "no memory is left");
    if (preset.name == names.at(Command::adopt_refused)) return false;
    seed_ = preset.seed;
    return true;
  }

private:
  std::uint64_t seed_;
  std::promise<void>* entered_;
  std::shared_future<void> let_go_;
};

/// A worker whose job works at the first of some commands when the others come.
class Trial {
public:
  explicit Trial(std::vector<Command> orders) : orders_(std::move(orders)) {
    worker_.start(maker(0, &entered_));
    give(orders_[0]);
    entered_.get_future().wait();
    for (std::size_t i = 1; i < orders_.size(); ++i) give(orders_[i]);
    release_.set_value();
  }

  /// What differs from what it has to come to; empty: nothing.
  std::string difference() const {
    const Status status = worker_.status();
    const auto snapshot = worker_.snapshot();
    if (snapshot && picture_of(*snapshot) != seed_of(snapshot->adoption) && picture_of(*snapshot) != started_)
      return "the picture is not of the preset that it counts as";
    if (cancelled_) return status.state == job::State::cancelled || fails_at_first() ? "" : "is not cancelled";
    if (fails_)
      return status.state != job::State::failed ? "has not failed"
             : status.failures != 1             ? "failed more than once"
                                                : "";
    if (status.failures != 0) return "an adoption failed that nobody waited for";
    if (status.state == job::State::paused)
      return paused_ == false ? "does not run" : ""; // perhaps before its first picture
    if (!snapshot || picture_of(*snapshot) != newest_) return "the picture is not the newest preset's";
    if (snapshot->adoption != adoptions_) return "the picture does not count as the newest preset's";
    return status.state != job::State::running ? "does not run" : paused_ == true ? "is not paused" : "";
  }

  std::string name() const {
    std::string text;
    for (const Command order : orders_) text += (text.empty() ? "" : ", ") + names.at(order);
    return text;
  }

private:
  static std::uint64_t picture_of(const Snapshot& snapshot) {
    return static_cast<std::uint64_t>(snapshot.picture->rgb[0]);
  }
  std::uint64_t seed_of(std::uint64_t adoption) const { return adoption == 0 ? 0 : seeds_.at(adoption); }
  bool fails_at_first() const { return orders_[0] == Command::adopt_failing && adoptions_ == 1 && started_ == 0; }

  std::function<std::unique_ptr<Job>()> maker(std::uint64_t seed, std::promise<void>* entered = nullptr) {
    return [this, seed, entered] { return std::make_unique<AdoptingJob>(seed, entered, let_go_); };
  }

  void give(Command command) {
    if (command == Command::cancel) {
      worker_.cancel();
      cancelled_ = true;
    } else if (command == Command::pause || command == Command::go_on) {
      worker_.pause(command == Command::pause);
      paused_ = command == Command::pause;
    } else {
      ++newest_;
      if (is_adoption(command)) {
        auto preset = std::make_shared<preset::Preset>();
        preset->name = names.at(command);
        preset->seed = newest_;
        adoptions_ = worker_.adopt(preset, maker(newest_));
        seeds_[adoptions_] = newest_;
      } else {
        worker_.start(maker(newest_));
        started_ = newest_;
      }
      fails_ = command == Command::adopt_failing && !cancelled_; // a job that is made of it does not fail
      // A pause ends with a start; whether it does with an adoption depends on what becomes of it.
      if (!is_adoption(command))
        paused_ = false;
      else if (paused_ != false)
        paused_.reset();
      cancelled_ = false;
    }
  }

  std::vector<Command> orders_;
  std::uint64_t newest_ = 0, started_ = 0,
                adoptions_ = 0; ///< seeds of the newest preset and of the newest start()'s; adopt()s so far
  std::map<std::uint64_t, std::uint64_t> seeds_; ///< by adoption
  bool cancelled_ = false, fails_ = false;       ///< what it has to come to
  std::optional<bool> paused_ = false;           ///< nothing: either
  std::promise<void> entered_, release_;
  std::shared_future<void> let_go_ = release_.get_future().share();
  Worker worker_; ///< last: its job uses the others
};

TEST(WorkerCommands, EveryOrderWhileAnAdoptionIsInHand) {
  for (const Command first : {Command::adopt, Command::adopt_refused, Command::adopt_failing}) {
    std::vector<std::unique_ptr<Trial>> trials;
    for (int i = 0; i < commands * commands * commands; ++i)
      trials.push_back(std::make_unique<Trial>(std::vector{first, static_cast<Command>(i / (commands * commands)),
                                                           static_cast<Command>(i / commands % commands),
                                                           static_cast<Command>(i % commands)}));
    std::size_t right = 0; // all before this one
    test::eventually([&] {
      while (right < trials.size() && trials[right]->difference().empty()) ++right;
      return right == trials.size();
    });
    for (const auto& trial : trials) EXPECT_EQ(trial->difference(), "") << trial->name();
  }
}

} // namespace nephroid::worker_commands_test
