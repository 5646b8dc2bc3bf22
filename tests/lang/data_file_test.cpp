// SPDX-License-Identifier: Apache-2.0
// #fopen, #read, #write and #fclose. The rows were run as those of povray_test.cpp.
#include "support/catch.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/lang/oracle.h"

namespace vestige::lang::test {
namespace {

namespace fs = std::filesystem;

const Row kRows[] = {
    // clang-format off
    {R"(#fopen F "t2.txt" write #write(F,"1,2,3,<4,5,6>,\"hi\",-7,+8,<1,2>,<1,2,3,4>,<1,2,3,4,5>\n") #fclose F #fopen F "t2.txt" read #read(F,A,B,C,D,E,G,H,I,J,K) P(A) P(C) Q(D) S(E) P(G) P(H) Q(I) R(J) R(K) #ifdef(F) P(1) #else P(0) #end)", "1.000000000000|3.000000000000|4.000000000,5.000000000,6.000000000|hi|-7.000000000000|8.000000000000|1.000000000,2.000000000,0.000000000|1.000000000,2.000000000,3.000000000,4.000000000,0.000000000|1.000000000,2.000000000,3.000000000,4.000000000,5.000000000|0.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"1,2") #fclose F #fopen F "t3.txt" read #read(F,A,B,C) P(A) P(B) #ifdef(C) P(1) #else P(0) #end #ifdef(F) P(1) #else P(0) #end)", "1.000000000000|2.000000000000|0.000000000000|0.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"1,2\n") #fclose F #fopen F "t3.txt" read #while(defined(F)) #read(F,A) P(A) #end)", "1.000000000000|2.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"1,2,") #fclose F #fopen F "t3.txt" read #while(defined(F)) #read(F,A) P(A) #end)", "1.000000000000|2.000000000000|2.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"1,2,") #fclose F #fopen F "t3.txt" append #write(F,"3,4") #fclose F #fopen F "t3.txt" read #while(defined(F)) #read(F,A) P(A) #end)", "1.000000000000|2.000000000000|3.000000000000|4.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"1 // c\n /* x */ , 2\n") #fclose F #fopen F "t3.txt" read #while(defined(F)) #read(F,A) P(A) #end)", "1.000000000000|2.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"<1 2 3>,<-4,+5,-6>\n") #fclose F #fopen F "t3.txt" read #while(defined(F)) #read(F,A) Q(A) #end)", "1.000000000,2.000000000,3.000000000|-4.000000000,5.000000000,-6.000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"1,2\n") #fclose F #fopen F "t3.txt" read #read(F A B) P(A))", "1.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"1,2\n") #fclose F #fopen F "t3.txt" read #declare A="s"; #read(F,A,B) P(A))", "1.000000000000"},
    {R"(#fopen F concat("t","3.txt") write #write(F,1,"\n") #fclose F #fopen F "t3.txt" read #read(F,A) P(A) #ifdef(F) P(1) #end)", "1.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"\"a,b\", \"c\\\"d\"\n") #fclose F #fopen F "t3.txt" read #while(defined(F)) #read(F,A) S(A) #end)", R"(a,b|c"d)"},
    {R"(#fopen F "t3.txt" write #write(F,"- 5, 1e3, .5, 5., -.5e-1\n") #fclose F #fopen F "t3.txt" read #while(defined(F)) #read(F,A) P(A) #end)", "-5.000000000000|1000.000000000000|0.500000000000|5.000000000000|-0.050000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"5,\n\n\n") #fclose F #fopen F "t3.txt" read #read(F,A) P(A) #ifdef(F) P(1) #end)", "5.000000000000|1.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"7,8") #fclose F #declare B=3; #fopen F "t3.txt" read #read(F,A,A,B) P(A) P(B))", "8.000000000000|3.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F,"\"",1,2,"|",<1,2>,<1,2,3,4,5>,"|",1/3,"|",1e20,"|",1e-20,"|",-0.5,"|",100000000,"|",123456.789,"|",1.0000001,"\"") #fclose F #fopen F "t3.txt" read #read(F,A) S(A))", "12|<1,2> <1,2,3,4,5> |0.333333|1e+20|1e-20|-0.5|1e+08|123457|1"},
    {R"(#fopen F "t3.txt" write #declare I=1/0; #write(F,"\"",I,"|",pi,"|",0.1+0.2,"|",1234567,"|",0.0001,"|",0.00001,"|",true,"|",x,"\"") #fclose F #fopen F "t3.txt" read #read(F,A) S(A))", "inf|3.14159|0.3|1.23457e+06|0.0001|1e-05|1|<1,0,0> "},
    {R"(#fopen F "t3.txt" write #write(F,"\"",concat("a","b"),str(3,0,1),vlength(<3,4,0>),2*<1,2,3>,"|" 1 2 "a","\"") #fclose F #fopen F "t3.txt" read #read(F,A) S(A))", "ab3.05<2,4,6> |12a"},
    {R"(#macro M() #fopen F "w2.txt" write #end M() #ifdef(F) P(1) #write(F,"5") #else P(0) #end)", "1.000000000000"},
    {R"(#macro M() #read(F,A) P(1) #end #fopen F "w1.txt" write #write(F,"7,8,9") #fclose F #fopen F "w1.txt" read M() #ifdef(A) P(A) #else P(0) #end)", "1.000000000000|7.000000000000"},
    {R"(#macro M() #local A=0; #read(F,A) #end #fopen F "w1.txt" write #write(F,"7,8,9") #fclose F #fopen F "w1.txt" read M() #ifdef(A) P(A) #else P(0) #end)", "0.000000000000"},
    {R"(#macro M(A) #read(F,A) #end #fopen F "w1.txt" write #write(F,"7,8,9") #fclose F #declare Z=1; #fopen F "w1.txt" read M(Z) P(Z))", "7.000000000000"},
    {R"(#fopen F "w1.txt" write #write(F,"7,8,9") #fclose F #fopen F "w1.txt" read #fopen G "w1.txt" read #read(F,A) #read(G,B) P(A) P(B) #read(F,A) P(A))", "7.000000000000|7.000000000000|8.000000000000"},
    {R"(#fopen F "w1.txt" write #write(F,"7") #fclose F #fopen F "w1.txt" read #read(F,A) #fclose F P(defined(F)))", "0.000000000000"},
    {R"(#fopen F "w1.txt" write #write(F,"1,2,3") #fclose F #fopen F "w1.txt" read #read(F,A,) P(A) #read(F,A) P(A))", "1.000000000000|2.000000000000"},
    {R"(#fopen F "t3.txt" write #write(F) #fclose F P(1))", "1.000000000000"},
    {R"(#fopen F "t3.txt" write #undef F #ifdef(F) P(1) #else P(0) #end)", "0.000000000000"},
    {"#fclose F P(1)", "1.000000000000"},
    // clang-format on
};

/// A folder that is removed with its contents; the folder `out` in it may be written to.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("vestige-data-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path / "out"); }
  ~Folder() { fs::remove_all(path); }

  Options options(bool writes = true) const {
    Options o;
    o.writeFolder = (path / "out").string();
    o.writes = writes;
    return o;
  }
  std::string contents(const std::string& name) const {
    std::ifstream in(path / name);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
  }
  int files() const {
    const auto all = fs::recursive_directory_iterator(path);
    return int(
        std::count_if(begin(all), end(all), [](const auto& e) { return !e.is_directory(); }));
  }
};

}  // namespace

TEST_CASE("files of data are POV-Ray's", "[lang]") {
  const Folder folder;
  checkRows(kRows, folder.options(false));
  CHECK(folder.files() == 0);
}

TEST_CASE("#write makes files where the program says", "[lang]") {
  const Folder folder;
  const std::string text = R"(#fopen F "a.txt" write #write(F, 1, ",", <1, 2>, "\n") #fclose F)";
  CHECK(debugOf(text, folder.options()) == "");
  CHECK(folder.contents("out/a.txt") == "1,<1,2> \n");
  CHECK(debugOf(R"(#fopen F "a.txt" append #write(F, "more"))", folder.options()) == "");
  CHECK(folder.contents("out/a.txt") == "1,<1,2> \nmore");  // closed at the end
  CHECK(debugOf(R"(#fopen F "a.txt" write #write(F, "new") #error "stop")", folder.options()) ==
        "error: stop\n");
  CHECK(folder.contents("out/a.txt") == "new");
  CHECK(folder.files() == 1);
}

TEST_CASE("without a folder nothing is written", "[lang]") {
  CHECK(debugOf(R"(#fopen F "a.txt" write #write(F, 1) #fclose F)") ==
        "error: this scene writes the file 'a.txt': --write-folder DIR allows it, in that folder "
        "only\n");
  CHECK(!fs::exists("a.txt"));
}

TEST_CASE("#write leaves its folder on no path", "[lang]") {
  const Folder folder;
  folder.put("secret.txt", "old");
  fs::create_directory_symlink(folder.path, folder.path / "out/up");
  fs::create_symlink(folder.path / "secret.txt", folder.path / "out/link.txt");
  fs::create_symlink(folder.path / "made.txt", folder.path / "out/dangling.txt");
  fs::create_directory(folder.path / "out/sub");
  const int before = folder.files();
  const std::string outside = (folder.path / "made.txt").string();
  for (const std::string& name :
       {std::string("../made.txt"), std::string("sub/../../made.txt"), outside,
        std::string("up/made.txt"), std::string("up/secret.txt"), std::string("link.txt"),
        std::string("dangling.txt"), std::string("sub"), std::string("."), std::string("none/a"),
        std::string("")}) {
    INFO(name);
    const std::string said =
        debugOf("#fopen F \"" + name + "\" write #write(F, \"new\") #fclose F", folder.options());
    CHECK(said.find("error: ") == 0);
    const std::string appended =
        debugOf("#fopen F \"" + name + "\" append #write(F, \"new\") #fclose F", folder.options());
    CHECK(appended.find("error: ") == 0);
  }
  CHECK(folder.contents("secret.txt") == "old");
  CHECK(folder.files() == before);
  CHECK(debugOf(R"(#fopen F "sub/a.txt" write #write(F, 1))", folder.options()) == "");
  CHECK(folder.contents("out/sub/a.txt") == "1");
}

TEST_CASE("what is written can be read back without touching the disk", "[lang]") {
  const Folder folder;
  folder.put("out/a.txt", "1,2");
  const std::string read = R"(#fopen F "a.txt" read #read(F, A) #debug str(A, 0, 0) #fclose F )";
  const std::string write = R"(#fopen F "a.txt" write #write(F, 7) #fclose F )";
  CHECK(debugOf(read + write + read, folder.options(false)) == "17");
  CHECK(folder.contents("out/a.txt") == "1,2");
  CHECK(debugOf(R"(#fopen F "b.txt" write #debug str(file_exists("b.txt"), 0, 0) #fclose F
    #debug str(file_exists("b.txt"), 0, 0))",
                folder.options(false)) == "01");
}

TEST_CASE("reading follows the rules of includes", "[lang]") {
  const Folder folder;
  folder.put("secret.txt", "42");
  Options options;
  options.sandbox = true;
  const std::string path = (folder.path / "secret.txt").string();
  const std::string text = "#fopen F \"" + path + "\" read #read(F, A) #debug str(A, 0, 0)";
  CHECK(debugOf(text, options).find("--sandbox forbids") != std::string::npos);
  CHECK(debugOf(text) == "42");
  CHECK(debugOf(R"(#fopen F "/dev/zero" read)").find("error: ") == 0);
  CHECK(debugOf("#fopen F \"" + folder.path.string() + "\" read").find("error: ") == 0);
  fs::create_symlink(folder.path / "secret.txt", folder.path / "out/link.txt");
  Options boxed = folder.options();
  boxed.sandbox = true;
  CHECK(debugOf(R"(#fopen F "link.txt" read)", boxed).find("error: ") == 0);
}

TEST_CASE("data count against the limits", "[lang]") {
  const Folder folder;
  Options options = folder.options(false);
  options.limits.memory = 8 << 20;
  CHECK(debugOf(R"(#fopen F "a.txt" write #declare L = "0123456789"; #for (I, 1, 6)
    #declare L = concat(L, L, L, L, L, L); #end #while (1) #write(F, L) #end)",
                options)
            .find("--max-memory") != std::string::npos);
  options.limits.expandedTokens = 100'000;
  CHECK(debugOf(R"(#while (1) #fopen F "a.txt" write #fclose F #end)", options)
            .find("--max-tokens") != std::string::npos);
  CHECK(debugOf(R"(#fopen F "a.txt" write #for (I, 1, 3000) #write(F, "1,2,3,4,5,6,7,8,9,") #end
    #fclose F #while (1) #fopen F "a.txt" read #read(F, A) #fclose F #end)",
                options)
            .find("--max-tokens") != std::string::npos);
}

TEST_CASE("a closed file stays closed for parameters of macros", "[lang]") {
  const Folder folder;
  CHECK(debugOf(R"(#fopen F "a.txt" write #write(F, "1,2") #fclose F
    #macro Next(File) #read(File, A) #debug str(A, 0, 0) #end
    #fopen G "a.txt" read #while (defined(G)) Next(G) #end #debug "end")",
                folder.options(false)) == "12end");
}

}  // namespace vestige::lang::test
