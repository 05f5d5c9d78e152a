// SPDX-License-Identifier: Apache-2.0
// `nephroid completions SHELL`: what a shell reads to complete verbs, options and their values, from the tables that
// --help prints. Names of presets and devices are asked of the program when they are wanted. The build writes all three
// to share/.
#include "cli/verb.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::cli {
namespace {

enum class Kind { nothing, files, folders, presets, devices, words };

/// How each shell names a kind of values; {} stands for the words.
struct ShellForms {
  const char *bash, *zsh, *fish;
};
constexpr ShellForms shell_forms[] = {{"kind=nothing", " ", " -f"},
                                      {"kind=files", "_files", " -F"},
                                      {"kind=folders", "_files -/", " -f -a '(__fish_complete_directories)'"},
                                      {"kind=presets", "_nephroid_presets", " -F -k -a '(__nephroid_list presets)'"},
                                      {"kind=devices", "_nephroid_devices", " -f -k -a '(__nephroid_list devices)'"},
                                      {"kind=words words='{}'", "({})", " -f -a '{}'"}};

struct Values {
  Kind kind = Kind::nothing;
  std::string words = {}; ///< separated by spaces

  std::string to(const char* ShellForms::*shell) const {
    return fmt::format(fmt::runtime(shell_forms[static_cast<int>(kind)].*shell), words);
  }
};

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Makes text safe between single quotes in all three shells; fish alone would read a backslash in it.
std::string plain(std::string text) { return replaced(replaced(std::move(text), "'", "’"), "\\", "/"); }

/// Escapes text for a spec of zsh.
std::string in_spec(const std::string& text) {
  std::string escaped;
  for (const char c : plain(text)) escaped += (c == '[' || c == ']' || c == ':' ? "\\" : "") + std::string(1, c);
  return escaped;
}

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

Values values_of(const CLI::Option& option) {
  if (is_flag(option)) return {};
  const std::string type = option.get_type_name(); // "FILE", or "TEXT:{even,draws}" if these words alone are valid
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open != std::string::npos && close != std::string::npos)
    return {Kind::words, replaced(type.substr(open + 1, close - open - 1), ",", " ")};
  if (option.get_positional())
    return {option.get_description().find("preset") != std::string::npos ? Kind::presets : Kind::files};
  if (type == "SEL") return {Kind::devices};
  if (type == "DIR") return {Kind::folders};
  return {type == "FILE" ? Kind::files : Kind::nothing};
}

/// "-o" and "--output".
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// The arguments or the options of a verb, or of the program itself.
std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional() == positional) options.push_back(option);
  return options;
}

/// The values of the first argument, which also serve for those that follow.
Values argument_of(const CLI::App& app) {
  const std::vector<const CLI::Option*> arguments = options_of(app, true);
  return arguments.empty() ? Values{} : values_of(*arguments.front());
}

std::vector<const CLI::App*> verbs_of(const CLI::App& program) { return program.get_subcommands({}); }

std::string verb_list(const CLI::App& program) {
  std::string list = "help";
  for (const CLI::App* verb : verbs_of(program)) list += " " + verb->get_name();
  return list;
}

// ---------------------------------------------------------------- bash

void bash_case(const CLI::App& app) {
  std::string all;
  for (const CLI::Option* option : options_of(app, false)) {
    std::string pattern;
    for (const std::string& name : names_of(*option)) {
      all += (all.empty() ? "" : " ") + name;
      pattern += (pattern.empty() ? "" : " | ") + name;
    }
    if (!is_flag(*option)) fmt::print("        {}) {}; return ;;\n", pattern, values_of(*option).to(&ShellForms::bash));
  }
  fmt::print("      esac\n      options='{}' {} ;;\n", all, argument_of(app).to(&ShellForms::bash));
}

void print_bash(const CLI::App& program) {
  fmt::print("{}", R"(# What follows the word $1: sets kind, words, options.
_nephroid_expected() {
  case $verb in
)");
  for (const CLI::App* verb : verbs_of(program)) {
    fmt::print("    {})\n      case $1 in\n", verb->get_name());
    bash_case(*verb);
  }
  fmt::print("    help) kind=words words=$verbs ;;\n    *)\n      case $1 in\n");
  bash_case(program);
  fmt::print("  esac\n}}\n_nephroid() {{\n  local verbs='{}'\n", verb_list(program));
  fmt::print("{}", R"sh(  local cur=$2 before=$3 verb='' kind='' words='' options=''
  [[ ${COMP_WORDS[COMP_CWORD]} == = ]] && cur=''
  [[ $before == = ]] && before=${COMP_WORDS[COMP_CWORD-2]}
  [[ $COMP_CWORD -gt 1 && " $verbs " == *" ${COMP_WORDS[1]} "* ]] && verb=${COMP_WORDS[1]}
  _nephroid_expected "$before"
  [[ $cur == -* ]] && kind=words words=$options
  [[ $COMP_CWORD -eq 1 && $cur != -* ]] && words=$verbs
  COMPREPLY=()
  case $kind in
    presets)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -W "$words $("$1" presets 2>/dev/null | cut -d' ' -f1)" -- "$cur"
                               compgen -f -X '!*.json' -- "$cur"; compgen -d -- "$cur") ;;
    folders) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$cur") ;;
    devices) mapfile -t COMPREPLY < <(compgen -W "$("$1" devices 2>/dev/null | cut -d' ' -f1)" -- "$cur") ;;
    words) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur") ;;
    files) ;;
    *) compopt +o default +o bashdefault 2>/dev/null ;;
  esac
}
complete -o default -o bashdefault -F _nephroid nephroid
)sh");
}

// ---------------------------------------------------------------- zsh

void zsh_arguments(const CLI::App& app) {
  fmt::print("_arguments -s");
  for (const CLI::Option* option : options_of(app, false)) {
    const std::string value =
        is_flag(*option)
            ? ""
            : fmt::format(":{}:{}", in_spec(option->get_lnames().empty() ? "value" : option->get_lnames().front()),
                          values_of(*option).to(&ShellForms::zsh));
    for (const std::string& name : names_of(*option))
      fmt::print(" \\\n        '*{}[{}]{}'", name, in_spec(option->get_description()), value);
  }
  if (const Values values = argument_of(app); values.kind != Kind::nothing)
    fmt::print(" \\\n        '*:argument:{}'", values.to(&ShellForms::zsh));
  fmt::print(" ;;\n");
}

void print_zsh(const CLI::App& program) {
  fmt::print("{}", R"sh(_nephroid_presets() {
  local -a names=("${(@f)$(_call_program presets $_nephroid_program presets 2>/dev/null | sed 's/:/\\:/g; s/  */:/')}")
  _describe preset names
  _files -g '*.json'
}
_nephroid_devices() {
  local -a names=("${(@f)$(_call_program devices $_nephroid_program devices 2>/dev/null | sed 's/:/\\:/g; s/  */:/')}")
  _describe device names
}
_nephroid() {
  local _nephroid_program=$words[1] verb=''
  local -a verbs=(
    'help:What a verb does'
)sh");
  for (const CLI::App* verb : verbs_of(program))
    fmt::print("    '{}:{}'\n", verb->get_name(), in_spec(verb->get_description()));
  fmt::print("{}", R"sh(  )
  if (( CURRENT == 2 )); then
    _describe verb verbs
  else
    verb=$words[2]
    (( ${verbs[(I)$verb:*]} )) && { shift words; (( CURRENT-- )) }
  fi
  case $verb in
    help) _describe verb verbs ;;
)sh");
  for (const CLI::App* verb : verbs_of(program)) {
    fmt::print("    {}) ", verb->get_name());
    zsh_arguments(*verb);
  }
  fmt::print("    *) ");
  zsh_arguments(program);
  fmt::print("  esac\n}}\n_nephroid \"$@\"\n");
}

// ---------------------------------------------------------------- fish

void fish_lines(const CLI::App& app, const std::string& when) {
  const std::string start = fmt::format("complete -c nephroid -n '{}'", when);
  for (const CLI::Option* option : options_of(app, false)) {
    std::string names;
    for (const std::string& name : option->get_snames()) names += " -s " + name;
    for (const std::string& name : option->get_lnames()) names += " -l " + name;
    fmt::print("{}{}{} -d '{}'\n", start, names,
               is_flag(*option) ? "" : " -r" + values_of(*option).to(&ShellForms::fish),
               plain(option->get_description()));
  }
  fmt::print("{}{}\n", start, argument_of(app).to(&ShellForms::fish));
}

void print_fish(const CLI::App& program) {
  fmt::print("{}", R"sh(function __nephroid_list
    set -l program (commandline -opc)[1]
    $program $argv 2>/dev/null | string replace -r '  +' \t
end
function __nephroid_verb
    set -l words (commandline -opc)
    set -q words[2]; and contains -- $words[2] $argv
end
)sh");
  const std::string none = "not __nephroid_verb " + verb_list(program);
  fmt::print("complete -c nephroid -n __fish_is_first_token -a help -d 'What a verb does'\n");
  for (const CLI::App* verb : verbs_of(program))
    fmt::print("complete -c nephroid -n __fish_is_first_token -a {} -d '{}'\n", verb->get_name(),
               plain(verb->get_description()));
  fmt::print("complete -c nephroid -n '__nephroid_verb help' -f -a '{}'\n", verb_list(program));
  for (const CLI::App* verb : verbs_of(program)) fish_lines(*verb, "__nephroid_verb " + verb->get_name());
  fish_lines(program, none);
}

} // namespace

void add_completions(CLI::App& program, Session&) {
  const auto shell = std::make_shared<std::string>();
  Verb verb(program, "completions", "What a shell completes: verbs, options, presets, devices",
            {{"nephroid completions bash > nephroid.bash", "then `source nephroid.bash`"}},
            "A package brings all three along. docs/install.md says where each shell looks for them.");
  verb.option("SHELL", *shell, {.says = "Which one", .words = {"bash", "zsh", "fish"}, .required = true});
  verb.work([&program, shell] {
    if (*shell == "zsh") fmt::print("#compdef nephroid\n");
    fmt::print("# Made by `nephroid completions {}`. Do not edit.\n", *shell);
    (*shell == "bash" ? print_bash : *shell == "zsh" ? print_zsh : print_fish)(program);
  });
}

} // namespace nephroid::cli
