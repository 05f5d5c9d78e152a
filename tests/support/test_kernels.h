// SPDX-License-Identifier: Apache-2.0
// Which kernels tests run, and how a test runs OpenCL source that it brings with it, with the project's own headers
// beside it.
#pragma once
#include "compute/compute.h"
#include "tests/support/standard.h"

namespace nephroid::test {

/// The folder of the kernels under test: NEPHROID_TEST_KERNELS, which tests/faults puts broken copies into, else the
/// project's own.
inline fs::path kernel_folder() {
  const char* const folder = std::getenv("NEPHROID_TEST_KERNELS");
  return folder != nullptr ? folder : NEPHROID_SOURCE_DIR "/kernels";
}

/// What a test opens a device with: the kernels that are built in, or those of NEPHROID_TEST_KERNELS.
inline compute::DeviceOptions device_options() {
  compute::DeviceOptions options;
  if (std::getenv("NEPHROID_TEST_KERNELS") != nullptr) options.kernels = kernel_folder();
  return options;
}

/// A context whose kernel folder holds the project's kernels and `source` as test.cl. The folder goes with the object.
class TestKernels {
public:
  explicit TestKernels(const std::string& source) {
    std::string name = (fs::temp_directory_path() / "nephroid-kernels-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    for (const auto& entry : fs::directory_iterator(kernel_folder()))
      fs::create_symlink(fs::absolute(entry.path()), folder_ / entry.path().filename());
    std::ofstream(folder_ / "test.cl") << source;
    compute::DeviceOptions options{.kernels = folder_};
    context_ = compute::Context::open(options);
  }
  ~TestKernels() { fs::remove_all(folder_); }
  TestKernels(const TestKernels&) = delete;
  TestKernels& operator=(const TestKernels&) = delete;

  const compute::Context& context() const { return context_; }
  compute::Kernel kernel(const std::string& name, const compute::Defines& defines = {}) const {
    return compute::Program(context_, "test.cl", defines).kernel(name);
  }

private:
  fs::path folder_;
  compute::Context context_;
};

} // namespace nephroid::test
