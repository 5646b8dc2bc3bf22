// SPDX-License-Identifier: Apache-2.0
// Names and their values: POV-Ray's dynamic stack of tables, main file < include < macro call.
#pragma once
#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lang/lexer.h"
#include "lang/value.h"

namespace vestige::lang {

/// A macro is a range of tokens; names in its body are looked up in the caller's tables.
struct Macro {
  struct Parameter {
    const Name* name;
    Span declared;
    bool isOptional = false;
    Datum initial =
        {};  ///< default of an optional one; monostate: undefined in the body if omitted
  };
  const Name* name;
  std::vector<Parameter> parameters;
  const TokenList* list;
  std::uint32_t begin, end;  ///< the body's tokens
  Span declared;
};

struct ElementOf;
struct Symbol {
  Datum value;
  Span declared;
  /// Of a macro's parameter that stands for an element of an array; null: `value` counts.
  std::shared_ptr<const ElementOf> element = nullptr;
};
/// Shared between a name and the macro parameters that refer to it.
using Cell = std::shared_ptr<Symbol>;

/// An element of an array, of an array in it, and so on.
struct ElementOf {
  Cell array;
  std::vector<std::size_t> places;  ///< in Array::data, outermost first
};

/// The value that a name has now. If the array of its element is gone, the one that it had first.
inline const Datum& valueOf(const Symbol& symbol) {
  if (!symbol.element) return symbol.value;
  const Datum* place = &valueOf(*symbol.element->array);
  for (const std::size_t i : symbol.element->places) {
    const auto* array = std::get_if<ArrayPtr>(place);
    if (!array || i >= (*array)->data.size()) return symbol.value;
    place = &(*array)->data[i];
  }
  return *place;
}

/// Every name has a stack of bindings, innermost last: finding one takes the same time at any
/// depth.
class Symbols {
 public:
  explicit Symbols(Total memory) : memory_(std::move(memory)) { push(); }
  void push() { tables_.emplace_back(); }
  void pop() {
    const std::size_t table = innermost();
    for (const std::uint32_t id : tables_.back())
      if (auto& stack = stacks_[id]; !stack.empty() && stack.back().table == table) drop(stack);
    *memory_ -= std::int64_t(tables_.back().capacity() * sizeof(std::uint32_t));
    tables_.pop_back();
  }

  /// The nearest binding, or null.
  Cell find(const Name* name) const {
    const Binding* nearest = nearestOf(name);
    return nearest ? nearest->cell : nullptr;
  }
  /// The value of the nearest binding, or null.
  const Datum* value(const Name* name) const {
    const Binding* nearest = nearestOf(name);
    return nearest ? &valueOf(*nearest->cell) : nullptr;
  }
  /// The binding in one table, or null.
  Cell findIn(std::size_t table, const Name* name) const {
    const Binding* found = bindingIn(table, name);
    return found ? found->cell : nullptr;
  }
  bool isMacro(const Name* name) const {
    const Datum* d = value(name);
    return d && std::holds_alternative<MacroPtr>(*d);
  }
  /// #declare: the nearest binding, else a new global one.
  Cell declare(const Name* name) { return in(tableOf(name), name); }
  /// A parameter of a macro: a binding to the argument in the innermost table.
  void bind(const Macro::Parameter& parameter, Cell cell) {
    Binding& made = at(innermost(), parameter.name);
    made.cell = std::move(cell);
    made.parameter = parameter.declared;
  }
  /// Where the nearest binding was declared; of a parameter, in the macro's head. Nothing if there
  /// is none.
  std::optional<Span> declaration(const Name* name) const {
    const Binding* nearest = nearestOf(name);
    return nearest ? std::optional(declarationOf(*nearest)) : std::nullopt;
  }
  /// The same of the binding in one table.
  std::optional<Span> declarationIn(std::size_t table, const Name* name) const {
    const Binding* found = bindingIn(table, name);
    return found ? std::optional(declarationOf(*found)) : std::nullopt;
  }
  /// #local: a binding in the innermost table.
  Cell local(const Name* name) { return in(innermost(), name); }

  std::size_t innermost() const { return tables_.size() - 1; }
  /// The table with the nearest binding, else the global one.
  std::size_t tableOf(const Name* name) const {
    const Binding* nearest = nearestOf(name);
    return nearest ? nearest->table : 0;
  }
  /// The binding in one table, made if there is none. A table that has been left: the innermost.
  Cell in(std::size_t table, const Name* name) {
    Cell& cell = at(std::min(table, innermost()), name).cell;
    if (!cell) cell = std::make_shared<Symbol>();
    return cell;
  }
  /// #undef: the nearest binding; false if there is none.
  bool undefine(const Name* name) {
    const Binding* nearest = nearestOf(name);
    if (!nearest) return false;
    // Most often the latest one: a loop that declares and forgets leaves nothing behind.
    if (auto& bound = tables_[nearest->table]; bound.back() == name->id) bound.pop_back();
    drop(stacks_[name->id]);
    return true;
  }
  /// #undef in one table; false if it does not bind the name.
  bool undefineIn(std::size_t table, const Name* name) {
    if (!findIn(table, name)) return false;
    auto& stack = stacks_[name->id];
    stack.erase(std::find_if(stack.begin(), stack.end(),
                             [table](const Binding& b) { return b.table == table; }));
    *memory_ -= kEntry;
    return true;
  }
  /// Every visible name, for "did you mean".
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& stack : stacks_)
      if (!stack.empty()) all.push_back(*stack.back().name);
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  struct Binding {
    std::size_t table;
    const Name* name;
    Cell cell;
    Span parameter = {};  ///< in the head of a macro; nowhere: not a parameter
  };
  /// Bytes of a binding and its cell, without what the value refers to.
  static constexpr std::int64_t kEntry = sizeof(Symbol) + 96;

  const Binding* nearestOf(const Name* name) const {
    return name->id >= stacks_.size() || stacks_[name->id].empty() ? nullptr
                                                                   : &stacks_[name->id].back();
  }
  const Binding* bindingIn(std::size_t table, const Name* name) const {
    if (nearestOf(name))
      for (const Binding& b : stacks_[name->id])
        if (b.table == table) return &b;
    return nullptr;
  }
  static Span declarationOf(const Binding& b) {
    return b.parameter.file >= 0 ? b.parameter : b.cell->declared;
  }
  void drop(std::vector<Binding>& stack) {
    stack.pop_back();
    *memory_ -= kEntry;
  }
  /// The binding in one table; a new one has no cell.
  Binding& at(std::size_t table, const Name* name) {
    if (name->id >= stacks_.size()) grow(name->id);
    std::vector<Binding>& stack = stacks_[name->id];
    auto place = stack.end();
    while (place != stack.begin() && std::prev(place)->table > table) --place;
    if (place != stack.begin() && std::prev(place)->table == table) return *std::prev(place);
    *memory_ += kEntry;
    auto& names = tables_[table];
    const std::size_t before = names.capacity();
    names.push_back(name->id);
    *memory_ += std::int64_t((names.capacity() - before) * sizeof(std::uint32_t));
    return *stack.insert(place, {table, name, nullptr});
  }
  void grow(std::uint32_t id) {
    const std::size_t before = stacks_.capacity();
    stacks_.resize(std::size_t(id) + 1);
    *memory_ += std::int64_t((stacks_.capacity() - before) * sizeof stacks_[0]);
  }

  Total memory_;
  std::vector<std::vector<Binding>> stacks_;  ///< by the name's id, innermost last
  /// The ids of the names bound in each table. Those undefined since are left in.
  std::vector<std::vector<std::uint32_t>> tables_;
};

}  // namespace vestige::lang
