// SPDX-License-Identifier: Apache-2.0
#include "app/window/watch.h"

#include <chrono>
#include <fstream>

#include "app/run.h"
#include "support/catch.h"

using vestige::app::FileWatch;

TEST_CASE("files that change, come and go are noticed once", "[window][watch]") {
  const Folder folder;
  const std::string a = folder.write("a", "one"), b = folder / "b";
  FileWatch watch;
  watch.watch({a, b});
  CHECK_FALSE(watch.hasChanged());
  folder.write("a", "longer");
  CHECK_FALSE(watch.hasChanged());  // it may still be being written
  CHECK(watch.hasChanged());
  CHECK_FALSE(watch.hasChanged());
  folder.write("b", "here");
  CHECK_FALSE(watch.hasChanged());
  folder.write("b", "here, and more");
  CHECK_FALSE(watch.hasChanged());  // it was
  CHECK(watch.hasChanged());
  std::filesystem::remove(a);
  watch.hasChanged();
  CHECK(watch.hasChanged());
  // One that is saved while it was being read counts, though it was not known before.
  const std::string late = folder.write("late", "x");
  watch.watch({late}, std::filesystem::last_write_time(late) - std::chrono::seconds(1));
  watch.hasChanged();
  CHECK(watch.hasChanged());
  watch.watch({a});
  // What is watched anew does not forget what was known of it.
  folder.write("a", "back");
  watch.watch({a});
  watch.hasChanged();
  CHECK(watch.hasChanged());
  CHECK_FALSE(watch.hasChanged());
}
