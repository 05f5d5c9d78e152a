// SPDX-License-Identifier: Apache-2.0
// A verb of the command line and its options. CLI11, which parses them, is known to verb.cpp, command_line.cpp and manual.cpp only: each
// file that includes it takes seconds more to compile.
#pragma once
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace nephroid::cli {

struct Example {
  const char* command; ///< with "nephroid"
  const char* says;    ///< may be empty
};

/// "Examples:", then a line each: what says is a comment, so that a line can be pasted into a shell. tests/docs runs each of them as it
/// stands, one after the other.
std::string examples(std::initializer_list<Example> list);

/// What more there is to say about an option.
class Option {
public:
  explicit Option(CLI::Option& option) : option_(option) {}
  const Option& required() const;
  /// The only words that it takes.
  const Option& one_of(const std::vector<std::string>& words) const;
  /// The only numbers that it takes. CLI11 by itself reads "nan" as a number in any range, -1 as 2^64 - 1 and 1e30 as the largest whole
  /// number, and knows no whole number 1e5. Number: int, std::uint64_t or double.
  template <class Number>
  const Option& from_to(Number lowest, Number highest) const;
  /// Several values may stand in one argument, with this between them.
  const Option& separated_by(char separator) const;
  const Option& needs(const Option& other) const;
  const Option& excludes(const Option& other) const;

private:
  CLI::Option& option_;
};

/// The values that options are read into must live until the work is done.
class Verb {
public:
  Verb(CLI::App& program, const char* name, const char* says, std::initializer_list<Example> examples, const char* more = "");
  /// The program itself, whose options then stand under `group` in its help.
  Verb(CLI::App& program, const char* group) : app_(program), group_(group) {}

  /// names: "-o,--output", or of an argument "FILE". Value: a number, a std::string, a path, a std::optional of these; a std::array, or a
  /// std::vector, for which the option may be repeated. type: what a value is called in the help.
  template <class Value>
  Option option(const char* names, Value& value, const char* type, const std::string& says);
  template <class Value>
  Option argument(const char* name, Value& value, const std::string& says);
  Option flag(const char* name, bool& value, const std::string& says);
  /// --set KEY=VALUE
  void overrides(std::vector<std::string>& values, const std::string& says = "Change a setting: scene.lights.0.power_w=2; may be repeated");
  void work(std::function<void()> work);

private:
  CLI::App& app_;
  const char* group_ = nullptr;
};

} // namespace nephroid::cli
