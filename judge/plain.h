// SPDX-License-Identifier: Apache-2.0
// Plausible values for the rows of a light's or camera's schema.
#pragma once
#include "judge/differences.h"
#include "judge/made.h"

namespace vestige::judge {

/// A random value; of a file any name, since NullHost finds each; of a pigment an image. Kind none:
/// the row is left at its default (texts, and blocks of other kinds).
Value plainValue(const Parameter& row, Random& r);

/// All required rows, and most of the others.
Settings plainSettings(const Schema& schema, Random& r);

/// Defaults, but required rows, the first image and numbers that are 0 (a tilt) have values: what a
/// picture is made with. Without images: those that are required only.
Settings shownSettings(const Schema& schema, Random& r, bool withImage = true);

/// Records which rows had a value that the plugin accepted.
class TriedRows {
 public:
  void offer(const Settings& s) {
    for (const auto& [name, value] : s) taken_.try_emplace(name, false);
  }
  void accept(const Settings& s) {
    for (const auto& [name, value] : s) taken_[name] = true;
  }
  /// Files and blocks whose values were always refused, "file (every value was refused), ..."; "":
  /// none. (Other rows are refused for what stands beside them.)
  std::string refused(const Schema& schema) const {
    std::string names;
    for (const Parameter& row : schema.params) {
      const bool isOffered = row.type == ValueType::file || row.type == ValueType::block;
      const auto found = taken_.find(row.name);
      if (isOffered && found != taken_.end() && !found->second)
        names += (names.empty() ? "" : ", ") + row.name + " (every value was refused)";
    }
    return names;
  }

 private:
  std::map<std::string, bool> taken_;
};

/// The rows without a value from plainValue(), "color_space (text), ..."; "": none.
std::string rowsLeftAlone(const Schema& schema);

}  // namespace vestige::judge
