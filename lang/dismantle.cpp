// SPDX-License-Identifier: Apache-2.0
#include "lang/dismantle.h"

namespace vestige::lang {
namespace {

/// The values that are still to be destroyed; null while none is.
thread_local std::vector<Datum>* pending = nullptr;

bool isHolder(const Datum& d) {
  return std::holds_alternative<ArrayPtr>(d) || std::holds_alternative<DictionaryPtr>(d) ||
         std::holds_alternative<FunctionPtr>(d);
}

/// Destroys them, and what they hold, now or, inside of another call, at its end.
void destroy(std::vector<Datum> values) {
  if (pending) {
    for (Datum& d : values) pending->push_back(std::move(d));
    return;
  }
  pending = &values;
  while (!values.empty()) {
    const Datum last = std::move(values.back());
    values.pop_back();
  }
  pending = nullptr;
}

void take(Datum& d, std::vector<Datum>& values) {
  if (isHolder(d)) values.push_back(std::move(d));
}

/// A tree is not deep; the functions that it calls may be.
void take(Expr& e, std::vector<Datum>& values) {
  take(e.value, values);
  for (const ExprPtr& operand : e.operands)
    if (operand) take(*operand, values);
}

}  // namespace

void Dismantle::operator()(const Array* dead) const {
  std::vector<Datum> values;
  for (Datum& d : const_cast<Array*>(dead)->data) take(d, values);
  delete dead;
  destroy(std::move(values));
}

void Dismantle::operator()(const Dictionary* dead) const {
  std::vector<Datum> values;
  for (auto& [key, d] : const_cast<Dictionary*>(dead)->entries) take(d, values);
  delete dead;
  destroy(std::move(values));
}

void Dismantle::operator()(const Function* dead) const {
  std::vector<Datum> values;
  if (dead->body) take(*dead->body, values);
  delete dead;
  destroy(std::move(values));
}

}  // namespace vestige::lang
