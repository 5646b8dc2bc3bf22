// SPDX-License-Identifier: Apache-2.0
// Rows of texts and of what POV-Ray 3.7.0.10 wrote for them, see povray_test.cpp.
#pragma once
#include <span>
#include <string>

#include "tests/lang/povray_rows.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {

inline const char* const kPrelude = R"(
#macro P(V) #debug concat("@",str(V,0,12),"\n") #end
#macro Q(V) #debug concat("@",vstr(3,V,",",0,9),"\n") #end
#macro R(V) #debug concat("@",vstr(5,V,",",0,9),"\n") #end
#macro S(V) #debug concat("@",V,"\n") #end
)";

struct Row {
  const char* text;
  const char* expected;
  double tolerance = 0;  ///< of its numbers; 0: every character counts
};

/// Without the marks, lines joined by '|'.
inline std::string joined(const std::string& lines) {
  std::string s;
  for (const char c : lines) {
    if (c == '@') continue;
    s += c == '\n' ? '|' : c;
  }
  if (!s.empty() && s.back() == '|') s.pop_back();
  return s;
}

inline void checkRows(std::span<const Row> rows, const Options& options = {},
                      const SchemaSource& source = schemas()) {
  for (const Row& row : rows) {
    const std::string found = joined(debugOf(std::string(kPrelude) + row.text, options, source));
    INFO(row.text);
    INFO("expected " << row.expected);
    INFO("found    " << found);
    CHECK((row.tolerance > 0 ? isNear(found, row.expected, row.tolerance) : found == row.expected));
  }
}

}  // namespace vestige::lang::test
