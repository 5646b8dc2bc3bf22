// SPDX-License-Identifier: Apache-2.0
// Diagnostics while parsing: deduplicated, limited, and the exceptions used for recovery.
#pragma once
#include <string>
#include <string_view>
#include <unordered_set>

#include <vestige/diagnostic.h>

#include "lang/edit.h"

namespace vestige::lang {

/// A syntax error. Already reported; caught where parsing can continue.
struct SyntaxError {};
/// Ends the parsing (a limit is reached, #error). Already reported; caught in lang.cpp.
struct Stop {};

class Reporter {
 public:
  Reporter(Diagnostics& diagnostics, Edits& edits, int mostErrors)
      : diagnostics_(diagnostics), edits_(edits), mostErrors_(mostErrors) {}

  /// The edit that mends what is reported next; it is forgotten if that is a repetition.
  void offer(const Span& span, std::string text) {
    offered_ = {Edit{diagnostics_.list().size(), span, std::move(text)}};
  }
  void withdraw() { offered_.clear(); }

  /// During its lifetime errors and warnings are discarded; a limit still stops the reading.
  class Muted {
   public:
    explicit Muted(Reporter& reporter, bool isMuted = true)
        : reporter_(reporter), before_(reporter.isMuted_) {
      reporter.isMuted_ |= isMuted;
    }
    ~Muted() { reporter_.isMuted_ = before_; }
    Muted(const Muted&) = delete;
    Muted& operator=(const Muted&) = delete;

   private:
    Reporter& reporter_;
    bool before_;
  };

  /// Reports an error. The same message at the same place, as in a loop, is reported once.
  Diagnostic& error(const Span& span, const std::string& message) {
    if (isMuted_) return discarded();
    fail();
    return errorAhead(span, message);
  }
  /// Reports an error in a part of the text that is not reached yet. Reaching it must fail().
  Diagnostic& errorAhead(const Span& span, const std::string& message) {
    const Edits offered = std::move(offered_);
    offered_.clear();
    if (!isNew(span, message)) {
      if (++repeats_ > kMostRepeats) throw Stop{};  // has been reported, and costs time
      return discarded();
    }
    if (diagnostics_.errors() >= mostErrors_) {
      diagnostics_.error(span,
                         "too many errors, the rest is not shown: --max-errors raises the "
                         "limit of " +
                             std::to_string(mostErrors_));
      throw Stop{};
    }
    edits_.insert(edits_.end(), offered.begin(), offered.end());
    return diagnostics_.error(span, shortened(message));
  }
  Diagnostic& warning(const Span& span, const std::string& message) {
    if (isMuted_) return discarded();
    const Edits offered = std::move(offered_);
    offered_.clear();
    if (warnings_ >= kMostWarnings || !isNew(span, message)) return discarded();
    ++warnings_;
    edits_.insert(edits_.end(), offered.begin(), offered.end());
    return diagnostics_.warning(span, shortened(message));
  }
  void fail() { hasFailed_ = true; }
  /// Whether reading has come to an error: POV-Ray would have stopped there.
  bool hasFailed() const { return hasFailed_; }
  [[noreturn]] void syntaxError(const Span& span, const std::string& message) {
    error(span, message);
    throw SyntaxError{};
  }
  [[noreturn]] void stop(const Span& span, const std::string& message) {
    isMuted_ = false;
    error(span, message);
    throw Stop{};
  }

 private:
  static constexpr int kMostWarnings = 100;
  static constexpr int kMostRepeats = 10'000;  ///< of errors, as in a long loop
  static constexpr std::size_t kLongestMessage = 4000;

  /// Only a hash is kept: a message may quote a long string.
  bool isNew(const Span& span, const std::string& message) {
    const std::size_t place = std::size_t(span.file) << 32 | span.begin;
    const std::size_t hash = std::hash<std::string_view>()(message);
    return seen_.insert(hash ^ place * 0x9E3779B97F4A7C15ull).second;
  }
  Diagnostic& discarded() { return ignored_ = {}; }
  static std::string shortened(const std::string& message) {
    if (message.size() <= kLongestMessage) return message;
    return message.substr(0, kLongestMessage) + "...";
  }

  Diagnostics& diagnostics_;
  Edits& edits_;
  Edits offered_;  ///< none or one
  int mostErrors_;
  bool isMuted_ = false;
  int warnings_ = 0;
  bool hasFailed_ = false;
  int repeats_ = 0;
  std::unordered_set<std::size_t> seen_;
  Diagnostic ignored_;  ///< receives the notes of a repeated error
};

}  // namespace vestige::lang
