// SPDX-License-Identifier: Apache-2.0
#include "lang/events.h"

#include <array>

namespace vestige::lang {

Declared Events::kindOf(const Datum& value) {
  if (const Numbers* n = numbers(value))
    return n->isColour ? Declared::colour : n->size == 1 ? Declared::number : Declared::vector;
  // In the order of Datum.
  constexpr std::array kinds = {Declared::broken, Declared::number,    Declared::string,
                                Declared::block,  Declared::transform, Declared::function,
                                Declared::array,  Declared::macro,     Declared::spline,
                                Declared::file,   Declared::dictionary};
  static_assert(kinds.size() == std::variant_size_v<Datum>);
  return kinds[value.index()];
}

void Events::nearest(const Token& name) {
  if (const auto declaration = symbols_.declaration(name.text)) used(name, *declaration);
}

void Events::between(const TokenList& list, std::uint32_t from, std::uint32_t part, int via) {
  // From the end of the token in front: comments at either end belong to the branch.
  observer_->skipped({list.file, list.tokens[from - 1].end, list.tokens[part].begin, via});
}

}  // namespace vestige::lang
