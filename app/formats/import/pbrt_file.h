// SPDX-License-Identifier: Apache-2.0
// The words of a PBRT file and of those that it includes, with their lines, and the parameters of its directives.
#pragma once
#include "base/location.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::formats {

struct PbrtToken {
  std::string text;    ///< without the quotes
  bool quoted = false; ///< a string
  Location where;
};

struct PbrtParameter {
  std::string type, name;
  std::vector<std::string> values;
  Location where;
  mutable bool was_asked_for = false;  ///< by PbrtParameters::find
  std::vector<double> numbers() const; ///< throws bad_input where one is no number
};

/// The parameters of a directive.
struct PbrtParameters {
  std::vector<PbrtParameter> all;
  Location where; ///< the directive's
  const PbrtParameter* find(const std::string& name) const;
  std::string text(const std::string& name, const std::string& standard) const;
  double number(const std::string& name, double standard) const;
  glm::dvec3 vector(const std::string& name, const glm::dvec3& standard) const;
  /// Those that nothing asked for.
  std::vector<PbrtParameter> unasked() const;
  /// Those that are not among these, as values where these say none.
  void add_missing(const std::vector<PbrtParameter>& more);
};

/// Reads the tokens in sequence. `where` is the place of the directive that needs one: bad_input names it if the file
/// ends.
class PbrtFile {
public:
  /// Throws bad_input at FILE:LINE: a string without an end, a file that is not there or includes itself.
  /// Files may be packed as .gz.
  explicit PbrtFile(const std::filesystem::path& file);

  /// A file that a token names: beside the scene, as PBRT has it, or beside the file that has the name.
  std::filesystem::path find(const std::string& name, const Location& where) const;

  bool ended() const { return next_ == tokens_.size(); }
  bool string_follows() const { return !ended() && tokens_[next_].quoted; }
  const PbrtToken& token(const Location& where);
  std::string string(const Location& where);
  /// As many numbers, with or without brackets.
  std::vector<double> numbers(const Location& where, std::size_t count);
  PbrtParameters parameters(const Location& where);

private:
  void read(const std::filesystem::path& file);
  void include_if_asked();

  std::filesystem::path scene_;
  std::vector<std::filesystem::path> open_; ///< the files that are being read, each included by the one before
  std::vector<PbrtToken> tokens_;
  std::size_t next_ = 0;
};

} // namespace nephroid::formats
