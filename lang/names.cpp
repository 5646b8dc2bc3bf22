// SPDX-License-Identifier: Apache-2.0
#include "lang/names.h"

#include "lang/builtins.h"

namespace vestige::lang {

Name::Name(std::string_view letters, std::uint32_t number)
    : std::string(letters),
      id(number),
      word(wordOf(letters)),
      builtin(findBuiltin(std::string(letters))) {}

}  // namespace vestige::lang
