// SPDX-License-Identifier: Apache-2.0
// Where the parser hands events to the observer of its run. Without one each costs a branch.
#pragma once
#include "lang/observer.h"
#include "lang/symbols.h"

namespace vestige::lang {

class Events {
 public:
  Events(Observer* observer, const Symbols& symbols) : observer_(observer), symbols_(symbols) {}

  bool areWanted() const { return observer_ != nullptr; }
  void declared(const Token& name, const Datum& value) {
    if (observer_) observer_->declared(*name.text, name.span, kindOf(value));
  }
  void parameter(const Name& name, const Span& span) {
    if (observer_) observer_->declared(name, span, Declared::parameter);
  }
  /// The nearest binding of the name, if it has one.
  void used(const Token& name) {
    if (observer_) nearest(name);
  }
  void used(const Token& name, const Span& declaration) {
    if (observer_) observer_->used(*name.text, name.span, declaration);
  }
  void block(const Schema& schema, const Span& head) {
    if (observer_) observer_->block(schema, head);
  }
  void setting(const Schema& schema, const Parameter& row, const Span& span) {
    if (observer_) observer_->setting(schema, row, span);
  }
  void call(const std::string& name, const Span& span) {
    if (observer_) observer_->call(name, span);
  }
  /// The tokens from `from` up to the directive `part` are not read.
  void skipped(const TokenList& list, std::uint32_t from, std::uint32_t part, int via) {
    if (observer_ && from < part) between(list, from, part, via);
  }

 private:
  static Declared kindOf(const Datum& value);
  void nearest(const Token& name);
  void between(const TokenList& list, std::uint32_t from, std::uint32_t part, int via);

  Observer* observer_;
  const Symbols& symbols_;
};

}  // namespace vestige::lang
