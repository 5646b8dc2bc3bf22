// SPDX-License-Identifier: Apache-2.0
// Names and their values: POV-Ray's dynamic stack of tables, main file < include < macro call.
#pragma once
#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
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

/// Every name has a stack of bindings, innermost last: finding one takes the same time at any
/// depth.
class Symbols {
 public:
  explicit Symbols(Total memory) : memory_(std::move(memory)) { push(); }
  void push() { tables_.emplace_back(); }
  void pop() {
    *memory_ -= kEntry * std::int64_t(tables_.back().size());
    for (const std::string* name : tables_.back()) stacks_.find(name)->second.pop_back();
    tables_.pop_back();
  }

  /// The nearest binding, or null.
  Cell find(const std::string* name) const {
    const Binding* nearest = nearestOf(name);
    return nearest ? nearest->cell : nullptr;
  }
  /// #declare: the nearest binding, else a new global one.
  Cell declare(const std::string* name) { return in(tableOf(name), name); }
  /// A parameter of a macro: a binding to the argument in the innermost table.
  void bind(const std::string* name, Cell cell) { at(innermost(), name) = std::move(cell); }
  /// #local: a binding in the innermost table.
  Cell local(const std::string* name) { return in(innermost(), name); }

  std::size_t innermost() const { return tables_.size() - 1; }
  /// The table with the nearest binding, else the global one.
  std::size_t tableOf(const std::string* name) const {
    const Binding* nearest = nearestOf(name);
    return nearest ? nearest->table : 0;
  }
  /// The binding in one table, made if there is none. A table that has been left: the innermost.
  Cell in(std::size_t table, const std::string* name) {
    Cell& cell = at(std::min(table, innermost()), name);
    if (!cell) cell = std::make_shared<Symbol>();
    return cell;
  }
  /// #undef: the nearest binding; false if there is none.
  bool undefine(const std::string* name) {
    const Binding* nearest = nearestOf(name);
    if (!nearest) return false;
    tables_[nearest->table].erase(name);
    stacks_.find(name)->second.pop_back();
    *memory_ -= kEntry;
    return true;
  }
  /// Every visible name, for "did you mean".
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& [name, stack] : stacks_)
      if (!stack.empty()) all.push_back(*name);
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  struct Binding {
    std::size_t table;
    Cell cell;
  };
  /// Bytes of a binding and its cell, without what the value refers to.
  static constexpr std::int64_t kEntry = sizeof(Symbol) + 80;
  /// Bytes of a name's stack, which stays when its bindings are gone.
  static constexpr std::int64_t kStack = 96;

  const Binding* nearestOf(const std::string* name) const {
    const auto found = stacks_.find(name);
    return found == stacks_.end() || found->second.empty() ? nullptr : &found->second.back();
  }
  /// The cell of a binding in one table; null in a new one.
  Cell& at(std::size_t table, const std::string* name) {
    const auto [found, isNew] = stacks_.try_emplace(name);
    if (isNew) *memory_ += kStack;
    std::vector<Binding>& stack = found->second;
    auto place = stack.end();
    while (place != stack.begin() && std::prev(place)->table > table) --place;
    if (place != stack.begin() && std::prev(place)->table == table) return std::prev(place)->cell;
    *memory_ += kEntry;
    tables_[table].insert(name);
    return stack.insert(place, {table, nullptr})->cell;
  }

  Total memory_;
  std::unordered_map<const std::string*, std::vector<Binding>> stacks_;
  std::vector<std::unordered_set<const std::string*>> tables_;  ///< the names bound in each
};

}  // namespace vestige::lang
