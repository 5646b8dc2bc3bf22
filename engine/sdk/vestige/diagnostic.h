// SPDX-License-Identifier: Apache-2.0
// Errors, warnings and notes with their places: the one type by which the language, the engine and
// the plugins' host report to the user. `app` prints it with the line and a caret.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace vestige {

/// A piece of scene text. Indices refer to the text's own tables (lang/source.h); the engine only
/// hands spans on.
struct Span {
  std::int32_t file = -1;            ///< -1: nowhere in a text
  std::uint32_t begin = 0, end = 0;  ///< byte offsets, half open
  std::int32_t via = -1;             ///< the macro call or include that led here; -1: none
};

enum class Severity { error, warning, note };

struct Note {
  Span span;
  std::string message;
};

struct Diagnostic {
  Severity severity = Severity::error;
  Span span;
  std::string message;      ///< one sentence in the user's words, no full stop
  std::vector<Note> notes;  ///< "to close '{'", "first declared here", ...
};

/// A list of diagnostics in the order of their reports.
class Diagnostics {
 public:
  Diagnostic& error(Span span, std::string message) {
    ++errors_;
    return list_.emplace_back(Diagnostic{Severity::error, span, std::move(message), {}});
  }
  Diagnostic& warning(Span span, std::string message) {
    return list_.emplace_back(Diagnostic{Severity::warning, span, std::move(message), {}});
  }
  /// A note about something that is not a mistake: --werror does not turn it into an error.
  Diagnostic& note(Span span, std::string message) {
    return list_.emplace_back(Diagnostic{Severity::note, span, std::move(message), {}});
  }
  bool hasErrors() const noexcept { return errors_ > 0; }
  int errors() const noexcept { return errors_; }
  int warnings() const noexcept {
    return int(std::count_if(list_.begin(), list_.end(),
                             [](const Diagnostic& d) { return d.severity == Severity::warning; }));
  }
  const std::vector<Diagnostic>& list() const noexcept { return list_; }

 private:
  std::vector<Diagnostic> list_;
  int errors_ = 0;
};

/// The known word nearest to a misspelt one, or "" if none is near (at most a third of the letters
/// differ, counting insertions, deletions, changes and swaps).
inline std::string nearestWord(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t bestCost = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& k : known) {
    const std::size_t n = word.size(), m = k.size();
    std::vector<std::vector<std::size_t>> d(n + 1, std::vector<std::size_t>(m + 1));
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= m; ++j) {
        if (i == 0 || j == 0) {
          d[i][j] = i + j;
          continue;
        }
        d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1,
                            d[i - 1][j - 1] + (word[i - 1] == k[j - 1] ? 0 : 1)});
        if (i > 1 && j > 1 && word[i - 1] == k[j - 2] && word[i - 2] == k[j - 1])
          d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    if (d[n][m] < bestCost) bestCost = d[n][m], best = k;
  }
  return best;
}

}  // namespace vestige
