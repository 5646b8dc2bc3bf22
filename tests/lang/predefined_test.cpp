// SPDX-License-Identifier: Apache-2.0
// Names that are there before the text, and dates. The rows were run as those of povray_test.cpp
// (so image_width is 8 there, and given here).
#include "support/catch.h"

#include "tests/lang/oracle.h"

namespace vestige::lang::test {
namespace {

const Row kRows[] = {
    // clang-format off
    {"P(clock) P(clock_delta) P(clock_on) P(frame_number) P(initial_frame) P(final_frame) P(initial_clock) P(final_clock)", "0.000000000000|0.000000000000|0.000000000000|0.000000000000|0.000000000000|0.000000000000|0.000000000000|0.000000000000"},
    {"P(image_width) P(image_height)", "8.000000000000|8.000000000000"},
    {"#local frame_number=3; P(frame_number)", "3.000000000000"},
    {"#declare initial_clock=1; P(initial_clock)", "1.000000000000"},
    {R"(#declare input_file_name="x"; S(input_file_name))", "x"},
    {"P(defined(input_file_name)) P(defined(clock_on)) P(defined(now)) P(defined(final_clock)) P(defined(clock_delta)) P(defined(initial_frame))", "1.000000000000|0.000000000000|0.000000000000|1.000000000000|1.000000000000|1.000000000000"},
    {"#undef frame_number P(defined(frame_number))", "0.000000000000"},
    {"#declare F=function(a){a+clock+image_width}; P(F(1))", "9.000000000000"},
    {"S(datetime(0))", "2000-01-01 00:00:00Z"},
    {"S(datetime(-3.75))", "1999-12-28 06:00:00Z"},
    {"S(datetime(-36525))", "1899-12-31 00:00:00Z"},
    {"S(datetime(1e6))", "4737-11-28 00:00:00Z"},
    {"S(datetime(0.999995))", "2000-01-02 00:00:00Z"},
    {"S(datetime(-219145))", "1400-01-01 00:00:00Z"},
    {"S(datetime(2932896-10957+0.5))", "9999-12-31 12:00:00Z"},
    {"S(datetime(now-now+1.5,\"%Y\"))", "2000"},
    {R"(S(datetime(0,"%c|%x|%X|%p|%j|%a|%A|%b|%B")))", "Sat Jan  1 00:00:00 2000|01/01/00|00:00:00|AM|001|Sat|Saturday|Jan|January"},
    {R"(S(datetime(7638.5123,"%U|%w|%y|%Z|%%|%C|%e")))", "48|0|20||%|20|29"},
    {R"(S(datetime(7638.5123,"%z|%h|%I|%M|%R|%s|%V|%u|%G|%g|%W|%t|")))", "|Nov|12|17|12:17|1606652263|48|7|2020|20|47|\t|"},
    {R"(S(datetime(7638.5123,"%D %F %T %q")))", "11/29/20 2020-11-29 12:17:43 %q"},
    {R"(S(datetime(-200000.25,"%c|%s|%y|%C|%G-%V")))", "Tue Jun  1 18:00:00 1452|-16333336800|52|14|1452-23"},
    {R"(S(datetime(0,"%")))", "%"},
    {R"(S(datetime(10, concat("%","Y"))))", "2000"},
    {R"(S(datetime(0.00000578,"%T")) S(datetime(0.00000579,"%T")) S(datetime(-0.00000001,"%T")))", "00:00:00|00:00:01|00:00:00"},
    // clang-format on
};

Options withSize(int width, int height) {
  Options options;
  options.imageWidth = width, options.imageHeight = height;
  return options;
}

}  // namespace

TEST_CASE("names before the text and dates have POV-Ray's values", "[lang]") {
  checkRows(kRows, withSize(8, 8));
}

TEST_CASE("the time runs, and can be given", "[lang]") {
  CHECK(debugOf(R"(#declare A = now; #for (I, 1, 1000) #end
    #if (now >= A & A > 9000 & A < 100000) #debug "later" #end)") == "later");
  Options options;
  options.definitions = {{"now", "9132.5"}, {"clock", "0.25"}, {"frame_number", "7"}};
  CHECK(debugOf(R"(#debug concat(datetime(now), " ", str(clock + clock_on + frame_number, 0, 2)))",
                options) == "2025-01-01 12:00:00Z 8.25");
}

TEST_CASE("the picture's size is the program's, else the film's", "[lang]") {
  const std::string size = R"(#debug concat(vstr(2, <image_width, image_height>, "x", 0, 0), " "))";
  const std::string film = " film { resolution <300, 200> } ";
  CHECK(debugOf(size + film + size) == "640x480 300x200 ");
  CHECK(debugOf(size + film + size, withSize(600, 0)) == "600x450 600x400 ");
  CHECK(debugOf(size + film + size, withSize(0, 100)) == "133x100 150x100 ");
  CHECK(debugOf(size + film + size, withSize(10, 20)) == "10x20 10x20 ");
  CHECK(debugOf("#declare image_width = 5;" + film + size) == "5x200 ");
  CHECK(debugOf("#debug input_file_name") == "test.scene");
}

}  // namespace vestige::lang::test
