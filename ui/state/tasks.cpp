// SPDX-License-Identifier: Apache-2.0
#include "ui/state/tasks.h"

#include <algorithm>

namespace nephroid::ui {

TaskQueue::~TaskQueue() {
  Messages unread;
  finish(unread);
}

bool TaskQueue::is_of(const Task& task, const TaskKey& key) {
  return !task.control->cancelled() && task.key.lock() == key.alive_;
}

void TaskQueue::add(const TaskKey& key, TaskAbout about, Step work) {
  if (about.replaces)
    std::erase_if(tasks_, [&](const TaskPtr& task) { return !task->delivery.valid() && is_of(*task, key); });
  auto task = std::make_shared<Task>();
  task->id = ++last_id_;
  task->about = std::move(about);
  task->key = key.alive_;
  task->work = std::move(work);
  tasks_.push_back(std::move(task));
  begin_waiting();
}

/// Keys are compared by their owners, even after the keys are gone.
bool TaskQueue::holds_up(const Task& earlier, const Task& task) const {
  return !earlier.control->cancelled() && !earlier.key.owner_before(task.key) && !task.key.owner_before(earlier.key);
}

void TaskQueue::begin_waiting() {
  for (auto task = tasks_.begin(); task != tasks_.end(); ++task) {
    if ((*task)->delivery.valid()) continue;
    if (std::any_of(tasks_.begin(), task, [&](const TaskPtr& earlier) { return holds_up(*earlier, **task); })) continue;
    (*task)->begun = Clock::now();
    (*task)->delivery = std::async(
        std::launch::async, [work = std::move((*task)->work), control = (*task)->control] { return work(*control); });
  }
}

bool TaskQueue::busy(const TaskKey& key) const {
  return std::ranges::any_of(tasks_, [&](const TaskPtr& task) { return is_of(*task, key); });
}

/// Removes waiting tasks and cancels running ones.
void TaskQueue::drop(const std::function<bool(const Task&)>& which) {
  std::erase_if(tasks_, [&](const TaskPtr& task) {
    if (task->about.kind == TaskKind::write || !which(*task)) return false;
    task->control->cancelled_ = true;
    return !task->delivery.valid();
  });
  begin_waiting();
}

void TaskQueue::forget(const TaskKey& key) {
  drop([&](const Task& task) { return is_of(task, key); });
}

void TaskQueue::cancel(std::uint64_t id) {
  drop([&](const Task& task) { return task.id == id && task.about.kind == TaskKind::request; });
}

std::vector<TaskView> TaskQueue::running(Clock::duration at_least) const {
  std::vector<TaskView> views;
  const Clock::time_point now = Clock::now();
  for (const TaskPtr& task : tasks_)
    if (task->delivery.valid() && !task->control->cancelled() && now - task->begun >= at_least)
      views.push_back({task->id, task->about.name, task->control->progress_, task->about.kind == TaskKind::request});
  return views;
}

void TaskQueue::end(const TaskPtr& task, Messages& messages) {
  std::erase(tasks_, task);
  try {
    const Delivery deliver = task->delivery.get();
    if (!finishing_ && !task->control->cancelled() && !task->key.expired()) deliver();
  } catch (const std::exception& error) {
    if (!task->control->cancelled()) messages.error(error);
  }
}

void TaskQueue::collect(Messages& messages) {
  for (const TaskPtr& task : std::vector(tasks_)) // tasks that a delivery starts are not among them
    if (task->delivery.valid() && task->delivery.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
      end(task, messages);
  begin_waiting();
}

void TaskQueue::wait(const TaskKey& key, Messages& messages) {
  while (true) {
    const auto first = std::ranges::find_if(tasks_, [&](const TaskPtr& task) { return is_of(*task, key); });
    if (first == tasks_.end()) return;
    end(TaskPtr(*first), messages); // it has begun, so no task of its key precedes it
    begin_waiting();
  }
}

void TaskQueue::finish(Messages& messages) {
  finishing_ = true;
  drop([](const Task&) { return true; });
  const auto is_write = [](const TaskPtr& task) { return task->about.kind == TaskKind::write; };
  for (auto task = std::ranges::find_if(tasks_, is_write); task != tasks_.end();
       task = std::ranges::find_if(tasks_, is_write)) {
    end(TaskPtr(*task), messages);
    begin_waiting();
  }
}

} // namespace nephroid::ui
