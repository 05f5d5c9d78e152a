// SPDX-License-Identifier: Apache-2.0
// The queue of what takes longer than a frame: order, newest wins, cancelling, what is thrown, owners that are gone,
// and the end.
#include "tests/support/test.h"
#include "ui/state/tasks.h"

#include <future>

namespace nephroid::ui::tasks_test {

class TasksTest : public testing::Test {
protected:
  /// Until nothing runs or waits.
  void settle() {
    ASSERT_TRUE(test::eventually([&] { tasks.collect(messages); }, [&] { return tasks.empty(); }));
  }
  /// A task that waits for `gate`, and then is `number`.
  void start(const TaskKey& task_key, int number, TaskAbout about = {"waiting"}) {
    tasks.start(
        task_key, std::move(about), [number, open = open] { return open.wait(), number; },
        [this](int result) { delivered.push_back(result); });
  }

  std::promise<void> gate;
  std::shared_future<void> open = gate.get_future().share();
  std::vector<int> delivered;
  Messages messages;
  TaskKey key;
  TaskQueue tasks;
};

TEST_F(TasksTest, ThoseOfOneKeyRunInTheirOrderAndOthersBesideThem) {
  TaskKey other;
  for (int i = 0; i < 5; ++i) start(key, i);
  EXPECT_EQ(tasks.running().size(), 1u);
  tasks.start(
      other, {"other"}, [] { return std::this_thread::get_id(); },
      [this](std::thread::id id) {
        EXPECT_NE(id, std::this_thread::get_id());
        delivered.push_back(-1);
      });
  ASSERT_TRUE(test::eventually([&] { tasks.collect(messages); }, [&] { return !tasks.busy(other); }));
  EXPECT_THAT(delivered, ElementsAre(-1));
  EXPECT_TRUE(tasks.busy(key));
  gate.set_value();
  settle();
  EXPECT_THAT(delivered, ElementsAre(-1, 0, 1, 2, 3, 4));
}

TEST_F(TasksTest, TheNewestReplacesThoseThatHaveNotBegun) {
  for (int i = 0; i < 5; ++i) start(key, i, {.name = "list", .kind = TaskKind::write, .replaces = true});
  gate.set_value();
  settle();
  EXPECT_THAT(delivered, ElementsAre(0, 4));
}

TEST_F(TasksTest, WhatIsThrownThereOrInTheDeliveryIsAMessage) {
  gate.set_value();
  tasks.start(
      key, {"work"}, [] { throw bad_input("a.json", "is broken"); }, [] {});
  tasks.start(
      key, {"delivery"}, [] { return 1; }, [](int) { throw std::runtime_error("no room"); });
  settle();
  ASSERT_EQ(messages.all().size(), 2u);
  EXPECT_EQ(messages.all()[0].line, "a.json: is broken");
  EXPECT_EQ(messages.all()[0].kind, ErrorKind::bad_input);
  EXPECT_EQ(messages.all()[1].line, "no room");
}

TEST_F(TasksTest, ACancelledOneSaysNothingAndKeepsNobodyWaiting) {
  start(key, 1, {"reading", TaskKind::request});
  start(key, 2, {"reading", TaskKind::request});
  start(key, 3, {"keeping", TaskKind::write});
  ASSERT_EQ(tasks.running().size(), 1u);
  EXPECT_TRUE(tasks.running()[0].can_cancel);
  tasks.cancel(tasks.running()[0].id);
  ASSERT_EQ(tasks.running().size(), 1u) << "the second begins beside the first, which ends when it likes";
  tasks.cancel(tasks.running()[0].id);
  ASSERT_EQ(tasks.running().size(), 1u);
  EXPECT_FALSE(tasks.running()[0].can_cancel);
  tasks.cancel(tasks.running()[0].id);
  tasks.forget(key);
  EXPECT_TRUE(tasks.busy(key)) << "a file is written to its end";
  gate.set_value();
  settle();
  EXPECT_THAT(delivered, ElementsAre(3));
  EXPECT_THAT(messages.all(), IsEmpty());
}

TEST_F(TasksTest, TheWorkSaysHowFarItIsAndSeesThatItIsCancelled) {
  std::atomic<bool> seen{false};
  tasks.start(
      key, {"counting", TaskKind::request},
      [&seen](TaskControl& control) {
        control.progress(0.25);
        while (!control.cancelled()) std::this_thread::yield();
        seen = true;
      },
      [] {});
  ASSERT_TRUE(test::eventually([&] { return !tasks.running().empty() && tasks.running()[0].progress == 0.25; }));
  EXPECT_THAT(tasks.running(std::chrono::hours(1)), IsEmpty());
  tasks.cancel(tasks.running()[0].id);
  settle();
  EXPECT_TRUE(seen);
}

TEST_F(TasksTest, NothingIsDeliveredToAnOwnerThatIsGone) {
  {
    const TaskKey of_owner;
    start(of_owner, 1);
    start(of_owner, 2, {"writing", TaskKind::write});
  }
  gate.set_value();
  settle();
  EXPECT_THAT(delivered, IsEmpty());
}

TEST_F(TasksTest, WaitingForAKeyDeliversItAndLeavesTheOthers) {
  TaskKey other;
  start(other, 1);
  tasks.start(
      key, {"short"}, [] { return 2; }, [this](int result) { delivered.push_back(result); });
  tasks.start(
      key, {"short"}, [] { return 3; }, [this](int result) { delivered.push_back(result); });
  tasks.wait(key, messages);
  EXPECT_THAT(delivered, ElementsAre(2, 3));
  EXPECT_TRUE(tasks.busy(other));
  gate.set_value();
  settle();
}

TEST_F(TasksTest, TheEndWaitsForWhatIsWrittenAndDeliversNothing) {
  std::atomic<int> written{0};
  gate.set_value();
  for (int i = 0; i < 3; ++i)
    tasks.start(
        key, {"writing", TaskKind::write},
        [&written] {
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
          if (++written == 2) throw failed("b.json", "cannot be written");
        },
        [this] { delivered.push_back(1); });
  start(key, 2);
  tasks.finish(messages);
  EXPECT_EQ(written, 3);
  EXPECT_THAT(delivered, IsEmpty());
  ASSERT_EQ(messages.all().size(), 1u);
  EXPECT_EQ(messages.all()[0].line, "b.json: cannot be written");
}

} // namespace nephroid::ui::tasks_test
