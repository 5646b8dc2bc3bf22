// SPDX-License-Identifier: Apache-2.0
// Values by key, as POV-Ray 3.8 has them.
#pragma once
#include <map>
#include <string>

#include "lang/value.h"

namespace vestige::lang {

/// A value like an array: other owners keep their entries when one is assigned to.
struct Dictionary {
  std::map<std::string, Datum> entries;
  Share share = {};  ///< share of the limit on live elements
  Share bytes = {};

  /// Bytes of an entry without the letters of its key.
  static constexpr std::size_t kEntry = sizeof(Datum) + 96;
};

}  // namespace vestige::lang
