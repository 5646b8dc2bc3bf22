// SPDX-License-Identifier: Apache-2.0
// Diagnostics while parsing: deduplicated, limited, and the exceptions used for recovery.
#pragma once
#include <set>
#include <string>
#include <tuple>

#include <vestige/diagnostic.h>

namespace vestige::lang {

/// A syntax error. Already reported; caught where parsing can continue.
struct SyntaxError {};
/// Ends the parsing (a limit is reached, #error). Already reported; caught in lang.cpp.
struct Stop {};

class Reporter {
 public:
  Reporter(Diagnostics& diagnostics, int mostErrors)
      : diagnostics_(diagnostics), mostErrors_(mostErrors) {}

  /// Reports an error. The same message at the same place, as in a loop, is reported once.
  Diagnostic& error(const Span& span, const std::string& message) {
    if (!isNew(span, message)) return ignored_;
    if (diagnostics_.errors() >= mostErrors_) {
      diagnostics_.error(span,
                         "too many errors, the rest is not shown: --max-errors raises the "
                         "limit of " +
                             std::to_string(mostErrors_));
      throw Stop{};
    }
    return diagnostics_.error(span, message);
  }
  Diagnostic& warning(const Span& span, const std::string& message) {
    if (!isNew(span, message) || warnings_ >= kMostWarnings) return ignored_;
    ++warnings_;
    return diagnostics_.warning(span, message);
  }
  [[noreturn]] void syntaxError(const Span& span, const std::string& message) {
    error(span, message);
    throw SyntaxError{};
  }
  [[noreturn]] void stop(const Span& span, const std::string& message) {
    error(span, message);
    throw Stop{};
  }

 private:
  static constexpr int kMostWarnings = 100;
  bool isNew(const Span& span, const std::string& message) {
    ignored_ = {};
    return seen_.emplace(span.file, span.begin, message).second;
  }

  Diagnostics& diagnostics_;
  int mostErrors_;
  int warnings_ = 0;
  std::set<std::tuple<std::int32_t, std::uint32_t, std::string>> seen_;
  Diagnostic ignored_;  ///< receives the notes of a repeated error
};

/// "; did you mean 'x'?", or nothing.
inline std::string didYouMean(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearestWord(word, known);
  return near.empty() || near == word ? "" : "; did you mean '" + near + "'?";
}

}  // namespace vestige::lang
