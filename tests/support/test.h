// SPDX-License-Identifier: Apache-2.0
// What every test uses: GoogleTest and the names of its matchers, fmt, the standard library, and the names of tests/support without
// `test::`.
#pragma once
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace nephroid::test {
}

namespace nephroid {

using namespace test;
using testing::AllOf, testing::AnyOf, testing::Contains, testing::DoubleNear, testing::Each, testing::ElementsAre, testing::EndsWith,
    testing::FloatNear, testing::HasSubstr, testing::IsEmpty, testing::Not, testing::Optional, testing::SizeIs, testing::StartsWith;
namespace fs = std::filesystem;

} // namespace nephroid
