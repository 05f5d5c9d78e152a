// SPDX-License-Identifier: Apache-2.0
// Who follows a job while somebody steps it: run::drive, or a Worker on its thread.
#pragma once

namespace nephroid::job {

class Job;

/// All calls come on the job's thread, between steps. What they throw ends the run.
class Observer {
public:
  virtual ~Observer() = default;
  virtual void begun(Job&) {} ///< before the first step
  virtual void stepped(Job&) {}
  virtual void ended(Job&) {} ///< no step follows: it is finished, or was stopped
};

} // namespace nephroid::job
