// SPDX-License-Identifier: Apache-2.0
// Values that may hold values, which may hold values: they are destroyed in turn, not one inside
// the other, so that a long chain of them takes no stack.
#pragma once
#include <memory>

#include "lang/ast.h"
#include "lang/dictionary.h"
#include "lang/value.h"

namespace vestige::lang {

struct Dismantle {
  void operator()(const Array* dead) const;
  void operator()(const Dictionary* dead) const;
  void operator()(const Function* dead) const;
};

/// In place of std::make_shared for these three.
template <class T, class... Arguments>
std::shared_ptr<T> makeHolder(Arguments&&... arguments) {
  return std::shared_ptr<T>(new T{std::forward<Arguments>(arguments)...}, Dismantle{});
}

}  // namespace vestige::lang
