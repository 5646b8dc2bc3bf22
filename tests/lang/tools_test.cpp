// SPDX-License-Identifier: Apache-2.0
// The example of docs/tools.md. The page quotes this file.
#include <fstream>
#include <sstream>

#include "tests/lang/schemas.h"

// The example begins here.
#include "lang/observer.h"
#include "lang/source.h"
#include "lang/text_store.h"

namespace lang = vestige::lang;

/// Collects the uses of declared names.
class Uses : public lang::Observer {
 public:
  struct Use {
    vestige::Span name, declaration;
  };
  std::vector<Use> all;

  void used(const std::string&, const vestige::Span& name,
            const vestige::Span& declaration) override {
    all.push_back({name, declaration});
  }
};

/// "file:line" of the declaration of the name at a place (lines and columns from 0), or "".
std::string declarationOf(const std::string& file, int line, int utf16Column,
                          lang::TextStore& store, const lang::SchemaSource& schemas) {
  Uses uses;
  lang::Options options;
  options.store = &store;  // unsaved buffers, and the tokens of files that have not changed
  options.observer = &uses;
  const lang::Result result = lang::readScene(file, schemas, options);
  const lang::Sources& sources = *result.sources;
  const std::uint32_t at = sources.offset(0, line, utf16Column);  // text 0 is the scene itself
  for (const Uses::Use& use : uses.all)
    if (use.name.file == 0 && use.name.begin <= at && at < use.name.end &&
        use.declaration.file >= 0) {
      const int there = sources.position(use.declaration.file, use.declaration.begin).line;
      return sources.text(use.declaration.file).name + ":" + std::to_string(there);
    }
  return "";
}
// The example ends here.

namespace vestige::lang::test {
namespace {

std::string contents(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(std::string(VESTIGE_SOURCE_DIR) + "/" + file).rdbuf();
  return text.str();
}

/// What stands between two pieces of text.
std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t at = text.find(open);
  if (at == std::string::npos) return "missing: " + open;
  const std::size_t begin = at + open.size();
  return text.substr(begin, text.find(close, begin) - begin);
}

}  // namespace

TEST_CASE("the example for authors of editors finds declarations", "[lang]") {
  TextStore store;
  store.setBuffer("unsaved/scene.scene",
                  "#include \"names.inc\"\n/* \U0001F600 */ sphere { R, S }\n"
                  "#declare T = 1; box { 0, T }");
  store.setBuffer("unsaved/names.inc", "#declare R = <1, 2, 3>;\n#declare S = 2;");
  const auto at = [&](int line, int column) {
    return declarationOf("unsaved/scene.scene", line, column, store, schemas());
  };
  CHECK(at(1, 18) == "unsaved/names.inc:0");  // the face takes two of UTF-16's code units
  CHECK(at(1, 21) == "unsaved/names.inc:1");
  CHECK(at(2, 25) == "unsaved/scene.scene:2");
  CHECK(at(1, 10) == "");
}

TEST_CASE("the page for authors of editors shows the example that is tested", "[lang]") {
  CHECK(between(contents("docs/tools.md"), "```cpp\n", "```") ==
        between(contents("tests/lang/tools_test.cpp"), "// The example begins here.\n",
                "// The example ends here."));
}

}  // namespace vestige::lang::test
