// SPDX-License-Identifier: Apache-2.0
#include "base/build_info.h"
#include "base/files.h"
#include "base/nearest.h"
#include "cli/verb.h"
#include "engine/engine.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <system_error>

namespace nephroid::cli {
namespace {

constexpr const char* summary =
    "Nephroid is a caustics workbench: it renders, explores and designs the light that glass, water and mirrors throw. "
    "All that a run\n"
    "depends on is one JSON file, the preset. The window shows and edits it, `run` renders it.";
constexpr const char* closing =
    "Without a verb the window opens. `nephroid VERB --help` explains a verb and has examples.\n"
    "Presets: `nephroid presets` lists those that come with the program, `nephroid schema` says what can be in one.\n"
    "Docs: docs/README.md in the sources, share/doc/nephroid/README.md where it is installed. They begin with tours, a "
    "task each.\n"
    "Exit codes: 0 done, 1 failed, 2 bad usage or bad input, 3 no usable device, 130 interrupted.";

std::string description() {
  std::vector<Example> list{
      {"nephroid first-light", "the window: a glass bunny and its caustic, to watch and to change"}};
  for (const engine::Engine* engine : engine::engines())
    if (const engine::ShippedExample& shipped = engine->introduction.example; shipped.preset)
      list.push_back({fmt::format("nephroid run {}", shipped.preset), shipped.run});
  return fmt::format("{}\n\n{}\n", summary, examples(list));
}

std::vector<std::string> verb_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string did_you_mean(const std::string& name) {
  return name.empty() ? std::string() : fmt::format("did you mean '{}'?", name);
}

/// The command whose parsing failed: the verb if one was named, else the program itself.
const CLI::App& erring_app(const CLI::App& program) {
  const std::vector<CLI::App*> verbs = program.get_subcommands();
  return verbs.empty() ? program : *verbs.front();
}

/// CLI11's errors in the program's own form, with the nearest name for an unknown one.
Error usage_error(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& app = erring_app(program);
  const Location where = app.get_parent() ? app.get_name() : "";
  const std::string see = "see nephroid " + (app.get_parent() ? app.get_name() + " " : std::string()) + "--help";
  const std::vector<std::string> extras = program.remaining(true);
  for (const std::string& extra : extras) // before missing arguments: a mistyped option often explains those
    if (extra.size() > 1 && extra.front() == '-') {
      const std::string name = extra.substr(0, extra.find('='));
      return bad_input(where, fmt::format("unknown option '{}'", name), did_you_mean(nearest(name, option_names(app))),
                       see);
    }
  std::string text = error.what();
  if (error.get_exit_code() ==
      static_cast<int>(CLI::ExitCodes::ExtrasError)) { // "The following argument was not expected: WORDS"
    const std::size_t words = text.find(": ");
    return bad_input(where,
                     fmt::format("unexpected argument '{}'", text.substr(words == std::string::npos ? 0 : words + 2)),
                     {}, see);
  }
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  return bad_input(where, text, {}, see);
}

/// `nephroid rum first-light`: a word that is no file and no shipped preset, but nearly a verb, is a mistyped verb.
void refuse_mistyped_verb(const CLI::App& program, const std::string& word) {
  if (word.find_first_of("./") != std::string::npos || is_there(word)) return;
  std::vector<std::string> known = verb_names(program);
  known.insert(known.end(), {"help", "--version"});
  const std::string verb = nearest(word, known);
  if (verb.empty()) return;
  if (const auto presets = presets_folder_if_any(); !presets.empty() && is_there(presets / (word + ".json"))) return;
  throw bad_input("", fmt::format("unknown verb '{}'", word), did_you_mean(verb), "see nephroid --help");
}

/// What stands before a verb is for the window, which does not open: it would have no effect.
void refuse_words_before(const CLI::App& program, const std::string& verb) {
  for (const CLI::Option* option : program.get_options())
    if (option->count() > 0)
      throw bad_input(option->get_positional() ? option->results().front() : option->get_name(),
                      fmt::format("stands before the verb '{}'", verb), {},
                      fmt::format("put it after the verb; see nephroid {} --help", verb));
}

int open_window(const CLI::App& program, const Window& window, const std::vector<std::string>& files) {
  if (!files.empty()) refuse_mistyped_verb(program, files.front());
  if (window.open) return window.open(files);
  const std::string file = files.empty() ? "FILE" : files.front();
  throw bad_input("", "this build has no window", {},
                  fmt::format("render with `nephroid run {}`; see nephroid --help", file));
}

int parse_and_run(int argc, const char* const* argv, const Window& window) {
  Session session;
  std::vector<std::string> files;
  CLI::App program(description(), "nephroid");
  program.footer(closing);
  program.set_version_flag("--version", [] { return program_name(); });
  program.get_formatter()->column_width(34);
  program.get_formatter()->label("SUBCOMMAND", "VERB");
  program.require_subcommand(0, 1);
  program.add_option("FILE", files, "Open in the window: presets by path or shipped name");
  if (window.add_options) window.add_options(program);
  for (const auto add :
       {add_run,     add_plan,    add_dispersion, add_clusters, add_importance,  add_segment, add_pictures, add_plate,
        add_judge,   add_measure, add_gem,        add_compare,  add_report,      add_presets, add_import,   add_export,
        add_devices, add_check,   add_schema,     add_manual,   add_completions, add_version})
    add(program, session);
  for (CLI::App* verb : program.get_subcommands({})) {
    verb->group("Verbs");
    verb->preparse_callback([&program, verb](std::size_t) { refuse_words_before(program, verb->get_name()); });
  }
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "help") { // `help VERB` is `VERB --help`
    words.erase(words.begin());
    const std::vector<std::string> verbs = verb_names(program);
    if (!words.empty() && std::find(verbs.begin(), verbs.end(), words.front()) == verbs.end())
      throw bad_input("help", fmt::format("unknown verb '{}'", words.front()),
                      did_you_mean(nearest(words.front(), verbs)), "see nephroid help");
    words.emplace_back("--help");
  }
  std::reverse(words.begin(), words.end()); // CLI11 pops arguments from the end
  try {
    program.parse(std::move(words));
  } catch (const CLI::Success& request) { // --help and --version
    std::ostringstream text;
    const int exit_code = program.exit(request, text, text);
    fmt::print("{}", text.str()); // says why where it cannot be written
    return exit_code;
  } catch (const CLI::ParseError& error) {
    throw usage_error(program, error);
  }
  return program.get_subcommands().empty() ? open_window(program, window, files) : session.exit_code;
}

/// Results that cannot be written (a full disk, a closed pipe) are a failure, not silence.
Error cannot_write_results(const std::error_code& reason) {
  return failed("standard output", "cannot be written" + (reason ? ": " + reason.message() : std::string()));
}

void flush_results() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw cannot_write_results(std::error_code(errno, std::generic_category()));
}

Error defect(const std::exception& error) {
  return failed("", error.what(), {}, "this is a defect of the program: please report it");
}

} // namespace

int run_command_line(int argc, const char* const* argv, const Window& window) {
  const auto report = [](const Error& error) {
    std::fflush(stdout);
    fmt::print(stderr, "nephroid: {}\n", error.line());
    return error.exit_code();
  };
  try {
    const int exit_code = parse_and_run(argc, argv, window);
    flush_results();
    return exit_code;
  } catch (const Error& error) {
    return report(error);
  } catch (const std::bad_alloc&) {
    return report(failed("", "out of memory", {}, "see `nephroid plan` for what a run needs"));
  } catch (const std::system_error& error) { // fmt's own, if a write fails before the last flush
    if (std::ferror(stdout)) return report(cannot_write_results(error.code()));
    return report(defect(error));
  } catch (const std::exception& error) {
    return report(defect(error));
  }
}

} // namespace nephroid::cli
