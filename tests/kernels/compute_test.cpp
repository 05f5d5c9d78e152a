// SPDX-License-Identifier: Apache-2.0
// compute/: devices, buffers, programs from embedded and from edited sources, and what each failure says.
#include "compute/compute.h"
#include "compute/embedded.h"
#include "tests/support/child.h"

#include <cctype>
#include <numeric>

namespace nephroid::compute_test {

using compute::Buffer;
using compute::Context;
using compute::Program;

/// The line of the Error that f throws.
template <class F>
std::string error_line(const F& f, ErrorKind kind = ErrorKind::failed) {
  const Error error = error_of(f);
  EXPECT_EQ(error.kind(), kind) << error.line();
  EXPECT_THAT(error.line(), Not(HasSubstr("\n")));
  return error.line();
}

/// A folder of kernels that a test writes, and a context that takes its programs from there.
class EditedKernels : public testing::Test {
protected:
  void write(const std::string& file, const std::string& text) const { std::ofstream(folder() / file) << text; }
  Context open() const { return Context::open({.kernels = folder()}); }
  const fs::path& folder() const { return folder_.path(); }

private:
  test::TemporaryFolder folder_;
};

TEST(Devices, AreListedWithWhatTheyCanDo) {
  const std::vector<compute::DeviceInfo> devices = compute::list_devices();
  ASSERT_FALSE(devices.empty()) << compute::no_device_error().line();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, static_cast<int>(i));
    EXPECT_GT(devices[i].compute_units, 0);
    EXPECT_GT(devices[i].max_buffer_bytes, 0u);
    EXPECT_THAT(devices[i].type, AnyOf("cpu", "gpu", "accelerator"));
  }
}

TEST(Devices, AreChosenByNumberAndByPartOfTheirName) {
  const compute::DeviceInfo first = compute::list_devices().at(0);
  EXPECT_EQ(Context::open({.selector = "0"}).device().name, first.name);
  std::string part = first.name.substr(1, 5);
  std::transform(part.begin(), part.end(), part.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  EXPECT_EQ(Context::open({.selector = part}).device().name, first.name);
  for (const std::string selector : {"17", "no such device"})
    EXPECT_THAT(error_line([&] { Context::open({.selector = selector}); }, ErrorKind::no_device),
                AllOf(HasSubstr(selector), HasSubstr(first.name)));
}

TEST(Buffers, KeepWhatIsWritten) {
  const Context context = Context::open();
  std::vector<int> numbers(1001);
  std::iota(numbers.begin(), numbers.end(), -3);
  Buffer<int> buffer(context, "numbers", std::span<const int>(numbers));
  EXPECT_EQ(buffer.read(), numbers);
  const std::vector<int> three{7, 8, 9};
  buffer.write(three, 998);
  std::copy(three.begin(), three.end(), numbers.begin() + 998);
  EXPECT_EQ(buffer.read(), numbers);
  buffer.fill_zero();
  EXPECT_EQ(buffer.read(), std::vector<int>(1001, 0));
  EXPECT_THAT(error_line([&] { buffer.write(three, 999); }), HasSubstr("numbers"));
  EXPECT_TRUE(Buffer<int>(context, "nothing", 0).read().empty());
}

TEST(Buffers, SayWhatDoesNotFit) {
  const Context context = Context::open();
  const std::size_t bytes = context.device().max_buffer_bytes + 1;
  EXPECT_THAT(error_line([&] { Buffer<char>(context, "film", bytes); }),
              AllOf(HasSubstr("film"), HasSubstr("MB"), HasSubstr(context.device().name)));
}

TEST(Programs, EveryEmbeddedSourceIsTheFileItWasMadeFrom) {
  EXPECT_FALSE(compute::embedded_sources().empty());
  for (const compute::EmbeddedSource& source : compute::embedded_sources()) {
    std::ifstream file(fs::path(NEPHROID_SOURCE_DIR) / "kernels" / source.name);
    EXPECT_EQ(source.text, std::string(std::istreambuf_iterator<char>(file), {})) << source.name;
  }
}

TEST_F(EditedKernels, RunWithIncludesDefinesAndRoundedSizes) {
  write("twice.h", "// once\ninline int twice(int a) { return 2 * a; }\n");
  write("also.h", "#include \"twice.h\"\n");
  write("test.cl",
        "#include \"twice.h\"\n#include \"also.h\"\n"
        "kernel void fill(global int* a, int first, uint count)\n"
        "{ const uint i = get_global_id(0); if (i < count) a[i] = twice(first) + OFFSET + get_local_size(0); }\n");
  const Context context = open();
  Buffer<int> a(context, "a", 100);
  for (const int offset : {5, 6}) {
    Program program(context, "test.cl", {{"OFFSET", std::to_string(offset)}});
    program.kernel("fill").run(a.size(), 64, {{"a", a}, {"first", 4}, {"count", 100u}});
    EXPECT_EQ(a.read(), std::vector<int>(100, 8 + offset + 64));
  }
}

TEST_F(EditedKernels, HaveEachItemOfALongLaunchOnce) {
  std::ifstream work_item(NEPHROID_SOURCE_DIR "/kernels/tracing/work_item.h");
  write("test.cl", std::string(std::istreambuf_iterator<char>(work_item), {}) +
                       "kernel void visit(global int* visits, uint count)\n"
                       "{ const uint i = work_item(); if (i < count) visits[i] += i + 1; }\n");
  const Context context = open();
  Program program(context, "test.cl");
  for (const std::uint32_t count : {32767u, 65535u, 65537u, 1000001u}) {
    auto visits = compute::zeroed<int>(context, "visits", count);
    program.kernel("visit").run(count, 48, {{"visits", visits}, {"count", count}});
    std::vector<int> once(count);
    std::iota(once.begin(), once.end(), 1);
    EXPECT_EQ(visits.read(), once);
  }
}

TEST_F(EditedKernels, SayWhenTheyAreCompiled) {
  write("test.cl", "kernel void k(global int* a) { a[0] = VALUE; }\n");
  const Context context = open();
  int told = 0;
  const compute::TellOfCompiling telling(context, [&] { ++told; });
  for (const char* value : {"1", "1", "2"}) Program(context, "test.cl", {{"VALUE", value}});
  EXPECT_EQ(told, 2) << "not of the one that is built already";
}

TEST_F(EditedKernels, ErrorsNameTheFileAndLineThatIsWrong) {
  write("wrong.h", "// a comment\ninline int f(int a) { return a + b; }\n");
  write("test.cl", "\n#include \"wrong.h\"\nkernel void k(global int* a) { a[0] = f(1); }\n");
  write("below.cl", "#include \"fine.h\"\nkernel void k(global int* a) {\n  a[0] = nothing;\n}\n");
  write("fine.h", "#define A 1\n#define B 2\n");
  write("missing.cl", "// a comment\n  #  include \"not there.h\"\n");
  const Context context = open();
  EXPECT_THAT(error_line([&] { Program(context, "test.cl"); }),
              AllOf(StartsWith("wrong.h:2: "), HasSubstr("'b'"), HasSubstr("test.cl")));
  EXPECT_THAT(error_line([&] { Program(context, "below.cl"); }), StartsWith("below.cl:3: "));
  EXPECT_THAT(error_line([&] { Program(context, "missing.cl"); }),
              AllOf(StartsWith("missing.cl:2: "), HasSubstr("not there.h")));
  EXPECT_THAT(error_line([&] { Program(Context::open(), "nothing.cl"); }),
              AllOf(HasSubstr("nothing.cl"), HasSubstr("tracing/trace.cl")));
  try {
    Program(context, "test.cl");
  } catch (const compute::BuildError& error) {
    EXPECT_THAT(error.log(), HasSubstr("\n"));
  }
}

TEST_F(EditedKernels, CallsWithOtherArgumentsAreRefused) {
  write("test.cl", "kernel void k(global int* a, int b) { a[0] = b; }\n");
  const Context context = open();
  Program program(context, "test.cl");
  compute::Kernel kernel = program.kernel("k");
  Buffer<int> a(context, "a", 1);
  EXPECT_THAT(error_line([&] {
                kernel.run(1, 1, {{"a", a}});
              }),
              AllOf(HasSubstr("test.cl: k"), HasSubstr("argument b is not given")));
  EXPECT_THAT(error_line([&] {
                kernel.run(1, 1, {{"a", 1}, {"b", 2}});
              }),
              HasSubstr("argument a is a value of type int; it takes a buffer"));
  EXPECT_THAT(error_line([&] {
                kernel.run(1, 1, {{"a", a}, {"b", a}});
              }),
              HasSubstr("argument b is a buffer of int; it takes a value"));
  EXPECT_THAT(error_line([&] { kernel.run(1, 1, {{"a", Buffer<int>()}, {"b", 2}}); }), HasSubstr("never made"));
  EXPECT_THAT(error_line([&] {
                kernel.run(1, 1, {{"a", a}, {"b", 2.0f}});
              }),
              HasSubstr("argument b is a value of type float; it takes a"));
  EXPECT_THAT(error_line([&] {
                kernel.run(1, 1, {{"a", a}, {"b", 2}, {"c", 2}});
              }),
              HasSubstr("argument c: the kernel has none"));
  EXPECT_THAT(error_line([&] {
                kernel.run(1, 1, {{"a", a}, {"b", 2}, {"b", 2}});
              }),
              HasSubstr("argument b is given twice"));
  EXPECT_THAT(error_line([&] {
                kernel.run(1, 1000000, {{"a", a}, {"b", 2}});
              }),
              AllOf(HasSubstr("clEnqueueNDRangeKernel"), HasSubstr("CL_INVALID_WORK_")));
  EXPECT_THAT(error_line([&] { program.kernel("other"); }), AllOf(HasSubstr("other"), HasSubstr("there are: k")));
  EXPECT_THAT(error_line([&] { Program(context, "test.cl", {{"A", "1 -DB=2"}}); }), HasSubstr("-DA="));
  kernel.run(0, 1, {{"a", a}, {"b", 3}}); // nothing to do is no error
  kernel.run(1, 1, {{"a", a}, {"b", 4}});
  EXPECT_EQ(a.read().at(0), 4);
}

TEST_F(EditedKernels, AChangeIsBuilt) {
  write("test.cl", "kernel void k(global int* a) { a[0] = 1; }\n");
  const Context context = open();
  Buffer<int> a(context, "a", 1);
  Program(context, "test.cl").kernel("k").run(1, 1, {{"a", a}});
  EXPECT_EQ(a.read().at(0), 1);
  write("test.cl", "kernel void k(global int* a) { a[0] = 2; }\n");
  Program(context, "test.cl").kernel("k").run(1, 1, {{"a", a}});
  EXPECT_EQ(a.read().at(0), 2);
  EXPECT_THAT(error_line([&] { Context::open({.kernels = folder() / "none"}); }, ErrorKind::bad_input),
              HasSubstr("not a folder"));
}

// The window's worker builds programs while another thread watches the folder: what is built stays, whatever changes
// beside it.
TEST_F(EditedKernels, AreWatchedWhileTheyAreBuilt) {
  write("test.cl", "kernel void k(global int* a) { a[0] = 1; }\n");
  const Context context = open();
  int told = 0;
  const compute::TellOfCompiling telling(context, [&] { ++told; });
  Program(context, "test.cl");
  const compute::KernelTimes before = compute::kernel_times(folder());
  EXPECT_EQ(compute::kernel_times(folder()), before);
  write("other.cl", "// another kernel\n");
  std::atomic<bool> seen{false};
  std::jthread watcher([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) seen = seen || compute::kernel_times(folder()) != before;
  });
  EXPECT_TRUE(test::eventually([&] {
    Program(context, "test.cl");
    return seen.load();
  }));
  EXPECT_EQ(told, 1);
  EXPECT_EQ(compute::kernel_times(folder() / "none"), compute::KernelTimes());
}

TEST_F(EditedKernels, AnEngineMayHaveNone) {
  const Context context = open();
  fs::create_directory(folder() / "photons");
  write("photons/test.cl", "// a kernel\n");
  EXPECT_THAT(compute::kernel_sources(context, "photons"), HasSubstr("// a kernel"));
  EXPECT_EQ(compute::kernel_sources(context, "inverse"), "");
  fs::create_symlink("loop", folder() / "loop");
  EXPECT_THAT(error_line([&] { compute::kernel_sources(context, "loop"); }), HasSubstr("loop: cannot be read: "));
}

test::Ended devices_with(const test::Environment& environment) {
  const test::TemporaryFolder logs;
  return test::nephroid({"devices"}, logs.path(), logs.path(), environment);
}

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Environment, WithoutAPlatformThereIsOneClearLine) {
  const test::Ended ended = devices_with({{"OCL_ICD_VENDORS", "/nonexistent"}});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_THAT(ended.err, AllOf(StartsWith("nephroid: "), HasSubstr("no OpenCL platform"),
                               HasSubstr("apt install pocl-opencl-icd")));
  EXPECT_EQ(lines(ended.err), 1);
  EXPECT_EQ(ended.out, "");
}

TEST(Environment, WithoutHomeOrAWritableCacheThereIsANoteAndAWayOn) {
  const test::Environment environments[] = {{{"HOME", {}}, {"XDG_CACHE_HOME", {}}, {"POCL_CACHE_DIR", {}}},
                                            {{"POCL_CACHE_DIR", "/dev/null/cache"}},
                                            {{"POCL_CACHE_DIR", {}}, {"XDG_CACHE_HOME", "/dev/null"}}};
  for (const test::Environment& environment : environments) {
    const test::Ended ended = devices_with(environment);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("kernels are kept in"));
    EXPECT_EQ(lines(ended.err), 1);
    EXPECT_EQ(lines(ended.out), static_cast<long>(compute::list_devices().size()));
  }
}

} // namespace nephroid::compute_test
