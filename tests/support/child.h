// SPDX-License-Identifier: Apache-2.0
// Runs the built program, or another, as a child process, the way a person or a script does: arguments, environment,
// folder, signals.
#pragma once
#include "tests/support/process_state.h"

#include <csignal>
#include <sys/prctl.h>
#include <sys/wait.h>

namespace nephroid::test {

struct Ended {
  int exit_code = -1; ///< -1 where a signal ended it
  int signal = 0;
  std::string out, err;
};

/// Set, or unset where empty, on top of the test's own environment.
using Environment = std::map<std::string, std::optional<std::string>>;

/// Bakes, references and thumbnails below a folder of the program's own.
inline Environment own_cache(const fs::path& folder) {
  return {{"XDG_CACHE_HOME", folder.string()}, {"POCL_CACHE_DIR", kernel_cache()}};
}

class Child {
public:
  /// Starts the program in `folder`, with its output going to files in `logs`. It is killed where the test is.
  Child(const std::vector<std::string>& arguments, const fs::path& folder, const fs::path& logs,
        const Environment& environment = {}, const std::string& program = NEPHROID_PROGRAM)
      : out_(logs / "stdout"), err_(logs / "stderr") {
    for (const auto& file : {out_, err_}) fs::remove(file); // what a child before this one printed
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const auto& [name, value] : environment)
      value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const bool ready = std::freopen(out_.c_str(), "w", stdout) && std::freopen(err_.c_str(), "w", stderr) &&
                       ::chdir(folder.c_str()) == 0;
    if (ready) ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ~Child() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void send(int signal) const { ::kill(pid_, signal); }

  /// Until condition() holds or the child is gone or five minutes are over; says whether it holds.
  template <class Condition>
  bool until(Condition condition) const {
    bool holds = false;
    eventually([&] { return (holds = condition()) || gone(); });
    return holds || condition(); // what it waited for may be the child's last deed, or its end
  }

  bool gone() const {
    siginfo_t ended{};
    return ::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == pid_;
  }

  /// The output so far.
  std::string out() const { return text_of(out_); }

  Ended wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    Ended ended;
    if (WIFEXITED(status)) ended.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
    ended.out = text_of(out_);
    ended.err = text_of(err_);
    return ended;
  }

private:
  static std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  pid_t pid_ = -1;
  fs::path out_, err_;
};

/// Runs the program to its end.
inline Ended nephroid(const std::vector<std::string>& arguments, const fs::path& folder, const fs::path& logs,
                      const Environment& environment = {}) {
  return Child(arguments, folder, logs, environment).wait();
}

} // namespace nephroid::test
