// SPDX-License-Identifier: Apache-2.0
// Edits that mend a diagnostic: the text that results must have no errors.
#include "tests/lang/schemas.h"

#include "lang/source.h"

namespace vestige::lang::test {
namespace {

std::string mended(std::string text, const Result& r) {
  for (auto e = r.edits.rbegin(); e != r.edits.rend(); ++e)  // from the end: offsets stay right
    text.replace(e->span.begin, e->span.end - e->span.begin, e->text);
  return text;
}

}  // namespace

TEST_CASE("the edits of a diagnostic mend the text", "[lang]") {
  for (const char* text :
       {"#declare A = 3\nsphere { 0, A }", "#declare A = rgb 1 // white\nsphere { 0, 1 }",
        "#declare Radius = 1; sphere { 0, Radus }", "sphere { 0, 1 brdf phong { exponant 3 } }",
        "spere { 0, 1 }", "#declar A = 3;\nsphere { 0, 1 }",
        "sphere { 0, 1 brdf phon { exponent 3 } }",
        "#declare Radius = 1; #declare A = Radus + 1; #declare B = 2\nsphere { 0, Radiuss }"}) {
    INFO(text);
    const Result r = read(text);
    REQUIRE(r.diagnostics.hasErrors());
    CHECK(r.edits.size() == r.diagnostics.list().size());
    const Result again = read(mended(text, r));
    INFO(printed(again));
    CHECK(again.diagnostics.list().empty());
  }
}

TEST_CASE("an edit belongs to one diagnostic", "[lang]") {
  const Result r = read("sphere { 0, \"x\" }\n#declare A = 3\nsphere { 0, A }");
  REQUIRE(r.diagnostics.list().size() == 2);
  REQUIRE(r.edits.size() == 1);
  CHECK(r.edits[0].diagnostic == 1);
  CHECK(r.edits[0].text == ";");
  CHECK(r.sources->position(r.edits[0].span.file, r.edits[0].span.begin).utf16Column == 14);
}

TEST_CASE("a repeated error has one edit; words of POV-Ray's have none", "[lang]") {
  const Result loop = read("#declare Radius = 1; #for (I, 1, 5) sphere { 0, Radus } #end");
  CHECK(loop.diagnostics.list().size() == 1);
  CHECK(loop.edits.size() == 1);
  CHECK(read("#declare Textur = 1; texture { Textur }").edits.empty());
}

}  // namespace vestige::lang::test
