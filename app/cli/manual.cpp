// SPDX-License-Identifier: Apache-2.0
// `nephroid manual`: the man page, as roff, from the texts that --help prints. The build writes it to
// share/man/man1/nephroid.1.
#include "base/build_info.h"
#include "cli/verb.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace nephroid::cli {
namespace {

/// Escapes text for roff: a backslash, a hyphen that is a minus, and a control character that begins a line.
std::string roff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) escaped += "\\&";
    escaped += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  }
  return escaped;
}

/// Prints a help text: its paragraphs, and indented lines, such as examples, unchanged.
void print_text(const std::string& text) {
  std::istringstream lines(text);
  bool literal = false;
  for (std::string line; std::getline(lines, line);) {
    const bool indented = line.starts_with("  ");
    if (indented != literal) fmt::print("{}\n", indented ? ".PP\n.nf\n.RS 4" : ".RE\n.fi\n.PP");
    literal = indented;
    if (line.empty())
      fmt::print(".PP\n");
    else
      fmt::print("{}\n", roff(indented ? line.substr(2) : line));
  }
  if (literal) fmt::print(".RE\n.fi\n");
}

void print_options(const CLI::App& app, bool positional) {
  const CLI::Formatter format;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional() != positional) continue;
    fmt::print(".TP\n\\fB{}\\fR{}\n{}\n", roff(format.make_option_name(option, positional)),
               roff(format.make_option_opts(option)), roff(option->get_description()));
  }
}

std::string usage(const CLI::App& app) {
  const CLI::Formatter format;
  std::string line = "\\fBnephroid";
  line += app.get_parent() ? " " + app.get_name() + "\\fR" : "\\fR";
  line += " [\\fIOPTIONS\\fR]";
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional()) line += " " + roff(format.make_option_usage(option));
  return line;
}

void print_manual(const CLI::App& program) {
  fmt::print(".\\\" Made by `nephroid manual`. Do not edit.\n");
  fmt::print(".TH NEPHROID 1 \"\" \"{}\" \"User commands\"\n", roff(program_name()));
  fmt::print(".SH NAME\nnephroid \\- a caustics workbench\n");
  const std::vector<const CLI::App*> verbs = program.get_subcommands({});
  fmt::print(".SH SYNOPSIS\n{}\n", usage(program));
  for (const CLI::App* verb : verbs) fmt::print(".br\n{}\n", usage(*verb));
  fmt::print(".SH DESCRIPTION\n");
  print_text(program.get_description());
  fmt::print(".SH OPTIONS\n");
  print_options(program, true);
  print_options(program, false);
  fmt::print(".SH VERBS\n");
  for (const CLI::App* verb : verbs) {
    fmt::print(".SS {}\n", verb->get_name());
    print_text(verb->get_description() + ".");
    print_options(*verb, true);
    print_options(*verb, false);
    if (verb->get_footer().empty()) continue;
    fmt::print(".PP\n");
    print_text(verb->get_footer());
  }
  fmt::print(".SH NOTES\n");
  print_text(program.get_footer());
}

} // namespace

void add_manual(CLI::App& program, Session&) {
  Verb verb(program, "manual", "The man page of this program, as roff",
            {{"nephroid manual > nephroid.1", "then `man -l nephroid.1`"}});
  verb.work([&program] { print_manual(program); });
}

} // namespace nephroid::cli
