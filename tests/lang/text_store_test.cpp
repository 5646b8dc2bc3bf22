// SPDX-License-Identifier: Apache-2.0
// Runs with a store give what runs without one give, and tokenise only what is new.
#include "support/catch.h"

#include <filesystem>
#include <fstream>
#include <thread>

#include "lang/text_store.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, with files that it writes.
struct Folder {
  fs::path path = fs::temp_directory_path() / "vestige_text_store_test";
  Folder() { fs::remove_all(path), fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator()(const char* name) const { return (path / name).string(); }
  void write(const char* name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
  }
};

/// All that a user sees of a run: the scene, what was said, the edits.
std::string outcome(const std::string& file, const Options& given) {
  std::string all;
  Options options = given;
  options.debug = [&](const std::string& s) { all += s; };
  const Result r = readScene(file, schemas(), options);
  all += printed(r) + std::to_string(r.scene.hash);
  for (const Edit& e : r.edits)
    for (const std::size_t part : {e.diagnostic, std::size_t(e.span.begin)})
      all += std::to_string(part) + e.text;
  for (const std::string& f : r.scene.files) all += f;
  return all;
}

constexpr const char* kTexts[] = {
    "#declare R = 2; sphere { <0,0,0>, R } #debug concat(str(R, 0, 1), \"\\n\")",
    "#end sphere { <0,0,0>, 1 } #if (1) box { 0, 1",              // unpaired
    "sphere { <0,0,0>, 1e999 } @ \"open",                         // lexical errors
    "#for (I, 0, 3) sphere { I, 1 } #end #declare A = 1 sfere",   // edits
    "#macro M(X) sphere { X, undeclared } #end M(1) M(2) #case",  // through a macro
    "/* never closed",
    "",
};

}  // namespace

TEST_CASE("a second run with a store gives the same, and tokenises nothing", "[lang]") {
  const Folder folder;
  for (const char* text : kTexts) {
    INFO(text);
    folder.write("a.scene", text);
    TextStore store;
    Options with;
    with.store = &store;
    const std::string expected = outcome(folder("a.scene"), {});
    CHECK(outcome(folder("a.scene"), with) == expected);
    CHECK(store.tokenised() == 1);
    CHECK(outcome(folder("a.scene"), with) == expected);
    CHECK(store.tokenised() == 1);
  }
}

TEST_CASE("limits are the same with a store", "[lang]") {
  const Folder folder;
  std::string text;
  for (int i = 0; i < 2000; ++i) text += "#declare A" + std::to_string(i) + " = 1;\n";
  folder.write("a.scene", text);
  TextStore store;
  Options with;
  with.store = &store;
  REQUIRE(outcome(folder("a.scene"), with).find("error") == std::string::npos);
  int stopped = 0;
  for (const std::int64_t memory : {100'000, 200'000, 400'000, 500'000, 700'000, 10'000'000})
    for (const std::int64_t steps : {100, 1000, 1'000'000}) {
      Options without;
      without.limits.memory = memory, without.limits.expandedTokens = steps;
      with.limits = without.limits;
      const std::string expected = outcome(folder("a.scene"), without);
      CHECK(outcome(folder("a.scene"), with) == expected);
      stopped += expected.find("raises the limit") != std::string::npos;
    }
  CHECK(stopped > 10);
  CHECK(stopped < 18);
  CHECK(store.tokenised() == 1);
}

TEST_CASE("a changed file is seen, a removed one is an error", "[lang]") {
  const Folder folder;
  folder.write("a.scene", "#include \"b.inc\" #include \"c.inc\" #debug concat(B, C, \"\\n\")");
  folder.write("b.inc", "#declare B = \"one\";");
  folder.write("c.inc", "#declare C = \"last\";");
  TextStore store;
  Options with;
  with.store = &store;
  CHECK(outcome(folder("a.scene"), with).rfind("onelast", 0) == 0);
  CHECK(store.tokenised() == 3);
  // Of the same length and with the same time, which no time stamp shows.
  const auto time = fs::last_write_time(folder("b.inc"));
  folder.write("b.inc", "#declare B = \"two\";");
  fs::last_write_time(folder("b.inc"), time);
  CHECK(outcome(folder("a.scene"), with).rfind("twolast", 0) == 0);
  CHECK(store.tokenised() == 4);
  fs::remove(folder("c.inc"));
  const std::string without = outcome(folder("a.scene"), {});
  CHECK(without.find("no file 'c.inc' to include") != std::string::npos);
  CHECK(outcome(folder("a.scene"), with) == without);
  fs::remove(folder("a.scene"));
  CHECK(outcome(folder("a.scene"), with) == outcome(folder("a.scene"), {}));
}

TEST_CASE("a buffer counts in place of its file", "[lang]") {
  const Folder folder;
  folder.write("a.scene", "#include \"b.inc\" #debug concat(B, \"\\n\")");
  folder.write("b.inc", "#declare B = \"file\";");
  TextStore store;
  Options with;
  with.store = &store;
  CHECK(outcome(folder("a.scene"), with).rfind("file", 0) == 0);
  store.setBuffer(folder("./b.inc"), "#declare B = \"typed\";");
  CHECK(outcome(folder("a.scene"), with).rfind("typed", 0) == 0);
  store.setBuffer(folder("b.inc"), "#declare B = \"retyped\";");
  CHECK(outcome(folder("a.scene"), with).rfind("retyped", 0) == 0);
  store.dropBuffer(folder("b.inc"));
  CHECK(outcome(folder("a.scene"), with).rfind("file", 0) == 0);
  store.setBuffer(folder("a.scene"), "#debug \"scene\"");
  CHECK(outcome(folder("a.scene"), with).rfind("scene", 0) == 0);
  with.limits.memory = 1 << 20;
  store.setBuffer(folder("a.scene"), std::string(2 << 20, ' '));
  CHECK(outcome(folder("a.scene"), with).find("is larger than 1 MB") != std::string::npos);
}

TEST_CASE("a buffer of a file that was never saved can be included", "[lang]") {
  const Folder folder;
  folder.write("a.scene", "#if (file_exists(\"new.inc\")) #include \"new.inc\" #end");
  TextStore store;
  Options with;
  with.store = &store;
  store.setBuffer(folder("new.inc"), "#debug \"new\"");
  CHECK(outcome(folder("a.scene"), with).rfind("new", 0) == 0);
  store.dropBuffer(folder("new.inc"));
  CHECK(outcome(folder("a.scene"), with) == outcome(folder("a.scene"), {}));
}

TEST_CASE("the sandbox also holds for buffers", "[lang]") {
  const Folder folder;
  fs::create_directories(folder.path / "in");
  folder.write("in/a.scene", "#include \"../out.inc\"");
  TextStore store;
  Options with;
  with.store = &store, with.sandbox = true;
  store.setBuffer(folder("out.inc"), "#debug \"outside\"");
  CHECK(outcome(folder("in/a.scene"), with).find("which --sandbox forbids") != std::string::npos);
}

TEST_CASE("the examples, read twice with one store", "[lang]") {
  TextStore store;
  Options with, without;
  without.includePaths = {VESTIGE_SOURCE_DIR "/library"};
  with.includePaths = without.includePaths, with.store = &store;
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(VESTIGE_SOURCE_DIR "/examples"))
    if (entry.path().extension() == ".scene") files.push_back(entry.path().string());
  REQUIRE(files.size() > 5);
  for (int run = 0; run < 2; ++run)
    for (const std::string& file : files) CHECK(outcome(file, with) == outcome(file, without));
  const std::size_t before = store.tokenised();
  for (const std::string& file : files) outcome(file, with);
  CHECK(store.tokenised() == before);
}

TEST_CASE("several threads share a store", "[lang]") {
  const Folder folder;
  folder.write("b.inc", "#declare B = 1;");
  folder.write("a.scene", "#include \"b.inc\" sphere { <0,0,0>, B }");
  const std::string expected = outcome(folder("a.scene"), {});
  TextStore store;
  Options with;
  with.store = &store;
  std::vector<std::string> found(4);
  std::vector<std::thread> threads;
  for (std::string& each : found)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        store.setBuffer(folder("b.inc"), "#declare B = 1;");
        each = outcome(folder("a.scene"), with);
        store.dropBuffer(folder("b.inc"));
      }
    });
  for (std::thread& t : threads) t.join();
  for (const std::string& each : found) CHECK(each == expected);
}

}  // namespace vestige::lang::test
