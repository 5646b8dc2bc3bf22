// SPDX-License-Identifier: Apache-2.0
// What an observer receives of texts whose events follow from the description in observer.h.
#include "tests/lang/schemas.h"

#include <filesystem>
#include <fstream>

#include "lang/observer.h"
#include "lang/source.h"
#include "lang/text_store.h"

namespace vestige::lang::test {
namespace {

const char* nameOf(Declared kind) {
  const char* const names[] = {"broken", "number",    "vector",     "colour",   "string",
                               "block",  "transform", "function",   "array",    "macro",
                               "spline", "file",      "dictionary", "parameter"};
  return names[int(kind)];
}

/// One line for each event. Places are resolved at the end, when the run hands out its sources.
class Recorder : public Observer {
 public:
  void declared(const std::string& name, const Span& span, Declared kind) override {
    add(std::string("declared ") + nameOf(kind) + " " + name, span);
  }
  void used(const std::string& name, const Span& span, const Span& declaration) override {
    add("used " + name, span);
    events_.back().declaration = declaration;
    events_.back().hasDeclaration = true;
  }
  void block(const Schema& schema, const Span& head) override {
    add("block " + schema.kind + " " + schema.name, head);
  }
  void setting(const Schema& schema, const Parameter& row, const Span& span) override {
    add("setting " + (schema.name.empty() ? schema.kind : schema.name) + "." + row.name, span);
  }
  void call(const std::string& name, const Span& span) override { add("call " + name, span); }
  void skipped(const Span& span) override { add("skipped", span); }

  /// "event at line:column 'text'", with the declaration and the calls that led there.
  std::vector<std::string> lines(const Sources& sources) const {
    std::vector<std::string> all;
    for (const Event& e : events_) {
      std::string s = e.what + " " + place(e.span, sources) + " '" + sources.excerpt(e.span) + "'";
      if (e.hasDeclaration) s += " from " + place(e.declaration, sources);
      for (int via = e.span.via; via >= 0; via = sources.expansion(via).call.via)
        s += " in " + std::filesystem::path(*sources.expansion(via).name).filename().string();
      all.push_back(s);
    }
    return all;
  }

 private:
  struct Event {
    std::string what;
    Span span, declaration = {};
    bool hasDeclaration = false;
  };
  void add(std::string what, const Span& span) { events_.push_back({std::move(what), span}); }
  static std::string place(const Span& span, const Sources& sources) {
    if (span.file < 0) return "nowhere";
    const Place p = locate(span, sources);
    return std::to_string(p.line) + ":" + std::to_string(p.column);
  }
  std::vector<Event> events_;
};

using Lines = std::vector<std::string>;

Lines eventsOf(const std::string& text, Options options = {}) {
  Recorder recorder;
  options.observer = &recorder;
  const Result result = read(text, options);
  return recorder.lines(*result.sources);
}

void check(const Lines& found, const Lines& expected) {
  for (std::size_t i = 0; i < std::max(found.size(), expected.size()); ++i) {
    INFO("event " << i);
    CHECK((i < found.size() ? found[i] : "nothing") ==
          (i < expected.size() ? expected[i] : "nothing"));
  }
}

}  // namespace

TEST_CASE("an observer receives declarations, uses, blocks and settings", "[lang]") {
  check(eventsOf("#declare R = 2;\n"
                 "#declare Gold = brdf phong { exponent R };\n"
                 "sphere { <0, R, 0>, R  brdf { Gold ior 2 }  emission rgb 1 }\n"),
        {
            "declared number R 1:10 'R'",
            "block brdf phong 2:17 'brdf phong'",
            "setting phong.exponent 2:30 'exponent'",
            "used R 2:39 'R' from 1:10",
            "declared block Gold 2:10 'Gold'",
            "block shape sphere 3:1 'sphere'",
            "setting sphere.centre 3:10 '<'",
            "used R 3:14 'R' from 1:10",
            "setting sphere.radius 3:21 'R'",
            "used R 3:21 'R' from 1:10",
            "used Gold 3:31 'Gold' from 2:10",
            "block brdf phong 3:24 'brdf { Gold'",
            "setting phong.ior 3:36 'ior'",
            "setting sphere.emission 3:45 'emission'",
        });
}

TEST_CASE("an observer receives every kind of declaration", "[lang]") {
  const Lines found = eventsOf(
      "#declare A = 1;\n#declare B = <1, 2>;\n#declare C = rgb 1;\n#declare D = \"d\";\n"
      "#declare E = sphere { 0, 1 }\n#declare F = transform { scale 2 }\n"
      "#declare G = function { x };\n#declare H = array[1];\n#declare I = spline { 0, 1 }\n"
      "#declare J = dictionary;\n#local (K, L) = (1, \"l\");\n#for (M, 1, 1) #end\n"
      "#macro N(O, optional P) #end\n#declare Q = function(r) { sum(s, 1, 2, s + r) };\n"
      "#declare T = ;\n");
  Lines declared;
  for (const std::string& s : found)
    if (s.rfind("declared", 0) == 0) declared.push_back(s);
  check(declared, {"declared number A 1:10 'A'",     "declared vector B 2:10 'B'",
                   "declared colour C 3:10 'C'",     "declared string D 4:10 'D'",
                   "declared block E 5:10 'E'",      "declared transform F 6:10 'F'",
                   "declared function G 7:10 'G'",   "declared array H 8:10 'H'",
                   "declared spline I 9:10 'I'",     "declared dictionary J 10:10 'J'",
                   "declared number K 11:9 'K'",     "declared string L 11:12 'L'",
                   "declared number M 12:7 'M'",     "declared macro N 13:8 'N'",
                   "declared parameter O 13:10 'O'", "declared parameter P 13:22 'P'",
                   "declared parameter r 14:23 'r'", "declared parameter s 14:32 's'",
                   "declared function Q 14:10 'Q'",  "declared broken T 15:10 'T'"});
}

TEST_CASE("uses are observed wherever a name may stand", "[lang]") {
  check(eventsOf("#declare A = array[2] { 1, 2 };\n"
                 "#declare A[1] = A[0];\n"
                 "#undef A[0]\n"
                 "#ifdef (A) #end\n"
                 "#declare T = transform { scale 2 }\n"
                 "sphere { 0, 1 transform T transform { T } }\n"
                 "#declare S = spline { 0, 1 }\n"
                 "#declare Z = spline { S 1, 2 }\n"
                 "#declare N = Z(1) + sin(global.N2) + now;\n"
                 "#declare D = dictionary { .k: 1 };\n"
                 "#declare D.k = D.k;\n"
                 "#declare G = function(a) { a + sum(i, 1, 2, i) + x };\n"
                 "#declare Y = (0 ? G(1) : 2);\n"),
        {
            "declared array A 1:10 'A'",       "used A 2:10 'A' from 1:10",
            "used A 2:17 'A' from 1:10",       "used A 3:8 'A' from 1:10",
            "used A 4:9 'A' from 1:10",        "declared transform T 5:10 'T'",
            "block shape sphere 6:1 'sphere'", "setting sphere.centre 6:10 '0'",
            "setting sphere.radius 6:13 '1'",  "used T 6:25 'T' from 5:10",
            "used T 6:39 'T' from 5:10",       "declared spline S 7:10 'S'",
            "used S 8:23 'S' from 7:10",       "declared spline Z 8:10 'Z'",
            "used Z 9:14 'Z' from 8:10",       "call Z 9:14 'Z(1)'",
            "call sin 9:21 'sin(global.N2)'",  "declared broken N 9:10 'N'",
            "declared dictionary D 10:10 'D'", "used D 11:10 'D' from 10:10",
            "used D 11:16 'D' from 10:10",     "declared parameter a 12:23 'a'",
            "used a 12:28 'a' from 12:23",     "declared parameter i 12:36 'i'",
            "used i 12:45 'i' from 12:36",     "declared function G 12:10 'G'",
            "used G 13:19 'G' from 12:10",     "call G 13:19 'G(1)'",
            "declared number Y 13:10 'Y'",
        });
}

TEST_CASE("inside an expansion the span is that of the macro's body", "[lang]") {
  check(eventsOf("#declare R = 2;\n"
                 "#macro Ball(S, T)\n"
                 "  #local U = S + T;\n"
                 "  sphere { 0, U }\n"
                 "#end\n"
                 "#macro Two(V) Ball(V, 1) #end\n"
                 "Two(R)\n"),
        {
            "declared number R 1:10 'R'",
            "declared macro Ball 2:8 'Ball'",
            "declared parameter S 2:13 'S'",
            "declared parameter T 2:16 'T'",
            "declared macro Two 6:8 'Two'",
            "declared parameter V 6:12 'V'",
            "used Two 7:1 'Two' from 6:8",
            "used R 7:5 'R' from 1:10",
            "call Two 7:1 'Two(R)'",
            "used Ball 6:15 'Ball' from 2:8 in Two",
            "used V 6:20 'V' from 6:12 in Two",
            "call Ball 6:15 'Ball(V, 1)' in Two",
            "used S 3:14 'S' from 2:13 in Ball in Two",
            "used T 3:18 'T' from 2:16 in Ball in Two",
            "declared number U 3:10 'U' in Ball in Two",
            "block shape sphere 4:3 'sphere' in Ball in Two",
            "setting sphere.centre 4:12 '0' in Ball in Two",
            "setting sphere.radius 4:15 'U' in Ball in Two",
            "used U 4:15 'U' from 3:10 in Ball in Two",
        });
}

TEST_CASE("text that is not read is observed", "[lang]") {
  check(eventsOf("#if (0) a #elseif (1) #else b // c\n#end\n"
                 "#if (1) #elseif (2) d #else e #end\n"
                 "#switch (2) #case (1) f #break #case (2) #break g #case (3) h #else i #end\n"
                 "#while (0) j #end\n"
                 "#for (I, 2, 1) k #end\n"
                 "#ifdef (L) #end\n"
                 "#macro M() #if (0) n #end #end M()\n"),
        {
            "skipped 1:8 ' a '",
            "skipped 1:28 ' b // c\n'",
            "skipped 3:16 ' (2) d '",
            "skipped 3:28 ' e '",
            "skipped 4:22 ' f #break '",
            "skipped 4:48 ' g '",
            "skipped 4:56 ' (3) h '",
            "skipped 4:68 ' i '",
            "skipped 5:11 ' j '",
            "declared number I 6:7 'I'",
            "skipped 6:15 ' k '",
            "declared macro M 8:8 'M'",
            "used M 8:32 'M' from 8:8",
            "call M 8:32 'M()'",
            "skipped 8:19 ' n ' in M",
        });
}

TEST_CASE("a branch is observed in every turn of a loop", "[lang]") {
  check(eventsOf("#for (I, 1, 2) #if (I = 1) sphere { 0, 1 } #end #end"),
        {
            "declared number I 1:7 'I'",
            "used I 1:21 'I' from 1:7",
            "block shape sphere 1:28 'sphere'",
            "setting sphere.centre 1:37 '0'",
            "setting sphere.radius 1:40 '1'",
            "used I 1:21 'I' from 1:7",
            "skipped 1:27 ' sphere { 0, 1 } '",
        });
}

TEST_CASE("after an error the events go on", "[lang]") {
  check(eventsOf("#declare R = 1;\n"
                 "sphere { 0, R radus 3 brdf phong { exponent ) ior R } }\n"
                 "#declare Q = R + ;\n"
                 "#macro M(A) A #end\n"
                 "M(R, R)\n"
                 "sphere { 0, Q }\n"
                 "box { 0,"),
        {
            "declared number R 1:10 'R'",
            "block shape sphere 2:1 'sphere'",
            "setting sphere.centre 2:10 '0'",
            "setting sphere.radius 2:13 'R'",
            "used R 2:13 'R' from 1:10",
            "block brdf phong 2:23 'brdf phong'",
            "setting phong.exponent 2:36 'exponent'",
            "setting phong.ior 2:47 'ior'",
            "used R 2:51 'R' from 1:10",
            "used R 3:14 'R' from 1:10",
            "declared broken Q 3:10 'Q'",
            "declared macro M 4:8 'M'",
            "declared parameter A 4:10 'A'",
            "used M 5:1 'M' from 4:8",
            "used R 5:3 'R' from 1:10",
            "used R 5:6 'R' from 1:10",
            "block shape sphere 6:1 'sphere'",
            "setting sphere.centre 6:10 '0'",
            "setting sphere.radius 6:13 'Q'",
            "used Q 6:13 'Q' from 3:10",
            "block shape box 7:1 'box'",
            "setting box.low 7:7 '0'",
        });
}

TEST_CASE("an included text has its own places, names of the command line have theirs", "[lang]") {
  const auto folder = std::filesystem::temp_directory_path() / "vestige_observer_test";
  std::filesystem::create_directories(folder);
  TextStore store;
  store.setBuffer((folder / "a.inc").string(), "#declare\n A = N;\n");
  Options options;
  options.store = &store;
  options.includePaths = {folder.string()};
  options.definitions = {{"N", "3"}};
  check(eventsOf("#include \"a.inc\"\n#declare B = A + frame_number;\n", options),
        {
            "declared number N 1:10 'N'",
            "used N 2:6 'N' from 1:10 in a.inc",
            "declared number A 2:2 'A' in a.inc",
            "used A 2:14 'A' from 2:2",
            "used frame_number 2:18 'frame_number' from nowhere",
            "declared number B 2:10 'B'",
        });
  std::filesystem::remove_all(folder);
}

TEST_CASE("files of data are observed", "[lang]") {
  Options options;
  options.writeFolder = std::filesystem::temp_directory_path().string();
  check(eventsOf("#fopen F \"observed.txt\" write\n#write (F, 1)\n#fclose F\n"
                 "#fopen F \"observed.txt\" read\n#read (F, A, B)\n",
                 options),
        {
            "declared file F 1:8 'F'",
            "used F 2:9 'F' from 1:8",
            "used F 3:9 'F' from 1:8",
            "declared file F 4:8 'F'",
            "used F 5:8 'F' from 4:8",
            "declared number A 5:11 'A'",
        });
}

}  // namespace vestige::lang::test
