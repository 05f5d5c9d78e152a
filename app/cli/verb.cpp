// SPDX-License-Identifier: Apache-2.0
#include "cli/verb.h"

#include "cli/numbers.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <utility>

namespace nephroid::cli {
namespace {

template <class Value>
constexpr bool is_vector = false;
template <class Item>
constexpr bool is_vector<std::vector<Item>> = true;

} // namespace

std::string examples(std::initializer_list<Example> list)
{
  std::size_t width = 0;
  for (const Example& example : list)
    if (*example.says) width = std::max(width, std::strlen(example.command));
  std::string text = list.size() == 1 ? "Example:" : "Examples:";
  for (const Example& example : list)
    text += *example.says ? fmt::format("\n  {:<{}}  # {}", example.command, width, example.says) : fmt::format("\n  {}", example.command);
  return text;
}

const Option& Option::required() const
{
  option_.required();
  return *this;
}

const Option& Option::one_of(const std::vector<std::string>& words) const
{
  option_.check(CLI::IsMember(words));
  return *this;
}

template <class Number>
const Option& Option::from_to(Number lowest, Number highest) const
{
  option_.transform(CLI::Validator(
      [=](std::string& text) -> std::string {
        const std::optional<Number> number = typed_number<Number>(text);
        if (!number || !(*number >= lowest && *number <= highest))
          return fmt::format("'{}' is not {} from {} to {}", text, std::integral<Number> ? "a whole number" : "a number", lowest, highest);
        text = fmt::format("{}", *number); // as CLI11 reads it
        return {};
      },
      ""));
  return *this;
}
template const Option& Option::from_to(int, int) const;
template const Option& Option::from_to(std::uint64_t, std::uint64_t) const;
template const Option& Option::from_to(double, double) const;

const Option& Option::separated_by(char separator) const
{
  option_.delimiter(separator);
  return *this;
}

const Option& Option::needs(const Option& other) const
{
  option_.needs(&other.option_);
  return *this;
}

const Option& Option::excludes(const Option& other) const
{
  option_.excludes(&other.option_);
  return *this;
}

Verb::Verb(CLI::App& program, const char* name, const char* says, std::initializer_list<Example> list, const char* more)
    : app_(*program.add_subcommand(name, says))
{
  app_.footer(examples(list) + (*more ? std::string("\n\n") + more : std::string()));
}

template <class Value>
Option Verb::argument(const char* name, Value& value, const std::string& says)
{
  return Option(*app_.add_option(name, value, says));
}

template <class Value>
Option Verb::option(const char* names, Value& value, const char* type, const std::string& says)
{
  CLI::Option& option = *app_.add_option(names, value, says)->type_name(type);
  if (group_) option.group(group_);
  if constexpr (is_vector<Value>) option.expected(1)->take_all();
  return Option(option);
}

#define NEPHROID_OPTION(...) template Option Verb::option(const char*, __VA_ARGS__&, const char*, const std::string&)
NEPHROID_OPTION(std::string);
NEPHROID_OPTION(std::filesystem::path);
NEPHROID_OPTION(int);
NEPHROID_OPTION(std::uint64_t);
NEPHROID_OPTION(double);
NEPHROID_OPTION(std::array<int, 2>);
NEPHROID_OPTION(std::vector<std::string>);
NEPHROID_OPTION(std::vector<double>);
NEPHROID_OPTION(std::optional<int>);
NEPHROID_OPTION(std::optional<std::uint64_t>);
NEPHROID_OPTION(std::optional<double>);
NEPHROID_OPTION(std::optional<std::string>);
#undef NEPHROID_OPTION
#define NEPHROID_ARGUMENT(...) template Option Verb::argument(const char*, __VA_ARGS__&, const std::string&)
NEPHROID_ARGUMENT(std::string);
NEPHROID_ARGUMENT(std::filesystem::path);
NEPHROID_ARGUMENT(std::vector<std::string>);
NEPHROID_ARGUMENT(std::vector<std::filesystem::path>);
#undef NEPHROID_ARGUMENT

Option Verb::flag(const char* name, bool& value, const std::string& says) { return Option(*app_.add_flag(name, value, says)); }

void Verb::overrides(std::vector<std::string>& values, const std::string& says) { option("--set", values, "KEY=VALUE", says); }

void Verb::work(std::function<void()> work) { app_.callback(std::move(work)); }

} // namespace nephroid::cli
