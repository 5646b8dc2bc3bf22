// SPDX-License-Identifier: Apache-2.0
// The outline of texts whose structure is evident, and what must hold for every text.
#include "lang/outline.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

const char* nameOf(OutlineNode::Kind kind) {
  const char* const names[] = {"text",   "block", "braces", "declaration", "macro",
                               "choice", "part",  "loop",   "directive"};
  return names[int(kind)];
}

/// One line for each node but the text, indented by its depth: kind, [name] and its own text, where
/// each child is a '@'. An unfinished one has a '?'.
std::vector<std::string> shown(const std::string& text) {
  const Outline all = outlineOf(*tokenisedText(text), schemas());
  std::vector<std::string> lines;
  std::vector<int> depth(all.size(), -1);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const OutlineNode& n = all[i];
    depth[i] = depth[n.parent] + 1;
    std::string own;
    std::uint32_t at = n.begin;
    for (std::uint32_t child = std::uint32_t(i) + 1; child < n.after; child = all[child].after) {
      own += text.substr(at, all[child].begin - at) + "@";
      at = all[child].end;
    }
    own += text.substr(at, n.end - at);
    lines.push_back(std::string(std::size_t(2 * depth[i]), ' ') + nameOf(n.kind) + " [" +
                    text.substr(n.name, n.nameEnd - n.name) + "]" + (n.isFinished ? " " : "? ") +
                    own);
  }
  return lines;
}

void check(const std::string& text, const std::vector<std::string>& expected) {
  INFO(text);
  const auto found = shown(text);
  for (std::size_t i = 0; i < std::max(found.size(), expected.size()); ++i)
    CHECK((i < found.size() ? found[i] : "nothing") ==
          (i < expected.size() ? expected[i] : "nothing"));
}

/// "" if the nodes are nested, in order, and cut no token, else what is wrong.
std::string flaw(const std::string& text) {
  const auto tokens = tokenisedText(text);
  const Outline all = outlineOf(*tokens, schemas());
  std::string whole;
  std::vector<bool> isEdge(text.size() + 1, true);
  for (const StoredToken& t : tokens->tokens)
    for (std::uint32_t i = t.begin + 1; i < t.end; ++i) isEdge[i] = false;
  std::vector<std::size_t> path;
  std::uint32_t at = 0;
  for (std::size_t i = 0; i <= all.size(); ++i) {
    while (!path.empty() && (i == all.size() || i >= all[path.back()].after)) {
      const OutlineNode& done = all[path.back()];
      if (done.end < at) return "a child reaches beyond its parent";
      whole += text.substr(at, done.end - at);
      at = done.end;
      path.pop_back();
    }
    if (i == all.size()) break;
    const OutlineNode& n = all[i];
    if (n.begin < at || n.end < n.begin || n.end > text.size()) return "nodes overlap";
    if (!isEdge[n.begin] || !isEdge[n.end]) return "a node cuts a token";
    if (n.name > n.nameEnd || n.name < n.begin || n.nameEnd > n.end) return "a name is outside";
    if (i > 0 && (path.empty() || n.parent != path.back())) return "a parent is wrong";
    if (i > 0 && n.end == n.begin) return "a node is empty";
    whole += text.substr(at, n.begin - at);
    at = n.begin;
    path.push_back(i);
    if (path.size() > std::size_t(kDeepestOutline) + 1) return "too deep";
  }
  return whole == text ? "" : "text is lost";
}

std::string repeated(int n, const std::string& s) {
  std::string all;
  for (int i = 0; i < n; ++i) all += s;
  return all;
}

}  // namespace

TEST_CASE("the outline has blocks, declarations, macros and directives", "[lang]") {
  check("sphere { 0, 1 brdf phong { exponent 3 } } // x",
        {"block [sphere] sphere { 0, 1 @ }", "  block [brdf phong] brdf phong { exponent 3 }"});
  check("#declare A = 3;\n#local B = brdf { A }\n#declare C = array[2] { 1, 2 };\nfilm { }",
        {"declaration [A] #declare A = 3;", "declaration [B] #local B = @",
         "  block [brdf] brdf { A }", "declaration [C] #declare C = array[2] @;",
         "  braces [] { 1, 2 }", "block [film] film { }"});
  check("#macro M(A, B) union { A } #end M(1, 2)",
        {"macro [M] #macro M(A, B) @ #end", "  block [union] union { A }"});
  check("#include \"a.inc\" // first\n#debug concat(\"a\",\n \"b\")\n#version 3.7; #break x",
        {"directive [#include] #include \"a.inc\"",
         "directive [#debug] #debug concat(\"a\",\n \"b\")", "directive [#version] #version 3.7;",
         "directive [#break] #break"});
  check("#if (1) a #elseif (2) #for (I, 1, 2) b #end #else c #end",
        {"choice [#if] @ @ @ #end", "  part [#if] #if (1) a", "  part [#elseif] #elseif (2) @",
         "    loop [#for] #for (I, 1, 2) b #end", "  part [#else] #else c"});
  check("#declare F = function(x) { x }\n#declare (A, B) = (sphere { 0, 1 }, 2);",
        {"declaration [F] #declare F = function(x) @", "  braces [] { x }",
         "declaration [#declare] #declare (A, B) = (@, 2);", "  block [sphere] sphere { 0, 1 }"});
  check("#declare D = dictionary { .a: 1 } #declare U = union { #if (1) box { } #end };",
        {"declaration [D] #declare D = @", "  braces [dictionary] dictionary { .a: 1 }",
         "declaration [U] #declare U = @;", "  block [union] union { @ }",
         "    choice [#if] @ #end", "      part [#if] #if (1) @", "        block [box] box { }"});
  check("camera { thin_lens aperture 1 }\ntexture { finish { phong 1 } }",
        {"block [camera] camera { thin_lens aperture 1 }", "block [texture] texture { @ }",
         "  block [finish] finish { phong 1 }"});
}

TEST_CASE("the outline of an unfinished text", "[lang]") {
  check("union { sphere { 0, 1 ", {"block [union]? union { @", "  block [sphere]? sphere { 0, 1"});
  check("#declare A = 3\n#declare B = sphere { 0, A\n#declare C = 4;",
        {"declaration [A]? #declare A = 3", "declaration [B]? #declare B = @",
         "  block [sphere]? sphere { 0, A\n@", "    declaration [C] #declare C = 4;"});
  check("#declare A = max(1,\nsphere { 0, 1 }",
        {"declaration [A]? #declare A = max(1,\n@", "  block [sphere] sphere { 0, 1 }"});
  check("#declare A = M(1)\nsphere { 0, 1 }",
        {"declaration [A]? #declare A = M(1)", "block [sphere] sphere { 0, 1 }"});
  check("#macro M() sphere { #if (1) ", {"macro [M]? #macro M() @", "  block [sphere]? sphere { @",
                                         "    choice [#if]? @", "      part [#if] #if (1)"});
  check("box { } } #end #else #case (1) box { }", {"block [box] box { }", "block [box] box { }"});
  check("union { #if (1) sphere { #else } #end }",
        {"block [union] union { @ }", "  choice [#if] @ @ #end", "    part [#if] #if (1) @",
         "      block [sphere]? sphere {", "    part [#else] #else }"});
  check("#declare", {"declaration [#declare]? #declare"});
  check("#undef brdf\nphong { }", {"directive [#undef] #undef brdf", "block [phong] phong { }"});
  check("", {});
}

TEST_CASE("folds leave the first line and the closing sign visible", "[lang]") {
  const std::string text =
      "union {\n  sphere {\n    0, 1\n  }\n}\n"  // 0 to 4
      "#declare A = union {\n  box { }\n};\n"    // 5 to 7
      "#if (1)\n  a\n#else\n  b\n  c\n#end\n"    // 8 to 13
      "#for (I, 1, 2)\n  d\n#end box { }\n"      // 14 to 16
      "#macro M()\n  e";                         // 17 and 18, unfinished
  const auto tokens = tokenisedText(text);
  std::vector<std::pair<int, int>> found;
  for (const Fold& f : foldsOf(outlineOf(*tokens, schemas()), *tokens))
    found.emplace_back(f.first, f.last);
  CHECK(found == std::vector<std::pair<int, int>>{
                     {0, 3}, {1, 2}, {5, 6}, {8, 9}, {10, 12}, {14, 15}, {17, 18}});
}

TEST_CASE("the outline of any text is nested, cuts no token and loses nothing", "[lang]") {
  CHECK(flaw("sphere { 0, 1 }") == "");
  for (const char* text : {"", " ", "}", "{", "{}", "#end", "#", "\"no end", "/* no end", "a {{}}",
                           "#declare", "#declare {", "#macro", "#if #else #end", "#for }", ") ] ;",
                           "#declare A = { #end } ;", "#switch (1) #case (2) } #break { #end"}) {
    INFO(text);
    CHECK(flaw(text) == "");
  }
  const std::filesystem::path root = VESTIGE_SOURCE_DIR;
  int files = 0;
  for (const char* folder : {"examples", "library", "tests/lang/errors"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string kind = entry.path().extension().string();
      if (kind != ".scene" && kind != ".inc") continue;
      std::stringstream stream;
      stream << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      const std::string text = stream.str();
      INFO(entry.path().string());
      CHECK(flaw(text) == "");
      ++files;
      constexpr std::size_t kPrefixes = 60;
      for (std::size_t i = 0; i < kPrefixes; ++i) {
        const std::size_t cut = text.size() * i / kPrefixes;
        INFO("up to byte " << cut);
        CHECK(flaw(text.substr(0, cut)) == "");
        CHECK(flaw(text.substr(cut)) == "");
      }
    }
  CHECK(files > 50);
}

TEST_CASE("the outline of a hostile text takes linear time and is not deep", "[lang]") {
  constexpr int kMany = 200'000;
  const auto outline = [](const std::string& text) {  // in square time: minutes
    const auto tokens = tokenisedText(text);
    const Outline all = outlineOf(*tokens, schemas());
    foldsOf(all, *tokens);
    return all.size();
  };
  CHECK(outline(repeated(5 * kMany, "{")) < 1000);
  for (const char* part : {"{", "}", "{}", "union { ", "#if (1) ", "#else ", "#end ",
                           "#if (1) { #end ", "#declare A = ", "#declare A = {", "#debug (",
                           "#macro A() {", "#switch (1) #case (1) } ", "a { ; } "}) {
    INFO(part);
    CHECK(outline(repeated(kMany, part)) > 0);
    CHECK(flaw(repeated(10'000, part)) == "");
    CHECK(flaw(repeated(10'000, part) + repeated(10'000, "}") + repeated(10'000, "#end ")) == "");
  }
}

}  // namespace vestige::lang::test
