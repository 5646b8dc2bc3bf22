// SPDX-License-Identifier: Apache-2.0
// State shared by all parts of the parser.
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>

#include "lang/budget.h"
#include "lang/events.h"
#include "lang/lang.h"
#include "lang/lexer.h"
#include "lang/report.h"
#include "lang/source.h"
#include "lang/symbols.h"

namespace vestige::lang {

/// A level of braces or parentheses takes about 3 kB of the stack of 8 MB (on Linux), twice that
/// with a sanitizer.
inline constexpr int kDeepestNesting = 1000;

/// The texts of -D are called by this and the name that they declare.
inline const std::string kDefinition = "-D ";

/// '#declare deprecated': what is said where the name is used.
struct Deprecation {
  std::string message;
  bool isOnce = false;  ///< said at the first use only
};

struct Context {
  Context(const Options& o, Sources& t, Diagnostics& d, Edits& e)
      : options(o), sources(t), reporter(d, e, o.limits.errors), budget(o.limits, reporter) {
    sources.countOn(budget.bytes());
  }

  const Options& options;
  Sources& sources;
  Reporter reporter;
  Budget budget;
  Names names{budget.bytes()};
  Symbols symbols{budget.bytes()};
  Events events{options.observer, symbols};
  double version = 3.7;  ///< set by #version, returned by `version`; has no other effect
  std::vector<std::uint32_t> streams;  ///< states of rand(), by what seed() returned
  std::unordered_map<const Name*, Deprecation> deprecations;
  int evaluating = 0;       ///< depth of functions' trees that are evaluated or compiled
  int nesting = 0;          ///< depth of braces, parentheses and calls: bounds our own stack
  std::int64_t blocks = 0;  ///< number created so far, copies included
  Total elements =
      std::make_shared<std::atomic<std::int64_t>>(0);  ///< elements in live arrays and lists
  std::function<bool(const std::string&)> fileExists;
  /// The element or entry that follows the name of this value, to be assigned to; null after an
  /// error.
  std::function<Datum*(Symbol&)> placeBehind;
  Numbers tracedNormal;  ///< of the last trace()
  /// The file in the include paths that declares a name, or "".
  std::function<std::string(const std::string&)> declaredIn;

  /// Greatest depth of nesting: the user's limit, but no more than the stack allows.
  int deepest() const { return std::min(options.limits.nesting, kDeepestNesting); }
  [[noreturn]] void stopTooDeep(const Span& span, const std::string& whatIs) {
    reporter.stop(span,
                  whatIs + " nested more than " + std::to_string(deepest()) + " deep" +
                      (options.limits.nesting < kDeepestNesting ? ": --max-nesting raises the limit"
                                                                : ", the built-in maximum"));
  }
  void checkElements(const Span& span) {
    if (*elements > std::int64_t(options.limits.arrayElements)) stopAtElements(span);
  }
  [[noreturn]] void stopAtElements(const Span& span) {
    reporter.stop(span, "the arrays and lists of this scene have more than " +
                            std::to_string(options.limits.arrayElements) +
                            " elements: --max-array-elements raises the limit");
  }
  void step(const Span& span, std::int64_t count = 1) { budget.step(span, count); }
  /// A declared name stands here.
  void used(const Token& name) {
    events.used(name);
    warnOfDeprecation(name);
  }
  void warnOfDeprecation(const Token& name) {
    if (deprecations.empty()) return;
    const auto found = deprecations.find(name.text);
    if (found == deprecations.end()) return;
    reporter.warning(name.span, found->second.message);
    if (found->second.isOnce) deprecations.erase(found);
  }
  /// "; did you mean 'x'?" for a misspelt word, which the edit of the next diagnostic replaces; or
  /// nothing. Comparing it with each name is work.
  std::string suggest(const Span& span, const std::string& word,
                      const std::vector<std::string>& known) {
    constexpr std::int64_t kStepsAName = 8;
    step(span, kStepsAName * std::int64_t(known.size()));
    const std::string near = nearestWord(word, known);
    if (near.empty() || near == word) return "";
    reporter.offer(span, near);
    return "; did you mean '" + near + "'?";
  }
};

/// Increases the nesting depth during its lifetime.
class Nested {
 public:
  Nested(Context& c, const Span& span) : context_(c) {
    if (c.nesting >= c.deepest()) c.stopTooDeep(span, "this is");
    ++c.nesting;
  }
  ~Nested() { --context_.nesting; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;

 private:
  Context& context_;
};

/// The same in the tree of a function, which may call others.
class Deeper {
 public:
  Deeper(Context& c, const Span& span) : context_(c) {
    // An expression in parentheses takes several levels of its tree.
    constexpr int kLevelsPerNesting = 4;
    if (c.evaluating > c.deepest() * kLevelsPerNesting) c.stopTooDeep(span, "these functions are");
    ++c.evaluating;
  }
  ~Deeper() { --context_.evaluating; }
  Deeper(const Deeper&) = delete;
  Deeper& operator=(const Deeper&) = delete;

 private:
  Context& context_;
};

}  // namespace vestige::lang
