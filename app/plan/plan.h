// SPDX-License-Identifier: Apache-2.0
// The plan: what a run computes, what is left out and why, the memory of each buffer, the -D flags of its kernels.
// Engines make one from the preset and the loaded scene; the command line prints it, every run saves it.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace nephroid::plan {

/// Whether a part of the work is done.
struct Decision {
  std::string name;
  bool runs = true;
  std::string reason;     ///< a sentence a person can read
  std::string field = {}; ///< JSON pointer of the preset's boolean that decides, null where the scene does;
                          ///< empty where none does
  bool run_value = false; ///< what it must be for that to run; what is needed runs whatever it is
};

struct PlannedBuffer {
  std::string name;
  std::uint64_t bytes = 0;
  bool on_host = false; ///< in the program's own memory, not on the device
};

/// A file that the run is made of.
struct Input {
  std::string file;    ///< as the preset names it; a frame's, what the one before left, from its folder
  std::string content; ///< a hash of what it held when the plan was made; empty where it could not be read
};

/// An engine may add to it what it worked out on the way, for its job.
struct Plan {
  virtual ~Plan() = default;
  Plan() = default;
  Plan(const Plan&) = default;
  Plan(Plan&&) = default;
  Plan& operator=(const Plan&) = default;
  Plan& operator=(Plan&&) = default;

  std::string engine;
  std::vector<Decision> decisions;
  std::vector<PlannedBuffer> buffers;
  std::map<std::string, std::string> defines;
  std::vector<Input> inputs;               ///< what the run was made of
  std::vector<std::string> notes;          ///< what the run should say once: extrapolated data, open meshes
  std::vector<std::string> not_imported;   ///< the preset's
  int layers = 0;                          ///< pictures that the run makes and adds up
  std::uint64_t picture_bytes_a_pixel = 0; ///< on this machine, while a picture is made, beside it
  std::string smaller = {};     ///< what to choose where the memory is too small for it; empty: a smaller picture
  bool mixes_frames = false;    ///< an animation's frame begins with what the one before left (job::Job::begin_with)
  bool estimates_error = false; ///< films are kept in two halves, whose difference tells the error
};

/// {"engine","passes":[{"name","runs","reason","field","run_value"}],"buffers":[{"name","bytes"}],"defines":{},
/// "inputs":[{"file","content"}]}, plus "notes" and "not_imported"; "field" and "run_value" only where a field decides.
/// "passes" are the decisions, by the name that files have.
std::string to_json(const Plan& plan);
/// The inputs in a plan.json; none if it is damaged.
std::vector<Input> inputs_of(const std::string& plan_json);
/// The same on one line, with the run's "name" before it: a sweep is a line a run.
std::string to_json_line(const Plan& plan, const std::string& name);
/// For a terminal.
std::string to_text(const Plan& plan);
/// "1.50 MiB": three figures are enough for a person.
std::string readable_bytes(std::uint64_t bytes);

} // namespace nephroid::plan
