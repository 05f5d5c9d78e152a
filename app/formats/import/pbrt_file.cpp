// SPDX-License-Identifier: Apache-2.0
#include "formats/import/pbrt_file.h"

#include "base/error.h"
#include "base/files.h"
#include "formats/import/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

Error wrong_count(const PbrtParameter& parameter, std::size_t count, const char* wanted) {
  return bad_input(parameter.where, fmt::format("\"{}\" has {} values", parameter.name, count), wanted);
}

} // namespace

std::vector<double> PbrtParameter::numbers() const {
  std::vector<double> result;
  for (const std::string& text : values) {
    const auto value = scene_number(text);
    if (!value) throw bad_input(where, fmt::format("\"{}\" of \"{}\" is no number", text, name), "expected numbers");
    result.push_back(*value);
  }
  return result;
}

const PbrtParameter* PbrtParameters::find(const std::string& name) const {
  const auto found = std::ranges::find(all, name, &PbrtParameter::name);
  if (found == all.end()) return nullptr;
  found->was_asked_for = true;
  return &*found;
}

std::vector<PbrtParameter> PbrtParameters::unasked() const {
  std::vector<PbrtParameter> unasked;
  std::ranges::remove_copy_if(all, std::back_inserter(unasked), &PbrtParameter::was_asked_for);
  return unasked;
}

std::string PbrtParameters::text(const std::string& name, const std::string& standard) const {
  const PbrtParameter* found = find(name);
  return found && !found->values.empty() ? found->values[0] : standard;
}

double PbrtParameters::number(const std::string& name, double standard) const {
  const PbrtParameter* found = find(name);
  if (!found) return standard;
  const auto values = found->numbers();
  if (values.size() != 1) throw wrong_count(*found, values.size(), "expected one number");
  return values[0];
}

glm::dvec3 PbrtParameters::vector(const std::string& name, const glm::dvec3& standard) const {
  const PbrtParameter* found = find(name);
  if (!found) return standard;
  const auto v = found->numbers();
  if (v.size() != 3) throw wrong_count(*found, v.size(), "expected three numbers");
  return {v[0], v[1], v[2]};
}

void PbrtParameters::add_missing(const std::vector<PbrtParameter>& more) {
  for (const PbrtParameter& parameter : more)
    if (std::ranges::find(all, parameter.name, &PbrtParameter::name) == all.end()) all.push_back(parameter);
}

PbrtFile::PbrtFile(const fs::path& file) : scene_(file) { read(file); }

fs::path PbrtFile::find(const std::string& name, const Location& where) const {
  const fs::path meant = scene_.parent_path() / name, beside = fs::path(where.name).parent_path() / name;
  return !is_there(meant) && is_there(beside) ? beside : meant;
}

void PbrtFile::read(const fs::path& file) {
  const std::string text = read_packed_file(file);
  open_.push_back(fs::absolute(file).lexically_normal());
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const Location where(file.string(), line);
    if (c == '\n') ++line;
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
      ++i;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else if (c == '[' || c == ']') {
      tokens_.push_back({std::string(1, c), false, where});
      ++i;
    } else if (c == '"') {
      const std::size_t end = text.find_first_of("\"\n", i + 1);
      if (end == std::string::npos || text[end] == '\n') throw bad_input(where, "a string has no end", "expected \"");
      tokens_.push_back({text.substr(i + 1, end - i - 1), true, where});
      i = end + 1;
      include_if_asked();
    } else {
      const std::size_t end = std::min(text.find_first_of(" \t\r\n[]\"#", i), text.size());
      tokens_.push_back({text.substr(i, end - i), false, where});
      i = end;
    }
  }
  open_.pop_back();
}

void PbrtFile::include_if_asked() {
  if (tokens_.size() < 2) return;
  const PbrtToken &word = *(tokens_.end() - 2), &name = tokens_.back();
  if (word.quoted || (word.text != "Include" && word.text != "Import")) return;
  const fs::path next = find(name.text, name.where);
  if (!is_there(next)) throw bad_input(name.where, "the file " + next.string() + " is not there", {}, "put it there");
  if (std::ranges::count(open_, fs::absolute(next).lexically_normal()) > 0)
    throw bad_input(name.where, "the file " + next.string() + " includes itself", {},
                    "take this " + word.text + " out");
  tokens_.resize(tokens_.size() - 2);
  read(next);
}

const PbrtToken& PbrtFile::token(const Location& where) {
  if (ended()) throw bad_input(where, "the file ends here", "expected more", "check that the file is whole");
  return tokens_[next_++];
}

std::string PbrtFile::string(const Location& where) {
  const PbrtToken& t = token(where);
  if (!t.quoted) throw bad_input(t.where, "\"" + t.text + "\" is no string", "expected a text in quotes");
  return t.text;
}

std::vector<double> PbrtFile::numbers(const Location& where, std::size_t count) {
  PbrtParameter list{{}, "the transform", {}, where};
  const bool bracket = !ended() && tokens_[next_].text == "[";
  if (bracket) ++next_;
  while (list.values.size() < count) list.values.push_back(token(where).text);
  if (bracket && token(where).text != "]")
    throw bad_input(where, "has too many numbers", fmt::format("expected {}", count));
  return list.numbers();
}

PbrtParameters PbrtFile::parameters(const Location& where) {
  PbrtParameters result{{}, where};
  while (string_follows()) {
    const PbrtToken& declared = tokens_[next_++];
    const std::size_t space = declared.text.find_first_of(" \t"), name = declared.text.find_first_not_of(" \t", space);
    if (space == std::string::npos || name == std::string::npos)
      throw bad_input(declared.where, "\"" + declared.text + "\" is no parameter", "expected \"type name\"");
    PbrtParameter p{declared.text.substr(0, space), declared.text.substr(name), {}, declared.where};
    p.name.erase(p.name.find_last_not_of(" \t") + 1);
    const auto is_bracket = [](const PbrtToken& t, const char* bracket) { return !t.quoted && t.text == bracket; };
    if (const PbrtToken* value = &token(declared.where); !is_bracket(*value, "["))
      p.values.push_back(value->text);
    else
      while (!is_bracket(*(value = &token(declared.where)), "]")) p.values.push_back(value->text);
    result.all.push_back(std::move(p));
  }
  return result;
}

} // namespace nephroid::formats
