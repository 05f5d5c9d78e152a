// SPDX-License-Identifier: Apache-2.0
// Who follows a job while somebody advances it: run::drive, or a Worker on its thread.
#pragma once

namespace nephroid::job {

class Job;

/// All calls come on the job's thread, between slices. What they throw ends the run.
class Observer {
public:
  virtual ~Observer() = default;
  virtual void begun(Job&) {} ///< before the first slice
  virtual void advanced(Job&) {}
  virtual void ended(Job&) {} ///< no slice follows: it is finished, or was stopped
};

} // namespace nephroid::job
