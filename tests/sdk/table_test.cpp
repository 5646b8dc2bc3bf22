// SPDX-License-Identifier: Apache-2.0
#include <vestige/table.h>

#include <numeric>
#include <span>

#include "support/catch.h"

using namespace vestige;

TEST_CASE("a table is a vector with whole numbers as indices", "[table]") {
  Table<double> table(3, 0.5);
  table.push_back(2);
  table[1] = -1;
  CHECK(table.size() == 4);
  CHECK(table == Table<double>{0.5, -1, 0.5, 2});
  CHECK(table.back() == 2);
  CHECK(std::accumulate(table.begin(), table.end(), 0.0) == 2);
  CHECK(std::span<const double>(table).subspan(1, 2).front() == -1);
  table.resize(1);
  CHECK(table == Table<double>{0.5});
  table.clear();
  CHECK(table.empty());
}

TEST_CASE("a table of flags can be written to", "[table]") {
  Table<bool> flags(2);
  flags[1] = true;
  CHECK_FALSE(flags[0]);
  CHECK(flags[1]);
}
