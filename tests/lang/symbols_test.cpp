// SPDX-License-Identifier: Apache-2.0
// Names and their tables: what hides what, and what comes back.
#include "support/catch.h"

#include "lang/symbols.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

struct Tables {
  Total bytes = std::make_shared<std::atomic<std::int64_t>>(0);
  Names pool{bytes};
  Symbols symbols{bytes};
  const Name* a = pool.intern("A");

  void set(std::size_t table, double x) { symbols.in(table, a)->value = Numbers(x); }
  double seen() const { return numbers(symbols.find(a)->value)->v[0]; }
};

}  // namespace

TEST_CASE("an inner name hides an outer one until its table is left", "[lang]") {
  Tables t;
  t.symbols.push();
  t.symbols.push();
  t.set(2, 3);
  t.set(0, 1);  // an outer binding that comes later stays hidden
  t.set(1, 2);
  CHECK(t.seen() == 3);
  CHECK(t.symbols.tableOf(t.a) == 2);
  t.symbols.pop();
  CHECK(t.seen() == 2);
  t.symbols.pop();
  CHECK(t.seen() == 1);
  t.set(7, 5);  // a table that has been left: the innermost
  CHECK(t.seen() == 5);
}

TEST_CASE("an undefined name shows the one that it hid", "[lang]") {
  Tables t;
  t.set(0, 1);
  t.symbols.push();
  t.set(1, 2);
  CHECK(t.symbols.undefine(t.a));
  CHECK(t.seen() == 1);
  t.set(1, 3);
  t.symbols.pop();
  CHECK(t.seen() == 1);
  CHECK(t.symbols.undefine(t.a));
  CHECK_FALSE(t.symbols.undefine(t.a));
  CHECK(t.symbols.find(t.a) == nullptr);
  CHECK(t.symbols.names().empty());
}

TEST_CASE("leaving a table keeps the outer name when the inner one was undefined", "[lang]") {
  Tables t;
  t.set(0, 1);
  t.symbols.push();
  t.set(1, 2);
  t.symbols.undefine(t.a);
  t.symbols.pop();
  REQUIRE(t.symbols.find(t.a) != nullptr);
  CHECK(t.seen() == 1);
}

TEST_CASE("names that come and go take no more memory each time", "[lang]") {
  Tables t;
  const auto turn = [&] {
    t.symbols.push();
    t.set(1, 2);
    t.symbols.undefine(t.a);
    t.set(1, 3);
    t.symbols.pop();
  };
  turn();
  const std::int64_t once = *t.bytes;
  for (int i = 0; i < 100; ++i) turn();
  CHECK(*t.bytes == once);
}

}  // namespace vestige::lang::test
