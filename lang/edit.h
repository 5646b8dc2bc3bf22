// SPDX-License-Identifier: Apache-2.0
// Changes of the text that editors offer as quick fixes.
#pragma once
#include <string>
#include <vector>

#include <vestige/diagnostic.h>

namespace vestige::lang {

/// A change that would mend a diagnostic.
struct Edit {
  std::size_t diagnostic = 0;  ///< its place in the list of diagnostics
  Span span;                   ///< what to replace; empty: insert here
  std::string text;
};
using Edits = std::vector<Edit>;

}  // namespace vestige::lang
