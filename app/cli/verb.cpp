// SPDX-License-Identifier: Apache-2.0
#include "cli/verb.h"

#include "base/numbers.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <type_traits>
#include <utility>

namespace nephroid::cli {
namespace {

template <class Value>
struct ItemOf {
  using Type = Value;
};
template <class Item>
struct ItemOf<std::vector<Item>> : ItemOf<Item> {};
template <class Item>
struct ItemOf<std::optional<Item>> : ItemOf<Item> {};
template <class Item, std::size_t count>
struct ItemOf<std::array<Item, count>> : ItemOf<Item> {};

/// Refuses text that is no number, has anything after it, or is out of range.
template <class Number>
CLI::Validator number_from_to(double from, double to) {
  const auto lowest = static_cast<Number>(from),
             highest = std::isinf(to) ? std::numeric_limits<Number>::max() : static_cast<Number>(to);
  const auto check = [=](std::string& text) -> std::string {
    const std::optional<Number> number = typed_number<Number>(text);
    if (!number || !(*number >= lowest && *number <= highest))
      return fmt::format("'{}' is not {} from {} to {}", text, std::integral<Number> ? "a whole number" : "a number",
                         lowest, highest);
    text = fmt::format("{}", *number); // in a form that CLI11 reads
    return {};
  };
  return CLI::Validator(check, "");
}

} // namespace

std::string examples(const std::vector<Example>& list) {
  std::size_t width = 0;
  for (const Example& example : list)
    if (!example.says.empty()) width = std::max(width, example.command.size());
  std::string text = list.size() == 1 ? "Example:" : "Examples:";
  for (const Example& example : list)
    text += example.says.empty() ? fmt::format("\n  {}", example.command)
                                 : fmt::format("\n  {:<{}}  # {}", example.command, width, example.says);
  return text;
}

Verb::Verb(CLI::App& program, const char* name, const char* says, const std::vector<Example>& list, const char* more)
    : app_(*program.add_subcommand(name, says)) {
  app_.footer(examples(list) + (*more ? std::string("\n\n") + more : std::string()));
}

template <class Value>
void Verb::option(const char* names, Value& value, const Option& o) {
  CLI::Option& option = *app_.add_option(names, value, o.says)->required(o.required);
  if (o.type) option.type_name(o.type);
  if (group_) option.group(group_);
  if (o.separator) option.delimiter(o.separator);
  if (!o.words.empty()) option.check(CLI::IsMember(o.words));
  if (o.needs) option.needs(app_.get_option(o.needs));
  using Item = typename ItemOf<Value>::Type;
  if constexpr (std::is_arithmetic_v<Item>)
    if (!std::isnan(o.from)) option.transform(number_from_to<Item>(o.from, o.to));
  if constexpr (std::is_same_v<Value, std::vector<Item>>)
    if (*names == '-') option.expected(1)->take_all();
}

template void Verb::option(const char*, std::string&, const Option&);
template void Verb::option(const char*, std::filesystem::path&, const Option&);
template void Verb::option(const char*, int&, const Option&);
template void Verb::option(const char*, std::uint64_t&, const Option&);
template void Verb::option(const char*, double&, const Option&);
template void Verb::option(const char*, std::array<int, 2>&, const Option&);
template void Verb::option(const char*, std::array<double, 2>&, const Option&);
template void Verb::option(const char*, std::vector<std::string>&, const Option&);
template void Verb::option(const char*, std::vector<std::filesystem::path>&, const Option&);
template void Verb::option(const char*, std::vector<double>&, const Option&);
template void Verb::option(const char*, std::optional<int>&, const Option&);
template void Verb::option(const char*, std::optional<std::uint64_t>&, const Option&);
template void Verb::option(const char*, std::optional<double>&, const Option&);
template void Verb::option(const char*, std::optional<std::string>&, const Option&);

void Verb::flag(const char* name, bool& value, const std::string& says, const char* excludes) {
  CLI::Option* option = app_.add_flag(name, value, says);
  if (excludes) option->excludes(app_.get_option(excludes));
}

void Verb::overrides(std::vector<std::string>& values, const std::string& says) {
  option("--set", values, {.type = "KEY=VALUE", .says = says});
}

void Verb::device(std::string& selector, std::filesystem::path& kernels) {
  option("--device", selector, {.type = "SEL", .says = "An index or part of a name (see nephroid devices)"});
  option("--kernels", kernels, {.type = "DIR", .says = "Load kernels from this folder instead of the built-in ones"});
}

void Verb::work(std::function<void()> work) { app_.callback(std::move(work)); }

} // namespace nephroid::cli
