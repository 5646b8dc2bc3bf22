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

/// Longer words get no suggestion: a search through all names must cost little.
inline constexpr std::size_t kLongestGuess = 64;

/// The number of insertions, deletions, changes and swaps that turn one word into the other;
/// `bound` if there are that many or more. Both words have at most kLongestGuess letters.
inline std::size_t editDistance(const std::string& a, const std::string& b, std::size_t bound) {
  const std::size_t n = a.size(), m = b.size();
  if ((n < m ? m - n : n - m) >= bound) return bound;
  std::size_t rows[3][kLongestGuess + 1] = {};  // row i of the table is rows[i % 3]
  for (std::size_t j = 0; j <= m; ++j) rows[0][j] = j;
  for (std::size_t i = 1; i <= n; ++i) {
    std::size_t* const row = rows[i % 3];
    const std::size_t *const above = rows[(i + 2) % 3], *const twoAbove = rows[(i + 1) % 3];
    std::size_t least = row[0] = i;
    for (std::size_t j = 1; j <= m; ++j) {
      row[j] =
          std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], twoAbove[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    if (least >= bound) return bound;  // a swap skips a row, which costs as much
  }
  return std::min(rows[n % 3][m], bound);
}

/// The known word nearest to a misspelt one, or "" if none is near (at most a third of the letters
/// differ, counting insertions, deletions, changes and swaps).
inline std::string nearestWord(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  if (word.size() > kLongestGuess) return best;
  std::size_t bestCost = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& k : known) {
    if (k.size() > kLongestGuess) continue;
    const std::size_t cost = editDistance(word, k, bestCost);
    if (cost < bestCost) bestCost = cost, best = k;
  }
  return best;
}

}  // namespace vestige
