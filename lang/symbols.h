// SPDX-License-Identifier: Apache-2.0
// Names and their values: POV-Ray's dynamic stack of tables, main file < include < macro call.
#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lang/lexer.h"
#include "lang/value.h"

namespace vestige::lang {

/// A macro is a range of tokens; names in its body are looked up in the caller's tables.
struct Macro {
  struct Parameter {
    const std::string* name;
    bool isOptional = false;
    Datum initial =
        {};  ///< default of an optional one; monostate: undefined in the body if omitted
  };
  const std::string* name;
  std::vector<Parameter> parameters;
  const TokenList* list;
  std::uint32_t begin, end;  ///< the body's tokens
  Span declared;
};

struct Symbol {
  Datum value;
  Span declared;
};
/// Shared between a name and the macro parameters that refer to it.
using Cell = std::shared_ptr<Symbol>;

class Symbols {
 public:
  using Table = std::unordered_map<const std::string*, Cell>;

  explicit Symbols(Total memory) : memory_(std::move(memory)) { push(); }
  void push() { tables_.emplace_back(); }
  void pop() {
    *memory_ -= kEntry * std::int64_t(top().size());
    tables_.pop_back();
  }
  Table& top() { return tables_.back(); }

  /// The nearest binding, or null.
  Cell find(const std::string* name) const {
    for (auto t = tables_.rbegin(); t != tables_.rend(); ++t)
      if (const auto found = t->find(name); found != t->end()) return found->second;
    return nullptr;
  }
  /// #declare: the nearest binding, else a new global one.
  Cell declare(const std::string* name) { return in(tableOf(name), name); }
  /// A parameter of a macro: a binding to the argument in the innermost table.
  void bind(const std::string* name, Cell cell) {
    if (top().insert_or_assign(name, std::move(cell)).second) *memory_ += kEntry;
  }
  /// #local: a binding in the innermost table.
  Cell local(const std::string* name) { return in(innermost(), name); }

  std::size_t innermost() const { return tables_.size() - 1; }
  /// The table with the nearest binding, else the global one.
  std::size_t tableOf(const std::string* name) const {
    for (std::size_t t = innermost(); t > 0; --t)
      if (tables_[t].count(name)) return t;
    return 0;
  }
  /// The binding in one table, made if there is none. A table that has been left: the innermost.
  Cell in(std::size_t table, const std::string* name) {
    Table& t = tables_[std::min(table, innermost())];
    if (const auto found = t.find(name); found != t.end()) return found->second;
    *memory_ += kEntry;
    return t[name] = std::make_shared<Symbol>();
  }
  /// #undef: the nearest binding; false if there is none.
  bool undefine(const std::string* name) {
    for (auto t = tables_.rbegin(); t != tables_.rend(); ++t)
      if (t->erase(name) > 0) {
        *memory_ -= kEntry;
        return true;
      }
    return false;
  }
  /// Every visible name, for "did you mean".
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const Table& t : tables_)
      for (const auto& [name, cell] : t) all.push_back(*name);
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  /// Bytes of a name's entry and its cell, without what the value refers to.
  static constexpr std::int64_t kEntry = sizeof(Symbol) + 80;
  Total memory_;
  std::vector<Table> tables_;
};

}  // namespace vestige::lang
