// SPDX-License-Identifier: Apache-2.0
#include "lang/stream.h"

namespace vestige::lang {

void TokenStream::push(Frame frame) {
  if (!frames_.empty()) context_.symbols.push();  // the main file's table is the global one
  if (frame.kind == Frame::Kind::macro) ++macroDepth_;
  frames_.push_back(std::move(frame));
}

void TokenStream::pop() {
  if (frame().kind == Frame::Kind::macro) --macroDepth_;
  frames_.pop_back();
  context_.symbols.pop();
}

void TokenStream::advance(Token& t) {
  while (frame().at >= frame().end && frames_.size() > 1) pop();
  Frame& f = frame();
  const bool isAtEnd = f.at >= f.end;
  f.list->get(isAtEnd ? std::uint32_t(f.list->tokens.size() - 1) : f.at, f.via, t);
  if (isAtEnd) return;
  ++f.at;
  context_.step(t.span);
}

void TokenStream::fetch() {
  while (!hasNext_) {
    advance(next_);
    if (next_.kind == Token::Kind::directive)
      onDirective(Token(next_));
    else if (next_.isName() && context_.symbols.isMacro(next_.text))
      onMacro(Token(next_));
    else
      hasNext_ = true;
  }
}

Token TokenStream::take() {
  hasNext_ = false;
  last_ = next_.span;
  ++taken_;
  if (next_.is("{")) ++braces_;
  if (next_.is("}")) --braces_;
  return next_;
}

Token TokenStream::next() {
  peek();
  return take();
}

bool TokenStream::accept(const char* sign) {
  if (!peek().is(sign)) return false;
  next();
  return true;
}

Token TokenStream::peekRaw(int ahead) const {
  if (hasNext_ && ahead-- == 0) return next_;
  for (std::size_t f = frames_.size(); f-- > 0;) {
    const Frame& frame = frames_[f];
    const auto left = int(frame.end - std::min(frame.at, frame.end));
    if (ahead < left) return frame.token(frame.at + std::uint32_t(ahead));
    ahead -= left;
  }
  const Frame& bottom = frames_.front();
  return bottom.token(std::uint32_t(bottom.list->tokens.size() - 1));
}

/// The innermost frame is at its end.
const StoredToken& TokenStream::storedBeyond() const {
  for (std::size_t f = frames_.size() - 1; f-- > 0;)
    if (frames_[f].at < frames_[f].end) return frames_[f].list->tokens[frames_[f].at];
  return frames_.front().list->tokens.back();
}

Token TokenStream::nextRaw() {
  if (!hasNext_) advance(next_);
  return take();
}

bool TokenStream::acceptRaw(const char* sign) {
  if (rawSign() != signCode(sign)) return false;
  nextRaw();
  return true;
}

Span TokenStream::behindLast() const {
  Span s = last_;
  s.begin = s.end;
  return s;
}

}  // namespace vestige::lang
