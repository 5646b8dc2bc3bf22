// SPDX-License-Identifier: Apache-2.0
// The tokens for the parser: macros expanded, includes opened, directives executed.
#pragma once
#include <functional>
#include <vector>

#include "lang/context.h"

namespace vestige::lang {

/// A construct (from a directive to its #end) that is being read.
struct OpenDirective {
  enum class Kind { branch, whileLoop, forLoop, choice };
  Kind kind = Kind::branch;
  std::uint32_t first = 0;     ///< index of the directive that opened it
  Cell counter = {};           ///< the variable of #for, with its last value and step
  const Name* name = nullptr;  ///< of the counter
  double last = 0, step = 1;
  std::uint32_t body = 0;      ///< of #for: index of the token behind the head
  double value = 0;            ///< of #switch
  bool isBeforeCases = false;  ///< of #switch: the first #case chooses
  bool isLastPart = false;     ///< of #if: #else has been read
};

/// A text or a macro's body that is being read.
struct Frame {
  enum class Kind { file, macro };
  Kind kind = Kind::file;
  const TokenList* list = nullptr;
  std::uint32_t at = 0, end = 0;  ///< next token, one past the last
  int via = -1;                   ///< Expansion that leads here, for spans
  int file = -1;                  ///< index in Sources of a file, else -1
  std::vector<OpenDirective> open = {};

  Token token(std::uint32_t i) const { return list->token(i, via); }
};

class TokenStream {
 public:
  explicit TokenStream(Context& context) : context_(context) {}

  /// Called for each directive that is reached. May read further tokens and may move the frame.
  std::function<void(const Token&)> onDirective;
  /// Called for each macro's name; makes the stream read the body.
  std::function<void(const Token&)> onMacro;

  void push(Frame frame);
  Frame& frame() { return frames_.back(); }
  const std::vector<Frame>& frames() const { return frames_; }
  int macroDepth() const { return macroDepth_; }
  /// Leaves the innermost frame with its names.
  void pop();

  /// The next token, after all directives and macros before it. `end` at the end, for ever.
  const Token& peek() {
    if (!hasNext_) fetch();
    return next_;
  }
  Token next();
  bool accept(const char* sign);

  /// The next token without executing directives or expanding macros. May look several tokens
  /// ahead, through the ends of macros.
  Token peekRaw(int ahead = 0) const;
  /// The sign of peekRaw(); 0: it is not a sign.
  std::uint16_t rawSign() const { return hasNext_ ? next_.sign : stored().sign; }
  /// Whether peekRaw() is a directive.
  bool isRawDirective() const { return !hasNext_ && stored().kind == Token::Kind::directive; }
  Token nextRaw();
  bool acceptRaw(const char* sign);

  /// The end of the last token read: the place to report a missing ';'.
  Span behindLast() const;
  const Span& last() const { return last_; }
  /// Number of tokens read: shows whether a step made progress.
  std::int64_t taken() const { return taken_; }
  /// Number of '{' minus number of '}' read.
  int braces() const { return braces_; }
  /// Discards the lookahead token: the frame is about to move.
  void drop() { hasNext_ = false; }

 private:
  void fetch();
  /// The next token of the frames.
  const StoredToken& stored() const {
    const Frame& f = frames_.back();
    return f.at < f.end ? f.list->tokens[f.at] : storedBeyond();
  }
  const StoredToken& storedBeyond() const;
  /// Takes the next raw token from the frames, leaving those that are at their end.
  void advance(Token& t);
  Token take();

  Context& context_;
  std::vector<Frame> frames_;
  bool hasNext_ = false;
  Token next_;
  Span last_;
  std::int64_t taken_ = 0;
  int braces_ = 0;
  int macroDepth_ = 0;
};

}  // namespace vestige::lang
